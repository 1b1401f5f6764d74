//! Cheaper models of the same pair, in time: from a checked scene to rows, spectra, section, ledger and report.
//!
//! | module | what it does |
//! |---|---|
//! | `bodies` | bodies, supports and torques of the scene |
//! | `mesh_cycle` | stiffness over the mesh cycle: given, fed by the reduced model, ISO's |
//! | `lumped` | the models with eight and twelve coordinates |
//! | `shafts`, `impact` | lumped shafts, rigid gears |
//! | `model`, `recipe` | what a model must answer to be run; what it is made of |
//! | `campbell` | natural frequencies over speed |
//! | `sweep` | a run at each value of a key: bifurcation diagrams, resonance curves |
//! | `course`, `settle` | a run of any of them |
//! | `headline` | what is read off the rows |

mod bodies;
mod campbell;
mod course;
mod headline;
mod impact;
mod lumped;
mod mesh_cycle;
mod model;
mod recipe;
mod settle;
mod shafts;
mod sweep;

use std::f64::consts::TAU;

use ::lumped::LumpedError;
use analysis::motion::{MotionSpectrum, Passage};
use study::{Columns, Window};

use report::{
    columns::motion_history::{COAST_FORCE, NORMAL_FORCE},
    columns_to_csv,
    motion_files::{CYCLES_FILE, SPECTRUM_FILE, cycles_csv, motion_series, spectrum_csv},
};

use crate::{
    cache::Cache,
    certificate::{Certificate, Written},
    error::CommandError,
    facts::{Facts, Resolution},
    gears,
    motion::{self, ENERGY_FILE, HISTORY},
    output::{
        LadderPictures, MotionPictures, ResultDirectory, ladder_table, write_columnar, write_ladder_report,
        write_summary,
    },
    phases::Phases,
    resolution::resolution,
    run,
    scene::{Driver, Model as Name, MotionScene, Run, Scene},
};
use course::Course;
use headline::Known;

pub(crate) use campbell::CampbellDiagram;
pub(crate) use headline::LadderHeadline;
pub(crate) use mesh_cycle::Sources;
pub(crate) use model::Model;
pub(crate) use recipe::{Made, Recipe};
pub(crate) use sweep::{Once, SweepPoint, SweepRequest, SweepSummary, sweep_key};

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
    matches!(scene.analysis.model, Name::Lumped8 | Name::Lumped12 | Name::Shaft18 | Name::Impact)
}

/// Runs the model of a scene and writes all files of the result.
///
/// # Errors
/// Exit status 2 when the input is wrong, 1 when no motion comes out.
pub(crate) fn solve(
    scene: &Scene,
    words: &MotionScene,
    phases: &mut Phases,
    results: &ResultDirectory,
    cache: &Cache,
) -> Result<Written, CommandError> {
    if let Some(speeds) = &words.sweep {
        let table = sweep::over_speed(scene, (words, speeds), phases, results, cache)?;
        return Ok(Written { table, verdict: Ok(()) });
    }
    let recipe = Recipe::gather(scene, &mut Sources::new(phases, results, cache))?;
    let made = recipe.model()?;
    Case { recipe: &recipe, words, results }.run(made, phases)
}

/// Rows of a run alone, and the mesh cycles that it took in all: for comparing models.
///
/// # Errors
/// Exit status 1 when no motion comes out.
pub(crate) fn steady_rows(recipe: &Recipe, made: Made, words: &MotionScene) -> Result<(Columns, u64), CommandError> {
    let Made { mut model, resonance_hz, .. } = made;
    let frequencies = [recipe.mesh_frequency_hz(words), resonance_hz];
    refuse_unstable(recipe, words, &mut model, resonance_hz)?;
    let course = course::run(&mut model, &recipe.scene, words, frequencies, None, || ())
        .map_err(|e| complaint(&recipe.scene, &e))?;
    within_bounds(&course.history)?;
    certificate(recipe, &course).verdict(&recipe.scene)?;
    Ok((course.history, course.warm_up + course.cycles))
}

/// What every model of a scene is run with.
struct Case<'a> {
    recipe: &'a Recipe,
    words: &'a MotionScene,
    results: &'a ResultDirectory,
}

