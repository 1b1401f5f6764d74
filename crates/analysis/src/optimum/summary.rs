//! Results of an optimum for the report.

use design::{Goal, Measure};
use ltca::{StaticHistory, StaticPosition};
use scene::{Scene, optimum::Optimisation};
use serde::Serialize;

use super::Optimum;
use crate::{AnalysisError, RemarksAtRest, RestRequest, SharedModels, parallel_map, shared_solutions::Rates};

/// Results before and after optimisation.
#[derive(Debug, Clone)]
pub struct Optimised {
    /// Results at each torque that counts, for the nominal design without deviations.
    pub torques: Vec<TorqueLine>,
    /// Results over the torque.
    pub harris: Vec<HarrisPoint>,
    /// Influence of each parameter.
    pub influences: Vec<Influence>,
}

described::described! {
    /// A torque before and after.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct TorqueLine {
        /// torque of the driven gear
        pub torque_nm: f64,
        /// peak to peak of the STE at the start
        pub peak_to_peak_before_um: f64,
        /// peak to peak of the STE of the optimum
        pub peak_to_peak_after_um: f64,
        /// largest contact pressure at the start
        pub max_pressure_before_mpa: f64,
        /// largest contact pressure of the optimum
        pub max_pressure_after_mpa: f64,
        /// largest contact pressure at end faces and tip edges, at the start
        pub max_edge_pressure_before_mpa: f64,
        /// largest contact pressure at end faces and tip edges, of the optimum
        pub max_edge_pressure_after_mpa: f64,
        /// transmission error over the mesh cycle before and after, um
        #[serde(skip)]
        pub curves: [Vec<f64>; 2],
    }
}

described::described! {
    /// A torque of the Harris map.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct HarrisPoint {
        /// torque of the driven gear
        pub torque_nm: f64,
        /// peak to peak of the STE at the start
        pub peak_to_peak_before_um: Option<f64>,
        /// peak to peak of the STE of the optimum
        pub peak_to_peak_after_um: Option<f64>,
    }
}

described::described! {
    /// What a parameter does at the optimum.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct Influence {
        /// key of the parameter
        pub key: String,
        /// value at the start
        pub start: f64,
        /// value that the search found
        pub found: f64,
        /// value that a machine can be set to
        pub value: f64,
        /// lower bound
        pub lowest: f64,
        /// upper bound
        pub highest: f64,
        /// step of the machine, else a hundredth of the bounds: the step of the two changes of the goal
        pub step: f64,
        /// change of the goal with one step less, to first order
        pub goal_change_less_um: f64,
        /// change of the goal with one step more, to first order
        pub goal_change_more_um: f64,
    }
}

/// Torques of the Harris map over the largest that counts.
const SHARES: [f64; 12] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4];

/// Computes the report of an optimum; every position has its own number of slices, as in a run.
///
/// # Errors
/// [`AnalysisError`] at a torque that counts.
pub fn summarise(models: &SharedModels<'_>, optimum: &Optimum) -> Result<Optimised, AnalysisError> {
    let Optimum { plan, values, .. } = optimum;
    let plan = &Optimisation { slices: None, ..plan.clone() };
    let start = plan.start();
    let most = plan.torques.iter().map(|t| t.torque_nm).fold(0.0, f64::max);
    let counted: Vec<f64> = plan.torques.iter().map(|t| t.torque_nm).collect();
    let mut all: Vec<f64> = counted.iter().copied().chain(SHARES.iter().map(|s| s * most)).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    let solved = parallel_map(2 * all.len(), |i| {
        let values = if i % 2 == 0 { &start } else { values };
        let scene = Scene { rating: None, ..plan.scene(values, all[i / 2], None)? };
        let request = RestRequest::to_the_end(RemarksAtRest::Skipped).without_line_lengths();
        Ok(cycle(&models.solve(&scene, Rates::default(), request)?.history))
    });
    let mut cycles = Vec::new();
    for (i, found) in solved.into_iter().enumerate() {
        // A torque beyond those that count may be more than the teeth stand.
        let found: Result<Cycle, AnalysisError> = found;
        cycles.push(if counted.contains(&all[i / 2]) { Some(found?) } else { found.ok() });
    }
    let both = |i: usize| [&cycles[2 * i], &cycles[2 * i + 1]];
    let harris = (0..all.len())
        .map(|i| {
            let [before, after] = both(i).map(|c| c.as_ref().map(Cycle::peak_to_peak));
            HarrisPoint { torque_nm: all[i], peak_to_peak_before_um: before, peak_to_peak_after_um: after }
        })
        .collect();
    let line = |torque_nm: &f64| {
        let [Some(before), Some(after)] = both(all.iter().position(|t| t == torque_nm)?) else { return None };
        Some(TorqueLine {
            torque_nm: *torque_nm,
            peak_to_peak_before_um: before.peak_to_peak(),
            peak_to_peak_after_um: after.peak_to_peak(),
            max_pressure_before_mpa: before.max_pressure_mpa,
            max_pressure_after_mpa: after.max_pressure_mpa,
            max_edge_pressure_before_mpa: before.max_edge_pressure_mpa,
            max_edge_pressure_after_mpa: after.max_edge_pressure_mpa,
            curves: [before.ste_um.clone(), after.ste_um.clone()],
        })
    };
    let torques = counted.iter().filter_map(line).collect();
    Ok(Optimised { torques, harris, influences: influences(optimum) })
}

/// What is kept of a solved mesh cycle.
struct Cycle {
    ste_um: Vec<f64>,
    max_pressure_mpa: f64,
    max_edge_pressure_mpa: f64,
}

fn cycle(history: &StaticHistory) -> Cycle {
    Cycle {
        ste_um: history.positions.iter().map(|p| 1e3 * p.transmission_error).collect(),
        max_pressure_mpa: history.positions.iter().map(|p| p.max_pressure).fold(0.0, f64::max),
        max_edge_pressure_mpa: history.positions.iter().map(StaticPosition::max_edge_pressure).fold(0.0, f64::max),
    }
}

impl Cycle {
    fn peak_to_peak(&self) -> f64 {
        let largest = self.ste_um.iter().copied().fold(f64::MIN, f64::max);
        largest - self.ste_um.iter().copied().fold(f64::MAX, f64::min)
    }
}

fn influences(optimum: &Optimum) -> Vec<Influence> {
    let Optimum { plan, found, values, evaluation, .. } = optimum;
    let goal: &Goal = &plan.goal;
    let here = goal.value(&evaluation.curves);
    let of_one = |(k, parameter): (usize, &scene::optimum::DesignParameter)| {
        let [lowest, highest] = parameter.bounds;
        let step = if parameter.grain > 0.0 { parameter.grain } else { 0.01 * (highest - lowest) };
        let by = |amount: f64| {
            let mut change = vec![0.0; values.len()];
            change[k] = amount;
            goal.value_after(&evaluation.curves, &change) - here
        };
        Influence {
            key: parameter.name().to_owned(),
            start: parameter.start,
            found: found.values[k],
            value: values[k],
            lowest,
            highest,
            step,
            goal_change_less_um: by(-step),
            goal_change_more_um: by(step),
        }
    };
    plan.parameters.iter().enumerate().map(of_one).collect()
}

impl Optimised {
    /// Text for the goal that is minimised.
    pub fn goal_words(goal: &Goal) -> &'static str {
        match goal.measure {
            Measure::PeakToPeak => "peak to peak of the transmission error",
            Measure::Rms => "rms of the transmission error less its mean",
            Measure::Harmonics(_) => "rms of mesh harmonics of the transmission error",
        }
    }
}
