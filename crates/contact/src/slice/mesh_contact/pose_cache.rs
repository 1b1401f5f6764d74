//! Contact in the pose bins that were visited before.

use super::{pose_bin::PoseBin, pose_contact::PoseContact};

/// Largest size of the cache, bytes, and its largest number of bins: those of the steps of a mesh cycle and of their
/// middles.
const CACHE_BYTES: usize = 48 << 20;
const CACHE_BINS: usize = 512;

/// What was found in other cells than the one that serves now.
#[derive(Debug, Default)]
pub(super) struct PoseCache {
    bins: Vec<PoseContact>,
    /// Which one served before, and which one has to go next.
    last: usize,
    next: usize,
}

impl PoseCache {
    /// Forgets all.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Forgets which one served before.
    pub fn start(&mut self) {
        self.last = usize::MAX;
    }

    /// The one that served before.
    pub fn last(&self) -> Option<&PoseContact> {
        self.bins.get(self.last)
    }

    /// Makes the one that served before serve again, `now` being the one that does.
    pub fn swap_back(&mut self, now: &mut PoseContact) {
        if let Some(last) = self.bins.get_mut(self.last) {
            std::mem::swap(last, now);
        }
    }

    /// Brings out what was found in a cell; whether there is anything.
    pub fn recall(&mut self, bin: &PoseBin, now: &mut PoseContact) -> bool {
        let Some(point) = self.bins.iter().position(|contact| contact.bin.as_ref() == Some(bin)) else { return false };
        std::mem::swap(&mut self.bins[point], now);
        self.last = point;
        true
    }

    /// Puts `now` away, so that it can be filled with something else.
    pub fn put_away(&mut self, now: &mut PoseContact) {
        let bytes: usize = self.bins.first().map_or(0, PoseContact::bytes);
        let most = (CACHE_BYTES / bytes.max(1)).clamp(2, CACHE_BINS);
        if self.bins.len() < most {
            self.last = self.bins.len();
            // As much room as the last one took: the next one is of the same size.
            let next = PoseContact::with_capacity(now.rows.len() + 8);
            self.bins.push(std::mem::replace(now, next));
        } else {
            // The one that served before may be asked for again within a step.
            self.next = (self.next + 1) % most;
            self.last = self.next;
            std::mem::swap(&mut self.bins[self.next], now);
        }
    }
}
