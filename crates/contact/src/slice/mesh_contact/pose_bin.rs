//! Cells of a lattice over the poses: what was found in the middle of one serves the whole of it, and whoever comes again finds it there.
//!
//! The middle depends on the cell alone and not on who came first. So what is kept is memory of a pure function: with it or without, results are the same to the last bit.

use nalgebra::{Quaternion, Translation3, UnitQuaternion, Vector3};

use super::found::{Found, NEAR};
use crate::{ModalFlanks, Pose};

/// Side of a cell as the flanks move over it, mm. Compliance differs by some 1e-9 of itself over it, gaps by less: what a tooth change does to the sum of forces, whose frames have cells of their own, is below 1e-9 of it.
const SIDE: f64 = 1e-8;
/// What is kept at most, bytes, and how many cells: steps of a mesh cycle, their middles among them.
const MOST_BYTES: usize = 48 << 20;
const MOST: usize = 512;

/// Number of a cell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Cell {
    /// Translation and quaternion of both gears.
    poses: [[i64; 7]; 2],
    /// Opening of gaps by modes that is reckoned with: a power of two times [`NEAR`].
    reach: i32,
    /// Amplitudes of the modes.
    amplitudes: Vec<i64>,
}

impl Cell {
    /// The cell that some poses are in; `radius` (mm) is that of the larger gear's tip.
    pub fn of(poses: &[Pose; 2], radius: f64, modal: Option<&ModalFlanks>) -> Self {
        let round = |x: f64| x.round() as i64;
        let poses = poses.each_ref().map(|pose| {
            let (t, r) = (pose.translation.vector / SIDE, pose.rotation.into_inner().coords * (radius / SIDE));
            [t.x, t.y, t.z, r.x, r.y, r.z, r.w].map(round)
        });
        let Some(modal) = modal else { return Self { poses, reach: 0, amplitudes: Vec::new() } };
        let reach = (modal.largest() / NEAR + 1.0).log2().ceil() as i32;
        let amplitudes = modal.amplitudes().iter().zip(modal.sizes()).map(|(a, size)| round(a * size / SIDE)).collect();
        Self { poses, reach, amplitudes }
    }

    /// Poses in the middle.
    pub fn middle(&self, radius: f64) -> [Pose; 2] {
        self.poses.map(|[x, y, z, i, j, k, w]| {
            let place = Vector3::new(x as f64, y as f64, z as f64) * SIDE;
            let [w, i, j, k] = [w, i, j, k].map(|c| c as f64 * (SIDE / radius));
            Pose::from_parts(Translation3::from(place), UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k)))
        })
    }

    /// Amplitudes of the modes in the middle.
    pub fn amplitudes(&self, modal: &ModalFlanks) -> Vec<f64> {
        self.amplitudes.iter().zip(modal.sizes()).map(|(&n, size)| n as f64 * SIDE / size).collect()
    }

    /// Opening of gaps by modes, mm, that is reckoned with.
    pub fn reach(&self) -> f64 {
        NEAR * f64::from(self.reach).exp2()
    }
}

/// What was found in other cells than the one that serves now.
#[derive(Debug, Default)]
pub(super) struct Kept {
    cells: Vec<Found>,
    /// Which one served before, and which one has to go next.
    last: usize,
    next: usize,
}

impl Kept {
    /// Forgets all.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Forgets which one served before.
    pub fn start(&mut self) {
        self.last = usize::MAX;
    }

    /// The one that served before.
    pub fn last(&self) -> Option<&Found> {
        self.cells.get(self.last)
    }

    /// Makes the one that served before serve again, `now` being the one that does.
    pub fn go_back(&mut self, now: &mut Found) {
        if let Some(last) = self.cells.get_mut(self.last) {
            std::mem::swap(last, now);
        }
    }

    /// Brings out what was found in a cell; whether there is anything.
    pub fn bring(&mut self, cell: &Cell, now: &mut Found) -> bool {
        let Some(place) = self.cells.iter().position(|found| found.cell.as_ref() == Some(cell)) else { return false };
        std::mem::swap(&mut self.cells[place], now);
        self.last = place;
        true
    }

    /// Puts `now` away, so that it can be filled with something else.
    pub fn put_away(&mut self, now: &mut Found) {
        let bytes: usize = self.cells.first().map_or(0, Found::bytes);
        let most = (MOST_BYTES / bytes.max(1)).clamp(2, MOST);
        if self.cells.len() < most {
            self.last = self.cells.len();
            // As much room as the last one took: the next one is of the same size.
            let next = Found::with_capacity(now.rows.len() + 8);
            self.cells.push(std::mem::replace(now, next));
        } else {
            // The one that served before may be asked for again within a step.
            self.next = (self.next + 1) % most;
            self.last = self.next;
            std::mem::swap(&mut self.cells[self.next], now);
        }
    }
}
