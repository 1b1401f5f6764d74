//! The scene's models in motion at its torque and speed: what each says of the dynamic transmission error, against the reduced one, and what a mesh cycle costs.

use std::time::Instant;

use analysis::motion::{MotionAnalysis, MotionOutcome, NoMotionSink};
use report::columns::motion_history::DTE;
use study::Columns;

use super::{Density, ladder_scene, plan};
use crate::{
    cache::Cache,
    error::CommandError,
    ladder::{self, Recipe, Sources},
    output::ResultDirectory,
    phases::Phases,
    scene::Scene,
};

/// Mesh cycles that are judged.
const CYCLES: u32 = 4;
/// Models that are run.
pub(super) const WAYS: usize = 6;
/// Name of what the others are compared with.
pub(crate) const REDUCED: &str = "reduced";

/// A model in motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionRow {
    /// Its name.
    pub way: &'static str,
    /// What it gave, or why nothing.
    pub outcome: Result<MotionPoint, String>,
}

/// What it gave and took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionPoint {
    /// Rigid coordinates that are integrated.
    pub coordinates: usize,
    /// Time before the first step, s.
    pub offline_s: f64,
    /// Time of a mesh cycle, s.
    pub cycle_s: f64,
    /// Mean of the dynamic transmission error, um.
    pub mean_um: f64,
    /// Root mean square about it.
    pub rms_um: f64,
    /// Largest minus smallest.
    pub peak_to_peak_um: f64,
}

type Edit = fn(&mut Scene);

/// The reduced model with slices, in motion.
fn reduced(scene: &mut Scene) {
    plan::slice(scene);
    ladder_scene::in_motion(scene);
}

/// Every model in motion, `reduced` first.
pub(super) fn rows(
    scene: &Scene,
    density: Density,
    results: &ResultDirectory,
    mut seen: impl FnMut(&str),
) -> Vec<MotionRow> {
    let ways: [(&'static str, Edit); WAYS] = [
        (REDUCED, reduced),
        ("lumped8", ladder_scene::lumped8),
        ("lumped12", ladder_scene::lumped12),
        (plan::FED, ladder_scene::lumped12_fed),
        ("shaft18", ladder_scene::shaft18),
        ("impact", ladder_scene::impact),
    ];
    let one = |(way, edit): (&'static str, Edit)| {
        seen(&format!("{way} in motion"));
        let mut own = plan::meshed(scene, Some(density));
        edit(&mut own);
        own.analysis.cycles = CYCLES;
        own.output.root_stress = false;
        own.output.contact_lines = false;
        own.output.vtu = false;
        let outcome = if way == REDUCED { whole(&own) } else { cheap(&own, results) };
        MotionRow { way, outcome: outcome.map_err(|e| e.message.replace('\n', " ")) }
    };
    ways.into_iter().map(one).collect()
}

/// The reduced model.
fn whole(scene: &Scene) -> Result<MotionPoint, CommandError> {
    let mut phases = Phases::quiet();
    let outcome = MotionAnalysis::new(scene).solve_into(&mut phases, &mut NoMotionSink)?;
    let MotionOutcome::Finished(result) = outcome else {
        return Err(CommandError::failed(format_args!("{}: stopped before its end", scene.file.display()), None));
    };
    result.facts.certificate.verdict(scene)?;
    let mut rows = Columns::named([DTE.name]);
    result.rows.iter().for_each(|row| rows.push([row.dte_um]));
    let wall = |solve: bool| -> f64 {
        let own = phases.rows().iter().filter(|p| matches!(p.name.as_str(), "settle" | "solve") == solve);
        own.filter(|p| !solve || p.name == "solve").map(|p| p.wall_s).sum()
    };
    point(&rows, 1, wall(false), wall(true) / f64::from(CYCLES))
}

fn words(scene: &Scene) -> Result<&crate::scene::MotionScene, CommandError> {
    let none = || CommandError::input(format_args!("{}: no motion", scene.file.display()), None);
    scene.motion.as_ref().ok_or_else(none)
}

fn cheap(scene: &Scene, results: &ResultDirectory) -> Result<MotionPoint, CommandError> {
    let mut phases = Phases::quiet();
    let words = words(scene)?;
    let start = Instant::now();
    let recipe = Recipe::gather(scene, &mut Sources::new(&mut phases, results, &Cache::off()))?;
    let made = recipe.model()?;
    let coordinates = made.coordinates();
    let offline_s = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let (rows, cycles) = ladder::steady_rows(&recipe, made, words)?;
    point(&rows, coordinates, offline_s, start.elapsed().as_secs_f64() / cycles as f64)
}

fn point(rows: &Columns, coordinates: usize, offline_s: f64, cycle_s: f64) -> Result<MotionPoint, CommandError> {
    let dte = rows.series(DTE.name)?;
    let mean_um = study::mean(dte);
    let squares: f64 = dte.iter().map(|x| (x - mean_um).powi(2)).sum();
    Ok(MotionPoint {
        coordinates,
        offline_s,
        cycle_s,
        mean_um,
        rms_um: (squares / dte.len().max(1) as f64).sqrt(),
        peak_to_peak_um: study::peak_to_peak(dte),
    })
}
