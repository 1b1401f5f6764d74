//! Whether the rows and steps of a motion resolve its vibrations.

use answer::Remark;
use integrate::{Scheme, SteadySteps};
use scene::Scene;
use study::{order_amplitudes, unresolved_share};

use crate::remark;

/// Share of the vibration in the upper half of what rows can tell apart from which on a user should hear of it.
const UNRESOLVED: f64 = 0.05;
/// Share of the peak to peak that steps may change from which on a user should hear of it.
const STEPS: f64 = 0.01;
/// The resonance of a mesh lies within this share of that of its mean stiffness.
const SHIFT: f64 = 0.05;
/// Fewer steps than this in a period of the mesh resonance show it wrongly: peak to peak off by 10 to 60 % near it (map (c)
/// of `docs/envelope.md`).
const COARSE: f64 = 12.0;

/// What a user changes for more rows and for more steps.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepKeys {
    rows: &'static str,
    steps: &'static str,
    /// What lets energy close.
    energy: &'static str,
}

impl StepKeys {
    /// Names of the keys in the scene of a pair.
    pub const PAIR: Self = Self {
        rows: "more `steps_per_mesh_cycle`",
        steps: "more `steps_per_mesh_cycle` or `steps_per_resonance`",
        energy: "take more `steps_per_mesh_cycle` or `steps_per_resonance`, or `method = \"energy\"`, which keeps energy at any step",
    };
    /// Names of the keys in a gearbox file.
    pub const GEARBOX: Self = Self {
        rows: "more `steps_per_cycle`, or fewer `steps_per_row`",
        steps: "more `steps_per_cycle`",
        energy: "take more `steps_per_cycle`, or `method = \"energy\"`, which keeps energy at any step",
    };

    /// The same for steps with an error tolerance, if there is one.
    pub fn by(self, tolerance: Option<f64>) -> Self {
        let followed = Self {
            steps: "a smaller `error_tolerance`",
            energy: "take a smaller `error_tolerance`, or `method = \"energy\"`, which keeps energy at any step",
            ..self
        };
        if tolerance.is_some() { followed } else { self }
    }

    /// Keys of a pair's scene with its error tolerance, if it requests a motion.
    pub fn of_pair(scene: &Scene) -> Self {
        Self::PAIR.by(scene.motion.as_ref().and_then(|motion| motion.error_tolerance))
    }

    /// What closes the energy balance.
    pub fn energy(self) -> &'static str {
        self.energy
    }
}

/// What steps make of the steady motion.
#[derive(Debug, Clone, Copy, PartialEq)]
struct StepError {
    /// Of the peak to peak, over itself, at the most.
    share: f64,
    /// The mesh order that has the largest part of it.
    order: usize,
}

/// The transmission error of a mesh in motion, row by row.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeshRecord<'a> {
    /// Evenly spaced, um.
    pub samples: &'a [f64],
    /// Mesh cycles that they span.
    pub cycles: f64,
    /// On average where an error tolerance finds them; `None` where nobody knows them.
    pub steps: Option<SteadySteps>,
    /// Whether what comes after them is what they began with.
    pub comes_back: bool,
    pub keys: StepKeys,
}

/// How well rows and steps show what moves.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Resolved {
    /// About how much of itself steps change the peak to peak by, %: an estimate; `None` where nobody knows.
    pub step_error_percent: Option<f64>,
    /// Rows, or steps, that are too few.
    pub remarks: Vec<Remark>,
}

impl MeshRecord<'_> {
    /// How well its rows and steps resolve it.
    pub fn resolved(&self) -> Resolved {
        let found = self.steps.and_then(|steps| Some((steps, self.step_error(&steps)?)));
        let few_steps = found.and_then(|(steps, error)| self.few_steps(&steps, error));
        Resolved {
            step_error_percent: found.map(|(_, error)| 100.0 * error.share),
            remarks: self.few_rows().into_iter().chain(few_steps).collect(),
        }
    }

    /// Rows a mesh cycle.
    fn rows(&self) -> f64 {
        self.samples.len() as f64 / self.cycles
    }

    /// Largest minus smallest of a mesh cycle, averaged over the whole cycles.
    fn peak_to_peak(&self) -> f64 {
        let (rows, cycles) = (self.rows(), self.cycles.floor() as usize);
        let place = |cycle: usize| ((cycle as f64 * rows).round() as usize).min(self.samples.len());
        let of_cycle = |cycle: usize| {
            let own = &self.samples[place(cycle)..place(cycle + 1)];
            let [least, largest] =
                own.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(*x), h.max(*x)]);
            largest - least
        };
        (0..cycles).map(of_cycle).sum::<f64>() / cycles as f64
    }

    fn few_rows(&self) -> Option<Remark> {
        let share = unresolved_share(self.samples, 1, self.comes_back);
        let (share, rows) = (share.ok().filter(|share| *share > UNRESOLVED)?, self.rows() as u64);
        let cure = self.keys.rows;
        Some(remark::few_rows(rows, 100.0 * share, rows / 4, rows / 2, 100.0 * UNRESOLVED, cure))
    }

    /// What steps make of it; `None` of a mesh that stands still, and of a record too short to tell its orders.
    ///
    /// ```text
    /// e <= 2 sum_k A_k max |G(W_k h, W_k / w) - 1|,   w within SHIFT of the mesh resonance
    /// ```
    /// A_k: harmonics of the transmission error; G: [`integrate::Scheme::steady_gain`]. Theory (66a).
    fn step_error(&self, steps: &SteadySteps) -> Option<StepError> {
        let all = order_amplitudes(self.samples, self.cycles, self.comes_back).ok()?;
        let part = |(k, own): (usize, &f64)| (k + 1, 2.0 * own * steps.gain_error((k + 1) as f64, SHIFT));
        let parts: Vec<(usize, f64)> = all.iter().enumerate().map(part).collect();
        let (order, _) = *parts.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let share = parts.iter().map(|(_, own)| own).sum::<f64>() / self.peak_to_peak();
        share.is_finite().then_some(StepError { share, order })
    }

    fn few_steps(&self, steps: &SteadySteps, error: StepError) -> Option<Remark> {
        let (in_period, cure) = (steps.per_period / error.order as f64, self.keys.steps);
        let is_told = error.share > STEPS;
        is_told.then(|| remark::few_steps(100.0 * error.share, error.order, in_period, 100.0 * STEPS, cure))
    }
}

/// Steps of a mesh cycle by which their error is estimated: those of equal length, or where they follow an error their mean.
///
/// `None` of an explicit method that follows an error: kinks of the load, which the transfer function does not know, make
/// most of the error of its short steps. 4 to 43 times the estimate was found.
pub(crate) fn steps_of_cycle(
    scheme: Scheme,
    error_tolerance: Option<f64>,
    (equal, mean): (f64, Option<f64>),
) -> Option<f64> {
    match error_tolerance {
        None => Some(equal),
        Some(_) if scheme.is_explicit() => None,
        Some(_) => mean,
    }
}

/// Steps that are too long for a motion of this name and frequency, Hz; `steps`: in a period of it; `or`: what else helps.
pub(crate) fn coarse_steps(steps: f64, (what, hz): (&str, f64), (keys, or): (StepKeys, &str)) -> Option<Remark> {
    (steps < COARSE).then(|| remark::coarse_steps(steps, what, hz, format!("{}{or}", keys.steps)))
}

#[cfg(test)]
#[path = "../../tests/units/resolved.rs"]
mod tests;
