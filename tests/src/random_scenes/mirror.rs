//! A scene in a mirror: what a mirror does not change must stay the same to round-off.

use std::path::Path;

use scene::Value;

use super::{
    Csv, Draft, RandomScene,
    csv::largest,
    told::{Told, is_at_rest},
};

/// Largest difference over the largest value of a column.
const SAME: f64 = 5e-5;
/// Largest difference of the contact lines: how much of a slice at their end counts is found from its gap.
const SAME_LENGTH: f64 = 1e-3;

/// Round-off of places of some hundred mm, um.
const ROUND_OFF_UM: f64 = 1e-8;
/// Approach over round-off below which stiffness and contact have no digits that could agree.
const LOST: f64 = 30.0;

/// Where the mirror stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mirror {
    /// Across the axes: up is down, the other hand, the same sense of rotation.
    AcrossAxes,
    /// Through both axes: the other hand, the other sense of rotation.
    ThroughAxes,
}

impl Mirror {
    /// Signs of forces along x, y, z in the mirror.
    fn signs(self) -> [f64; 3] {
        match self {
            Self::AcrossAxes => [1.0, 1.0, -1.0],
            Self::ThroughAxes => [1.0, -1.0, 1.0],
        }
    }
}

/// The scene in one of both mirrors; `None` where files stand for what cannot be turned here, or nothing stands still.
pub fn tell(index: u64, scene: &RandomScene) -> Option<Told> {
    let d = &scene.draft;
    // Flat faces of a mesh are cut along diagonals, which have a hand of their own.
    let flat = d.get("contact.gap").is_some_and(|g| g.as_str() == Some("facet"));
    // The cuts of a sector of some teeth are free; its loaded teeth stand nearer to one of them than in the mirror.
    let sector = ["pinion", "wheel"].iter().any(|gear| d.get(&format!("{gear}.mesher.sector_teeth")).is_some());
    let one_handed = flat || sector || scene.foreign || !d.files.is_empty();
    if !is_at_rest(scene) || scene.anything || one_handed || d.get("accuracy").is_some() {
        return None;
    }
    // Bolts stand at places of the gear, which another tooth has in the mirror.
    if ["pinion", "wheel"].iter().any(|gear| d.get(&format!("{gear}.bore.bolts.count")).is_some()) {
        return None;
    }
    let mirror = if index.is_multiple_of(2) { Mirror::AcrossAxes } else { Mirror::ThroughAxes };
    let mut other = scene.draft.copy();
    for key in ["pinion.helix_angle_deg", "wheel.helix_angle_deg"] {
        turn(&mut other, key);
    }
    match mirror {
        Mirror::AcrossAxes => upside_down(&mut other),
        Mirror::ThroughAxes => other_way_round(&mut other),
    }
    let nodal = d.get("contact.method").is_some_and(|m| m.as_str() == Some("nodal"));
    let compare = move |one: &Path, other: &Path| compare(one, other, (mirror, nodal));
    Some(Told { first: None, other, compare: Box::new(compare) })
}

/// Changes the sign of a number, if it is there.
fn turn(d: &mut Draft, key: &str) {
    if let Some(value) = d.number(key) {
        d.set(key, 0.0 - value);
    }
}

fn upside_down(d: &mut Draft) {
    for key in ["deviation_um", "inclination_um", "in_plane_of_action_um", "across_plane_of_action_um"] {
        turn(d, &format!("pair.misalignment.{key}"));
    }
    turn(d, "pair.mid_face_offset_mm");
    for gear in ["pinion", "wheel"] {
        let key = format!("{gear}.bore.held_mm");
        if let Some(held) = d.get(&key).and_then(Value::as_array) {
            let turned: Vec<f64> = held.iter().rev().filter_map(Value::as_float).map(|z| 0.0 - z).collect();
            d.set(&key, turned);
        }
        for flank in ["", "drive.", "coast."] {
            let table = format!("{gear}.modification.{flank}");
            turn(d, &format!("{table}lead_slope_um"));
            turn(d, &format!("{table}bias_um"));
            for what in ["um", "length_mm"] {
                let keys = ["lower", "upper"].map(|end| format!("{table}end_relief_{end}_{what}"));
                let values = [0, 1].map(|i| d.number(&keys[i]));
                for (key, value) in keys.iter().zip([values[1], values[0]]) {
                    match value {
                        Some(value) => d.set(key, value),
                        None => d.unset(key),
                    }
                }
            }
        }
    }
}

