//! What a run cost.

use serde::{Deserialize, Serialize};

/// What one phase cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Phase {
    /// What was done: `read`, `reduce`, `solve`, ...
    pub name: String,
    /// Wall time, s.
    pub wall_s: f64,
    /// Largest resident set during the phase, MB; `null` where the system cannot tell a phase's own.
    pub peak_memory_mb: Option<f64>,
}

/// What the whole run cost.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
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
