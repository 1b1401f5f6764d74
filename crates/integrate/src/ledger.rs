//! Where the energy went.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Energy ledger of a motion, in the mechanism's units (mJ = N mm).
///
/// ```text
/// kinetic + potential - initial = supplied + parametric - dissipated + residual
/// ```
/// Whatever an integrator adds or takes by itself is the residual.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// v' M v / 2.
    pub kinetic: f64,
    /// V.
    pub potential: f64,
    /// Kinetic and potential energy at the start.
    pub initial: f64,
    /// Work of drives and loads.
    pub supplied: f64,
    /// Work that changes of V with time alone have done: a stiffness that varies under load.
    pub parametric: f64,
    /// Work that dampers and friction took.
    pub dissipated: f64,
    /// Sum of the absolute amounts of all work so far: what a residual is to be compared with.
    pub turnover: f64,
}

impl Ledger {
    /// At the start of a motion.
    pub fn open(mass: &DMatrix<f64>, v: &DVector<f64>, potential: f64) -> Self {
        let kinetic = kinetic(mass, v);
        Self { kinetic, potential, initial: kinetic + potential, ..Self::default() }
    }

    /// What does not close.
    pub fn residual(&self) -> f64 {
        self.kinetic + self.potential - self.initial - self.supplied - self.parametric + self.dissipated
    }

    /// The same over all the work done.
    pub fn relative_residual(&self) -> f64 {
        let scale = self.turnover.max(self.initial.abs());
        if scale > 0.0 { self.residual() / scale } else { 0.0 }
    }

    /// Entries of the step from `before` on are complete: kinetic energy and turnover.
    pub(crate) fn close_step(&mut self, before: &Self, mass: &DMatrix<f64>, v: &DVector<f64>) {
        self.kinetic = kinetic(mass, v);
        self.turnover += (self.supplied - before.supplied).abs()
            + (self.parametric - before.parametric).abs()
            + (self.dissipated - before.dissipated).abs();
    }
}

fn kinetic(mass: &DMatrix<f64>, v: &DVector<f64>) -> f64 {
    0.5 * (0..v.len()).map(|j| v[j] * mass.column(j).dot(v)).sum::<f64>()
}
