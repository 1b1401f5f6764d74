//! Cheaper models of the same pair, in time: from a checked scene to rows, spectra, section, ledger and report.
//!
//! | module | what it does |
//! |---|---|
//! | `bodies` | bodies, supports and torques of the scene |
//! | `mesh_cycle` | stiffness over the mesh cycle: given, fed by the reduced model, ISO's |
//! | `lumped` | the models with eight and twelve coordinates |
//! | `shafts`, `impact` | lumped shafts, rigid gears |
//! | `model` | what a model must answer to be run |
//! | `course`, `settle` | a run of any of them |
//! | `headline` | what is read off the rows |

mod bodies;
mod course;
mod headline;
mod impact;
mod lumped;
mod mesh_cycle;
mod model;
mod settle;
mod shafts;

use std::f64::consts::TAU;

use ::lumped::{LumpedError, shaft18::ShaftMechanism};
use study::Window;

use crate::{
    cache::Cache,
    error::CommandError,
    facts::{Cost, Facts},
    gears,
    motion::{self, Columns, ENERGY_FILE, HISTORY},
    output::{MotionPictures, ResultDirectory, ladder_table, write_columnar, write_ladder_report, write_summary},
    phases::Phases,
    scene::{Driver, Model, MotionScene, Run, Scene},
};
use course::Course;
use headline::Known;
use mesh_cycle::Sources;
use model::LadderModel;

pub(crate) use headline::LadderHeadline;

/// One row a mesh cycle.
const SECTION: &str = "section.csv";
/// Residual of the ledger over the turnover from which on a user should hear of it.
const OPEN_ENERGY: f64 = 1e-3;

/// Wrong input is status 2, a model that stands or goes nowhere status 1.
fn complaint(scene: &Scene, error: &LumpedError) -> CommandError {
    let message = format!("{}: {error}", scene.file.display());
    match error {
        LumpedError::Motion(_) | LumpedError::NoEquilibrium => CommandError::failed(message, error.hint()),
        _ => CommandError::input(message, error.hint()),
    }
}

/// Whether a scene's model is one of this module.
pub(crate) fn has(scene: &Scene) -> bool {
    matches!(scene.analysis.model, Model::Lumped8 | Model::Lumped12 | Model::Shaft18 | Model::Impact)
}

/// Runs the model of a scene and writes all files of the result; the text is the closing table.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn solve(
    scene: &Scene,
    words: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<String, CommandError> {
    let pair = phases.run("geometry", || gears::pair(scene))?;
    let facts = Facts { geometry: gears::geometry_facts(&pair), ..Facts::default() };
    let complain = |e: LumpedError| complaint(scene, &e);
    let doubts = gears::doubts(&pair);
    let case = Case { scene, words, results, doubts };
    if let Some(own) = &scene.impact {
        let (model, warnings) = impact::impact(scene, own, &pair).map_err(complain)?;
        return case.run(model, 0.0, facts, warnings, phases);
    }
    if let (Some(mesh), Some(own)) = (&scene.mesh, &scene.shaft18) {
        let made = shafts::system(scene, own, mesh, &pair, Sources { phases, results, cache })?;
        let model = ShaftMechanism::new(&made.system).map_err(complain)?;
        return case.run(model, made.resonance / TAU, facts, made.warnings, phases);
    }
    if let Some(mesh) = &scene.mesh {
        let made = lumped::lumped_pair(scene, mesh, &pair, Sources { phases, results, cache })?;
        let (warnings, resonance) = (made.warnings.clone(), made.pair.natural_frequency() / TAU);
        if let Some(own) = &scene.lumped8 {
            let model = lumped::eight(scene, own, mesh, &pair, made).map_err(complain)?;
            return case.run(model, resonance, facts, warnings, phases);
        }
        if let Some(own) = &scene.lumped12 {
            let model = lumped::twelve(scene, own, made).map_err(complain)?;
            return case.run(model, resonance, facts, warnings, phases);
        }
    }
    // The scene's checks let no other model come here.
    Err(CommandError::input(format_args!("{}: no model of the ladder", scene.file.display()), None))
}

/// What every model of a scene is run with.
struct Case<'a> {
    scene: &'a Scene,
    words: &'a MotionScene,
    results: &'a ResultDirectory,
    /// What is to be said of the pair itself.
    doubts: Vec<String>,
}

