//! Words on the impact of rigid gears.

use super::ImpactScene;
use super::raw::RawImpact;
use crate::source::Source;
use crate::{SceneError, schema};

pub(crate) fn impact(s: &Source<'_>, raw: &RawImpact) -> Result<ImpactScene, SceneError> {
    let made = ImpactScene {
        stiffness_n_per_mm_to_exponent: s.optional_of(
            &schema::IMPACT,
            "stiffness_n_per_mm_to_exponent",
            &raw.stiffness_n_per_mm_to_exponent,
        )?,
        // The formula for the stiffness belongs to 1.5.
        exponent: s.number_of(&schema::IMPACT, "exponent", &raw.exponent)?,
        damping_ns_per_mm: s.number_of(&schema::IMPACT, "damping_ns_per_mm", &raw.damping_ns_per_mm)?,
        damping_depth_mm: s.number_of(&schema::IMPACT, "damping_depth_mm", &raw.damping_depth_mm)?,
        static_friction: s.number_of(&schema::IMPACT, "static_friction", &raw.static_friction)?,
        dynamic_friction: s.number_of(&schema::IMPACT, "dynamic_friction", &raw.dynamic_friction)?,
        static_speed_mm_per_s: s.number_of(&schema::IMPACT, "static_speed_mm_per_s", &raw.static_speed_mm_per_s)?,
        dynamic_speed_mm_per_s: s.number_of(&schema::IMPACT, "dynamic_speed_mm_per_s", &raw.dynamic_speed_mm_per_s)?,
    };
    let ascending = made.dynamic_speed_mm_per_s > made.static_speed_mm_per_s;
    match raw.dynamic_speed_mm_per_s.as_ref().or(raw.static_speed_mm_per_s.as_ref()) {
        Some(at) if !ascending => {
            let what = format!(
                "`dynamic_speed_mm_per_s` is {}, not above `static_speed_mm_per_s`, {}",
                made.dynamic_speed_mm_per_s, made.static_speed_mm_per_s
            );
            Err(s.conflict(&at.span(), what, "flanks stick below the one and slip above the other"))
        }
        _ => Ok(made),
    }
}
