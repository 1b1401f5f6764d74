//! All points of a chart, with the one reference that they are judged by.

use study::{Answer, AnswerError, Work};

use super::{
    Density, MotionRow, Point, Way, guard,
    measure::{Measured, degrees_of_freedom, measure},
    motion,
    plan::{Engine, Range, Share, densities, reference},
    ways,
};
use crate::{error::CommandError, output::ResultDirectory, scene::Scene};

/// How much is run.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartOptions {
    /// Mesh densities, coarse to fine; the last one serves the reference.
    pub densities: Vec<Density>,
    /// Positions, at most, of ways that take minutes for each.
    pub part: u32,
    /// A point that would take longer than this, by what the one before it took, is left out, s.
    pub limit_s: f64,
    /// Whether the models are run in motion too.
    pub motion: bool,
}

impl ChartOptions {
    /// Four densities.
    pub fn whole(limit_s: f64) -> Self {
        Self { densities: Density::ALL.to_vec(), part: 2, limit_s, motion: false }
    }

    /// A look in less than a minute.
    pub fn quick(limit_s: f64) -> Self {
        Self { densities: Density::QUICK.to_vec(), part: 1, limit_s, motion: false }
    }
}

/// What became of a point.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// It was run.
    Measured {
        /// What it took.
        work: Work,
        /// What it gave.
        answer: Answer,
        /// How far that is off the reference.
        error: AnswerError,
        /// What a reader should know.
        note: String,
    },
    /// It was not, and why.
    Skipped(String),
}

/// One row of the chart's table.
#[derive(Debug, Clone, PartialEq)]
pub struct PointRow {
    /// Name of its way.
    pub way: &'static str,
    /// Its mesh; `None` without one.
    pub density: Option<Density>,
    /// What became of it.
    pub outcome: Outcome,
}

/// Every point of a scene's chart.
#[derive(Debug, Clone, PartialEq)]
pub struct WorkPrecision {
    /// Mesh of the reference.
    pub reference_density: Density,
    /// What the reference took.
    pub reference_work: Work,
    /// What it gave.
    pub reference: Answer,
    /// Why it was not taken on a finer mesh; empty when it is on the finest.
    pub reference_note: String,
    /// The points, way by way, coarse to fine.
    pub rows: Vec<PointRow>,
    /// The models in motion; empty where they were not asked for.
    pub motion: Vec<MotionRow>,
}

/// A point as it was measured, not yet compared.
struct Raw {
    way: Way,
    density: Option<Density>,
    measured: Result<Measured, String>,
}

/// Number of points that [`chart`] tells `seen` of.
pub fn point_count(options: &ChartOptions) -> usize {
    let in_motion = if options.motion { motion::WAYS } else { 0 };
    1 + in_motion + ways().iter().map(|w| densities(w, &options.densities).len()).sum::<usize>()
}

/// Runs every point of `scene`. `seen` is told of each before it runs.
///
/// A point that fails, or would take too much, is a row that says why; only without a reference there is no chart.
///
/// # Errors
/// Why there is no reference.
pub fn chart(
    scene: &Scene,
    options: &ChartOptions,
    results: &ResultDirectory,
    mut seen: impl FnMut(&str),
) -> Result<WorkPrecision, CommandError> {
    let mut raw: Vec<Raw> = Vec::new();
    for way in ways() {
        series(scene, way, options, results, &mut raw, &mut seen);
    }
    seen("reference");
    let (reference_density, reference_note, reference) = refined(scene, options, results, &raw)?;
    let rows = raw
        .into_iter()
        .map(|Raw { way, density, measured }| {
            let outcome = match measured {
                Err(why) => Outcome::Skipped(why),
                Ok(Measured { work, answer, note }) => match answer.error_against(&reference.answer) {
                    Ok(error) => Outcome::Measured { work, answer, error, note },
                    Err(e) => Outcome::Skipped(e.to_string()),
                },
            };
            PointRow { way: way.name, density, outcome }
        })
        .collect();
    let Measured { work: reference_work, answer: reference, .. } = reference;
    // The finest mesh that is not the reference's own.
    let density = options.densities.iter().rev().nth(1).or(options.densities.first());
    let motion = match density.filter(|_| options.motion) {
        Some(density) => motion::rows(scene, *density, seen),
        None => Vec::new(),
    };
    Ok(WorkPrecision { reference_density, reference_work, reference, reference_note, rows, motion })
}

/// The points of one way, coarse to fine.
fn series(
    scene: &Scene,
    way: Way,
    options: &ChartOptions,
    results: &ResultDirectory,
    raw: &mut Vec<Raw>,
    seen: &mut impl FnMut(&str),
) {
    let mut last: Option<Work> = None;
    let mut given_up: Option<String> = None;
    for density in densities(&way, &options.densities) {
        seen(&label(way.name, density));
        let point = Point::new(scene, way, density, options.part);
        let measured = match &given_up {
            Some(why) => Err(why.clone()),
            None => guarded(&point, last.as_ref(), options.limit_s, results),
        };
        match &measured {
            Ok(m) => last = Some(m.work),
            // What fails on a mesh would fail on a finer one.
            Err(why) => given_up = Some(why.clone()),
        }
        raw.push(Raw { way, density, measured });
    }
}

fn guarded(point: &Point, smaller: Option<&Work>, limit_s: f64, results: &ResultDirectory) -> Result<Measured, String> {
    let one_line = |e: CommandError| e.message.replace('\n', " ");
    if let Some(smaller) = smaller {
        let dof = degrees_of_freedom(&point.scene).map_err(one_line)?;
        if let Some(why) = guard::refusal(smaller, dof, limit_s) {
            return Err(why);
        }
    }
    measure(point, results).map_err(one_line)
}

/// The reference on the finest mesh that can be run: slices, twice as many as the scene's.
fn refined(
    scene: &Scene,
    options: &ChartOptions,
    results: &ResultDirectory,
    raw: &[Raw],
) -> Result<(Density, String, Measured), CommandError> {
    let way = Way { name: "reference", engine: Engine::Own(reference), range: Range::All, share: Share::Whole };
    // What slices took on coarser meshes tells what the reference will.
    let before: Vec<(Density, Work)> = raw
        .iter()
        .filter(|r| r.way.range == Range::BelowReference)
        .filter_map(|r| Some((r.density?, r.measured.as_ref().ok()?.work)))
        .collect();
    let mut coarser = String::new();
    for &density in options.densities.iter().rev() {
        let smaller = before.iter().filter(|(d, _)| *d <= density).max_by_key(|(d, _)| *d).map(|(_, work)| work);
        let point = Point::new(scene, way, Some(density), options.part);
        match guarded(&point, smaller, options.limit_s, results) {
            Ok(measured) => return Ok((density, coarser, measured)),
            Err(message) => coarser = format!("not on {} elements along the profile: {message}", density.profile),
        }
    }
    Err(CommandError::failed(format_args!("no reference: {coarser}"), None))
}

/// A point in a few words.
fn label(way: &str, density: Option<Density>) -> String {
    match density {
        Some(d) => format!("{way}, {} elements along the profile", d.profile),
        None => way.to_owned(),
    }
}
