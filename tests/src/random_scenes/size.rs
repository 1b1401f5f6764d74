//! A pair of another size: every number of a scene goes with the power of the size that its unit says, and so does every
//! number of the result.
//!
//! ```text
//! lengths s, stresses and speeds 1, forces s^2, torques and energies s^3, stiffnesses s, times s, masses s^3
//! ```
//! The size is a power of two, so that nothing is rounded: what changes is a number of the program that has a unit of its
//! own.

use std::path::Path;

use scene::{Scene, Value};

use super::{
    Csv, Draft, RandomScene,
    csv::largest,
    told::{Told, is_at_rest, is_plain},
};

/// Size over that of the scene.
const SIZE: f64 = 2.0;
/// Largest difference over the largest value of a column: numbers that are written with fewer digits are rounded.
const SAME: f64 = 1e-9;

/// The same of steps on reduced gears, which take their compliance from the bin of their pose: places on both sides of an end.
const IN_BINS: f64 = 1e-4;
/// The same of a stiffness whose unit has a broken power: it is rounded.
const ROUNDED: f64 = 1e-6;
/// Slices, a key of the table of the contact, which the program chooses where a scene has none.
const CHOSEN: [&str; 3] = ["contact", "contact.slices", "slices"];
/// Exponent of two balls.
const BALLS: f64 = 1.5;
/// Columns that are noise of the solution.
const NOISE: &str = "_residual";

/// Units at the ends of names, and the power of the size that they go with: the longer ones first.
const UNITS: &[(&str, i32)] = &[
    ("_ns_per_mm2", 1),
    ("_mpa_per_mm", -1),
    ("_nmms_per_rad", 4),
    ("_nmm_per_rad", 3),
    ("_urad_per_s", -1),
    ("_rad_per_s", -1),
    ("_mm_per_s2", -1),
    ("_m_per_s2", -1),
    ("_um_per_s", 0),
    ("_mm_per_s", 0),
    ("_ns_per_mm", 2),
    ("_n_per_mm_um", 0),
    ("_n_per_mm", 1),
    ("_n_per_um", 1),
    ("_nm_per_rad", 3),
    ("_per_s", -1),
    ("_kg_m2", 5),
    ("_kg_m3", 0),
    ("_kg", 3),
    ("_mj", 3),
    ("_nmm", 3),
    ("_nm", 3),
    ("_kn", 2),
    ("_n", 2),
    ("_w", 2),
    ("_um", 1),
    ("_mm", 1),
    ("_rpm", -1),
    ("_hz", -1),
    ("_mpa", 0),
    ("_deg", 0),
    ("_urad", 0),
    ("_rad", 0),
    ("_percent", 0),
    ("_s", 1),
];

/// Power of the size of a name; 0 without a unit.
pub fn power(name: &str) -> i32 {
    UNITS.iter().find(|(unit, _)| name.ends_with(unit)).map_or(0, |(_, power)| *power)
}

/// The scene twice as large; `None` where a formula has units of its own.
pub fn tell(_: u64, scene: &RandomScene) -> Option<Told> {
    if !is_plain(scene) || scene.model == "iso" {
        return None;
    }
    let whole = Scene::parse(&scene.draft.text().ok()?, Path::new("scene.toml")).ok()?;
    let whole: toml::Table = toml::from_str(&whole.to_toml()).ok()?;
    // ISO 6336-1 knows N/(mm um).
    let from_iso = whole.get("mesh").and_then(|mesh| mesh.get("stiffness_from")).and_then(Value::as_str) == Some("iso");
    if from_iso {
        return None;
    }
    let impact = |key: &str| whole.get("impact").and_then(|t| t.get(key)).and_then(Value::as_float);
    let exponent = impact("exponent").unwrap_or(BALLS);
    // The default stiffness is that of the exponent of two balls, whatever the exponent.
    if exponent != BALLS && impact("stiffness_n_per_mm_to_exponent").is_none() {
        return None;
    }
    let mut table = whole;
    // What the program chooses, it chooses again.
    if !scene.draft.keys().iter().any(|key| key == CHOSEN[1])
        && let Some(contact) = table.get_mut(CHOSEN[0]).and_then(Value::as_table_mut)
    {
        contact.remove(CHOSEN[2]);
    }
    scale_table(&mut table, exponent);
    let same = match scene.model {
        "reduced" | "reduced+modes" if !is_at_rest(scene) => IN_BINS,
        "impact" => ROUNDED,
        _ => SAME,
    };
    let compare = move |one: &Path, other: &Path| compare(one, other, same);
    Some(Told { first: None, other: Draft::of_table(table), compare: Box::new(compare) })
}

