//! Normal modes that move beside the rigid bodies. Theory (62).
//!
//! ```text
//! kinetic energy: x' M x' / 2 + q' . L D x' + q' . q' / 2
//!     x rigid coordinates of one gear, D their turn into the gear's own frame
//! p = q + L D x:  x' (M - L' L) x' / 2 + p' . p' / 2              constant, and without coupling
//! V = V_contact(x, q) + q' Omega^2 q / 2,   q = p - L D x
//! ```
//! L = Phi' M R is the inertia that modes share with rigid motion. Turning at the angular velocity W changes D; what
//! that adds to velocities, and Coriolis forces on the modes, are W / omega of what is kept and are left out.

use std::{f64::consts::TAU, sync::Arc};

use nalgebra::{DMatrix, DVector, SMatrix};
use reduction::GearModes;

use crate::{COORDINATES, Displacement, NominalState, mesh_side::SideForce};

/// Normal modes of a gear with their damping.
#[derive(Debug, Clone)]
pub struct GearVibration {
    /// Shapes and frequencies, bore held and flanks free ([`reduction::GearReducer::modes`]), or of its Craig-Bampton
    /// model ([`reduction::GearReducer::craig_bampton_modes`]).
    pub modes: Arc<GearModes>,
    /// Damping ratio of every mode, 0 .. 1; steel alone has a thousandth.
    pub damping_ratio: f64,
}

/// Modes of both gears as coordinates of a pair.
#[derive(Debug, Clone)]
pub(super) struct Modal {
    gears: [GearVibration; 2],
    /// omega^2 and 2 zeta omega of all modes, pinion's first.
    pub squares: DVector<f64>,
    pub dampers: DVector<f64>,
}

impl Modal {
    pub fn new(gears: [GearVibration; 2]) -> Self {
        let all = |value: fn(f64, f64) -> f64| {
            let of_gear =
                |g: &GearVibration| g.modes.squares().iter().map(|s| value(*s, g.damping_ratio)).collect::<Vec<_>>();
            DVector::from_vec(gears.iter().flat_map(of_gear).collect())
        };
        let (squares, dampers) = (all(|s, _| s), all(|s, zeta| 2.0 * zeta * s.sqrt()));
        Self { gears, squares, dampers }
    }

    /// Number of modes of both gears, m.
    pub fn count(&self) -> usize {
        self.squares.len()
    }

    /// L D of both gears, m x 12, with the gears' own frames turned by `angles` (rad).
    pub fn coupling(&self, angles: [f64; 2]) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(self.count(), 2 * COORDINATES);
        let mut row = 0;
        for (g, gear) in self.gears.iter().enumerate() {
            let own = gear.modes.coupling_at(angles[g]);
            all.view_mut((row, COORDINATES * g), own.shape()).copy_from(&own);
            row += own.nrows();
        }
        all
    }

    /// L' L of both gears, averaged over the turn, as bodies are.
    pub fn shared_inertia(&self) -> SMatrix<f64, 12, 12> {
        let mut all = SMatrix::<f64, 12, 12>::zeros();
        for (g, gear) in self.gears.iter().enumerate() {
            all.fixed_view_mut::<6, 6>(COORDINATES * g, COORDINATES * g).copy_from(&gear.modes.shared_inertia());
        }
        all
    }

    /// Turns of both gears by so many teeth, counter-clockwise, as their amplitudes see them
    /// ([`GearModes::turned_by_teeth`]), m x m; `None` where one of them has no such turn.
    pub fn turned_by_teeth(&self, teeth: [i64; 2]) -> Option<DMatrix<f64>> {
        let mut all = DMatrix::zeros(self.count(), self.count());
        let mut at = 0;
        for (gear, teeth) in self.gears.iter().zip(teeth) {
            let turn = gear.modes.turned_by_teeth(teeth)?;
            let m = turn.nrows();
            all.view_mut((at, at), (m, m)).copy_from(&turn);
            at += m;
        }
        Some(all)
    }

    /// q = p - L D d, for places and for velocities.
    pub fn amplitudes(&self, coupling: &DMatrix<f64>, d: &Displacement, p: &[f64]) -> DVector<f64> {
        DVector::from_column_slice(p) - coupling * d
    }

    /// Frequencies of all modes, Hz.
    pub fn frequencies_hz(&self) -> Vec<f64> {
        self.squares.iter().map(|s| s.sqrt() / TAU).collect()
    }
}

