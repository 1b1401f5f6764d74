//! Any key of the scene over its whole documented range, taken from the schema itself: a key that is added is drawn.

use std::sync::LazyLock;

use scene::{Value, json_schema};
use serde_json::Value as Json;

use super::Draft;

/// Keys that only make a scene larger, with the largest number that is drawn: a hundred million mesh cycles are no
/// small scene.
const COSTLY: [(&str, f64); 36] = [
    ("analysis.shaft_elements", 20.0),
    ("motion.checkpoint_every_cycles", 2.0),
    ("motion.continuation.harmonics", 16.0),
    ("motion.continuation.most_harmonics", 32.0),
    ("motion.continuation.motions", 12.0),
    ("motion.continuation.periods", 2.0),
    ("motion.continuation.phases", 256.0),
    ("motion.continuation.time_points", 64.0),
    ("motion.cycles", 6.0),
    ("motion.steps_per_cycle", 200.0),
    ("motion.steps_per_row", 4.0),
    ("motion.waterfall_cycles", 64.0),
    ("vibration.modes", 60.0),
    ("vibration.speeds", 30.0),
    ("analysis.positions_per_cycle", 16.0),
    ("analysis.cycles", 6.0),
    ("contact.points_per_face_edge", 8.0),
    ("contact.slices", 200.0),
    ("modes.count", 40.0),
    ("modes.below_hz", 1e5),
    ("modes.fixed_modes", 10.0),
    ("motion.duration_s", 1e-2),
    ("motion.ramp.duration_s", 1e-2),
    ("motion.ramp.before_s", 1e-3),
    ("motion.ramp.after_s", 1e-3),
    ("motion.ramp.waterfall_cycles", 64.0),
    ("motion.steps_per_mesh_cycle", 200.0),
    ("motion.steps_per_resonance", 40.0),
    ("motion.sweep.speeds", 6.0),
    ("motion.warm_up_cycles", 60.0),
    ("mesher.elements_profile", 6.0),
    ("mesher.elements_fillet", 6.0),
    ("mesher.elements_thickness", 6.0),
    ("mesher.elements_face", 40.0),
    ("mesher.elements_rim", 6.0),
    ("mesher.sector_teeth", 30.0),
];
/// Keys that a small number makes costly, with the smallest that is drawn: the slower, the more steps a mesh cycle.
const SLOW: [(&str, f64); 6] = [
    ("motion.speed_rpm", 50.0),
    ("motion.to_speed_rpm", 50.0),
    ("operation.speed_rpm", 50.0),
    ("motion.sweep.from_rpm", 50.0),
    ("motion.sweep.to_rpm", 50.0),
    ("motion.error_tolerance", 1e-8),
];
/// Where a range has no end of its own.
const FAR: f64 = 1e6;

/// A key with its row of the schema.
#[derive(Debug, Clone)]
pub struct Key {
    /// With dots before it; the first entry of a list of tables stands for all.
    pub name: String,
    row: Json,
}

/// Tables of what is asked of a pair beside a run: no keys of the pair.
pub(super) const TASKS: [&str; 2] = ["vary", "optimise"];

/// Every key of the scene file that is about the pair. The schema is made once: scenes are drawn by the thousand.
pub fn keys_of_schema() -> &'static [Key] {
    static KEYS: LazyLock<Vec<Key>> = LazyLock::new(keys_of_pair);
    &KEYS
}

fn keys_of_pair() -> Vec<Key> {
    let (mut all, mut schema) = (Vec::new(), json_schema()["$defs"]["pair"].take());
    for task in TASKS {
        schema["properties"].as_object_mut().and_then(|tables| tables.remove(task)).expect("a table of the schema");
    }
    walk("", &schema, &mut all);
    all
}

pub(super) fn walk(path: &str, table: &Json, all: &mut Vec<Key>) {
    for (key, row) in table["properties"].as_object().into_iter().flatten() {
        let name = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        if row.get("properties").is_some() {
            walk(&name, row, all);
        } else if row["items"].get("properties").is_some() {
            walk(&format!("{name}.0"), &row["items"], all);
        } else {
            all.push(Key { name, row: row.clone() });
        }
    }
}

