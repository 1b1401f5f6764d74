//! Accuracy and cost of a map. Theory (73).

use serde::{Deserialize, Serialize};

/// Error of a map's friction, relative to the force or, if larger, the mean force; errors of moments are in addition
/// divided by half of the path of contact and by the face width.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FrictionError {
    /// Root mean square of the largest of its four components.
    pub rms: f64,
    /// Largest error.
    pub largest: f64,
}

/// Certificate of a map: errors and cost.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MapCertificate {
    /// Number of phases of a mesh cycle.
    pub phases: usize,
    /// Number of forces.
    pub loads: usize,
    /// Number of tilts.
    pub tilts: usize,
    /// Number of contacts solved for the map.
    pub contacts: usize,
    /// Number of positions at which the map was compared with the contact.
    pub checks: usize,
    /// Root mean square error of the approach there, mm.
    pub rms_error_mm: f64,
    /// Largest error of the approach there, mm.
    pub largest_error_mm: f64,
    /// Mean approach under the mean force, from first contact, mm; errors are relative to it.
    pub deflection_mm: f64,
    /// Error of the friction there, for flanks with friction.
    pub friction: Option<FrictionError>,
}

impl MapCertificate {
    /// Root mean square error of the approach divided by the mean approach, or the error of the friction if that is
    /// larger.
    pub fn error(&self) -> f64 {
        (self.rms_error_mm / self.deflection_mm).max(self.friction.map_or(0.0, |of| of.rms))
    }
}