/// Forces on the modes and the tangents of all coordinates, as they are put together.
#[derive(Debug)]
pub(super) struct ModalBalance<'a> {
    modal: &'a Modal,
    /// Forces with a potential: normal forces and -Omega^2 q.
    pub conservative: DVector<f64>,
    /// Friction and damping.
    pub other: DVector<f64>,
    /// -df/d(d, q) and -df/d(velocities), (12 + m) x (12 + m).
    pub stiffness: DMatrix<f64>,
    pub damping: DMatrix<f64>,
    /// Power that the modes' own dampers take.
    pub dissipated: f64,
}

impl<'a> ModalBalance<'a> {
    /// Forces and tangents of the modes by themselves, without contact.
    pub fn new(modal: &'a Modal, q: &DVector<f64>, rate: &DVector<f64>) -> Self {
        let n = 2 * COORDINATES + modal.count();
        let on_diagonal = |values: &DVector<f64>| {
            let mut all = DMatrix::zeros(n, n);
            values.iter().enumerate().for_each(|(j, v)| all[(2 * COORDINATES + j, 2 * COORDINATES + j)] = *v);
            all
        };
        let damped = modal.dampers.component_mul(rate);
        Self {
            modal,
            conservative: -modal.squares.component_mul(q),
            dissipated: damped.dot(rate),
            other: -damped,
            stiffness: on_diagonal(&modal.squares),
            damping: on_diagonal(&modal.dampers),
        }
    }

    /// Adds what the contact of one side does; the power of friction on the modes.
    pub fn add(&mut self, force: &SideForce, rate: &DVector<f64>) -> f64 {
        let Some(modal) = &force.modal else { return 0.0 };
        self.conservative += &modal.normal;
        self.other += &modal.friction;
        if let Some(stiffness) = &modal.stiffness {
            self.stiffness += stiffness;
        }
        modal.friction.dot(rate)
    }

    /// Adds the inertia of a nominal motion that is not steady, -L D a, which is returned.
    pub fn accelerate(&mut self, coupling: &DMatrix<f64>, nominal: &NominalState) -> DVector<f64> {
        let mut force = DVector::zeros(self.modal.count());
        for g in 0..2 {
            force -= coupling.column(COORDINATES * (g + 1) - 1) * nominal.acceleration[g];
        }
        self.other += &force;
        force
    }

    /// Adds stiffness and damping of the rigid coordinates alone.
    pub fn add_rigid(&mut self, stiffness: &SMatrix<f64, 12, 12>, damping: &SMatrix<f64, 12, 12>) {
        for (all, own) in [(&mut self.stiffness, stiffness), (&mut self.damping, damping)] {
            let mut block = all.fixed_view_mut::<12, 12>(0, 0);
            block += own;
        }
    }
}

/// Y of y = (d, q) = Y (free coordinates, p), (12 + m) x (n + m).
pub(super) fn expansion(map: &DMatrix<f64>, coupling: &DMatrix<f64>) -> DMatrix<f64> {
    let (n, m) = (map.ncols(), coupling.nrows());
    let mut y = DMatrix::zeros(2 * COORDINATES + m, n + m);
    y.view_mut((0, 0), (2 * COORDINATES, n)).copy_from(map);
    y.view_mut((2 * COORDINATES, 0), (m, n)).copy_from(&(-coupling * map));
    y.view_mut((2 * COORDINATES, n), (m, m)).fill_with_identity();
    y
}
