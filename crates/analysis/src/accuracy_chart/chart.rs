//! All points of a chart, with the common reference for their errors.

use std::path::Path;

use scene::Scene;
use study::{Answer, AnswerError, Work};

use super::{
    Density, MemoryGauge, MotionRow, NoGauge, OwnBounds, Point, Way, guard,
    measure::measure,
    measured::{ChartTools, Measured, degrees_of_freedom},
    motion,
    plan::{Engine, Range, Share, densities, reference},
    ways,
};
use crate::{
    AnalysisError, Observer, PhaseWork,
    accuracy::{Accuracy, BoundsOfResults},
    refused::Refusal,
    run_phase,
};

/// Extent of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartOptions {
    /// Mesh densities, from coarse to fine; the last one is for the reference.
    pub densities: Vec<Density>,
    /// Largest number of positions for methods that take minutes per position.
    pub part: u32,
    /// Time limit of a point, s. A point is skipped if it would take longer, as predicted from the preceding one.
    pub limit_s: f64,
    /// Whether the models in motion are run as well.
    pub motion: bool,
}

impl ChartOptions {
    /// Options with four densities.
    pub fn whole(limit_s: f64) -> Self {
        Self { densities: Density::ALL.to_vec(), part: 2, limit_s, motion: false }
    }

    /// Options for a chart in less than a minute.
    pub fn quick(limit_s: f64) -> Self {
        Self { densities: Density::QUICK.to_vec(), part: 1, limit_s, motion: false }
    }
}

/// Outcome of a point.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// The point was run.
    Measured {
        /// Its cost.
        work: Work,
        /// Its result.
        answer: Answer,
        /// Error of the result compared with the reference.
        error: AnswerError,
        /// Its own error bounds, or the reason why there are none.
        bounds: Result<Box<OwnBounds>, String>,
        /// Note for the reader.
        note: String,
    },
    /// The point was skipped, with the reason.
    Skipped(String),
}

/// One row of the chart's table.
#[derive(Debug, Clone, PartialEq)]
pub struct PointRow {
    /// Name of the method.
    pub way: &'static str,
    /// Mesh of the point; `None` without one.
    pub density: Option<Density>,
    /// Outcome of the point.
    pub outcome: Outcome,
}

/// All points of a scene's chart.
#[derive(Debug, Clone, PartialEq)]
pub struct WorkPrecision {
    /// Mesh of the reference.
    pub reference_density: Density,
    /// Cost of the reference.
    pub reference_work: Work,
    /// Result of the reference.
    pub reference: Answer,
    /// Error bounds of the reference.
    pub reference_bounds: Result<Box<OwnBounds>, String>,
    /// Reason why the reference is not on a finer mesh; empty if it is on the finest.
    pub reference_note: String,
    /// The points, method by method, from coarse to fine.
    pub rows: Vec<PointRow>,
    /// The models in motion; empty if not requested.
    pub motion: Vec<MotionRow>,
}

/// A point as it was measured, not yet compared.
struct MeasuredPoint {
    way: Way,
    density: Option<Density>,
    measured: Result<Measured, String>,
}

/// Number of points that [`AccuracyChart::run`] tells its observer of.
fn point_count(options: &ChartOptions) -> usize {
    let in_motion = if options.motion { motion::WAYS } else { 0 };
    1 + in_motion + ways().iter().map(|w| densities(w, &options.densities).len()).sum::<usize>()
}

/// Accuracy against cost of all models of a scene.
#[derive(Clone, Copy)]
pub struct AccuracyChart<'a> {
    scene: &'a Scene,
    options: &'a ChartOptions,
    tools: ChartTools<'a>,
}

impl std::fmt::Debug for AccuracyChart<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("AccuracyChart").field("scene", &self.scene.name).field("options", self.options).finish()
    }
}

impl<'a> AccuracyChart<'a> {
    /// Chart of a scene, without memory measurements and CalculiX.
    pub fn new(scene: &'a Scene, options: &'a ChartOptions) -> Self {
        Self { scene, options, tools: ChartTools { memory: &NoGauge, scratch: None } }
    }

    /// Measures peak and free memory of the process; a point that does not fit into memory is skipped.
    #[must_use]
    pub fn with_memory(mut self, memory: &'a dyn MemoryGauge) -> Self {
        self.tools.memory = memory;
        self
    }

    /// Sets a folder for the files of CalculiX, which is run if it is installed.
    #[must_use]
    pub fn with_scratch(mut self, folder: &'a Path) -> Self {
        self.tools.scratch = Some(folder);
        self
    }

    /// Runs all points.
    ///
    /// A point that fails or would cost too much becomes a row with the reason. Only a missing reference is an error.
    ///
    /// # Errors
    /// [`AnalysisError::Refused`].
    pub fn run(&self, observer: &mut dyn Observer) -> Result<WorkPrecision, AnalysisError> {
        let steps = PhaseWork::Steps(point_count(self.options) as u64);
        run_phase(observer, "chart", steps, |progress| {
            self.points(|what| {
                progress.say(what.to_owned());
                progress.tick();
            })
        })
    }

