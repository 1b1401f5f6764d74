//! What a chart of accuracy against cost takes from this process: memory, a folder for CalculiX, the reduced model in motion.

use analysis::accuracy_chart::{AccuracyChart, ChartOptions, MOTION_CYCLES, MemoryGauge, MotionPoint, WorkPrecision};
use report::columns::motion_history::DTE;

use crate::{error::CommandError, memory, motion, partial::Partial, phases::Phases, scene::Scene};

/// Memory of this process.
pub(crate) struct ProcessMemory;

impl MemoryGauge for ProcessMemory {
    fn reset_peak(&self) {
        // Where the system cannot, peaks are those since the start.
        memory::reset_peak();
    }

    fn peak_mb(&self) -> Option<f64> {
        memory::peak_mb()
    }

    fn available_mb(&self) -> Option<f64> {
        memory::available_mb()
    }
}

/// Runs every point of a scene's chart.
///
/// # Errors
/// Exit status 1 without a reference.
pub(crate) fn chart(scene: &Scene, options: &ChartOptions, phases: &mut Phases) -> Result<WorkPrecision, CommandError> {
    let scratch = scratch_folder("calculix")?;
    let reduced = |scene: &Scene| reduced_motion(scene).map_err(|e| e.message);
    let chart = AccuracyChart::new(scene, options).with_memory(&ProcessMemory).with_scratch(scratch.path());
    Ok(chart.with_reduced_motion(&reduced).run(phases)?)
}

/// A folder for what is not a result; it goes with the value.
fn scratch_folder(what: &str) -> Result<Partial, CommandError> {
    let scratch = Partial::new(std::env::temp_dir().join(format!("ale-gear-{what}-{}", std::process::id())));
    std::fs::create_dir_all(scratch.path()).map_err(|e| CommandError::write(scratch.path(), &e))?;
    Ok(scratch)
}

/// The reduced model in motion; its rows go into a folder of their own.
fn reduced_motion(scene: &Scene) -> Result<MotionPoint, CommandError> {
    let scratch = scratch_folder("chart")?;
    let mut phases = Phases::quiet();
    let none = || CommandError::input(format_args!("{}: no motion", scene.file.display()), None);
    let rows = motion::rows_of(scene, scene.motion.as_ref().ok_or_else(none)?, &mut phases, scratch.path())?;
    let wall = |solve: bool| -> f64 {
        let own = phases.rows().iter().filter(|p| matches!(p.name.as_str(), "settle" | "solve") == solve);
        own.filter(|p| !solve || p.name == "solve").map(|p| p.wall_s).sum()
    };
    Ok(MotionPoint::of(rows.series(DTE.name)?, 1, wall(false), wall(true) / f64::from(MOTION_CYCLES)))
}
