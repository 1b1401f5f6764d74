//! Analyses in time: from a checked scene to rows, spectra, certificate and report.
//!
//! | module | what it does |
//! |---|---|
//! | `elasticity` | elastic frequencies beside mesh harmonics |
//! | `options` | words of the scene in the solvers' units |
//! | `prepare` | gears, quasi-static cycle, mechanism |
//! | `pattern` | what the flanks are pressed by |
//! | `course` | settle, write rows, checkpoints |
//! | `rows`, `table` | files of rows, written on the way and read back at the end |
//! | `store` | checkpoints on disk |
//! | `sweep` | steady states over speed |
//! | `precision` | step sizes against errors of every method |
//! | `headline`, `spectra` | what is read off the rows |

mod course;
mod elasticity;
mod headline;
mod options;
mod pattern;
mod precision;
mod prepare;
mod rows;
mod spectra;
mod store;
mod sweep;
mod table;

use std::path::{Path, PathBuf};

use dynamics::pair_motion::Drive;
use study::{StudyError, Window};

use course::{Finished, Places};
use prepare::{Inputs, Prepared, prepare};
use store::{CheckpointFolder, Stored};

pub(crate) use elasticity::ElasticHeadline;
pub(crate) use headline::MotionHeadline;
pub(crate) use options::{RPM, bearing, drive, scheme, stated_body, torque};
pub(crate) use precision::{Precision, PrecisionPoint, precision};
pub(crate) use rows::{ENERGY, ENERGY_FILE, GEARS, HISTORY, WRENCH, column_names, energy_row};
pub(crate) use spectra::{SPECTRA, Spectrum, WaterfallLine, spectrum, write_spectrum};
pub(crate) use sweep::{SweepHeadline, SweepRow};
pub(crate) use table::Columns;

use crate::{
    cache::Cache,
    error::CommandError,
    facts::Cost,
    output::{
        ResultDirectory, motion_table, sweep_table, write_columnar, write_motion_report, write_patterns, write_summary,
        write_sweep_report,
    },
    phases::Phases,
    run::{Failure, complaint},
    scene::{MotionScene, Run, Scene, SweepScene},
    talk::{self, Loudness},
};

/// More steps than this in a mesh cycle take half a minute or more.
const SLOW: f64 = 20_000.0;
/// Fewer steps than this in a period of the mesh resonance show it wrongly.
const COARSE: f64 = 8.0;

/// What is known of earlier and later runs of the same motion.
#[derive(Debug)]
pub(crate) struct Progression {
    folder: Option<CheckpointFolder>,
    resume: bool,
    stop_after: Option<u64>,
}

impl Progression {
    /// Checkpoints beside `out`, where scene or command ask for some.
    pub fn new(words: &MotionScene, out: &Path, resume: bool, stop_after: Option<u64>) -> Self {
        let wanted = words.checkpoint_every_cycles.is_some_and(|every| every > 0) || resume || stop_after.is_some();
        Self { folder: wanted.then(|| CheckpointFolder::beside(out)), resume, stop_after }
    }

    /// A run in one piece, without checkpoints.
    pub fn uncut() -> Self {
        Self { folder: None, resume: false, stop_after: None }
    }

    /// The results are whole: nothing is to be gone on from.
    pub fn done(&self) -> Result<(), CommandError> {
        self.folder.as_ref().map_or(Ok(()), CheckpointFolder::remove)
    }
}

/// How a run ended.
pub(crate) enum Outcome {
    /// All files are written; the closing table.
    Finished(String),
    /// The user asked to stop after so many mesh cycles.
    Stopped {
        /// Mesh cycles done.
        cycles: u64,
    },
}

