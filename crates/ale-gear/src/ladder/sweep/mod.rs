//! A run at each value of a key: bifurcation diagrams and resonance curves.
//!
//! | module | what it does |
//! |---|---|
//! | `point`, `free_turn` | one value: settle, section, exponent, and what the exponent leaves out |
//! | `files` | `sweep.csv`, `bifurcation.csv`, what is read off them |

mod files;
mod free_turn;
mod point;

use integrate::State;
use rayon::prelude::*;
use serde::Serialize;

pub(crate) use files::SweepSummary;
pub(crate) use point::SweepPoint;

use super::{Made, Recipe, Sources, facts, no_backlash};
use crate::{
    cache::Cache,
    error::CommandError,
    output::{ResultDirectory, bifurcation_picture, ladder_sweep_table, write_ladder_sweep_report, write_summary},
    phases::Phases,
    scene::{MotionScene, Run, Scene, SweepScene, SweepWay},
};

/// How often a section has a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Once {
    /// Once a mesh cycle.
    MeshCycle,
    /// Once a turn of the pinion.
    PinionTurn,
    /// Once a turn of the wheel.
    WheelTurn,
}

/// What a sweep is asked for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SweepRequest {
    /// The key that changes, with dots.
    pub key: String,
    /// Which way its values are gone through.
    pub ways: Vec<SweepWay>,
    /// How often a section has a point.
    pub once: Once,
    /// The column of `history.csv` whose section is taken.
    pub of: String,
    /// Points of a section, >= 1.
    pub points: u32,
    /// Stretches of a mesh cycle over which the exponent is found; 0: it is not.
    pub stretches: u32,
    /// Words of `ale-gear sweep` that make it again, behind the scene's file; `None` where the scene says it all.
    pub again: Option<String>,
}

impl SweepRequest {
    /// Mesh cycles from one point of a section to the next.
    pub fn every(&self, scene: &Scene) -> u32 {
        match self.once {
            Once::MeshCycle => 1,
            Once::PinionTurn => scene.pinion.teeth,
            Once::WheelTurn => scene.wheel.teeth,
        }
    }
}

/// A value with all that its model is made of, or why there is none.
struct Value {
    value: f64,
    recipe: Result<Recipe, CommandError>,
}

/// The scene of one value as it is run: to the periodic state, then as many cycles as the section takes.
fn settled(scene: &Scene, words: &MotionScene, request: &SweepRequest) -> Scene {
    let every = request.every(scene);
    let motion = MotionScene { run: Run::Steady, duration_s: None, ramp: None, sweep: None, ..words.clone() };
    let mut own = scene.clone();
    own.analysis.cycles = request.points.saturating_mul(every);
    own.motion = Some(motion);
    own
}

