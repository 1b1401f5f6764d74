//! A misalignment of a spur pair in the plane of action acts as a lead slope. Teeth at an angle slide along each other as well.

use std::path::Path;

use scene::{Scene, Value};

use super::{
    Draft, RandomScene,
    headline::{AT_REST, compare},
    told::{Told, is_at_rest, is_plain},
};

/// Misalignment and slope over the face width: um a mm.
const AMOUNT: f64 = 0.1;
/// Relative difference: a flank that leans touches elsewhere as well, by its square.
const SAME: f64 = 2e-3;

/// The scene with a misalignment, and with a lead slope in its place; `None` of helical pairs, of other contact than slices, and of
/// two face widths.
pub fn tell(_: u64, scene: &RandomScene) -> Option<Told> {
    let d = &scene.draft;
    let nodal = d.get("contact.method").and_then(Value::as_str) == Some("nodal");
    let helical = d.number("pinion.helix_angle_deg").is_some_and(|angle| angle != 0.0);
    if !is_plain(scene) || !is_at_rest(scene) || scene.model == "iso" || nodal || helical {
        return None;
    }
    let whole = Scene::parse(&d.text().ok()?, Path::new("scene.toml")).ok()?;
    let [one, two] = whole.face_widths_mm();
    if one != two || whole.pair.mid_face_offset_mm.is_some_and(|offset| offset != 0.0) {
        return None;
    }
    let table: toml::Table = toml::from_str(&whole.to_toml()).ok()?;
    let [mut first, mut other] = [(); 2].map(|()| Draft::of_table(table.clone()));
    let amount = AMOUNT * one;
    add(&mut first, "pair.misalignment.in_plane_of_action_um", amount);
    for flank in ["drive", "coast"] {
        add(&mut other, &format!("pinion.modification.{flank}.lead_slope_um"), amount);
    }
    let differ = move |one: &Path, other: &Path| compare(one, other, &AT_REST, SAME);
    Some(Told { first: Some(first), other, compare: Box::new(differ) })
}

fn add(d: &mut Draft, key: &str, amount: f64) {
    let before = d.number(key).unwrap_or(0.0);
    d.set(key, before + amount);
}
