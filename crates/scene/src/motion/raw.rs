//! The words of the tables on motion, nothing checked yet.

use serde::Deserialize;
use toml::Spanned;

use crate::raw::{Number, Whole, Word};

pub(crate) type Matrix = Option<Spanned<Vec<Spanned<Vec<f64>>>>>;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawBody {
    pub mass_kg: Number,
    pub transverse_inertia_kg_m2: Number,
    pub polar_inertia_kg_m2: Number,
    pub added_inertia_kg_m2: Number,
    pub free: Option<Vec<Spanned<String>>>,
}

/// A table with a spring and a damper along and about each axis, and keys of its own. (Unknown keys are refused, which serde cannot do for tables put together of two.)
macro_rules! held_table {
    ($name:ident { $($own:ident: $kind:ty),* }) => {
        #[derive(Debug, Default, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct $name {
            $(pub $own: $kind,)*
            pub stiffness_x_n_per_mm: Number,
            pub stiffness_y_n_per_mm: Number,
            pub stiffness_z_n_per_mm: Number,
            pub stiffness_rx_nmm_per_rad: Number,
            pub stiffness_ry_nmm_per_rad: Number,
            pub stiffness_rz_nmm_per_rad: Number,
            pub damping_x_ns_per_mm: Number,
            pub damping_y_ns_per_mm: Number,
            pub damping_z_ns_per_mm: Number,
            pub damping_rx_nmms_per_rad: Number,
            pub damping_ry_nmms_per_rad: Number,
            pub damping_rz_nmms_per_rad: Number,
        }
    };
}

held_table!(RawBearing { damping_ratio: Number, stiffness_matrix_n_mm_rad: Matrix, damping_matrix_ns_mm_rad: Matrix });
held_table!(RawSupport { at_mm: Number });

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawDrive {
    pub by: Word,
    pub torque_nm: Number,
    pub amplitude_nm: Number,
    pub frequency_hz: Number,
    pub phase_deg: Number,
    pub table_s_nm: Matrix,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawLoad {
    pub amplitude_nm: Number,
    pub frequency_hz: Number,
    pub phase_deg: Number,
    pub table_s_nm: Matrix,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMotion {
    pub run: Word,
    pub method: Word,
    pub spectral_radius: Number,
    pub steps_per_mesh_cycle: Whole,
    pub steps_per_resonance: Whole,
    pub error_tolerance: Number,
    pub stop_at_events: Option<Spanned<bool>>,
    pub mesh_damping_ratio: Number,
    pub mesh_damping_ns_per_mm2: Number,
    pub periodic_tolerance: Number,
    pub warm_up_cycles: Whole,
    pub duration_s: Number,
    pub checkpoint_every_cycles: Whole,
    pub ramp: Option<Spanned<RawRamp>>,
    pub sweep: Option<Spanned<RawSweep>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawRamp {
    pub from_rpm: Number,
    pub to_rpm: Number,
    pub duration_s: Number,
    pub before_s: Number,
    pub after_s: Number,
    pub waterfall_cycles: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSweep {
    pub from_rpm: Number,
    pub to_rpm: Number,
    pub speeds: Whole,
    pub ways: Option<Vec<Spanned<String>>>,
    pub steady_by: Word,
}
