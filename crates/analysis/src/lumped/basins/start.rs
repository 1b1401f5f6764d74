//! A start of a run, and the motion that it leads to.

use std::sync::Arc;

use crate::AnalysisError;

/// One start, and where it leads; units are in the names.
#[derive(Debug, Clone)]
pub struct BasinStart {
    /// Transmission error beside that of rest, um.
    pub initial_dte_um: f64,
    /// Rate of the transmission error beside that of rest, mm/s.
    pub initial_dte_rate_mm_s: f64,
    /// Number of the motion that it ends in; `None` where none comes out.
    pub attractor: Option<usize>,
    /// Mesh cycles until it is there.
    pub warm_up_cycles: u64,
    /// Why no motion comes out.
    pub failed: Option<Arc<AnalysisError>>,
}
