//! How good a map is, and what it cost. Theory (73).

use serde::{Deserialize, Serialize};

/// Error of the friction of a map, over the force there or the mean one where that is more; moments over half of the path of
/// contact and over the width of face beside.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FrictionError {
    /// Root mean square of the largest of its four parts.
    pub rms: f64,
    /// Largest.
    pub largest: f64,
}

/// Certificate of a map: errors and cost.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MapCertificate {
    /// Phases of a mesh cycle.
    pub phases: usize,
    /// Forces.
    pub loads: usize,
    /// Tilts.
    pub tilts: usize,
    /// Contacts that were solved for it.
    pub contacts: usize,
    /// Places at which it was held against the contact itself.
    pub checks: usize,
    /// Root mean square of the approach's error there, mm.
    pub rms_error_mm: f64,
    /// Largest error of the approach there, mm.
    pub largest_error_mm: f64,
    /// Mean approach under the mean force, from first touch, mm: what errors are relative to.
    pub deflection_mm: f64,
    /// Error of friction there, of flanks that have some.
    pub friction: Option<FrictionError>,
}

impl MapCertificate {
    /// Root mean square of the approach's error over the mean approach, or that of friction where it is larger.
    pub fn error(&self) -> f64 {
        (self.rms_error_mm / self.deflection_mm).max(self.friction.map_or(0.0, |of| of.rms))
    }
}
