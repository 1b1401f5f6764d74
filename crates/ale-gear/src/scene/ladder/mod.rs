//! What a scene says to the cheaper models of the pair, beside what it says to all: one table each, and one for the mesh.

mod belongs;
mod check;
mod raw;

use serde::Serialize;

pub(super) use belongs::{in_time, moves, tables};
pub(super) use check::{Rung, lumped8, lumped12, mesh};
pub(super) use raw::{RawLumped8, RawLumped12, RawMesh};

/// Mesh of a model that has a stiffness instead of flanks.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeshScene {
    /// Where the stiffness over the mesh cycle comes from.
    pub stiffness_from: StiffnessFrom,
    /// Mean along the flanks' normal, N/um; set exactly where the series is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_n_per_um: Option<f64>,
    /// Cosine amplitudes of the mesh orders 1, 2, ...
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stiffness_cos_n_per_um: Vec<f64>,
    /// Sine amplitudes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stiffness_sin_n_per_um: Vec<f64>,
    /// Unloaded transmission error on the transverse line of action, positive when the driven gear lags.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub error_cos_um: Vec<f64>,
    /// Sine amplitudes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub error_sin_um: Vec<f64>,
    /// Half of the backlash along the normal; 0: a linear mesh. `None`: that of the geometry, or of no meaning to the model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub half_backlash_um: Option<f64>,
    /// How friction weighs the contact lines; of the models that have lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line_sharing: Option<Sharing>,
}

/// Where the stiffness over the mesh cycle comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum StiffnessFrom {
    /// The series in the scene.
    Series,
    /// The quasi-static cycle of the reduced model of the same scene, its error with it.
    Reduced,
    /// ISO 6336-1's mean, in proportion to the length of the contact lines.
    Iso,
}

/// How friction weighs the contact lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Sharing {
    /// By their length.
    Length,
    /// Every line alike.
    Line,
}

/// The model with eight coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Lumped8Scene {
    /// How mesh stiffness becomes transverse and axial force.
    pub law: Law,
    /// Amplitude of the driver's speed about its mean, 1/min.
    pub speed_fluctuation_rpm: f64,
    /// Its frequency, Hz; set exactly where there is a fluctuation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed_fluctuation_hz: Option<f64>,
}

/// How mesh stiffness becomes transverse and axial force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Law {
    /// One spring along the normal.
    Normal,
    /// Two with projected stiffness, as seed 004 prints.
    Projected,
}

/// The model with twelve coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Lumped12Scene {
    /// Direction from the driver's centre to the driven gear's, degrees from +x; `None`: as the pair stands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation_deg: Option<f64>,
    /// Ratio of Rayleigh's damping at two frequencies.
    pub damping_ratio: f64,
    /// The lower.
    pub damping_from_hz: f64,
    /// The higher.
    pub damping_to_hz: f64,
}