fn other_way_round(d: &mut Draft) {
    // Across the plane of action the mirrored driving flanks have the other direction.
    ["deviation_um", "across_plane_of_action_um"].iter().for_each(|key| turn(d, &format!("pair.misalignment.{key}")));
    let cw = d.get("operation.rotation").and_then(Value::as_str) == Some("cw");
    d.set("operation.rotation", if cw { "ccw" } else { "cw" });
    for gear in ["pinion", "wheel"] {
        let key = format!("{gear}.pitch_errors_um");
        let Some(errors) = d.get(&key).and_then(Value::as_array) else { continue };
        // Teeth count the other way round, and stand too far the other way.
        let mut turned: Vec<f64> = errors.iter().filter_map(Value::as_float).map(|e| -e).collect();
        turned.get_mut(1..).unwrap_or_default().reverse();
        d.set(&key, turned);
    }
}

/// Columns that a mirror leaves as they are.
const STAYS: [&str; 8] = [
    "ste_um",
    "kinematic_te_um",
    "mesh_stiffness_n_per_um",
    "mesh_stiffness_tangent_n_per_um",
    "contact_line_length_mm",
    "geometric_line_length_mm",
    "strain_energy_nmm",
    "max_pressure_mpa",
];

/// What is not the same in both folders.
fn compare(folder: &Path, other: &Path, (mirror, nodal): (Mirror, bool)) -> Vec<String> {
    let (Ok(here), Ok(there)) = (Csv::read(&folder.join("history.csv")), Csv::read(&other.join("history.csv"))) else {
        return vec!["no history.csv".into()];
    };
    let stays = STAYS.iter().map(|name| ((*name).to_owned(), 1.0));
    let forces = ["pinion", "wheel"].into_iter().flat_map(|gear| {
        ["x", "y", "z"]
            .into_iter()
            .zip(mirror.signs())
            .map(move |(axis, sign)| (format!("{gear}_force_{axis}_n"), sign))
    });
    let total = largest(&here.column("wheel_force_x_n").unwrap_or_default())
        .max(largest(&here.column("wheel_force_y_n").unwrap_or_default()));
    let mut wrong = Vec::new();
    let approach = |csv: &Csv| {
        let [ste, free] = ["ste_um", "kinematic_te_um"].map(|name| csv.column(name).unwrap_or_default());
        ste.iter().zip(&free).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    // Teeth that hardly approach each other touch as round-off has it, and the result says so.
    let lost = approach(&here) < LOST * ROUND_OFF_UM;
    for (name, sign) in stays.chain(forces) {
        let (Some(a), Some(b)) = (here.column(&name), there.column(&name)) else { continue };
        let scale = if name.contains("_force_") { total } else { largest(&a) };
        // A point that just touches, at an end of a flank, stiffens the teeth or does not, as round-off has it: twice the
        // same position has two tangents then, and two pressures where its neighbour carries more.
        if lost && !name.ends_with("te_um") {
            continue;
        }
        if nodal && ["mesh_stiffness_tangent_n_per_um", "max_pressure_mpa"].contains(&name.as_str()) {
            continue;
        }
        let same = if name == "contact_line_length_mm" { SAME_LENGTH } else { SAME };
        let floor = if name.ends_with("te_um") { ROUND_OFF_UM } else { f64::MIN_POSITIVE };
        let off = a.iter().zip(&b).position(|(a, b)| (a - sign * b).abs() > same * scale + floor);
        if let Some(row) = off.or((a.len() != b.len()).then_some(0)) {
            wrong.push(format!("{mirror:?}: {name} is {} and {} in row {row}", a[row], b[row]));
        }
    }
    wrong.truncate(3);
    wrong
}
