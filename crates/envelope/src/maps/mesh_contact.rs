//! Density of the mesh over the discretisation of contact.

use super::{
    Cell, EnvelopeMap, judge,
    torque_misalignment::{FILE, PAIR},
};

pub(super) const MAP: EnvelopeMap = EnvelopeMap {
    key: "e",
    name: "mesh density over contact discretisation",
    file: FILE,
    judged: "Mean static transmission error with its own bounds, against the converged one (1 %): solved where both bounds meet.",
    columns: ("elements along the profile", &["1", "2", "3", "4"]),
    rows: ("contact", &["4 slices", "8 slices", "32 slices", "2 points an edge", "6 points an edge"]),
    layers: &["hex8", "hex20"],
    cell,
};

fn cell(layer: &str, contact: &str, elements: &str) -> Cell {
    let order = if layer == "hex8" { 1 } else { 2 };
    let (count, kind) = contact.split_once(' ').unwrap_or((contact, "slices"));
    let mut settings = vec!["analysis.model=reduced".to_owned(), "analysis.positions_per_cycle=8".to_owned()];
    settings.push("accuracy.mean_ste=50 %".to_owned());
    for gear in ["pinion", "wheel"] {
        settings.push(format!("{gear}.mesher.order={order}"));
        settings.push(format!("{gear}.mesher.elements_profile={elements}"));
        settings.push(format!("{gear}.mesher.elements_fillet=2"));
        settings.push(format!("{gear}.mesher.elements_thickness=2"));
        settings.push(format!("{gear}.mesher.elements_face=6"));
        settings.push(format!("{gear}.mesher.elements_rim=2"));
    }
    match kind {
        "slices" => settings.push(format!("contact.slices={count}")),
        _ => {
            settings.push("contact.method=nodal".to_owned());
            settings.push(format!("contact.points_per_face_edge={count}"));
        }
    }
    judge::against(FILE, PAIR, &settings, &["accuracy.mean_ste=1 %".to_owned()])
}