fn scale_table(table: &mut toml::Table, exponent: f64) {
    for (name, value) in table.iter_mut() {
        match name.as_str() {
            "table_s_nm" => by_place(value, &|_, column| SIZE.powi([1, 3][column.min(1)])),
            "stiffness_matrix_n_mm_rad" => by_place(value, &|i, j| SIZE.powi(1 + turns(i) + turns(j))),
            "damping_matrix_ns_mm_rad" => by_place(value, &|i, j| SIZE.powi(2 + turns(i) + turns(j))),
            "stiffness_n_per_mm_to_exponent" => scale(value, SIZE.powf(2.0 - exponent)),
            _ => match value {
                Value::Table(inner) => scale_table(inner, exponent),
                Value::Array(list) if list.iter().any(Value::is_table) => {
                    list.iter_mut().filter_map(Value::as_table_mut).for_each(|inner| scale_table(inner, exponent));
                }
                value => scale(value, SIZE.powi(power(name))),
            },
        }
    }
}

/// 1 of a coordinate that is an angle, of x, y, z, rx, ry.
fn turns(coordinate: usize) -> i32 {
    i32::from(coordinate >= 3)
}

fn scale(value: &mut Value, by: f64) {
    match value {
        _ if by == 1.0 => {}
        Value::Float(x) => *x *= by,
        Value::Integer(x) => *value = Value::Float(*x as f64 * by),
        Value::Array(list) => list.iter_mut().for_each(|value| scale(value, by)),
        _ => {}
    }
}

/// Rows of numbers, each by its row and column.
fn by_place(rows: &mut Value, by: &dyn Fn(usize, usize) -> f64) {
    let Value::Array(rows) = rows else { return };
    for (i, row) in rows.iter_mut().enumerate() {
        let Value::Array(row) = row else { continue };
        row.iter_mut().enumerate().for_each(|(j, value)| scale(value, by(i, j)));
    }
}

/// Columns of the history that do not go with their units.
fn compare(one: &Path, other: &Path, same: f64) -> Vec<String> {
    let [one, other] = [one, other].map(|folder| Csv::read(&folder.join("history.csv")));
    // Sweeps and branches have no history.
    let (Ok(one), Ok(other)) = (one, other) else { return Vec::new() };
    if one.names != other.names || one.rows.len() != other.rows.len() {
        let size = |csv: &Csv| format!("{} rows of {} columns", csv.rows.len(), csv.names.len());
        return vec![format!("{}, of twice the size {}", size(&one), size(&other))];
    }
    let mut wrong = Vec::new();
    for name in one.names.iter().filter(|name| !name.ends_with(NOISE)) {
        let (Some(a), Some(b)) = (one.column(name), other.column(name)) else { continue };
        let (by, scale) = (SIZE.powi(power(name)), size_of(&one, name));
        let off = |a: f64, b: f64| {
            let close = (a - b / by).abs() <= same * scale;
            (a.is_finite() || b.is_finite()) && !close
        };
        if let Some(row) = (0..a.len()).find(|&row| off(a[row], b[row])) {
            wrong.push(format!("{name} is {} and, of twice the size over {by}, {} in row {row}", a[row], b[row] / by));
        }
    }
    wrong.truncate(3);
    wrong
}

/// What a column is measured against: of a component of a vector the largest of all its kind, which may be round-off itself.
fn size_of(csv: &Csv, name: &str) -> f64 {
    let unit = UNITS.iter().find(|(unit, _)| name.ends_with(unit)).map_or("", |(unit, _)| unit);
    let is_component =
        |name: &str| ["_x", "_y", "_z", "_rx", "_ry"].iter().any(|axis| name.ends_with(&format!("{axis}{unit}")));
    let all = csv.names.iter().filter(|other| **other == name || is_component(name) && other.ends_with(unit));
    let of = |name: &String| csv.column(name).map_or(0.0, |column| largest(&column));
    all.map(of).fold(f64::MIN_POSITIVE, f64::max)
}
