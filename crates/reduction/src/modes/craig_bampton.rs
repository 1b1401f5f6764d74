//! Constraint modes and fixed-boundary modes, which keep the inertia of the flanks. Theory (60).

use faer::Mat;
use fem::dense;

use super::{
    choice::ModeChoice,
    gear_modes::{GearModes, HARMONIC_BLOCK, WHOLE_BLOCK, of_harmonics, of_whole},
    held::{Held, Rows, on_rows},
    krylov::{Eigenpairs, Until, lowest},
    pencil::Pencil,
    whole::Whole,
};
use crate::{GearReducer, ReductionError, load::Load, reducer::Method};

/// Coordinates of a boundary at most, of one harmonic or of a gear that is not cyclic.
const MOST_COORDINATES: usize = 6000;

impl GearReducer {
    /// Normal modes of the gear in the space of its flank coordinates and several fixed-boundary modes.
    ///
    /// ```text
    /// u = Psi u_B + Phi_f eta,   K^ = diag(C_B^-1, Omega_f^2),   M^ = [Psi Phi_f]' M [Psi Phi_f]
    /// ```
    /// B are the kept flanks of **every** tooth, so the result belongs to the gear and not to a window. Psi are the
    /// constraint modes, by harmonics for a cyclic gear, all at once for any other. Phi_f are the `fixed` lowest modes
    /// with these flanks held, per harmonic (for a gear that is not cyclic: in total). The method returns the
    /// eigenvectors of (K^, M^). Their frequencies converge to those of the gear from above as the number of fixed
    /// modes grows. All of them together have the full compliance of the flanks and their consistent mass. Source:
    /// Craig and Bampton, AIAA J. 6(7), 1968, p. 1313.
    ///
    /// # Errors
    /// [`ReductionError::LargeBoundary`]; those of [`GearReducer::modes`] and [`GearReducer::lowest_frequencies`].
    pub fn craig_bampton_modes(&self, choice: ModeChoice, fixed: usize) -> Result<GearModes, ReductionError> {
        match self.method()? {
            Method::Cyclic(cyclic) => {
                let sector = cyclic.vibrating()?;
                let (dofs, z) = (sector.dofs(), sector.teeth);
                let rows = dofs.free_count();
                let loads = cyclic.own_loads(&self.loads_of(&self.base.teeth)?);
                let of_wave = |waves: u32| {
                    let harmonic = sector.harmonic(waves)?;
                    let row = |p: usize| move |n, axis| Some(p * rows + dofs.dof(n, axis)?);
                    let loads = (0..harmonic.parts()).flat_map(|p| on_rows(&loads, row(p))).collect();
                    reduced_modes(&harmonic, loads, harmonic.parts() * fixed, HARMONIC_BLOCK, choice)
                };
                // One after the other: each holds its constraint modes.
                let found = (0..=z / 2).map(of_wave).collect::<Result<Vec<_>, _>>()?;
                of_harmonics(&sector, self.material(), choice, &found)
            }
            Method::General(gear, _) => {
                let mass = fem::assemble_mass(self.gear().mesh(), self.material(), self.dofs())?;
                let loads = on_rows(&self.loads_of(&self.gear().teeth())?, |n, axis| self.dofs().dof(n, axis));
                of_whole(self, choice, reduced_modes(&Whole { gear, mass }, loads, fixed, WHOLE_BLOCK, choice)?)
            }
        }
    }

    fn loads_of(&self, teeth: &[u32]) -> Result<Vec<Load>, ReductionError> {
        self.coordinates().loads(self.gear(), teeth, &self.base.sides)
    }
}

/// Eigenvectors of the Craig-Bampton matrices, those that `choice` may want.
fn reduced_modes(
    body: &dyn Pencil,
    loads: Vec<Rows>,
    fixed: usize,
    block: usize,
    choice: ModeChoice,
) -> Result<Eigenpairs, ReductionError> {
    if loads.len() > MOST_COORDINATES {
        return Err(ReductionError::LargeBoundary { coordinates: loads.len(), most: MOST_COORDINATES });
    }
    let held = Held::new(body, loads)?;
    let constraint = held.constraint_modes()?;
    let inside = lowest(&held, Until::Count(fixed), block)?;
    // All of unit strain energy, and neither kind does work on the other: K^ = 1, and M^ has the eigenvalues 1 /
    // omega^2.
    let (b, n) = (constraint.ncols(), constraint.ncols() + inside.squares.len());
    let mut space = Mat::zeros(body.order(), n);
    space.as_mut().subcols_mut(0, b).copy_from(&constraint);
    for (j, square) in inside.squares.iter().enumerate() {
        space.as_mut().col_mut(b + j).copy_from(faer::Scale(1.0 / square.sqrt()) * inside.shapes.col(j));
    }
    let mass = dense::product(space.transpose(), body.inertia(space.as_ref())?.as_ref());
    let (theta, vectors) = dense::symmetric_eigen(mass.as_ref())?;
    let wanted = match choice.until() {
        Until::Count(count) => count.min(n),
        Until::First { .. } => n.min(1),
        Until::Below(square) => theta.iter().filter(|t| **t * square >= 1.0).count(),
    };
    let vectors = Mat::from_fn(n, wanted, |i, j| vectors[(i, n - 1 - j)] / theta[n - 1 - j].sqrt());
    let squares = theta.iter().rev().take(wanted).map(|t| 1.0 / t).collect();
    Ok(Eigenpairs { squares, shapes: dense::product(space.as_ref(), vectors.as_ref()) })
}
