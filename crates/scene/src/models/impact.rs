//! Raw values of the impact model of rigid gears.

use crate::schema::RawImpact;
use crate::source::Source;
use crate::{ImpactScene, SceneError};

pub(crate) fn impact(s: &Source<'_>, raw: &RawImpact) -> Result<ImpactScene, SceneError> {
    // The formula for the stiffness belongs to the exponent 1.5.
    let made = ImpactScene::read(s, raw, f64::INFINITY)?;
    let ascending = made.dynamic_speed_mm_per_s > made.static_speed_mm_per_s;
    match raw.dynamic_speed_mm_per_s.as_ref().or(raw.static_speed_mm_per_s.as_ref()) {
        Some(at) if !ascending => {
            let what = format!(
                "`dynamic_speed_mm_per_s` is {}, not above `static_speed_mm_per_s`, {}",
                made.dynamic_speed_mm_per_s, made.static_speed_mm_per_s
            );
            Err(s.conflict(&at.span(), what, "friction is static below `static_speed_mm_per_s` and dynamic above `dynamic_speed_mm_per_s`: raise the second or lower the first"))
        }
        _ => Ok(made),
    }
}