impl Case<'_> {
    fn run(&self, made: Made, phases: &mut Phases) -> Result<Written, CommandError> {
        let Self { recipe, words, results } = *self;
        let scene = &recipe.scene;
        let coordinates = made.coordinates();
        let Made { mut model, resonance_hz, mut warnings, shafts } = made;
        warnings.extend(gears::warnings(&recipe.pair));
        warnings.extend(no_backlash(recipe));
        let mut facts = facts(recipe, coordinates);
        if let Some((resolution, said)) = cut(recipe) {
            facts.resolution = Some(resolution);
            warnings.extend(said);
        }
        let mesh_frequency_hz = recipe.mesh_frequency_hz(words);
        refuse_unstable(recipe, words, &mut model, resonance_hz)?;
        let campbell = phases.run("modes", || campbell::campbell(recipe, (&model, resonance_hz), shafts.as_ref()))?;
        if let Some(campbell) = &campbell {
            facts.model.extend(campbell.facts());
            results.write(campbell::FILE, campbell.to_csv().as_bytes())?;
        }
        let static_cycle =
            phases.run("quasi-static", || model.static_cycle(scene.analysis.positions_per_cycle as usize));
        let static_errors: Option<Vec<f64>> = static_cycle.map(|all| all.iter().map(|p| p.error).collect());
        let course = phases
            .run_steps("motion", u64::from(scene.analysis.cycles), |progress| {
                course::run(&mut model, scene, words, [mesh_frequency_hz, resonance_hz], None, || progress.tick())
            })
            .map_err(|e| complaint(scene, &e))?;
        within_bounds(&course.history)?;
        let known = Known {
            coordinates,
            mesh_frequency_hz,
            resonance_hz: (resonance_hz > 0.0).then_some(resonance_hz),
            static_normal_force: static_normal_force(recipe),
            static_errors: static_errors.as_deref(),
        };
        let no_statistics = |e: study::StudyError| CommandError::failed(&e, e.hint());
        let judged = course.history.last(course.judged as usize * words.steps_per_mesh_cycle as usize);
        let passage = words.ramp.map(|_| {
            let driver = (motion::speed(scene), recipe.driver_teeth());
            let per_cycle = words.steps_per_mesh_cycle as usize;
            Passage::of(&motion_series(&course.history)?, per_cycle, driver, known.static_normal_force, &[])
        });
        let passage = passage.transpose().map_err(no_statistics)?;
        let mut headline = headline::headline(scene, words, &course, &judged, &known).map_err(no_statistics)?;
        headline.ramp = passage.as_ref().and_then(Passage::headline);
        if let Some(passage) = &passage {
            results.write(CYCLES_FILE, cycles_csv(passage).as_bytes())?;
        }
        warnings.extend(doubts(words, &headline));
        facts.certificate = certificate(recipe, &course);
        let spectrum = motion_series(&judged)
            .and_then(|series| MotionSpectrum::of(&series, course.judged, mesh_frequency_hz, window(words, &course)))
            .map_err(no_statistics)?;
        for (name, text) in [
            (HISTORY, columns_to_csv(&course.history)),
            (ENERGY_FILE, columns_to_csv(&course.energy)),
            (SECTION, columns_to_csv(&course.section)),
            (SPECTRUM_FILE, spectrum_csv(&spectrum)),
        ] {
            results.write(name, text.as_bytes())?;
        }
        let cost = phases.cost();
        let pictures = MotionPictures {
            rows: &course.history,
            energy: &course.energy,
            spectrum: Some(&spectrum),
            waterfall: &[],
            ramp: passage.as_ref().map(|p| (motion::speed(scene), recipe.driver_teeth(), p)),
            campbell: None,
            per_cycle: words.steps_per_mesh_cycle as usize,
            quasi_static: static_errors.as_deref(),
            view: None,
        };
        let drawn = LadderPictures { motion: pictures, section: &course.section, campbell: campbell.as_ref() };
        let report = write_ladder_report(scene, &facts, &cost, &headline, &drawn, &warnings)?;
        report.write(results)?;
        write_columnar(scene, results)?;
        let files = results.files()?;
        let summary = write_summary(scene, &facts, &cost, &headline, &warnings, &files);
        results.write("summary.json", summary.as_bytes())?;
        let table = ladder_table(scene, &facts, &cost, &headline, &warnings);
        Ok(Written { table, verdict: facts.certificate.verdict(scene).map_err(CommandError::from) })
    }
}

