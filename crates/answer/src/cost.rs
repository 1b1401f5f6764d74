//! What a run cost.

use serde::{Deserialize, Serialize};

described::described! {
    /// What one phase cost.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct Phase {
        /// name of the phase: `read`, `reduce`, `solve`, ..
        pub name: String,
        /// wall time of the phase
        pub wall_s: f64,
        /// largest resident set during the phase; `null` where the system does not tell
        pub peak_memory_mb: Option<f64>,
    }
}

described::described! {
    /// What the whole run cost.
    #[derive(Debug, Clone, Default, Serialize, Deserialize)]
    pub struct Cost {
        /// threads of the computation
        pub threads: usize,
        /// wall time from reading the document to the last file but this one
        pub wall_s: f64,
        /// largest resident set of the run; `null` where the system does not tell
        pub peak_memory_mb: Option<f64>,
        /// wall time and memory of each phase
        pub phases: Vec<Phase>,
    }
}