    fn points(&self, mut seen: impl FnMut(&str)) -> Result<WorkPrecision, AnalysisError> {
        let Self { scene, options, tools } = *self;
        let mut raw: Vec<MeasuredPoint> = Vec::new();
        let mut bounds = BoundsOfResults::new();
        for way in ways() {
            self.series(way, &mut raw, &mut bounds, &mut seen);
        }
        seen("reference");
        let (reference_density, reference_note, reference) = self.refined(&raw, &mut bounds)?;
        let rows = raw.into_iter().map(|point| point.against(&reference.answer)).collect();
        let Measured { work: reference_work, answer: reference, accuracy, .. } = reference;
        let reference_bounds = own_bounds(accuracy, &reference, &reference);
        // The finest mesh that is not the reference's own.
        let density = options.densities.iter().rev().nth(1).or(options.densities.first());
        let motion = match density.filter(|_| options.motion) {
            Some(density) => motion::rows(scene, *density, tools, seen),
            None => Vec::new(),
        };
        Ok(WorkPrecision {
            reference_density,
            reference_work,
            reference,
            reference_bounds,
            reference_note,
            rows,
            motion,
        })
    }

    /// The points of one way, coarse to fine.
    fn series(
        &self,
        way: Way,
        raw: &mut Vec<MeasuredPoint>,
        bounds: &mut BoundsOfResults,
        seen: &mut impl FnMut(&str),
    ) {
        let mut last: Option<Work> = None;
        let mut given_up: Option<String> = None;
        for density in densities(&way, &self.options.densities) {
            seen(&label(way.name, density));
            let point = Point::new(self.scene, way, density, self.options.part);
            let measured = match &given_up {
                Some(why) => Err(why.clone()),
                None => self.guarded(&point, last.as_ref(), bounds),
            };
            match &measured {
                Ok(m) => last = Some(m.work),
                // What fails on a mesh would fail on a finer one.
                Err(why) => given_up = Some(why.clone()),
            }
            raw.push(MeasuredPoint { way, density, measured });
        }
    }

    fn guarded(&self, point: &Point, smaller: Option<&Work>, bounds: &mut BoundsOfResults) -> Result<Measured, String> {
        let one_line = |e: AnalysisError| e.to_string().replace('\n', " ");
        if let Some(smaller) = smaller {
            let dof = degrees_of_freedom(&point.scene).map_err(one_line)?;
            let free_mb = self.tools.memory.available_mb();
            if let Some(why) = guard::refusal(smaller, dof, self.options.limit_s, free_mb) {
                return Err(why);
            }
        }
        measure(point, self.tools, Some(bounds)).map_err(one_line)
    }

    /// The reference on the finest mesh that can be run: slices, twice as many as the scene's.
    fn refined(
        &self,
        raw: &[MeasuredPoint],
        bounds: &mut BoundsOfResults,
    ) -> Result<(Density, String, Measured), AnalysisError> {
        let way = Way { name: "reference", engine: Engine::Own(reference), range: Range::All, share: Share::Whole };
        // What slices took on coarser meshes tells what the reference will.
        let before: Vec<(Density, Work)> = raw
            .iter()
            .filter(|r| r.way.range == Range::BelowReference)
            .filter_map(|r| Some((r.density?, r.measured.as_ref().ok()?.work)))
            .collect();
        let mut coarser = String::new();
        for &density in self.options.densities.iter().rev() {
            let smaller = before.iter().filter(|(d, _)| *d <= density).max_by_key(|(d, _)| *d).map(|(_, work)| work);
            let point = Point::new(self.scene, way, Some(density), self.options.part);
            match self.guarded(&point, smaller, bounds) {
                Ok(measured) => return Ok((density, coarser, measured)),
                Err(message) => coarser = format!("not on {} elements along the profile: {message}", density.profile),
            }
        }
        Err(Refusal::no_result(format!("no reference: {coarser}"), None).into())
    }
}

impl MeasuredPoint {
    /// The row of the chart.
    fn against(self, reference: &Answer) -> PointRow {
        let Self { way, density, measured } = self;
        let outcome = match measured {
            Err(why) => Outcome::Skipped(why),
            Ok(Measured { work, answer, note, accuracy }) => match answer.error_against(reference) {
                Ok(error) => {
                    let bounds = own_bounds(accuracy, &answer, reference);
                    Outcome::Measured { work, answer, error, bounds, note }
                }
                Err(e) => Outcome::Skipped(e.to_string()),
            },
        };
        PointRow { way: way.name, density, outcome }
    }
}

/// Bounds of an answer beside its error against the reference.
fn own_bounds(
    accuracy: Result<Accuracy, String>,
    answer: &Answer,
    reference: &Answer,
) -> Result<Box<OwnBounds>, String> {
    accuracy.and_then(|a| {
        OwnBounds::new(&a, answer, reference).map(Box::new).ok_or_else(|| "no bound of its mean STE".to_owned())
    })
}

/// A point in a few words.
fn label(way: &str, density: Option<Density>) -> String {
    match density {
        Some(d) => format!("{way}, {} elements along the profile", d.profile),
        None => way.to_owned(),
    }
}
