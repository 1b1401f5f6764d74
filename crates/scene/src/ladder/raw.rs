//! The words of the tables on the cheaper models, nothing checked yet.

use serde::Deserialize;
use toml::Spanned;

use crate::motion::{Matrix, RawSupport};
use crate::raw::{Number, Word};

/// A list of numbers as written.
pub(crate) type List = Option<Spanned<Vec<f64>>>;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMesh {
    pub stiffness_from: Word,
    pub stiffness_n_per_um: Number,
    pub stiffness_cos_n_per_um: List,
    pub stiffness_sin_n_per_um: List,
    pub error_cos_um: List,
    pub error_sin_um: List,
    pub half_backlash_um: Number,
    pub line_sharing: Word,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawLumped8 {
    pub law: Word,
    pub speed_fluctuation_rpm: Number,
    pub speed_fluctuation_hz: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawLumped12 {
    pub orientation_deg: Number,
    pub damping_ratio: Number,
    pub damping_from_hz: Number,
    pub damping_to_hz: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawImpact {
    pub stiffness_n_per_mm_to_exponent: Number,
    pub exponent: Number,
    pub damping_ns_per_mm: Number,
    pub damping_depth_mm: Number,
    pub static_friction: Number,
    pub dynamic_friction: Number,
    pub static_speed_mm_per_s: Number,
    pub dynamic_speed_mm_per_s: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawShaft18 {
    pub mass_damping_per_s: Number,
    pub stiffness_damping_s: Number,
    pub gravity_m_per_s2: List,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawShaft {
    pub segments_mm: Matrix,
    pub gear_at_mm: Number,
    pub torque_at_mm: Number,
    pub nodes_mm: List,
    pub run_out_um: Number,
    pub run_out_phase_deg: Number,
    #[serde(default)]
    pub discs: Vec<Spanned<RawDisc>>,
    #[serde(default)]
    pub supports: Vec<Spanned<RawSupport>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawDisc {
    pub at_mm: Number,
    pub mass_kg: Number,
    pub polar_inertia_kg_m2: Number,
    pub transverse_inertia_kg_m2: Number,
    pub keeps: Option<Vec<Spanned<String>>>,
}
