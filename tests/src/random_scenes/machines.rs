//! Random gearboxes: one of the shipped documents, made small, with some of its keys anywhere in their ranges.

use std::{path::Path, sync::LazyLock};

use scene::{Value, json_schema};
use toml::Table;

use super::{
    Draft, RandomScene, keys_of_schema,
    whole_range::{Key, TASKS, value, walk},
};

/// Shipped gearboxes, each with something of its own: rolling bearings, a housing, planets, an idler, motion.
const SHIPPED: [&str; 14] = [
    "two_stages",
    "engine",
    "planetary_stage",
    "planetary_stage_ring_fixed",
    "planet_in_ring",
    "elastic_gears",
    "idler",
    "double_helical",
    "rolling_bearings",
    "in_housing",
    "rated",
    "reversal",
    "run_up",
    "resonance_curve",
];
/// Share of gearboxes that keep what they do in time; it takes some seconds each.
const IN_TIME: f64 = 0.3;
/// Share of keys that are those of a mesh's pair.
const OF_PAIR: f64 = 0.25;
/// Share of gearboxes with a key of the whole schema on top, which mostly does not fit.
const ANY_KEY: f64 = 0.3;
/// Gearboxes whose files are in the folder of these.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/gearbox");

/// Keys of the gearbox file, but for those of plans and searches.
fn keys() -> &'static [Key] {
    static KEYS: LazyLock<Vec<Key>> = LazyLock::new(|| {
        let (mut all, mut schema) = (Vec::new(), json_schema()["$defs"]["gearbox"].take());
        for task in TASKS {
            schema["properties"].as_object_mut().and_then(|tables| tables.remove(task)).expect("a table of the schema");
        }
        walk("", &schema, &mut all);
        all
    });
    &KEYS
}

/// Gearbox number `index` of a seed.
///
/// # Panics
/// When a shipped gearbox cannot be read.
pub fn draw_gearbox(seed: u64, index: u64) -> RandomScene {
    let mut d = Draft::new(seed, index);
    let name = d.pick(&SHIPPED);
    let table = shipped(name);
    let meshes = table["mesh"].as_array().map_or(0, Vec::len);
    d.put_all(table);
    for mesh in 0..meshes {
        for gear in ["pinion", "wheel"] {
            let mesher = format!("mesh.{mesh}.scene.{gear}.mesher");
            d.unset(&format!("mesh.{mesh}.scene.{gear}.mesh"));
            let layers = [("profile", 2), ("fillet", 2), ("thickness", 2), ("face", 2), ("rim", 2)];
            layers.iter().for_each(|(part, n)| d.set(&format!("{mesher}.elements_{part}"), i64::from(*n)));
        }
        d.set(&format!("mesh.{mesh}.scene.contact.slices"), 8);
        d.unset(&format!("mesh.{mesh}.scene.output"));
    }
    d.set("analysis.positions_per_cycle", 4);
    ["vary", "optimise"].iter().for_each(|task| d.unset(task));
    if !d.chance(IN_TIME) {
        ["motion", "vibration", "modes"].iter().for_each(|table| d.unset(table));
    }
    for _ in 0..d.whole(0, 3) {
        change(&mut d);
    }
    for _ in 0..u32::from(d.chance(ANY_KEY)) {
        let (keys, before) = if d.chance(OF_PAIR) {
            let mesh = d.whole(0, meshes.saturating_sub(1) as u32);
            (keys_of_schema(), format!("mesh.{mesh}.scene."))
        } else {
            (keys(), String::new())
        };
        let key = &keys[d.whole(0, keys.len() as u32 - 1) as usize];
        let name = before + &d.at_some_entry(&key.name);
        let drawn = match names_of(&key.name) {
            Some(of) if d.chance(0.8) => d.name_of(of),
            _ => value(&mut d, key),
        };
        if let Some(drawn) = drawn {
            d.set(&name, drawn);
        }
    }
    RandomScene { draft: d, model: name, anything: true, foreign: false }
}

/// Changes a number that is there to another of its order of magnitude.
fn change(d: &mut Draft) {
    let there: Vec<String> = d.paths().into_iter().filter(|path| d.number(path).is_some()).collect();
    let path = there[d.whole(0, there.len() as u32 - 1) as usize].clone();
    let Some(now) = d.number(&path) else { return };
    let is_whole = d.get(&path).is_some_and(Value::is_integer);
    let factor = d.log(0.3, 3.0) * if d.chance(0.1) { -1.0 } else { 1.0 };
    let next = if now == 0.0 { d.between(-1.0, 1.0) } else { now * factor };
    d.set(&path, if is_whole { Value::Integer(next.round() as i64) } else { Value::Float(next) });
}

/// The list whose entries a key names.
fn names_of(key: &str) -> Option<&'static str> {
    match key.rsplit('.').next()? {
        "shaft" | "in_shaft" | "input" | "around" => Some("shaft"),
        "pinion" | "wheel" | "in_bore_of" => Some("gear"),
        _ => None,
    }
}

/// A shipped gearbox with the scenes of its meshes in it, and its files by their whole path.
fn shipped(name: &str) -> Table {
    let folder = Path::new(FOLDER);
    let read = |path: &Path| -> Table {
        let text = std::fs::read_to_string(path).expect("a shipped gearbox");
        text.parse().expect("TOML of a shipped gearbox")
    };
    let mut table = read(&folder.join(format!("{name}.toml")));
    for mesh in table.get_mut("mesh").and_then(Value::as_array_mut).into_iter().flatten() {
        let Some(mesh) = mesh.as_table_mut() else { continue };
        if let Some(file) = mesh.get("scene").and_then(Value::as_str) {
            let scene = read(&folder.join(file));
            mesh.insert("scene".to_owned(), Value::Table(scene));
        }
    }
    with_whole_paths(&mut table, folder);
    table
}

/// Names of files beside the document become whole paths.
fn with_whole_paths(table: &mut Table, folder: &Path) {
    for (_, value) in table.iter_mut() {
        match value {
            Value::String(word) if folder.join(&*word).is_file() => *word = folder.join(&*word).display().to_string(),
            Value::Table(inner) => with_whole_paths(inner, folder),
            Value::Array(list) => {
                list.iter_mut().filter_map(Value::as_table_mut).for_each(|inner| with_whole_paths(inner, folder));
            }
            _ => {}
        }
    }
}