/// Refuses steps of given length that are too long for an explicit method.
fn refuse_unstable(
    recipe: &Recipe,
    words: &MotionScene,
    model: &mut Model,
    resonance_hz: f64,
) -> Result<(), CommandError> {
    let scene = &recipe.scene;
    let frequencies = [recipe.mesh_frequency_hz(words), resonance_hz];
    let limit = course::stable_step(model, words, frequencies[0]).map_err(|e| complaint(scene, &e))?;
    let Some(limit) = limit else { return Ok(()) };
    let steps = motion::Steps { step: course::step(words, frequencies), mesh_hz: frequencies[0], resonance_hz };
    Ok(motion::refuse_unstable(scene, &limit, &steps)?)
}

/// What must hold of a run: energy closes, no flank of a slice pulls.
fn certificate(recipe: &Recipe, course: &Course) -> Certificate {
    let (ledger, rows) = (&course.ledger, &course.history);
    let driven = [recipe.scene.wheel.teeth, recipe.scene.pinion.teeth]
        [usize::from(recipe.scene.operation.driver == Driver::Wheel)];
    let turned = TAU * (course.warm_up + course.cycles) as f64 / f64::from(driven);
    let through = recipe.scene.operation.torque().abs() * turned;
    let mut all = vec![motion::energy_check(ledger.residual(), through, ledger.relative_residual())];
    if let Some(least) = rows.find("least_slice_force_n").filter(|all| !all.is_empty()) {
        let forces = [NORMAL_FORCE.name, COAST_FORCE.name].into_iter().filter_map(|name| rows.find(name));
        let largest = forces.map(|all| study::extent(all)[1]).fold(f64::NEG_INFINITY, f64::max);
        all.push(motion::pulling_check(study::extent(least)[0], largest));
    }
    Certificate::new(all)
}

/// Geometry, and coordinates as degrees of freedom.
fn facts(recipe: &Recipe, coordinates: usize) -> Facts {
    let dof_after = [coordinates.div_ceil(2), coordinates / 2];
    Facts { geometry: gears::geometry_facts(&recipe.pair), dof_after, ..Facts::default() }
}

/// How rigid gears are cut, with what a user should hear of it; other models are not.
fn cut(recipe: &Recipe) -> Option<(Resolution, Vec<String>)> {
    let Recipe { scene, pair, .. } = recipe;
    (scene.analysis.model == Name::Impact).then(|| resolution(scene, pair, &run::options(scene, pair)))
}

/// Rows that hold numbers only.
fn within_bounds(rows: &Columns) -> Result<(), CommandError> {
    if rows.is_finite() {
        return Ok(());
    }
    let hint = Some("the motion has left all bounds: take smaller steps, or look at supports and damping".into());
    Err(CommandError::failed(format_args!("{HISTORY}: holds what is no number"), hint))
}

/// F_bn = T / (r_b cos b_b) of the mean load on the driven gear, N.
fn static_normal_force(recipe: &Recipe) -> f64 {
    let driven = match recipe.scene.operation.driver {
        Driver::Pinion => &recipe.pair.wheel,
        Driver::Wheel => &recipe.pair.pinion,
    };
    recipe.scene.operation.torque() / (driven.base_radius() * recipe.pair.base_helix_angle().cos())
}

/// None for a record of whole periods, where every line stands in one bin.
fn window(words: &MotionScene, course: &Course) -> Window {
    let tolerance = words.periodic_tolerance.unwrap_or(1e-6);
    let whole =
        |p: &integrate::Periodicity| p.residual <= 10.0 * tolerance && course.cycles.is_multiple_of(p.period as u64);
    if course.periodicity.as_ref().is_some_and(whole) { Window::Rectangular } else { Window::Hann }
}

/// A mesh without backlash where the model has one: its flanks do not part.
fn no_backlash(recipe: &Recipe) -> Option<String> {
    let Recipe { scene, pair, .. } = recipe;
    let of_pair = 1e3 * pair.backlash();
    let backlash_um = match (scene.analysis.model, &scene.mesh) {
        (Name::Lumped8 | Name::Shaft18, Some(mesh)) => mesh.half_backlash_um.map_or(of_pair, |half| 2.0 * half),
        (Name::Impact, _) => of_pair,
        _ => return None,
    };
    let own = if scene.mesh.is_some() { "`half_backlash_um` in [mesh], or " } else { "" };
    (backlash_um.abs() < motion::NO_BACKLASH_UM).then(|| {
        format!(
            "the mesh has no backlash: where the driving flanks part the coast flanks press at once, and there is no loss of contact as with a clearance; give {own}`thickness_allowance_mm` \
             in [pinion] and [wheel]"
        )
    })
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
