//! Loaded lengths of a map, and the share of damping that the limit by the contact force permits. Theory (74).

use serde::{Deserialize, Serialize};

/// Loaded lengths, and how strongly the local force limits a damper on each of them.
///
/// ```text
/// L_k = sum over loaded slices of h zeta^k,   k = 0, 1, 2
/// sum of min(w h, F_i) = F e(phase, F, sigma) sigma,   sigma = w L_0 / (F + w L_0)
/// ```
/// w is the damping per length times the rate of approach, N/mm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DampingTable {
    /// Coefficients of L_0, L_1, L_2 over the places of the map.
    pub(crate) lengths: [Vec<f64>; 3],
    /// Coefficients of e over phase, load and sigma.
    pub(crate) share: Vec<f64>,
    /// Intervals over sigma.
    pub(crate) shares: usize,
}