/// Keys of the pair that are numbers with both ends of a range.
pub(super) fn keys_with_range() -> &'static [(String, [f64; 2])] {
    static KEYS: LazyLock<Vec<(String, [f64; 2])>> = LazyLock::new(|| {
        let of = |key: &Key| Some((key.name.clone(), [key.row["minimum"].as_f64()?, key.row["maximum"].as_f64()?]));
        let costly = |name: &str| COSTLY.iter().chain(&SLOW).any(|(end, _)| name.ends_with(end));
        keys_of_schema().iter().filter(|key| !costly(&key.name)).filter_map(of).collect()
    });
    &KEYS
}

/// Sets one key, any of them, to something within its range.
pub fn draw_any_key(d: &mut Draft, keys: &[Key]) {
    let index = d.whole(0, keys.len() as u32 - 1) as usize;
    let key = &keys[index];
    if let Some(value) = value(d, key) {
        d.set(&key.name, value);
    }
}

/// Something within the range of a key; `None` where its kind is unknown.
pub(super) fn value(d: &mut Draft, key: &Key) -> Option<Value> {
    let row = &key.row;
    let bound = |list: &[(&str, f64)]| list.iter().find(|(name, _)| key.name.ends_with(name)).map(|(_, most)| *most);
    let low = row["minimum"].as_f64().or(bound(&SLOW)).map(|l| l.max(bound(&SLOW).unwrap_or(l)));
    let high = row["maximum"].as_f64().or(bound(&COSTLY)).map(|h| h.min(bound(&COSTLY).unwrap_or(h)));
    match row["type"].as_str()? {
        "number" => Some(number(d, low.unwrap_or(-FAR), high.unwrap_or(FAR)).into()),
        "integer" => Some((number(d, low.unwrap_or(0.0), high.unwrap_or(FAR)).round() as i64).into()),
        "boolean" => Some(d.chance(0.5).into()),
        "string" => match row["enum"].as_array() {
            Some(words) => words[d.whole(0, words.len() as u32 - 1) as usize].as_str().map(Value::from),
            None => text(d, &key.name),
        },
        "array" => list(d, &row["items"]),
        _ => None,
    }
}

/// An end of the range, or a number in it by size or by order of magnitude.
fn number(d: &mut Draft, low: f64, high: f64) -> f64 {
    match d.whole(0, 5) {
        0 => low,
        1 => high,
        2 | 3 if low >= 0.0 && high > 0.0 => d.log(low.max(1e-9 * high), high),
        _ => d.between(low, high),
    }
}

fn text(d: &mut Draft, key: &str) -> Option<Value> {
    let word = match key.rsplit('.').next()? {
        "name" => d.pick(&["x", "", "\u{1F6E0} <b>", "line\nline"]),
        "mesh" => d.pick(&["meshes/periodic_hex8.msh", "meshes/sector3_tet4.msh", "meshes/README.md", "nowhere.msh"]),
        "topography" | "pitch_errors_file" => d.pick(&["nowhere.csv", "scene.toml"]),
        "flank_left" | "flank_right" => d.pick(&["{k}", "flank_left_{k}", "flank"]),
        "file" | "spectrum" | "rexs" | "scene" => d.pick(&["nowhere.csv", "scene.toml", ""]),
        "bore" | "cut_0" | "cut_1" => d.pick(&["bore", "cut_0", "no such group"]),
        // What is left are the tolerances of [accuracy].
        _ => d.pick(&["1 %", "50 %", "0.05 um", "10 MPa", "1", "-3 %", "5 N/um"]),
    };
    Some(word.into())
}

fn list(d: &mut Draft, items: &Json) -> Option<Value> {
    if let Some(words) = items["enum"].as_array() {
        let words: Vec<&str> = words.iter().filter_map(Json::as_str).collect();
        return Some(d.some_of(&words).into());
    }
    let count = d.whole(0, 5);
    let numbers = |d: &mut Draft, n: u32| -> Vec<Value> { (0..n).map(|_| d.between(-50.0, 50.0).into()).collect() };
    match items["type"].as_str()? {
        "number" => Some(numbers(d, count).into()),
        _ => {
            let columns = items["minItems"].as_u64()? as u32;
            Some((0..count).map(|_| Value::from(numbers(d, columns))).collect::<Vec<_>>().into())
        }
    }
}
