//! Results at one value of a sweep.

use std::sync::Arc;

use files::Place;
use integrate::State;
use scene::SweepWay;
use serde::Serialize;
use study::{Lyapunov, extent, mean, section_period};

use super::{
    super::{LumpedInputs, analysis::checked_run, exponent::exponent, free_turn::free_turn},
    SweepOptions,
};
use crate::{AnalysisError, certificate::Checks, error::in_scene, inputs::motion_of, motion::SweepStatus};

/// Points of a section count as one when they differ by less than this share of the motion's peak to peak.
const SAME: f64 = 1e-3;

described::described! {
    /// What the motion settled to at one value; units are in the names, those of the section's column in its own.
    #[derive(Debug, Clone, Serialize)]
    pub struct SweepPoint {
        /// `up`, `down` (from the motion of the value before) or `apart` (from rest under the load)
        pub way: SweepWay,
        /// value of the key
        pub value: f64,
        /// points of the section, in their order in time
        #[serde(skip)]
        pub points: Vec<f64>,
        /// mean of the column of the section
        pub mean: f64,
        /// smallest and largest value of the column
        pub extent: [f64; 2],
        /// points after which the section comes back; `null`: after none up to a third of them
        pub period: Option<usize>,
        /// largest difference after the best period, over the peak to peak
        pub periodicity: Option<f64>,
        /// mesh cycles before the section
        pub warm_up_cycles: u64,
        /// largest Lyapunov exponent; `null` where none is asked for
        pub lyapunov: Option<Lyapunov>,
        /// smallest and largest normal force
        pub normal_force_n: [f64; 2],
        /// rows in which the driving flanks do not press
        pub rows_apart: usize,
        /// how the value came out
        #[serde(skip)]
        pub status: SweepStatus,
        /// what must hold of the motion
        #[serde(skip)]
        pub checks: Checks,
        /// reason why there is no motion
        #[serde(skip)]
        pub failed: Option<Arc<AnalysisError>>,
    }
}

impl SweepPoint {
    /// A value without a motion: nothing is known of it but why.
    pub(super) fn missing(way: SweepWay, value: f64, error: Arc<AnalysisError>) -> Self {
        let none = f64::NAN;
        Self {
            way,
            value,
            points: Vec::new(),
            mean: none,
            extent: [none; 2],
            period: None,
            periodicity: None,
            warm_up_cycles: 0,
            lyapunov: None,
            normal_force_n: [none; 2],
            rows_apart: 0,
            status: SweepStatus::Failed,
            checks: Checks::default(),
            failed: Some(error),
        }
    }

    /// Whether the exponent is positive by more than three standard errors and the section is not periodic.
    pub fn is_chaotic(&self) -> bool {
        self.period.is_none() && self.lyapunov.is_some_and(|l| l.is_chaotic())
    }

    /// Largest minus smallest value of the column.
    pub fn peak_to_peak(&self) -> f64 {
        self.extent[1] - self.extent[0]
    }
}

/// A point, and where its motion ends.
pub(super) struct SettledPoint {
    pub point: SweepPoint,
    pub end: State,
}

/// Settles and takes the section; from a state of another value where there is one of as many coordinates.
pub(super) fn run(
    inputs: &LumpedInputs,
    value: f64,
    options: &SweepOptions,
    from: Option<&State>,
) -> Result<SettledPoint, AnalysisError> {
    let scene = &inputs.scene;
    let motion = motion_of(scene)?;
    let system = inputs.build()?;
    let count = system.coordinates();
    let (mut model, resonance_hz) = (system.model, system.resonance_hz);
    let frequencies = inputs.frequencies(motion, resonance_hz);
    let from = from.filter(|s| s.q.len() == count);
    let place = || Place::Setting { label: format!("{} = {value}", options.key).into() };
    let located = |e: AnalysisError| e.at(place());
    // Standing, the model stands where it begins: this comes before the run.
    let free = free_turn(&mut model).map_err(|e| located(in_scene(scene)(e)))?;
    let (run, checks) = checked_run(inputs, &mut model, resonance_hz, from).map_err(located)?;
    let every = options.every.cycles(scene) as usize;
    let rows = 0..run.rows.len();
    let of_rows = run.rows.series(rows.clone(), |row| options.quantity.of(row))?;
    let force = run.rows.series(rows, |row| row.normal_force)?;
    // One row a mesh cycle, at its beginning: a stroboscopic section.
    let points: Vec<f64> = of_rows.iter().copied().step_by(run.per_cycle * every).collect();
    let range = extent(&of_rows);
    let lyapunov = match options.stretches {
        0 => None,
        n => {
            let found = exponent((&mut model, free.as_ref()), motion, &run.end, frequencies, n);
            Some(found.map_err(|e| located(in_scene(scene)(e)))?)
        }
    };
    let as_rows: Vec<Vec<f64>> = points.iter().map(|p| vec![*p]).collect();
    let point = SweepPoint {
        way: SweepWay::Apart,
        value,
        period: section_period(&as_rows, SAME, &[range[1] - range[0]]),
        points,
        mean: mean(&of_rows),
        extent: range,
        periodicity: run.periodicity.map(|p| p.residual),
        warm_up_cycles: run.warm_up,
        lyapunov,
        normal_force_n: extent(&force),
        rows_apart: force.iter().filter(|f| **f <= 0.0).count(),
        status: SweepStatus::of(
            run.periodicity.as_ref().map(|p| p.residual),
            motion.periodic_tolerance.unwrap_or(1e-6),
        ),
        checks,
        failed: None,
    };
    Ok(SettledPoint { point, end: run.end })
}
