//! Ledger of energy: what is stored, supplied and dissipated.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Energy ledger of a motion, in the mechanism's units (mJ = N mm).
///
/// ```text
/// kinetic + potential - initial = supplied + parametric - dissipated + residual
/// ```
/// Whatever an integrator adds or takes by itself is the residual. What it does in each step is summed up beside it by its
/// amount, and so is the energy that comes and goes: a residual that swings to and fro is small at no time by chance, and
/// the energy of a vibration does not grow with its duration, as work does.
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
    /// Sum of the absolute amounts of all work so far.
    pub turnover: f64,
    /// Sum of the absolute changes of kinetic and of potential energy from step to step: what vibrates.
    pub exchanged: f64,
    /// Sum of the absolute changes of the residual from step to step.
    pub open: f64,
    /// Part of the energies' amounts that is their round-off, summed over the steps.
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

    /// Residual of the ledger: energy that is not accounted for.
    pub fn residual(&self) -> f64 {
        self.kinetic + self.potential - self.initial - self.supplied - self.parametric + self.dissipated
    }

    /// Residual of the ledger over all the work done.
    pub fn relative_residual(&self) -> f64 {
        over(self.residual(), self.turnover.max(self.initial.abs()))
    }

    /// Energy that steps add or take by themselves, over the kinetic and potential energy that comes and goes in them:
    /// 0 of a ledger that closes in every step, about a half where half of the work of a vibration is not booked. NaN
    /// where an entry is none.
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
