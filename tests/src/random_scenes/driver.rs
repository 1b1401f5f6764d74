//! The other gear drives, the other way round: the same flanks press each other with the same force.

use std::path::Path;

use scene::Value;

use super::{
    RandomScene,
    headline::{AT_REST, compare},
    told::{Told, is_at_rest, is_plain},
};

/// Positions at which numbers of the cycle do not depend on where it begins.
const POSITIONS: i64 = 16;
/// Relative difference: positions lie elsewhere, and so does the largest force of a pair of teeth.
const SAME: f64 = 5e-2;
/// Relative difference of closed forms.
const CLOSED_FORM: f64 = 1e-9;

/// The scene driven by the other gear, backwards; `None` where something goes with the way that it turns.
pub fn tell(_: u64, scene: &RandomScene) -> Option<Told> {
    let d = &scene.draft;
    let counted = |gear: &str| d.get(&format!("{gear}.pitch_errors_um")).is_some();
    let rubs = d.number("contact.friction").is_some_and(|mu| mu != 0.0);
    if !is_plain(scene) || !is_at_rest(scene) || rubs || counted("pinion") || counted("wheel") {
        return None;
    }
    let mut first = d.copy();
    first.set("analysis.positions_per_cycle", POSITIONS);
    let mut other = first.copy();
    let is = |key: &str, word: &str| d.get(key).and_then(Value::as_str) == Some(word);
    let wheel_drives = is("operation.driver", "wheel");
    let ratio = d.number("wheel.teeth")?.abs() / d.number("pinion.teeth")?;
    other.set("operation.driver", if wheel_drives { "pinion" } else { "wheel" });
    other.set("operation.rotation", if is("operation.rotation", "cw") { "ccw" } else { "cw" });
    let torque = d.number("operation.torque_nm")?;
    other.set("operation.torque_nm", if wheel_drives { torque * ratio } else { torque / ratio });
    let same = if scene.model == "iso" { CLOSED_FORM } else { SAME };
    let differ = move |one: &Path, other: &Path| compare(one, other, &AT_REST, same);
    Some(Told { first: Some(first), other, compare: Box::new(differ) })
}