/// Runs the motion of a scene and writes all files of the result.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn solve(
    scene: &Scene,
    words: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
    progression: &Progression,
) -> Result<Outcome, CommandError> {
    let inputs = Inputs::new(scene, words, phases, cache)?;
    let meshes: Vec<_> = inputs.meshes.iter().map(|m| m.facts.clone()).collect();
    let mut from = match &progression.folder {
        Some(folder) if progression.resume => {
            let stored = folder.read()?;
            stored.check(scene, &meshes)?;
            Some(stored)
        }
        _ => None,
    };
    let mut window = from.as_ref().map(|f| f.window);
    let mut widened = Vec::new();
    loop {
        match attempt(&inputs, phases, results, progression, window, from.take()) {
            Ok(Attempt::Stopped { cycles }) => return Ok(Outcome::Stopped { cycles }),
            Ok(Attempt::Motion(mut prepared, done)) => {
                prepared.warnings.extend(widened);
                return write_motion(scene, words, phases, results, &prepared, &done).map(Outcome::Finished);
            }
            Ok(Attempt::Sweep(mut prepared, points, sweep)) => {
                prepared.warnings.extend(widened);
                return write_sweep(scene, (words, sweep), phases, results, &prepared, &points).map(Outcome::Finished);
            }
            Err(Failure::Command(e)) => return Err(e),
            Err(Failure::Static(e)) => match prepare::wider(&inputs, window, &e) {
                Some(teeth) => {
                    widened.push(format!("{e}; the window was widened to {teeth} teeth and the motion begun again"));
                    window = Some(teeth);
                }
                None => return Err(complaint(scene, &e)),
            },
        }
    }
}

/// Rows of a motion alone, written into `folder`: for comparing models.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn rows_of(
    scene: &Scene,
    words: &MotionScene,
    phases: &mut Phases,
    folder: &Path,
) -> Result<Columns, CommandError> {
    let cache = Cache::off();
    let inputs = Inputs::new(scene, words, phases, &cache)?;
    let mut window = None;
    loop {
        let places = Places { rows: folder, checkpoint: None, from: None, stop_after: None };
        let done = prepare(&inputs, phases, window)
            .and_then(|prepared| course::run(scene, words, &prepared, phases, places).map(|_| ()));
        match done {
            Ok(()) => return Columns::read(&folder.join(rows::HISTORY)),
            Err(Failure::Command(e)) => return Err(e),
            Err(Failure::Static(e)) => match prepare::wider(&inputs, window, &e) {
                Some(teeth) => window = Some(teeth),
                None => return Err(complaint(scene, &e)),
            },
        }
    }
}

/// One width of the window.
enum Attempt<'a> {
    Motion(Box<Prepared>, Box<Finished>),
    Sweep(Box<Prepared>, Vec<dynamics::pair_motion::SweepPoint>, &'a SweepScene),
    Stopped { cycles: u64 },
}

fn attempt<'a>(
    inputs: &Inputs<'a>,
    phases: &mut Phases,
    results: &ResultDirectory,
    progression: &Progression,
    window: Option<usize>,
    from: Option<Stored>,
) -> Result<Attempt<'a>, Failure> {
    let Inputs { scene, words, .. } = *inputs;
    let mut prepared = prepare(inputs, phases, window)?;
    prepared.warnings.extend(coarse(scene, words, &prepared));
    if let Some(slow) = slow(scene, words, &prepared) {
        // Who waits should hear it before the end.
        talk::say(Loudness::Bars, || format!("ale-gear: {slow}"));
        prepared.warnings.push(slow);
    }
    if let Some(sweep) = &words.sweep {
        let points = sweep::run(scene, (words, sweep), &prepared, phases)?;
        return Ok(Attempt::Sweep(Box::new(prepared), points, sweep));
    }
    let rows: PathBuf = match &progression.folder {
        Some(folder) => {
            if from.is_none() {
                folder.start()?;
            }
            folder.path().to_owned()
        }
        None => results.folder().to_owned(),
    };
    let places =
        Places { rows: &rows, checkpoint: progression.folder.as_ref(), from, stop_after: progression.stop_after };
    let done = course::run(scene, words, &prepared, phases, places)?;
    if done.stopped {
        return Ok(Attempt::Stopped { cycles: done.motion.cycle() });
    }
    if progression.folder.is_some() {
        for file in [rows::HISTORY, rows::ENERGY_FILE] {
            results.copy(&rows.join(file), file)?;
        }
    }
    Ok(Attempt::Motion(Box::new(prepared), Box::new(done)))
}

