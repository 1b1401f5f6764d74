//! Energy ledger: stored, supplied and dissipated energy.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Energy ledger of a motion, in the mechanism's units (mJ = N mm).
///
/// ```text
/// kinetic + potential - initial = supplied + parametric - dissipated + residual
/// ```
/// The residual is the energy that an integrator adds or removes numerically. The absolute change of the residual in
/// each step is summed as well, and so is the energy exchanged. So an oscillating residual does not appear small by
/// chance, and the reference does not grow with the duration, as work does.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// Kinetic energy v' M v / 2.
    pub kinetic: f64,
    /// Potential energy V.
    pub potential: f64,
    /// Kinetic and potential energy at the start.
    pub initial: f64,
    /// Work of drives and loads.
    pub supplied: f64,
    /// Work of explicit changes of V with time, such as a stiffness that varies under load.
    pub parametric: f64,
    /// Work dissipated by dampers and friction.
    pub dissipated: f64,
    /// Sum of the absolute amounts of all work so far.
    pub turnover: f64,
    /// Sum of the absolute changes of kinetic and of potential energy from step to step: the energy exchanged by the
    /// vibration.
    pub exchanged: f64,
    /// Sum of the absolute changes of the residual from step to step.
    pub open: f64,
    /// Round-off of the energies, summed over the steps.
    pub round_off: f64,
}

/// Parts of an energy that are its round-off: a contact's is found to some twelve digits, and a hundredth of what is
/// below a thousand times that is not to be told.
const ROUND_OFF: f64 = 1e-9;

impl Ledger {
    /// Ledger at the start of a motion.
    pub fn open(mass: &DMatrix<f64>, v: &DVector<f64>, potential: f64) -> Self {
        let kinetic = kinetic(mass, v);
        Self { kinetic, potential, initial: kinetic + potential, ..Self::default() }
    }

    /// Residual of the ledger: energy without a source.
    pub fn residual(&self) -> f64 {
        self.kinetic + self.potential - self.initial - self.supplied - self.parametric + self.dissipated
    }

    /// Residual of the ledger, divided by all the work done.
    pub fn relative_residual(&self) -> f64 {
        over(self.residual(), self.turnover.max(self.initial.abs()))
    }

    /// Energy that the steps add or remove numerically, divided by the kinetic and potential energy exchanged in them.
    /// It is 0 for a ledger that closes in every step, and about a half if half of the work of a vibration is missing.
    /// NaN if an entry is NaN.
    ///
    /// ```text
    /// sum |d residual| / sum (|d kinetic| + |d potential|)
    /// ```
    pub fn open_over_vibration(&self) -> f64 {
        over(self.open, self.exchanged + self.round_off)
    }

    /// Entries of the step from `before` on are complete: kinetic energy, and the sums of amounts.
    pub(crate) fn close_step(&mut self, before: &Self, mass: &DMatrix<f64>, v: &DVector<f64>) {
        self.kinetic = kinetic(mass, v);
        self.turnover += (self.supplied - before.supplied).abs()
            + (self.parametric - before.parametric).abs()
            + (self.dissipated - before.dissipated).abs();
        self.exchanged += (self.kinetic - before.kinetic).abs() + (self.potential - before.potential).abs();
        self.open += (self.residual() - before.residual()).abs();
        self.round_off += ROUND_OFF * (self.kinetic + self.potential.abs());
    }
}

/// A part of a whole; nothing is no part of anything, and of nothing everything is infinitely much.
fn over(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}

fn kinetic(mass: &DMatrix<f64>, v: &DVector<f64>) -> f64 {
    0.5 * (0..v.len()).map(|j| v[j] * mass.column(j).dot(v)).sum::<f64>()
}
