//! One value of a sweep.

use std::f64::consts::TAU;

use ::lumped::LumpedError;
use integrate::State;
use serde::Serialize;
use study::{Columns, Lyapunov, LyapunovPlan, extent, largest_lyapunov, mean, section_period};

use report::columns::motion_history::NORMAL_FORCE;

use super::{SweepRequest, free_turn::FreeTurn};
use crate::{
    error::CommandError,
    ladder::{Model, Recipe, certificate, complaint, course, refuse_unstable, within_bounds},
    scene::{MotionScene, Scene, SweepWay},
};

/// Points of a section count as one when they differ by less than this share of the motion's peak to peak.
const SAME: f64 = 1e-3;
/// Distance of the neighbour over the scales of the motion.
const DISTANCE: f64 = 1e-7;
/// Stretches before counting begins, over those that count.
const SETTLING: u32 = 5;

/// What the motion settled to at one value; units are in the names, those of the section's column in its own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct SweepPoint {
    /// Which way it was come from.
    pub way: SweepWay,
    /// Value of the key.
    pub value: f64,
    /// Points of the section, in their order in time.
    #[serde(skip)]
    pub points: Vec<f64>,
    /// Of the column over the cycles that are written.
    pub mean: f64,
    /// Its smallest and largest.
    pub extent: [f64; 2],
    /// Points after which the section comes back; `None`: after none up to a third of them.
    pub period: Option<usize>,
    /// Difference after the best period of a few mesh cycles, over the peak to peak.
    pub periodicity: Option<f64>,
    /// Mesh cycles before the section.
    pub warm_up_cycles: u64,
    /// Largest Lyapunov exponent, 1/s.
    pub lyapunov: Option<Lyapunov>,
    /// Smallest and largest normal force, N.
    pub normal_force_n: [f64; 2],
    /// Rows in which the driving flanks do not press.
    pub rows_apart: usize,
    /// Why there is no motion at this value; `None` where there is one.
    #[serde(skip)]
    pub failed: Option<CommandError>,
}

impl SweepPoint {
    /// A value without a motion: nothing is known of it but why.
    pub fn missing(way: SweepWay, value: f64, error: CommandError) -> Self {
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
            failed: Some(error),
        }
    }

    /// Exponent above zero beyond three standard errors, and a section that does not come back.
    pub fn is_chaotic(&self) -> bool {
        self.period.is_none() && self.lyapunov.is_some_and(|l| l.is_chaotic())
    }

    /// Largest minus smallest of the column.
    pub fn peak_to_peak(&self) -> f64 {
        self.extent[1] - self.extent[0]
    }
}

/// A point, and where its motion ends.
pub(super) struct Found {
    pub point: SweepPoint,
    pub end: State,
}

/// Refuses a column that the model does not write.
pub(super) fn known_column(model: &Model, scene: &Scene, name: &str) -> Result<(), CommandError> {
    let columns = model.columns();
    if columns.iter().any(|c| c == name) {
        return Ok(());
    }
    let whose = format!("{}: the model writes no column `{name}`", scene.file.display());
    Err(CommandError::input(whose, Some(format!("it writes {}", columns.join(", ")))))
}

/// Settles and takes the section; from a state of another value where there is one of as many coordinates.
pub(super) fn run(
    recipe: &Recipe,
    value: f64,
    request: &SweepRequest,
    from: Option<&State>,
) -> Result<Found, CommandError> {
    let scene = &recipe.scene;
    let Some(words) = &scene.motion else {
        return Err(CommandError::input(format_args!("{}: no motion", scene.file.display()), None));
    };
    let made = recipe.model()?;
    let count = made.coordinates();
    let mut model = made.model;
    let frequencies = [recipe.mesh_frequency_hz(words), made.resonance_hz];
    let from = from.filter(|s| s.q.len() == count);
    let located = |e: CommandError| CommandError { message: format!("{} = {value}: {}", request.key, e.message), ..e };
    let complain = |e: LumpedError| located(complaint(scene, &e));
    refuse_unstable(recipe, words, &mut model, made.resonance_hz).map_err(located)?;
    let course = course::run(&mut model, scene, words, frequencies, from, || ()).map_err(complain)?;
    within_bounds(&course.history).map_err(located)?;
    certificate(recipe, &course).verdict(scene).map_err(CommandError::from).map_err(located)?;
    let every = request.every(scene) as usize;
    let column = |of: &Columns, name: &str| {
        of.series(name).map(<[f64]>::to_vec).map_err(|e| located(CommandError::failed(&e, e.hint())))
    };
    let section = column(&course.section, &request.of)?;
    let points: Vec<f64> = section.iter().copied().step_by(every).collect();
    let (of_rows, force) = (column(&course.history, &request.of)?, column(&course.history, NORMAL_FORCE.name)?);
    let extent = extent(&of_rows);
    let lyapunov = match request.stretches {
        0 => None,
        n => Some(exponent(&mut model, words, &course.end, frequencies, n).map_err(complain)?),
    };
    let as_rows: Vec<Vec<f64>> = points.iter().map(|p| vec![*p]).collect();
    let point = SweepPoint {
        way: SweepWay::Apart,
        value,
        period: section_period(&as_rows, SAME, &[extent[1] - extent[0]]),
        points,
        mean: mean(&of_rows),
        extent,
        periodicity: course.periodicity.map(|p| p.residual),
        warm_up_cycles: course.warm_up,
        lyapunov,
        normal_force_n: study::extent(&force),
        rows_apart: force.iter().filter(|f| **f <= 0.0).count(),
        failed: None,
    };
    Ok(Found { point, end: course.end })
}

/// Largest Lyapunov exponent of the motion from `end` on, stretched once a mesh cycle; of the gears' free turn, which nothing holds, it says nothing.
fn exponent(
    model: &mut Model,
    words: &MotionScene,
    end: &State,
    frequencies_hz: [f64; 2],
    stretches: u32,
) -> Result<Lyapunov, LumpedError> {
    let (n, period) = (end.q.len(), 1.0 / frequencies_hz[0]);
    let fastest = TAU * frequencies_hz[0].max(frequencies_hz[1]);
    let lengths = model.scale();
    let scale: Vec<f64> = lengths.iter().copied().chain(lengths.iter().map(|s| fastest * s)).collect();
    let start: Vec<f64> = end.q.iter().chain(end.v.iter()).copied().collect();
    let plan = LyapunovPlan {
        stretch: period,
        settling: (stretches / SETTLING) as usize,
        stretches: stretches as usize,
        distance: DISTANCE,
    };
    let step = course::step(words, frequencies_hz);
    let free = FreeTurn::of(model)?;
    largest_lyapunov(&start, &scale, &plan, |x, k| {
        let (q, v) = x.split_at(n);
        let mut state = State::new(end.time + k as f64 * period, q.to_vec().into(), v.to_vec().into());
        let until = end.time + (k + 1) as f64 * period;
        course::integrator(model, words, step).advance(model, &mut state, until, |_, _| ())?;
        if let Some(free) = &free {
            free.remove(&mut state.q);
            free.remove(&mut state.v);
        }
        Ok(state.q.iter().chain(state.v.iter()).copied().collect())
    })
}
