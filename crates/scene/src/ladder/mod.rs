//! What a scene says to the cheaper models of the pair, beside what it says to all: one table each, and one for the
//! mesh.

mod check;
mod impact;
mod model_tables;
mod shaft;
mod without_effect;

use serde::Serialize;

pub(super) use check::Rung;
pub(super) use model_tables::{ModelTables, model_tables};
pub(super) use shaft::shaft;
pub(super) use without_effect::{check_free_coordinates, check_in_time, check_tables};

use crate::schema::{Law, ShaftCoordinate, Sharing, StiffnessFrom, SupportScene};

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
    /// Half of the backlash along the normal; 0: a linear mesh. `None`: that of the geometry, or of no meaning to the
    /// model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub half_backlash_um: Option<f64>,
    /// How friction weighs the contact lines; of the models that have lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line_sharing: Option<Sharing>,
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

/// Both shafts of the model of shafts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Shaft18Scene {
    /// Damping in proportion to mass, 1/s.
    pub mass_damping_per_s: f64,
    /// Damping in proportion to stiffness, s.
    pub stiffness_damping_s: f64,
    /// Acceleration of gravity along x, y, z, m/s^2.
    pub gravity_m_per_s2: [f64; 3],
}

/// The shaft of a gear; places are mm from the beginning of its first segment.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShaftScene {
    /// Length, outer and inner diameter of each segment, mm.
    pub segments_mm: Vec<[f64; 3]>,
    /// Place of the gear.
    pub gear_at_mm: f64,
    /// Where drive or load acts.
    pub torque_at_mm: f64,
    /// Further places at which the shaft's own mass is put.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub nodes_mm: Vec<f64>,
    /// Eccentricity of the gear's teeth, um.
    pub run_out_um: f64,
    /// Its angle before the line of action at the start, degrees.
    pub run_out_phase_deg: f64,
    /// Couplings and wheels on it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub discs: Vec<DiscScene>,
    /// Bearings.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub supports: Vec<SupportScene>,
}

/// A mass on a shaft.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DiscScene {
    /// Place.
    pub at_mm: f64,
    /// Mass, kg.
    pub mass_kg: f64,
    /// About the shaft's axis, kg m^2.
    pub polar_inertia_kg_m2: f64,
    /// About an axis across, kg m^2.
    pub transverse_inertia_kg_m2: f64,
    /// Coordinates that remain; the others follow statically.
    pub keeps: Vec<ShaftCoordinate>,
}

impl SupportScene {
    /// Along and about x, y, z.
    pub fn stiffnesses(&self) -> [f64; 6] {
        [
            self.stiffness_x_n_per_mm,
            self.stiffness_y_n_per_mm,
            self.stiffness_z_n_per_mm,
            self.stiffness_rx_nmm_per_rad,
            self.stiffness_ry_nmm_per_rad,
            self.stiffness_rz_nmm_per_rad,
        ]
    }

    /// Likewise.
    pub fn dampings(&self) -> [f64; 6] {
        [
            self.damping_x_ns_per_mm,
            self.damping_y_ns_per_mm,
            self.damping_z_ns_per_mm,
            self.damping_rx_nmms_per_rad,
            self.damping_ry_nmms_per_rad,
            self.damping_rz_nmms_per_rad,
        ]
    }
}
