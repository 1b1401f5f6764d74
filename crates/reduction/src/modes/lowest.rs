//! Lowest elastic frequency of a gear.

use std::f64::consts::TAU;

use faer::Mat;

use super::{
    held::{Held, Rows, on_rows},
    krylov::{Until, lowest},
    pencil::Pencil,
    whole::Whole,
};
use crate::{GearReducer, ReductionError, Window, cyclic::CyclicGear, load::Load, reducer::Method};

/// Lowest elastic frequencies of a gear held at its bore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LowestFrequencies {
    /// With all flanks free, Hz. From this frequency on the gear's compliance differs from the static one.
    pub flanks_free_hz: f64,
    /// With the coordinates of the window held, Hz: the lowest fixed-boundary mode (Craig and Bampton, AIAA J. 6(7),
    /// 1968, p. 1313). It limits the validity of an approximation that keeps the inertia M^ of the window's
    /// coordinates. Never below `flanks_free_hz`.
    pub flanks_held_hz: f64,
}

/// Columns of a Lanczos step.
const BLOCK: usize = 6;

impl GearReducer {
    /// Lowest frequencies of the gear with its bore held: with all flanks free, and with those of the first window
    /// held.
    ///
    /// # Errors
    /// Those of [`GearReducer::modes`]; [`ReductionError::NotPositiveDefinite`] for a grid with more nodes than the
    /// mesh can resolve.
    pub fn lowest_frequencies(&self) -> Result<LowestFrequencies, ReductionError> {
        let flanks_free_hz = self.lowest_elastic_hz()?;
        let window = Window { reduced: self.base.clone(), shift: 0 };
        let (loads, compliance) = (self.loads(&window)?, window.reduced.compliance());
        let square = match self.method()? {
            Method::Cyclic(cyclic) => {
                let sector = cyclic.vibrating()?;
                let ring = sector.ring()?;
                let rows = sector.dofs().free_count();
                let row = |node: u32, axis: usize| {
                    let place = cyclic.place(node)?;
                    Some(place.copy as usize * rows + sector.dofs().dof(place.node, axis)?)
                };
                // Vectors are in the frames of their sectors, the window's compliance is in its own.
                let copies: Vec<u32> = loads.iter().map(|l| first_copy(l, cyclic)).collect();
                held(&ring, on_rows(&loads, row), &turned(compliance, &copies, |k| self.gear().pitches_on(k)))?
            }
            Method::General(gear, _) => {
                let mass = fem::assemble_mass(self.gear().mesh(), self.material(), self.dofs())?;
                held(&Whole { gear, mass }, on_rows(&loads, |node, axis| self.dofs().dof(node, axis)), compliance)?
            }
        };
        Ok(LowestFrequencies { flanks_free_hz, flanks_held_hz: square.sqrt() / TAU })
    }
}

fn held(body: &dyn Pencil, loads: Vec<Rows>, compliance: &Mat<f64>) -> Result<f64, ReductionError> {
    let pairs = lowest(&Held::with_compliance(body, loads, compliance)?, Until::Count(1), BLOCK)?;
    Ok(pairs.squares.first().copied().unwrap_or(f64::INFINITY))
}

/// The copy of the sector that a load of a cyclic gear is in.
fn first_copy(load: &Load, cyclic: &CyclicGear) -> u32 {
    load.first().and_then(|&(node, _)| cyclic.place(node)).map_or(0, |place| place.copy)
}

/// C with every node's directions turned from the window's frame into that of its sector.
fn turned(compliance: &Mat<f64>, copies: &[u32], angle: impl Fn(u32) -> f64) -> Mat<f64> {
    let turns: Vec<[f64; 2]> = copies.iter().map(|&k| angle(k).sin_cos().into()).collect();
    // Rows, then columns by symmetry: u_sector = turn' u_window.
    let once = |c: &Mat<f64>| {
        Mat::from_fn(c.ncols(), c.nrows(), |j, i| {
            let ([sin, cos], at) = (turns[i / 3], i - i % 3);
            match i % 3 {
                0 => cos * c[(at, j)] + sin * c[(at + 1, j)],
                1 => cos * c[(at + 1, j)] - sin * c[(at, j)],
                _ => c[(i, j)],
            }
        })
    };
    once(&once(compliance))
}
