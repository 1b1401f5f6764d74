//! The table of ratings of a gearbox file, and that nobody asks for one in vain.

use toml::Spanned;

use super::{
    file::{BearingOil, GearboxBearing, GearboxMesh, GearboxRating},
    schema::{GEARBOX_RATING, RawGearbox, RawGearboxRating},
    values::{Checked, given, needed_of, row},
};
use crate::{Number, Source};

/// What is rated, and at which speed; nothing where there is no table and nobody needs it.
pub(super) fn rating(
    s: &Source<'_>,
    raw: &RawGearbox,
    (meshes, bearings): (&[GearboxMesh], &[GearboxBearing]),
) -> Checked<Option<GearboxRating>> {
    let rated_mesh = meshes.iter().position(|mesh| mesh.scene.rating.is_some());
    let rated_bearing =
        bearings.iter().position(|own| own.rolling.as_ref().is_some_and(|r| r.dynamic_rating.is_some()));
    let Some(table) = &raw.rating else {
        let advice = "say [rating] with `speed_rpm`, the speed of the input";
        if let Some(i) = rated_mesh {
            let said = format!("the pair of mesh \"{}\" is to be rated, and no speed is stated", meshes[i].name);
            return Err(s.conflict(&raw.mesh[i].span(), said, advice));
        }
        let at = rated_bearing.and_then(|i| raw.bearing[i].get_ref().dynamic_rating_kn.as_ref());
        return match at {
            Some(own) => Err(s.conflict(&own.span(), "the life of a bearing without a speed", advice)),
            None => Ok(None),
        };
    };
    if rated_mesh.is_none() && rated_bearing.is_none() {
        let advice =
            "give the scene of a mesh a [rating], or a rolling bearing its `dynamic_rating_kn`; or leave it out";
        return Err(s.conflict(&table.span(), "[rating] rates nothing", advice));
    }
    let speed_rpm = speed(s, table)?;
    let own = table.get_ref();
    let oil = oil(s, own)?;
    if let (Some(number), None) = (&own.viscosity_mm2_per_s, rated_bearing) {
        let advice = "give one its `dynamic_rating_kn`, or leave it out";
        return Err(s.conflict(&number.span(), "oil of bearings, none of which has a rating", advice));
    }
    Ok(Some(GearboxRating { speed_rpm, oil }))
}

fn speed(s: &Source<'_>, table: &Spanned<RawGearboxRating>) -> Checked<f64> {
    needed_of(s, (table, "[rating]"), &GEARBOX_RATING, "speed_rpm", &table.get_ref().speed_rpm)
}

/// Viscosity and dirt go together.
fn oil(s: &Source<'_>, raw: &RawGearboxRating) -> Checked<Option<BearingOil>> {
    let viscosity = given!(s, GEARBOX_RATING, raw.viscosity_mm2_per_s)?;
    let contamination = given!(s, GEARBOX_RATING, raw.contamination_factor)?;
    let alone = |number: &Number, other: &str| {
        let at = number.as_ref().map_or(0..0, Spanned::span);
        Err(s.conflict(&at, format!("a modified life also wants `{other}`"), "give both, or leave both out"))
    };
    match (viscosity, contamination) {
        (Some(viscosity), Some(contamination_factor)) => Ok(Some(BearingOil { viscosity, contamination_factor })),
        (Some(_), None) => alone(&raw.viscosity_mm2_per_s, "contamination_factor"),
        (None, Some(_)) => alone(&raw.contamination_factor, "viscosity_mm2_per_s"),
        (None, None) => Ok(None),
    }
}
