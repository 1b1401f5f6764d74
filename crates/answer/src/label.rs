//! Keys and columns in words.

use crate::unit::{ending, shown_units, unit_of};

/// Tables of a document that say nothing of where a key acts: all keys have them.
const SILENT: [&str; 5] = ["scene", "operation", "modification", "analysis", "pair"];

/// Short forms that are written in capitals.
const CAPITALS: [&str; 3] = ["ste", "dte", "te"];

/// A key or a column in words for a title or an axis: what it is of, what it is, its unit.
///
/// Entries of lists keep their number, from 0 on as in the key. A name with brackets, as of an output of a plan, keeps
/// what stands before them.
///
/// ```
/// assert_eq!(answer::label_of("peak_to_peak_ste_um"), "peak to peak STE [µm]");
/// assert_eq!(answer::label_of("operation.torque_nm"), "torque [N·m]");
/// assert_eq!(answer::label_of("mesh.0.scene.pinion.modification.lead_slope_um"), "mesh 0, pinion, lead slope [µm]");
/// assert_eq!(answer::label_of("face_load_factor.1"), "face load factor 1");
/// assert_eq!(answer::label_of("bearing.1.stiffness_n_per_mm.0"), "bearing 1, stiffness 0 [N/mm]");
/// assert_eq!(answer::label_of("mean(ste_um)"), "mean of STE [µm]");
/// ```
pub fn label_of(key: &str) -> String {
    if let Some((of, inner)) = key.strip_suffix(')').and_then(|key| key.split_once('(')) {
        return format!("{} of {}", words(of), label_of(inner));
    }
    if let Some((one, other)) = key.split_once('+') {
        return format!("{} and {}", label_of(one), label_of(other));
    }
    let mut parts: Vec<String> = Vec::new();
    let mut unit = String::new();
    for part in key.split('.') {
        if part.parse::<u32>().is_ok() {
            let last = parts.pop().unwrap_or_default();
            parts.push(format!("{last} {part}").trim_start().to_owned());
        } else if !SILENT.contains(&part) {
            unit = unit_of(part);
            parts.push(words(part));
        }
    }
    let unit = if unit.is_empty() { unit } else { format!(" [{}]", shown_units(&unit)) };
    format!("{}{unit}", parts.join(", "))
}

/// A name without its unit, with spaces.
fn words(name: &str) -> String {
    let own = match ending(name) {
        Some((end, unit)) if unit == unit_of(name) => name.strip_suffix(end).unwrap_or(name).trim_end_matches('_'),
        _ => name,
    };
    let word = |word: &str| if CAPITALS.contains(&word) { word.to_uppercase() } else { word.to_owned() };
    own.split('_').map(word).collect::<Vec<_>>().join(" ")
}
