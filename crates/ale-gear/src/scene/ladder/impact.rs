//! Words on the impact of rigid gears.

use super::ImpactScene;
use super::check::{conflict, optional};
use super::raw::RawImpact;
use crate::scene::SceneError;
use crate::scene::source::Source;

pub(in crate::scene) fn impact(s: &Source<'_>, raw: &RawImpact) -> Result<ImpactScene, SceneError> {
    let made = ImpactScene {
        stiffness_n_per_mm_to_exponent: optional(
            s,
            "stiffness_n_per_mm_to_exponent",
            &raw.stiffness_n_per_mm_to_exponent,
            1e-6,
            1e15,
        )?,
        // The formula for the stiffness belongs to 1.5.
        exponent: s.number("exponent", &raw.exponent, 1.5, 1.0, 10.0)?,
        damping_ns_per_mm: s.number("damping_ns_per_mm", &raw.damping_ns_per_mm, 50.0, 0.0, 1e9)?,
        damping_depth_mm: s.number("damping_depth_mm", &raw.damping_depth_mm, 0.1, 1e-9, 1e3)?,
        static_friction: s.number("static_friction", &raw.static_friction, 0.0, 0.0, 1.0)?,
        dynamic_friction: s.number("dynamic_friction", &raw.dynamic_friction, 0.0, 0.0, 1.0)?,
        static_speed_mm_per_s: s.number("static_speed_mm_per_s", &raw.static_speed_mm_per_s, 0.1, 1e-9, 1e6)?,
        dynamic_speed_mm_per_s: s.number("dynamic_speed_mm_per_s", &raw.dynamic_speed_mm_per_s, 10.0, 1e-9, 1e6)?,
    };
    let ascending = made.dynamic_speed_mm_per_s > made.static_speed_mm_per_s;
    match raw.dynamic_speed_mm_per_s.as_ref().or(raw.static_speed_mm_per_s.as_ref()) {
        Some(at) if !ascending => {
            let what = format!(
                "`dynamic_speed_mm_per_s` is {}, not above `static_speed_mm_per_s`, {}",
                made.dynamic_speed_mm_per_s, made.static_speed_mm_per_s
            );
            Err(conflict(s, at, what, "flanks stick below the one and slip above the other"))
        }
        _ => Ok(made),
    }
}
