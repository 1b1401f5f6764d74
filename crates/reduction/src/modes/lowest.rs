//! How slow is the slowest elastic motion of a gear?

use std::f64::consts::TAU;

use super::{
    choice::ModeChoice,
    held::Held,
    krylov::{Pencil, Until, lowest},
    whole::Whole,
};
use crate::{GearReducer, ReductionError, Window, reducer::Method};

/// Lowest elastic frequencies of a gear that is held at its bore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LowestFrequencies {
    /// With all flanks free, Hz: from here on the gear's compliance is not its static one any more.
    pub flanks_free_hz: f64,
    /// With the coordinates of the window held, Hz: the lowest fixed-boundary mode (Craig and Bampton, AIAA J. 6(7), 1968, p. 1313), which bounds an approximation that
    /// keeps the inertia M^ of the window's coordinates. Never below the other one.
    pub flanks_held_hz: f64,
}

/// Columns of a Lanczos step.
const BLOCK: usize = 6;

impl GearReducer {
    /// Lowest frequencies of the gear, its bore held, flanks free and those of the first window held.
    ///
    /// # Errors
    /// As [`GearReducer::modes`]; [`ReductionError::NotPositiveDefinite`] for a grid with more nodes than the mesh can tell apart.
    pub fn lowest_frequencies(&self) -> Result<LowestFrequencies, ReductionError> {
        let free = self.modes(ModeChoice::Count(1))?;
        let flanks_free_hz = free.frequencies_hz().first().copied().unwrap_or(f64::INFINITY);
        let window = Window { reduced: self.base.clone(), shift: 0 };
        let loads = self.loads(&window)?;
        let square = match self.method()? {
            Method::Cyclic(cyclic) => {
                let sector = cyclic.vibrating()?;
                let ring = sector.ring()?;
                let rows = sector.dofs().free_count();
                // Every direction of the window's frame is one of the sector's: all three are held.
                let of_load = |load: &Vec<(u32, f64)>, axis: usize| {
                    let row = |&(node, w): &(u32, f64)| {
                        let place = cyclic.place(node)?;
                        Some((place.copy as usize * rows + sector.dofs().dof(place.node, axis)?, w))
                    };
                    load.iter().filter_map(row).collect::<Vec<_>>()
                };
                let loads = loads.iter().flat_map(|l| (0..3).map(move |axis| of_load(l, axis))).collect();
                held(&ring, loads)?
            }
            Method::General(gear, _) => {
                let mass = fem::assemble_mass(self.gear().mesh(), self.material(), self.dofs())?;
                let row = |&(node, w): &(u32, f64), axis| self.dofs().dof(node, axis).map(|row| (row, w));
                let of_load =
                    |load: &Vec<(u32, f64)>, axis| load.iter().filter_map(|part| row(part, axis)).collect::<Vec<_>>();
                let loads = loads.iter().flat_map(|l| (0..3).map(move |axis| of_load(l, axis))).collect();
                held(&Whole { gear, mass }, loads)?
            }
        };
        Ok(LowestFrequencies { flanks_free_hz, flanks_held_hz: square.sqrt() / TAU })
    }
}

fn held(body: &dyn Pencil, loads: Vec<Vec<(usize, f64)>>) -> Result<f64, ReductionError> {
    let body = Held::new(body, loads, None)?;
    let pairs = lowest(&body, Until::Count(1), BLOCK)?;
    Ok(pairs.squares.first().copied().unwrap_or(f64::INFINITY))
}
