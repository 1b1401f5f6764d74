//! Contact in the pose bins visited before.

use super::{pose_bin::PoseBin, pose_contact::PoseContact};

/// Largest size of the cache, bytes, and its largest number of bins. The bins of a mesh cycle are those of its steps
/// and of the middles of its steps.
const CACHE_BYTES: usize = 48 << 20;
const CACHE_BINS: usize = 512;

/// Contact in the bins other than the current one.
#[derive(Debug, Default)]
pub(super) struct PoseCache {
    bins: Vec<PoseContact>,
    /// Index of the previous bin, and of the one to be replaced last.
    last: usize,
    next: usize,
}

impl PoseCache {
    /// Empties the cache.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Forgets the previous bin.
    pub fn start(&mut self) {
        self.last = usize::MAX;
    }

    /// Contact in the previous bin.
    pub fn last(&self) -> Option<&PoseContact> {
        self.bins.get(self.last)
    }

    /// Makes the previous bin the current one; `now` holds the current one.
    pub fn swap_back(&mut self, now: &mut PoseContact) {
        if let Some(last) = self.bins.get_mut(self.last) {
            std::mem::swap(last, now);
        }
    }

    /// Makes `bin` the current one; returns false if the cache does not contain it.
    pub fn recall(&mut self, bin: &PoseBin, now: &mut PoseContact) -> bool {
        let Some(point) = self.bins.iter().position(|contact| contact.bin.as_ref() == Some(bin)) else { return false };
        std::mem::swap(&mut self.bins[point], now);
        self.last = point;
        true
    }

    /// Stores `now`, so that it can be filled for another bin.
    pub fn put_away(&mut self, now: &mut PoseContact) {
        let bytes: usize = self.bins.first().map_or(0, PoseContact::bytes);
        let most = (CACHE_BYTES / bytes.max(1)).clamp(2, CACHE_BINS);
        if self.bins.len() < most {
            self.last = self.bins.len();
            // The next bin has about as many rows as the last one.
            let next = PoseContact::with_capacity(now.rows.len() + 8);
            self.bins.push(std::mem::replace(now, next));
        } else {
            // The previous bin may be asked for again within a step: it is not replaced.
            self.next = (self.next + 1) % most;
            self.last = self.next;
            std::mem::swap(&mut self.bins[self.next], now);
        }
    }
}
