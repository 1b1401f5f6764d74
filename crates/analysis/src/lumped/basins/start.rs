//! Start of a run, and the motion to which it leads.

use std::sync::Arc;

use crate::AnalysisError;

/// One start and its motion; units are in the names.
#[derive(Debug, Clone)]
pub struct BasinStart {
    /// Transmission error relative to that of equilibrium, um.
    pub initial_dte_um: f64,
    /// Rate of the transmission error relative to that of equilibrium, mm/s.
    pub initial_dte_rate_mm_s: f64,
    /// Index of the final motion; `None` if there is none.
    pub attractor: Option<usize>,
    /// Number of mesh cycles until the final motion.
    pub warm_up_cycles: u64,
    /// Reason why there is no final motion.
    pub failed: Option<Arc<AnalysisError>>,
}
