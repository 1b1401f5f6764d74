//! Headlines of two results that ought to agree.

use std::path::Path;

use serde_json::Value as Json;

/// Numbers of a headline at rest that do not depend on names, senses and where a cycle begins, and those whose size they
/// are measured against.
pub const AT_REST: [(&str, &str); 6] = [
    ("mean_ste_um", "mean_ste_um"),
    ("peak_to_peak_ste_um", "mean_ste_um"),
    ("mean_mesh_stiffness_n_per_um", "mean_mesh_stiffness_n_per_um"),
    ("mean_contact_line_length_mm", "mean_contact_line_length_mm"),
    ("mean_normal_force_n", "mean_normal_force_n"),
    ("max_pair_force_n", "mean_normal_force_n"),
];

/// What differs by more than a share.
pub fn compare(one: &Path, other: &Path, keys: &[(&str, &str)], same: f64) -> Vec<String> {
    let headline = |folder: &Path| -> Option<Json> {
        let text = std::fs::read(folder.join("summary.json")).ok()?;
        serde_json::from_slice::<Json>(&text).ok()?.get("headline").cloned()
    };
    let (Some(one), Some(other)) = (headline(one), headline(other)) else {
        return vec!["a result without a headline".into()];
    };
    let mut wrong = Vec::new();
    for (key, scale) in keys {
        let (Some(a), Some(b), Some(scale)) = (one[key].as_f64(), other[key].as_f64(), one[scale].as_f64()) else {
            continue;
        };
        if (a - b).abs() > same * scale.abs() {
            wrong.push(format!("{key} is {a} and {b}"));
        }
    }
    wrong
}
