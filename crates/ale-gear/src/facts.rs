//! What the writers need to know of a run beside its scene and its history.

use ltca::StaticHistory;
use serde::Serialize;

use report::view::View;

pub use analysis::facts::*;

use crate::phases::{Phase, Phases};

/// A solved scene.
#[derive(Debug, Clone)]
pub struct Solved {
    /// Position by position.
    pub history: StaticHistory,
    /// What it took.
    pub facts: Facts,
    /// The gears in space; `None` for a model without meshes, and where nobody asked.
    pub view: Option<View>,
}

/// What the whole run cost.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Cost {
    /// Threads of the computation.
    pub threads: usize,
    /// Wall time from reading the scene to the last file but this one, s.
    pub wall_s: f64,
    /// Largest resident set, MB; `null` where the system does not tell.
    pub peak_memory_mb: Option<f64>,
    /// Phase by phase.
    pub phases: Vec<Phase>,
}

impl Cost {
    /// So far.
    pub fn of(phases: &Phases) -> Self {
        Self {
            threads: rayon::current_num_threads(),
            wall_s: phases.total_wall_s(),
            peak_memory_mb: phases.peak_memory_mb(),
            phases: phases.rows().to_vec(),
        }
    }
}
