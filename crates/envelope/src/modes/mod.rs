//! The failure modes, a file each, in the order of their numbers.

use crate::FailureMode;

macro_rules! scene_text {
    ($file:literal) => {
        include_str!(concat!("../../../../scenes/envelope/", $file, ".toml"))
    };
}

mod f01_facet_noise;
mod f02_local_compliance;
mod f03_window_starvation;
mod f04_mode_switch;
mod f05_loaded_swap;
mod f06_rotation;
mod f07_low_frequency;
mod f08_periodic_faces;
mod f09_bad_elements;
mod f10_shear_locking;
mod f11_volumetric_locking;
mod f12_contact_patch;
mod f13_penalty;
mod f14_units;
mod f15_active_set;
mod f16_no_load;
mod f17_corner_contact;
mod f18_false_contact;
mod f19_coarse_stage;
mod f20_step_at_impact;
mod f21_ringing;
mod f22_energy;
mod f23_numerical_damping;
mod f24_explicit_limit;
mod f25_many_turns;
mod f26_friction_sign;
mod f27_impact_damping;
mod f28_checkerboard;
mod f29_threads;
mod f30_restart;
mod f31_bad_input;
mod f32_silent_failure;
mod f33_leakage;
mod f34_signs;
mod f35_geometry;
mod f37_lengths;
mod f38_certificate_scale;
mod f41_idle_checks;
mod f43_internal_interference;
mod f44_rigid_bore;
mod f46_opening_bolts;

/// All known failure modes, in the order of their numbers.
pub const MODES: &[FailureMode] = &[
    f01_facet_noise::MODE,
    f02_local_compliance::MODE,
    f03_window_starvation::MODE,
    f04_mode_switch::MODE,
    f05_loaded_swap::MODE,
    f06_rotation::MODE,
    f07_low_frequency::MODE,
    f08_periodic_faces::MODE,
    f09_bad_elements::MODE,
    f10_shear_locking::MODE,
    f11_volumetric_locking::MODE,
    f12_contact_patch::MODE,
    f13_penalty::MODE,
    f14_units::MODE,
    f15_active_set::MODE,
    f16_no_load::MODE,
    f17_corner_contact::MODE,
    f18_false_contact::MODE,
    f19_coarse_stage::MODE,
    f20_step_at_impact::MODE,
    f21_ringing::MODE,
    f22_energy::MODE,
    f23_numerical_damping::MODE,
    f24_explicit_limit::MODE,
    f25_many_turns::MODE,
    f26_friction_sign::MODE,
    f27_impact_damping::MODE,
    f28_checkerboard::MODE,
    f29_threads::MODE,
    f30_restart::MODE,
    f31_bad_input::MODE,
    f32_silent_failure::MODE,
    f33_leakage::MODE,
    f34_signs::MODE,
    f35_geometry::MODE,
    f37_lengths::MODE,
    f38_certificate_scale::MODE,
    f41_idle_checks::MODE,
    f43_internal_interference::MODE,
    f44_rigid_bore::MODE,
    f46_opening_bolts::MODE,
];
