//! The gears called by each other's name: which of them a scene calls pinion changes nothing.

use std::path::Path;

use scene::{Scene, Value};

use super::{
    Draft, RandomScene,
    headline::{AT_REST, compare},
    told::{Told, is_at_rest, is_plain},
};

/// Positions at which numbers of the cycle do not depend on where it begins.
const POSITIONS: i64 = 16;
/// Relative difference of closed forms.
const CLOSED_FORM: f64 = 1e-9;
/// Relative difference of elastic gears: slices are cut at heights of the pinion, and few slices see that.
const SLICED: f64 = 2e-2;

/// The scene with exchanged names; `None` of a ring, which is the wheel, and of what counts along one gear.
pub fn tell(_: u64, scene: &RandomScene) -> Option<Told> {
    let d = &scene.draft;
    let counted = |gear: &str| d.get(&format!("{gear}.pitch_errors_um")).is_some();
    let ring = d.number("wheel.teeth").is_some_and(|teeth| teeth < 0.0);
    let misaligned = d.get("pair.misalignment").is_some() || d.get("pair.mid_face_offset_mm").is_some();
    if !is_plain(scene) || !is_at_rest(scene) || ring || misaligned || counted("pinion") || counted("wheel") {
        return None;
    }
    let whole = Scene::parse(&d.text().ok()?, Path::new("scene.toml")).ok()?;
    let mut table: toml::Table = toml::from_str(&whole.to_toml()).ok()?;
    if let Some(Value::Table(analysis)) = table.get_mut("analysis") {
        analysis.insert("positions_per_cycle".into(), Value::Integer(POSITIONS));
    }
    let first = Draft::of_table(table.clone());
    let (pinion, wheel) = (table.remove("pinion")?, table.remove("wheel")?);
    table.insert("pinion".into(), wheel);
    table.insert("wheel".into(), pinion);
    let mut other = Draft::of_table(table);
    let is = |key: &str, word: &str| first.get(key).and_then(Value::as_str) == Some(word);
    other.set("operation.driver", if is("operation.driver", "wheel") { "pinion" } else { "wheel" });
    // The pinion's sense is told.
    other.set("operation.rotation", if is("operation.rotation", "cw") { "ccw" } else { "cw" });
    let same = if scene.model == "iso" { CLOSED_FORM } else { SLICED };
    let differ = move |one: &Path, other: &Path| compare(one, other, &AT_REST, same);
    Some(Told { first: Some(first), other, compare: Box::new(differ) })
}