/// Runs the model of a scene at each value, way by way; writes all files of the result, the text is the closing table.
///
/// `scenes` in ascending order of the value; the first stands for what they have in common.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out at any value: one value without a motion has its reason in its row.
pub(crate) fn sweep_key(
    scenes: &[(f64, Scene)],
    request: &SweepRequest,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<String, CommandError> {
    let mut sources = Sources::new(phases, results, cache);
    let mut values = Vec::new();
    for (value, scene) in scenes {
        let Some(words) = &scene.motion else { continue };
        let recipe = Recipe::gather(&settled(scene, words, request), &mut sources);
        values.push(Value { value: *value, recipe });
    }
    let (first, made) = first_of(&values)?;
    point::known_column(&made.model, &first.scene, &request.of)?;
    let (facts, mut warnings) = (facts(first, made.coordinates()), made.warnings);
    let count = (values.len() * request.ways.len()) as u64;
    let points = phases.run_steps("sweep", count, |progress| {
        let at = |value: f64, from: Option<&_>| {
            let recipe = values.iter().find(|v| v.value == value).map(|v| v.recipe.as_ref());
            match recipe {
                Some(Ok(recipe)) => point::run(recipe, value, request, from),
                Some(Err(e)) => Err(e.clone()),
                None => point::run(first, value, request, from),
            }
        };
        let of_way = |&way: &SweepWay| one_way(way, &values, at, &|| progress.tick());
        request.ways.par_iter().map(of_way).collect::<Vec<Vec<SweepPoint>>>()
    });
    let points: Vec<SweepPoint> = points.into_iter().flatten().collect();
    if let Some(none) =
        points.first().and_then(|p| p.failed.clone()).filter(|_| points.iter().all(|p| p.failed.is_some()))
    {
        return Err(none);
    }
    let summary = files::summary(&first.scene, request, &points);
    warnings.extend(summary.doubts());
    // Who sweeps the backlash knows.
    warnings
        .extend(no_backlash(first).filter(|_| !request.key.contains("backlash") && !request.key.contains("thickness")));
    results.write("sweep.csv", files::sweep_csv(request, &points).as_bytes())?;
    results.write("bifurcation.csv", files::bifurcation_csv(request, &points).as_bytes())?;
    if let Some(picture) = bifurcation_picture(&request.key, &request.of, &points) {
        results.write("bifurcation.svg", picture.as_bytes())?;
    }
    let scene = &first.scene;
    let cost = phases.cost();
    let report = write_ladder_sweep_report(scene, &facts, &cost, &summary, &points, &warnings)?;
    report.write(results)?;
    let files = results.files()?;
    results.write("summary.json", write_summary(scene, &facts, &cost, &summary, &warnings, &files).as_bytes())?;
    Ok(ladder_sweep_table(scene, &facts, &cost, &summary, &warnings))
}

/// The first value with a model: it stands for what they have in common.
///
/// # Errors
/// That of the first value where none has a model.
fn first_of(values: &[Value]) -> Result<(&Recipe, Made), CommandError> {
    let mut error = None;
    for value in values {
        match value.recipe.as_ref().map_err(Clone::clone).and_then(|r| r.model().map(|m| (r, m))) {
            Ok(first) => return Ok(first),
            Err(e) => error = error.or(Some(e)),
        }
    }
    let none = || CommandError::input("a sweep over no values", Some("give `--points 2` or more".into()));
    Err(error.unwrap_or_else(none))
}

/// All values one way, in ascending order. Upwards and downwards each begins at rest under the load at its first value and goes on from the last state; a value that does not get through from
/// there begins at rest again, and where that fails too it has its reason, and the next goes on from the last that has a motion.
fn one_way(
    way: SweepWay,
    values: &[Value],
    at: impl Fn(f64, Option<&State>) -> Result<point::Found, CommandError> + Sync,
    tick: &(dyn Fn() + Sync),
) -> Vec<SweepPoint> {
    let mut along: Vec<f64> = values.iter().map(|v| v.value).collect();
    let standing = |value: f64, state: Option<&State>| {
        let carried = state.and_then(|state| at(value, Some(state)).ok());
        let found = carried.map_or_else(|| at(value, None), Ok);
        tick();
        match found {
            Ok(point::Found { point, end }) => (SweepPoint { way, ..point }, Some(end)),
            Err(error) => (SweepPoint::missing(way, value, error), None),
        }
    };
    if way == SweepWay::Apart {
        return along.par_iter().map(|&value| standing(value, None).0).collect();
    }
    if way == SweepWay::Down {
        along.reverse();
    }
    let mut state = None;
    let mut points = Vec::with_capacity(along.len());
    for value in along {
        let (point, end) = standing(value, state.as_ref());
        state = end.or(state);
        points.push(point);
    }
    points.sort_by(|a, b| a.value.total_cmp(&b.value));
    points
}

/// The sweep over speed of a scene that says `run = "sweep"`.
///
/// # Errors
/// As of [`sweep_key`].
pub(super) fn over_speed(
    scene: &Scene,
    (words, speeds): (&MotionScene, &SweepScene),
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<String, CommandError> {
    let at = |speed_rpm: f64| {
        let mut own = scene.clone();
        own.operation.speed_rpm = speed_rpm;
        own.motion = Some(words.clone());
        (speed_rpm, own)
    };
    let scenes: Vec<(f64, Scene)> = speeds.all_rpm().into_iter().map(at).collect();
    let request = SweepRequest {
        key: "operation.speed_rpm".into(),
        ways: speeds.ways.clone(),
        once: Once::MeshCycle,
        of: "dte_um".into(),
        points: scene.analysis.cycles.max(1),
        stretches: 0,
        again: None,
    };
    sweep_key(&scenes, &request, phases, results, cache)
}
