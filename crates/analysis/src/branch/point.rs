//! Results of a periodic motion of a branch.

use std::f64::consts::TAU;

use integrate::State;
use nalgebra::{DMatrix, DVector};
use periodic::{Bifurcation, FourierSeries, Loss, PeriodicMotion};
use serde::Serialize;
use study::{extent, mean};

/// Rows of a mesh cycle.
pub(crate) const ROWS: usize = 128;
/// Mesh harmonics that are listed.
const ORDERS: usize = 5;

/// How a motion loses its stability.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LossName {
    /// The branch turns back, or another branch crosses it.
    Fold,
    /// A motion of twice the period branches off.
    PeriodDoubling,
    /// A second frequency appears: the motion is no longer periodic.
    Torus,
}

impl From<Loss> for LossName {
    fn from(loss: Loss) -> Self {
        match loss {
            Loss::Fold => Self::Fold,
            Loss::PeriodDoubling => Self::PeriodDoubling,
            Loss::Torus => Self::Torus,
        }
    }
}

described::described! {
    /// A periodic motion; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct BranchPoint {
        /// value of the key
        pub value: f64,
        /// whether disturbances fade
        pub is_stable: bool,
        /// size of the largest Floquet multiplier, the growth of a disturbance in a period; the free rotation of the gears is left out
        pub largest_multiplier: f64,
        /// bifurcation at which the motion loses stability, or has lost it: `fold`, `period-doubling` or `torus`
        pub loss: LossName,
        /// mean dynamic transmission error of the period
        pub mean_dte_um: f64,
        /// peak to peak of the dynamic transmission error of the period
        pub peak_to_peak_dte_um: f64,
        /// root mean square of the dynamic transmission error about its mean
        pub rms_dte_um: f64,
        /// amplitudes of the mesh harmonics 1 .. 5 of the dynamic transmission error
        pub dte_harmonics_um: [f64; ORDERS],
        /// smallest normal force on the driving flanks
        pub min_normal_force_n: f64,
        /// largest normal force on the driving flanks
        pub max_normal_force_n: f64,
        /// share of the period in which the driving flanks do not press
        pub share_apart: f64,
        /// harmonics of the period that the motion is made of
        pub harmonics: usize,
        /// Newton steps of the motion
        pub newton_steps: usize,
        /// residual of the balance of forces, over the forces
        pub residual: f64,
        /// estimate of the vibration that further harmonics would add, over the vibration
        pub tail: f64,
    }
}

impl BranchPoint {
    /// Reads a point off a motion, of transmission errors (um) and normal forces (N) at even instants of its period of so many
    /// mesh cycles.
    pub(crate) fn new(motion: &PeriodicMotion, errors: &[f64], forces: &[f64], cycles: usize) -> Self {
        let count = errors.len();
        let average = mean(errors);
        let most = motion.series.harmonics().min(count / 2 - 1);
        let series = FourierSeries::of_samples(&DMatrix::from_row_slice(1, count, errors), most);
        let amplitude = |order: usize| series.as_ref().map_or(f64::NAN, |s| s.amplitude(0, order * cycles));
        let one = DVector::from_element(1, 1.0);
        let [min_normal_force_n, max_normal_force_n] = extent(forces);
        Self {
            value: motion.parameter,
            is_stable: motion.floquet.is_stable(),
            largest_multiplier: motion.floquet.largest(),
            loss: motion.floquet.loss().into(),
            mean_dte_um: average,
            peak_to_peak_dte_um: series.as_ref().map_or(f64::NAN, |s| s.peak_to_peak(&one)),
            rms_dte_um: mean(&errors.iter().map(|e| (e - average).powi(2)).collect::<Vec<_>>()).sqrt(),
            dte_harmonics_um: std::array::from_fn(|k| amplitude(k + 1)),
            min_normal_force_n,
            max_normal_force_n,
            share_apart: forces.iter().filter(|f| **f <= 0.0).count() as f64 / count as f64,
            harmonics: motion.series.harmonics(),
            newton_steps: motion.iterations,
            residual: motion.residual,
            tail: motion.tail,
        }
    }
}

described::described! {
    /// Where the branch turns, or where another one leaves it.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct BranchTurn {
        /// `fold`, `period-doubling` or `torus`
        pub loss: LossName,
        /// the motion there
        #[serde(flatten)]
        pub point: BranchPoint,
    }
}

impl BranchTurn {
    /// Turn of a branch: a bifurcation and what was read off its motion.
    pub(crate) fn new(bifurcation: &Bifurcation, point: BranchPoint) -> Self {
        Self { loss: bifurcation.loss.into(), point }
    }
}

/// A motion of the branch, continued by integration in time; units are in the names.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TimePoint {
    /// Value of the key.
    pub value: f64,
    /// Peak to peak of the evaluated mesh cycles.
    pub peak_to_peak_dte_um: f64,
    /// Peak to peak of the branch.
    pub branch_peak_to_peak_dte_um: f64,
}

impl TimePoint {
    /// Difference relative to the value of the branch.
    pub fn difference(&self) -> f64 {
        (self.peak_to_peak_dte_um / self.branch_peak_to_peak_dte_um - 1.0).abs()
    }
}

/// The state at a part of the period.
pub(crate) fn state(motion: &PeriodicMotion, share: f64) -> State {
    let phase = TAU * share;
    let velocity = motion.series.rate(phase) * (TAU / motion.period);
    State::new(share * motion.period, motion.series.at(phase), velocity)
}