/// Steps that are too long for the mesh resonance, or for the highest mode that is kept.
fn coarse(scene: &Scene, words: &MotionScene, prepared: &Prepared) -> Option<String> {
    let fastest = prepare::fastest_hz(&prepared.system);
    let mesh = scene.pinion_speed() / std::f64::consts::TAU * f64::from(scene.pinion.teeth);
    let steps = f64::from(words.steps_per_resonance).max(f64::from(words.steps_per_mesh_cycle) * mesh / fastest);
    let given = words.error_tolerance.is_none() && words.ramp.is_none() && words.sweep.is_none();
    let (what, or) = match fastest > prepared.system.mesh_resonance_hz() {
        true => ("highest kept mode", ", or keep fewer modes"),
        false => ("mesh resonance", ""),
    };
    (given && steps < COARSE).then(|| {
        format!(
            "a step is 1/{steps:.1} of the period of the {what} ({fastest:.0} Hz), which it cannot show: take more \
             `steps_per_mesh_cycle` or `steps_per_resonance`{or}"
        )
    })
}

/// Steps of a mesh cycle so many that a user should know why nothing seems to go on.
fn slow(scene: &Scene, words: &MotionScene, prepared: &Prepared) -> Option<String> {
    let mesh = scene.pinion_speed() / std::f64::consts::TAU * f64::from(scene.pinion.teeth);
    let fastest = prepare::fastest_hz(&prepared.system);
    let steps = f64::from(words.steps_per_resonance) * fastest / mesh;
    let given = words.ramp.is_none() && words.sweep.is_none();
    (given && steps > SLOW).then(|| {
        format!(
            "a mesh cycle lasts {:.0} periods of the fastest motion that steps have to show ({fastest:.3e} Hz), so it takes {steps:.0} steps; so slow a pair \
             has nearly the answer of `kind = \"static\"`",
            fastest / mesh
        )
    })
}

fn no_statistics(e: StudyError) -> CommandError {
    CommandError::failed(&e, e.hint())
}

fn write_motion(
    scene: &Scene,
    words: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    prepared: &Prepared,
    done: &Finished,
) -> Result<String, CommandError> {
    let rows = Columns::read(&results.path(rows::HISTORY))?;
    let headline = headline::headline(scene, words, prepared, done, &rows).map_err(no_statistics)?;
    let mut warnings = prepared.warnings.clone();
    warnings.extend(doubts(words, prepared, &headline));
    warnings.extend(prepared.elasticity.warning(headline.elasticity.highest_mesh_frequency_hz));
    let (mut spectrum, mut waterfall) = (None, Vec::new());
    let per_cycle = words.steps_per_mesh_cycle as usize;
    match words.ramp {
        Some(ramp) => {
            waterfall = spectra::waterfall(&rows, per_cycle, ramp.waterfall_cycles as usize, scene.pinion.teeth)
                .map_err(no_statistics)?;
            results.write("waterfall.csv", spectra::write_waterfall(&waterfall, per_cycle).as_bytes())?;
        }
        None => {
            let window = window(words, &headline);
            let of =
                spectra::spectrum(&rows, headline.cycles, headline.mesh_frequency_hz, window).map_err(no_statistics)?;
            results.write("spectrum.csv", spectra::write_spectrum(&of).as_bytes())?;
            spectrum = Some(of);
        }
    }
    let energy = Columns::read(&results.path(rows::ENERGY_FILE))?;
    let cost = Cost::of(phases);
    let pictures = crate::output::MotionPictures {
        rows: &rows,
        energy: &energy,
        spectrum: spectrum.as_ref(),
        waterfall: &waterfall,
        per_cycle,
        quasi_static: Some(&prepared.quasi_static.transmission_error),
        view: prepared.view.as_ref(),
    };
    let pattern = write_patterns(scene, &done.patterns, results)?;
    let report = write_motion_report(scene, &prepared.facts, &cost, &headline, &pictures, pattern, &warnings)?;
    report.write(results)?;
    write_columnar(scene, results)?;
    let files = results.files()?;
    let summary = write_summary(scene, &prepared.facts, &cost, &headline, &warnings, &files);
    results.write("summary.json", summary.as_bytes())?;
    Ok(motion_table(scene, &prepared.facts, &cost, &headline, &warnings))
}

/// None for a record that repeats itself, where every line stands in one bin.
fn window(words: &MotionScene, headline: &MotionHeadline) -> Window {
    let tolerance = words.periodic_tolerance.unwrap_or(1e-6);
    let whole = headline.certificate.period_cycles.is_some_and(|p| headline.cycles.is_multiple_of(p as u64));
    let periodic = headline.certificate.periodicity.is_some_and(|r| r <= 10.0 * tolerance);
    if periodic && whole { Window::Rectangular } else { Window::Hann }
}

