//! The exact contact of gears with elastic modes, with these modes in equilibrium with it. Theory (61), (86a).

use std::sync::Arc;

use ale::ToothWindow;
use contact::{ContactError, ContactOptions, ContactSet, Pose, slice::MeshContact};
use geometry::GearPair;
use ltca::StaticError;
use nalgebra::{DMatrix, DVector};
use reduction::{ElasticGear, GearModes, StandingModes};

use crate::{GearboxError, ModalForces};

/// Steps of Newton's method at the most, and the last one over the displacements of the mesh, in the norm of the strain
/// energy.
const STEPS: usize = 60;
const SMALL: f64 = 1e-11;
/// Number of the turn of gear 2 among the displacements of both.
const TURN: usize = 11;

/// Contact whose compliance the modes have been taken out of, beside that of the gears at rest.
#[derive(Debug)]
pub(crate) struct ModalContact {
    contact: MeshContact,
    standing: [Option<StandingModes>; 2],
    counts: [usize; 2],
    /// omega^2 of all modes, gear 1's first.
    squares: DVector<f64>,
    /// p of the last solution.
    amplitudes: DVector<f64>,
}

impl ModalContact {
    pub fn new(
        pair: &GearPair,
        gears: &[ElasticGear; 2],
        window: &ToothWindow,
        modes: [Arc<GearModes>; 2],
        options: &ContactOptions,
    ) -> Result<Self, StaticError> {
        let mut contact = MeshContact::new(pair, ContactSet::new(pair, gears, window, options)?, options)?;
        let standing = modes.each_ref().map(|own| own.standing());
        let counts = modes.each_ref().map(|own| own.count());
        let squares = DVector::from_iterator(counts[0] + counts[1], modes.iter().flat_map(|m| m.squares()).copied());
        contact.keep_modes(gears, modes)?;
        let amplitudes = DVector::zeros(squares.len());
        Ok(Self { contact, standing, counts, squares, amplitudes })
    }

    pub fn enter_window(
        &mut self,
        pair: &GearPair,
        gears: &[ElasticGear; 2],
        window: &ToothWindow,
        options: &ContactOptions,
    ) -> Result<(), ContactError> {
        let set = self.contact.contact_set().clone();
        self.contact.enter_window(pair, gears, window, set, options)
    }

    /// Flanks and matrices of the window.
    pub fn contact_set(&self) -> &ContactSet {
        self.contact.contact_set()
    }

    /// e^(theta N) of both gears at their angles, m x m.
    fn turned(&self, angles: [f64; 2]) -> DMatrix<f64> {
        let mut all = DMatrix::identity(self.squares.len(), self.squares.len());
        for (g, at) in [(0, 0), (1, self.counts[0])] {
            if let Some(standing) = &self.standing[g] {
                all.view_mut((at, at), (self.counts[g], self.counts[g])).copy_from(&standing.turned(angles[g]));
            }
        }
        all
    }

    /// Forces with the frames of the matrices at `poses` and the gears' own frames at `angles` (rad, axes of the mesh),
    /// at the mode amplitudes that are in equilibrium with them.
    ///
    /// ```text
    /// Omega^2 q = H' F(d, q),   dq = (Omega^2 - T_qq)^-1 (H'F - Omega^2 q),   q = e^(theta N) p
    /// |dq| <= 1e-11 max(|q|, |M_2| / sqrt(-dM_2/d theta_2)),   |q|^2 = q' Omega^2 q
    /// ```
    /// Steps are measured by the strain energy of teeth and bodies under the moment M_2 on gear 2. Modes that the load
    /// does not excite, such as axial modes of spur gears, have none; their remaining amplitude is round-off of the
    /// contact.
    pub fn solve(
        &mut self,
        poses: &[Pose; 2],
        angles: [f64; 2],
        failed: impl Fn(ContactError) -> GearboxError,
    ) -> Result<ModalForces, GearboxError> {
        let turned = self.turned(angles);
        let m = self.squares.len();
        let energy = |x: &DVector<f64>| x.component_mul(x).dot(&self.squares).sqrt();
        let mut q = &turned * &self.amplitudes;
        let mut step = DVector::<f64>::zeros(m);
        let mut before = f64::INFINITY;
        let mut whole = 0.0;
        for _ in 0..STEPS {
            self.contact.deform(q.as_slice());
            self.contact.evaluate(poses).map_err(&failed)?;
            let Some(modal) = self.contact.modal() else { break };
            let pressed = DVector::from_column_slice(&modal.forces().normal);
            let left = pressed - self.squares.component_mul(&q);
            let size = left.component_mul(&left).component_div(&self.squares).sum().sqrt();
            let tangent = DMatrix::from_row_slice(12 + m, 12 + m, &modal.forces().tangent);
            let (moment, stiffness) = (self.contact.force().wrench[1].moment[2], -tangent[(TURN, TURN)]);
            let of_mesh = if stiffness > 0.0 { moment.abs() / stiffness.sqrt() } else { 0.0 };
            whole = of_mesh.max(energy(&q));
            if size > before && energy(&step) > SMALL * whole {
                // Another set of slices presses there: half of the way.
                step *= 0.5;
                q -= &step;
                continue;
            }
            before = size;
            let stiffness = DMatrix::from_diagonal(&self.squares) - tangent.view((12, 12), (m, m));
            let next = stiffness.lu().solve(&left).unwrap_or_else(|| DVector::zeros(m));
            if energy(&next) <= SMALL * whole {
                self.amplitudes = turned.tr_mul(&q);
                return Ok(self.found(&turned, &tangent));
            }
            q += &next;
            step = next;
        }
        Err(GearboxError::NoEquilibrium { iterations: STEPS, step: energy(&step) / whole })
    }

    /// Forces and tangent of the last evaluation, modes as patterns that stand in space.
    fn found(&self, turned: &DMatrix<f64>, tangent: &DMatrix<f64>) -> ModalForces {
        let m = self.squares.len();
        let mut basis = DMatrix::identity(12 + m, 12 + m);
        basis.view_mut((12, 12), (m, m)).copy_from(turned);
        let wrench = &self.contact.force().wrench;
        let on_gears = |i: usize| {
            let own = &wrench[i / 6];
            if i % 6 < 3 { own.force[i % 3] } else { own.moment[i % 3] }
        };
        let on_modes = self.contact.modal().map_or(&[][..], |modal| &modal.forces().normal);
        let force = DVector::from_iterator(12 + m, (0..12).map(on_gears).chain(on_modes.iter().copied()));
        ModalForces {
            amplitudes: self.amplitudes.clone(),
            force: basis.tr_mul(&force),
            tangent: basis.tr_mul(&(tangent * &basis)),
        }
    }
}
