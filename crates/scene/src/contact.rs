//! How flanks press on each other.

use serde::Serialize;

use crate::schema::{Flanks, Gap, Method};

/// How flanks press on each other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactScene {
    /// Where the contact unknowns sit.
    pub method: Method,
    /// Slices over the face width; `None` for the method nodal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slices: Option<u32>,
    /// Whether tip edges may press off the line of action; `None` for the method nodal, where they always may.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner_contact: Option<bool>,
    /// Coefficient of friction.
    pub friction: f64,
    /// Pressure a mm of penetration, MPa/mm; `None`: exact complementarity.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub penalty_mpa_per_mm: Option<f64>,
    /// Which surface gives the gaps; `None` for slices.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gap: Option<Gap>,
    /// Contact points along each edge of a flank face; `None` for slices.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub points_per_face_edge: Option<u32>,
    /// Which flanks may touch.
    pub flanks: Flanks,
}