/// What the certificate says that a user should hear.
fn doubts(words: &MotionScene, prepared: &Prepared, headline: &MotionHeadline) -> Vec<String> {
    let mut said = Vec::new();
    let c = &headline.certificate;
    let settles = matches!(words.run, Run::Steady | Run::Shooting);
    if let (true, Some(found), Some(asked)) = (settles, c.periodicity, words.periodic_tolerance)
        && found > asked
    {
        let early = c.warm_up_cycles < u64::from(words.warm_up_cycles.unwrap_or(1000)) && words.run == Run::Steady;
        said.push(if early {
            format!(
                "the motion repeated itself to {asked:.0e} of its peak to peak after {} mesh cycles, but those that were written do so to {found:.1e} only: \
                 ask for a smaller `periodic_tolerance`, or give a transient more damping",
                c.warm_up_cycles
            )
        } else { format!(
            "the motion does not repeat itself: after {} mesh cycles it is off by {found:.1e} of its peak to peak (asked: {asked:.0e}); \
             it may be chaotic, or need more `warm_up_cycles`",
            c.warm_up_cycles
        )});
    } else if let (true, Some(period)) = (settles, c.period_cycles.filter(|p| *p > 1)) {
        said.push(format!("the motion repeats itself after {period} mesh cycles: a subharmonic answer"));
    }
    if c.ledger_residual_over_work.abs() > 1e-6 {
        said.push(format!(
            "energy closes to {:.1e} of the work that goes through the pair only (asked: 1e-6): take smaller steps or `method = \"energy\"`",
            c.ledger_residual_over_work.abs()
        ));
    }
    // Without coast flanks nothing stops teeth that have parted.
    let pair = prepared.system.pair();
    let backlash = 1e3 * pair.backlash() * pair.base_helix_angle().cos();
    if !prepared.system.has_coast_flanks() && c.largest_gap_um > backlash {
        said.push(format!(
            "the flanks part by {:.1} um, more than the backlash of {backlash:.1} um: the coast flanks would touch; use `flanks = \"both\"`",
            c.largest_gap_um
        ));
    }
    if let Drive::Torque { start, .. } = &prepared.system.options().drive {
        let asked = start * 30.0 / std::f64::consts::PI;
        if (headline.speed_rpm / asked - 1.0).abs() > 0.01 {
            said.push(format!(
                "the driver's mean speed is {:.1}/min, it began with {asked:.1}/min: mesh cycles, and orders of the spectrum, are those of the \
                 start",
                headline.speed_rpm
            ));
        }
    }
    said
}

fn write_sweep(
    scene: &Scene,
    words: (&MotionScene, &SweepScene),
    phases: &mut Phases,
    results: &ResultDirectory,
    prepared: &Prepared,
    points: &[dynamics::pair_motion::SweepPoint],
) -> Result<String, CommandError> {
    let rows = sweep::rows(scene, &prepared.quasi_static, points).map_err(no_statistics)?;
    let driver = [scene.pinion.teeth, scene.wheel.teeth][1 - prepared.system.options().contact.driven()];
    let headline = sweep::headline(scene, words, prepared, &rows, driver);
    let mut warnings = prepared.warnings.clone();
    warnings.extend(prepared.elasticity.warning(headline.elasticity.highest_mesh_frequency_hz));
    if !headline.not_periodic_rpm.is_empty() {
        let first: Vec<String> = headline.not_periodic_rpm.iter().take(8).map(|n| format!("{n:.0}")).collect();
        warnings.push(format!(
            "no periodic state was found at {} of {} speeds (1/min: {}): chaotic, of a longer period, or `warm_up_cycles` are too few",
            headline.not_periodic_rpm.len(),
            rows.len(),
            first.join(", ")
        ));
    }
    results.write("resonance.csv", sweep::write(&rows).as_bytes())?;
    let cost = Cost::of(phases);
    let report =
        write_sweep_report(scene, &prepared.facts, &cost, &headline, (&rows, prepared.view.as_ref()), &warnings)?;
    report.write(results)?;
    let files = results.files()?;
    let summary = write_summary(scene, &prepared.facts, &cost, &headline, &warnings, &files);
    results.write("summary.json", summary.as_bytes())?;
    Ok(sweep_table(scene, &prepared.facts, &cost, &headline, &warnings))
}
