//! The scene's models in motion at its torque and speed: what each says of the dynamic transmission error, against the reduced one, and what a mesh cycle costs.

use std::time::Instant;

use analysis::lumped::{ExcitationSource, LumpedInputs, steady_rows};
use report::columns::motion_history::DTE;

use super::{Density, ladder_scene, plan};
use crate::{
    cache::Cache, error::CommandError, motion, output::ResultDirectory, partial::Partial, phases::Phases, scene::Scene,
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
pub(super) fn rows(scene: &Scene, density: Density, mut seen: impl FnMut(&str)) -> Vec<MotionRow> {
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
        let outcome = if way == REDUCED { whole(&own) } else { cheap(&own) };
        MotionRow { way, outcome: outcome.map_err(|e| e.message.replace('\n', " ")) }
    };
    ways.into_iter().map(one).collect()
}

/// The reduced model; its rows go into a folder of their own.
fn whole(scene: &Scene) -> Result<MotionPoint, CommandError> {
    let scratch = Partial::new(std::env::temp_dir().join(format!("ale-gear-chart-{}", std::process::id())));
    std::fs::create_dir_all(scratch.path()).map_err(|e| CommandError::write(scratch.path(), &e))?;
    let mut phases = Phases::quiet();
    let words = words(scene)?;
    let rows = motion::rows_of(scene, words, &mut phases, scratch.path())?;
    let wall = |solve: bool| -> f64 {
        let own = phases.rows().iter().filter(|p| matches!(p.name.as_str(), "settle" | "solve") == solve);
        own.filter(|p| !solve || p.name == "solve").map(|p| p.wall_s).sum()
    };
    point(rows.series(DTE.name)?, 1, wall(false), wall(true) / f64::from(CYCLES))
}

fn words(scene: &Scene) -> Result<&crate::scene::MotionScene, CommandError> {
    let none = || CommandError::input(format_args!("{}: no motion", scene.file.display()), None);
    scene.motion.as_ref().ok_or_else(none)
}

fn cheap(scene: &Scene) -> Result<MotionPoint, CommandError> {
    let mut phases = Phases::quiet();
    let start = Instant::now();
    let cache = Cache::off();
    let inputs = LumpedInputs::gather(scene, &mut ExcitationSource::new(&mut phases, &cache))?;
    let system = inputs.build()?;
    let coordinates = system.coordinates();
    let offline_s = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let (rows, cycles) = steady_rows(&inputs, system)?;
    let dte: Vec<f64> = rows.iter().map(|r| r.transmission_error_um).collect();
    point(&dte, coordinates, offline_s, start.elapsed().as_secs_f64() / cycles as f64)
}

fn point(dte: &[f64], coordinates: usize, offline_s: f64, cycle_s: f64) -> Result<MotionPoint, CommandError> {
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
