//! The rating table of a gearbox file; checks that a requested rating is possible.

use super::{
    file::{GearboxBearing, GearboxMesh, GearboxRating, GearboxRolling},
    schema::{GEARBOX_RATING, RawGearbox},
    values::{Checked, given, needed_of, row},
};
use crate::{Source, inputs::named};

/// What is rated, and at which speed; nothing where there is no table and nobody needs it.
pub(super) fn rating(
    s: &Source<'_>,
    raw: &RawGearbox,
    (meshes, bearings): (&[GearboxMesh], &[GearboxBearing]),
) -> Checked<Option<GearboxRating>> {
    let rated_mesh = meshes.iter().position(|mesh| mesh.scene.rating.is_some());
    let rated_bearing = bearings.iter().position(|own| own.rolling.as_ref().is_some_and(GearboxRolling::has_life));
    let Some(table) = &raw.rating else {
        let advice = "add [rating] with `speed_rpm`, the speed of the input";
        if let Some(i) = rated_mesh {
            let said = format!("the pair of mesh \"{}\" is to be rated, and no speed is stated", meshes[i].name);
            return Err(s.conflict(&raw.mesh[i].span(), said, advice));
        }
        let stated = raw.bearing.iter().find_map(|own| own.get_ref().dynamic_rating_kn.as_ref());
        return match stated {
            Some(own) => Err(s.conflict(&own.span(), "the life of a bearing without a speed", advice)),
            None => Ok(None),
        };
    };
    let own = table.get_ref();
    let viscosity = given!(s, GEARBOX_RATING, own.viscosity_mm2_per_s)?;
    let contamination_factor = given!(s, GEARBOX_RATING, own.contamination_factor)?;
    let has_loads = |mesh: &GearboxMesh| mesh.scene.rating.as_ref().is_some_and(|r| r.spectrum.is_some());
    if let Some(i) = meshes.iter().position(has_loads) {
        let said = format!("the scene of mesh \"{}\" has a load spectrum of its own", meshes[i].name);
        let advice = "leave it out, and give [rating] of the gearbox a `spectrum`: its loads act on all meshes";
        return Err(s.conflict(&raw.mesh[i].span(), said, advice));
    }
    let spectrum = own.spectrum.as_ref().map(|word| named(s, "spectrum", word)).transpose()?;
    if let Some(word) = &own.spectrum {
        if raw
            .torque
            .first()
            .is_none_or(|first| !first.get_ref().torque_nm.as_ref().is_some_and(|t| *t.get_ref() > 0.0))
        {
            let advice = "give the first [[torque]] a `torque_nm` above 0, which the spectrum multiplies, or leave the spectrum out";
            return Err(s.conflict(&word.span(), "a load spectrum without a torque", advice));
        }
        if rated_mesh.is_none() && rated_bearing.is_none() {
            let advice =
                "give the scene of a mesh a [rating], or a rolling bearing its `dynamic_rating_kn` or `designation`";
            return Err(s.conflict(&word.span(), "a load spectrum, and nothing has a life", advice));
        }
    }
    let rolls = bearings.iter().any(|own| own.rolling.is_some());
    if let (Some(number), false) = (&own.viscosity_mm2_per_s, rolls) {
        let advice = "give one its `type`, or leave it out";
        return Err(s.conflict(&number.span(), "`viscosity_mm2_per_s` needs a bearing with `type`", advice));
    }
    if let Some(number) = &own.contamination_factor {
        if rated_bearing.is_none() {
            let advice = "give one its `dynamic_rating_kn` or `designation`, or leave it out";
            return Err(s.conflict(
                &number.span(),
                "`contamination_factor` needs a bearing with `dynamic_rating_kn`",
                advice,
            ));
        }
        if viscosity.is_none() {
            let said = "a modified life also wants `viscosity_mm2_per_s`";
            return Err(s.conflict(&number.span(), said, "give both, or leave `contamination_factor` out"));
        }
    }
    if rated_mesh.is_none() && rated_bearing.is_none() && viscosity.is_none() {
        let advice = "give the scene of a mesh a [rating], or a rolling bearing its `dynamic_rating_kn` or `designation`; or leave it out";
        return Err(s.conflict(&table.span(), "[rating] rates nothing", advice));
    }
    let speed_rpm = needed_of(s, (table, "[rating]"), &GEARBOX_RATING, "speed_rpm", &own.speed_rpm)?;
    Ok(Some(GearboxRating { speed_rpm, viscosity, contamination_factor, spectrum }))
}
