//! What a chart of accuracy against cost takes from this process: memory, and a folder for CalculiX.

use analysis::accuracy_chart::{AccuracyChart, ChartOptions, MemoryGauge, WorkPrecision};

use files::Scratch;

use crate::{error::CommandError, memory, phases::Phases, scene::Scene};

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
    let scratch = Scratch::make("ale-gear-calculix").map_err(|e| CommandError::write(&std::env::temp_dir(), &e))?;
    let chart = AccuracyChart::new(scene, options).with_memory(&ProcessMemory).with_scratch(scratch.path());
    Ok(chart.run(phases)?)
}
