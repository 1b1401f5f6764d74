//! The words of the tables on the cheaper models, nothing checked yet.

use serde::Deserialize;
use toml::Spanned;

use crate::scene::raw::{Number, Word};

/// A list of numbers as written.
pub(in crate::scene) type List = Option<Spanned<Vec<f64>>>;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct RawMesh {
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
pub(in crate::scene) struct RawLumped8 {
    pub law: Word,
    pub speed_fluctuation_rpm: Number,
    pub speed_fluctuation_hz: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::scene) struct RawLumped12 {
    pub orientation_deg: Number,
    pub damping_ratio: Number,
    pub damping_from_hz: Number,
    pub damping_to_hz: Number,
}
