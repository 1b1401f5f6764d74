//! How slow is the slowest elastic motion of a gear?

use std::f64::consts::TAU;

use super::{
    choice::ModeChoice,
    held::{Held, Rows, on_rows},
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
                // All three directions are held, so it does not matter whose frame they are in.
                let row = |node: u32, axis: usize| {
                    let place = cyclic.place(node)?;
                    Some(place.copy as usize * rows + sector.dofs().dof(place.node, axis)?)
                };
                held(&ring, on_rows(&loads, row))?
            }
            Method::General(gear, _) => {
                let mass = fem::assemble_mass(self.gear().mesh(), self.material(), self.dofs())?;
                held(&Whole { gear, mass }, on_rows(&loads, |node, axis| self.dofs().dof(node, axis)))?
            }
        };
        Ok(LowestFrequencies { flanks_free_hz, flanks_held_hz: square.sqrt() / TAU })
    }
}

fn held(body: &dyn Pencil, loads: Vec<Rows>) -> Result<f64, ReductionError> {
    let pairs = lowest(&Held::new(body, loads)?, Until::Count(1), BLOCK)?;
    Ok(pairs.squares.first().copied().unwrap_or(f64::INFINITY))
}
