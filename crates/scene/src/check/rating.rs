//! Checks of `[rating]`: missing inputs are requested by name.

use toml::Spanned;

use super::Checked;
use crate::{
    Kind, RatingScene, Scene, SceneError,
    keys::nearest,
    schema::{RawRatedGear, RawRating, RawScene},
    source::Source,
    spanned::Number,
};

/// The table where it stands.
pub(super) fn rating(s: &Source<'_>, raw: &RawScene) -> Checked<Option<RatingScene>> {
    raw.rating.as_ref().map(|table| read(s, table.get_ref())).transpose()
}

/// A gear without keys, which is asked for all of them.
fn of_gear(table: &Option<Spanned<RawRatedGear>>) -> RawRatedGear {
    table.as_ref().map_or_else(RawRatedGear::default, |table| table.get_ref().clone())
}

fn read(s: &Source<'_>, raw: &RawRating) -> Checked<RatingScene> {
    let gears = [&raw.pinion, &raw.wheel].map(of_gear);
    let missing = missing(raw, &gears);
    if !missing.is_empty() {
        return Err(SceneError::Missing { file: s.file.to_owned(), keys: missing });
    }
    let mut rating = RatingScene::read(s, raw, f64::INFINITY)?;
    if raw.lubrication.is_none() {
        rating.lubrication = None;
    }
    without_effect(s, raw, &gears, &rating)?;
    if let (Some(word), None) = (&raw.lubricant, rating.oil()) {
        return Err(unknown(s, "lubricant", word, rating.lubricant_table().names().collect()));
    }
    for (k, raw) in gears.iter().enumerate() {
        if let (Some(word), None) = (&raw.material, rating.material_of(k)) {
            return Err(unknown(s, "material", word, rating.material_table().names().collect()));
        }
    }
    Ok(rating)
}

/// Keys without a default that are not there, all at once.
fn missing(raw: &RawRating, gears: &[RawRatedGear; 2]) -> Vec<String> {
    let [scuffing, micropitting] =
        [&raw.scuffing, &raw.micropitting].map(|switch| switch.as_ref().is_some_and(|on| *on.get_ref()));
    let hot = scuffing || micropitting;
    let by_test = micropitting && raw.permissible_specific_film_thickness.is_none();
    let of_pair = [
        ("life_h", raw.life_h.is_none()),
        ("application_factor", raw.application_factor.is_none()),
        ("tolerance_class", raw.tolerance_class.is_none()),
        ("lubricant", raw.lubricant.is_none()),
        ("oil_temperature_c", hot && raw.oil_temperature_c.is_none()),
        ("lubrication", hot && raw.lubrication.is_none()),
        ("structural_factor", scuffing && raw.structural_factor.is_none()),
        ("material_factor", by_test && raw.material_factor.is_none()),
    ];
    let oily = hot || raw.oil_temperature_c.is_some();
    let of_gears = ["pinion", "wheel"].into_iter().zip(gears).flat_map(|(name, gear)| {
        [
            ("material", gear.material.is_none()),
            ("flank_roughness_rz_um", gear.flank_roughness_rz_um.is_none()),
            ("root_roughness_rz_um", gear.root_roughness_rz_um.is_none()),
            ("flank_roughness_ra_um", oily && gear.flank_roughness_ra_um.is_none()),
        ]
        .map(|(key, gone)| (format!("`[rating.{name}] {key}`"), gone))
    });
    let of_pair = of_pair.into_iter().map(|(key, gone)| (format!("`[rating] {key}`"), gone));
    of_pair.chain(of_gears).filter(|(_, gone)| *gone).map(|(key, _)| key).collect()
}

/// A key that nothing reads is refused.
fn without_effect(s: &Source<'_>, raw: &RawRating, gears: &[RawRatedGear; 2], rating: &RatingScene) -> Checked<()> {
    let by_test = rating.micropitting && rating.permissible_specific_film_thickness.is_none();
    let span = |number: &Number| number.as_ref().map(Spanned::span);
    let oil = "`oil_temperature_c`";
    let keys = [
        (
            "lubrication",
            raw.lubrication.as_ref().map(Spanned::span),
            rating.scuffing || rating.micropitting,
            "`scuffing` and `micropitting`",
        ),
        ("structural_factor", span(&raw.structural_factor), rating.scuffing, "`scuffing = true`"),
        (
            "material_factor",
            span(&raw.material_factor),
            by_test,
            "`micropitting = true` without a permissible film thickness",
        ),
        (
            "permissible_specific_film_thickness",
            span(&raw.permissible_specific_film_thickness),
            rating.micropitting,
            "`micropitting = true`",
        ),
        ("flank_roughness_ra_um", span(&gears[0].flank_roughness_ra_um), rating.oil_temperature_c.is_some(), oil),
        ("flank_roughness_ra_um", span(&gears[1].flank_roughness_ra_um), rating.oil_temperature_c.is_some(), oil),
    ];
    match keys.into_iter().find_map(|(key, at, acts, whose)| Some((key, at.filter(|_| !acts)?, whose))) {
        Some((key, at, whose)) => Err(s.conflict(&at, format!("`{key}` belongs to {whose}"), "leave it out")),
        None => Ok(()),
    }
}

/// A name that no row of a table has.
fn unknown(s: &Source<'_>, key: &str, word: &Spanned<String>, names: Vec<&str>) -> SceneError {
    let written = word.get_ref();
    let advice = match nearest(written, &names) {
        Some(name) => format!("did you mean \"{name}\"?"),
        None => format!("the table has {}; `{key}s = \"FILE\"` in [rating] brings one of your own", list(&names)),
    };
    s.conflict(&word.span(), format!("`{key}` is \"{written}\", which the table of {key}s does not have"), advice)
}

fn list(names: &[&str]) -> String {
    names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ")
}

/// What can only be judged with the whole scene in view: there is a load to rate, and K_Hbeta is known or will be.
pub(super) fn together(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let (Some(table), Some(rating)) = (&raw.rating, &scene.rating) else { return Ok(()) };
    if scene.analysis.kind == Kind::Dynamic {
        return Err(SceneError::NotYet {
            place: s.place(&table.span()),
            key: "rating".into(),
            what: "the rating of a motion".into(),
            instead: "rate the pair at rest, with `kind = \"static\"` and the largest torque".into(),
        });
    }
    if rating.face_load_factor.is_none() && !scene.has_slices() {
        return Err(SceneError::Missing { file: s.file.to_owned(), keys: vec!["`[rating] face_load_factor`".into()] });
    }
    if !scene.has_slices() {
        let raw = table.get_ref();
        let solved = [
            ("micropitting", raw.micropitting.as_ref().map(Spanned::span), rating.micropitting),
            ("oil_temperature_c", raw.oil_temperature_c.as_ref().map(Spanned::span), !rating.scuffing),
        ];
        if let Some((key, at)) = solved.into_iter().find_map(|(key, at, acts)| Some((key, at.filter(|_| acts)?))) {
            let what = format!("`{key}` wants the pressures of a model with slices");
            let advice = "take `model = \"reduced\"`, or leave it out";
            return Err(s.conflict(&at, what, advice));
        }
    }
    if let (Some(torque), true) = (&raw.operation.torque_nm, scene.operation.torque_nm == 0.0) {
        let advice = "give the nominal torque, or leave [rating] out";
        return Err(s.conflict(&torque.span(), "`torque_nm` is 0: nothing is loaded that could be rated", advice));
    }
    Ok(())
}