impl Case<'_> {
    fn run(
        &self,
        mut model: impl LadderModel,
        resonance_hz: f64,
        mut facts: Facts,
        mut warnings: Vec<String>,
        phases: &mut Phases,
    ) -> Result<String, CommandError> {
        let Self { scene, words, results, ref doubts } = *self;
        warnings.extend(doubts.iter().cloned());
        let coordinates = model.mass().nrows();
        facts.dof_after = [coordinates.div_ceil(2), coordinates / 2];
        let driver = [scene.pinion.teeth, scene.wheel.teeth][usize::from(scene.operation.driver == Driver::Wheel)];
        let speed_rpm = words.ramp.map_or(scene.operation.speed_rpm, |r| r.to_rpm);
        let mesh_frequency_hz = speed_rpm / 60.0 * f64::from(driver);
        let frequencies = model.natural_frequencies_hz();
        if !frequencies.is_empty() {
            facts.model.insert("natural_frequencies_hz".into(), frequencies.into());
        }
        let static_errors =
            phases.run("quasi-static", || model.static_errors(scene.analysis.positions_per_cycle as usize));
        let course = phases
            .run_steps("motion", u64::from(scene.analysis.cycles), |progress| {
                course::run(&mut model, scene, words, [mesh_frequency_hz, resonance_hz], progress)
            })
            .map_err(|e| complaint(scene, &e))?;
        let (rows, energy) = (read(HISTORY, &course.history)?, read(ENERGY_FILE, &course.energy)?);
        let known = Known {
            coordinates,
            mesh_frequency_hz,
            resonance_hz: (resonance_hz > 0.0).then_some(resonance_hz),
            static_normal_force: static_normal_force(scene, &facts),
            static_errors: static_errors.as_deref(),
        };
        let no_statistics = |e: study::StudyError| CommandError::failed(&e, e.hint());
        let judged = rows.last(course.judged as usize * words.steps_per_mesh_cycle as usize);
        let headline = headline::headline(scene, words, &course, &judged, &known).map_err(no_statistics)?;
        warnings.extend(self::doubts(words, &headline));
        let spectrum = motion::spectrum(&judged, course.judged, mesh_frequency_hz, window(words, &course))
            .map_err(no_statistics)?;
        for (name, text) in [
            (HISTORY, &course.history),
            (ENERGY_FILE, &course.energy),
            (SECTION, &course.section),
            ("spectrum.csv", &motion::write_spectrum(&spectrum)),
        ] {
            results.write(name, text.as_bytes())?;
        }
        let cost = Cost::of(phases);
        let pictures = MotionPictures {
            rows: &rows,
            energy: &energy,
            spectrum: Some(&spectrum),
            waterfall: &[],
            per_cycle: words.steps_per_mesh_cycle as usize,
            quasi_static: static_errors.as_deref(),
            view: None,
        };
        let report = write_ladder_report(scene, &facts, &cost, &headline, &pictures, &warnings)?;
        report.write(results)?;
        write_columnar(scene, results)?;
        let files = results.files()?;
        let summary = write_summary(scene, &facts, &cost, &headline, &warnings, &files);
        results.write("summary.json", summary.as_bytes())?;
        Ok(ladder_table(scene, &facts, &cost, &headline, &warnings))
    }
}

/// Columns of what this run has just written.
fn read(name: &str, text: &str) -> Result<Columns, CommandError> {
    Columns::parse(text).ok_or_else(|| {
        let hint = Some("the motion has left all bounds: take smaller steps, or look at supports and damping".into());
        CommandError::failed(format_args!("{name}: holds what is no number"), hint)
    })
}

/// F_bn = T / (r_b cos b_b) of the mean load on the driven gear, N.
fn static_normal_force(scene: &Scene, facts: &Facts) -> f64 {
    let driven = usize::from(scene.operation.driver == Driver::Pinion);
    let cos = facts.geometry.base_helix_angle_deg.to_radians().cos();
    scene.operation.torque() / (facts.geometry.base_radius_mm[driven] * cos)
}

/// None for a record of whole periods, where every line stands in one bin.
fn window(words: &MotionScene, course: &Course) -> Window {
    let tolerance = words.periodic_tolerance.unwrap_or(1e-6);
    let whole = |p: &dynamics::pair_motion::Periodicity| {
        p.residual <= 10.0 * tolerance && course.cycles.is_multiple_of(p.period as u64)
    };
    if course.periodicity.as_ref().is_some_and(whole) { Window::Rectangular } else { Window::Hann }
}

/// What the certificate says that a user should hear.
fn doubts(words: &MotionScene, headline: &LadderHeadline) -> Vec<String> {
    let mut said = Vec::new();
    let c = &headline.certificate;
    if let (Run::Steady, Some(found), Some(asked)) = (words.run, c.periodicity, words.periodic_tolerance) {
        if found > asked {
            said.push(format!(
                "the motion does not repeat itself: after {} mesh cycles it is off by {found:.1e} of its peak to peak (asked: {asked:.0e}); it may be chaotic, or \
                 need more `warm_up_cycles`",
                c.warm_up_cycles
            ));
        } else if let Some(period) = c.period_cycles.filter(|p| *p > 1) {
            said.push(format!("the motion repeats itself after {period} mesh cycles: a subharmonic answer"));
        }
    }
    if c.ledger_residual_over_turnover.abs() > OPEN_ENERGY {
        said.push(format!(
            "energy closes to {:.1e} of the work done only (asked: {OPEN_ENERGY:.0e}): take smaller steps or `method = \"energy\"`",
            c.ledger_residual_over_turnover.abs()
        ));
    }
    said
}
