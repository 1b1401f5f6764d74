//! All keys, and the nearest key to a misspelt one.

/// Tables of a kind of file with their keys; the first entry is the file itself.
pub type Tables = fn() -> Vec<(String, Vec<&'static str>)>;

/// The other kind of machine: its name in messages, and its tables.
pub type Neighbour = (&'static str, Tables);

/// The nearest of `known` if it is near enough to be intended; upper and lower case are equal.
pub fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    // Words of very different length are never alike, and to compare long ones costs the product of their lengths.
    let length = word.chars().count();
    let small = |word: &str| if word.len() > LONGEST { word.to_owned() } else { word.to_lowercase() };
    let word = small(word);
    known
        .iter()
        .filter(|k| length <= 2 * k.len() + 1)
        .map(|&k| (strsim::normalized_damerau_levenshtein(&word, &small(k)), k))
        .filter(|&(likeness, _)| likeness >= 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, k)| k)
}

/// One sentence for someone who wrote `word` where only `here` may stand, in a file of these tables; `neighbour`: the other
/// kind of machine, whose keys may have been meant.
///
/// A heading (`is_heading`) is rather a table of this place, misspelt, than a key of another one.
pub(super) fn advice(
    (tables, neighbour): (Tables, Option<Neighbour>),
    (word, is_heading): (&str, bool),
    here: &[&str],
) -> String {
    if let Some(key) = nearest(word, here).filter(|_| is_heading) {
        return format!("did you mean `{key}`?");
    }
    let of_word = |(_, keys): &(String, Vec<&str>)| keys.contains(&word);
    if let Some((table, _)) = tables().into_iter().skip(1).find(of_word) {
        return format!("`{word}` belongs to [{table}]");
    }
    // A key without its unit (`torque`) is shorter than the real one, so the likeness alone misses it.
    let begins = || here.iter().find(|key| key.starts_with(word)).copied();
    if let Some(key) = nearest(word, here).or_else(|| called(word, here)).or_else(begins) {
        return format!("did you mean `{key}`?");
    }
    if let Some((key, table)) =
        tables().into_iter().skip(1).find_map(|(table, keys)| Some((called(word, &keys)?, table)))
    {
        return format!("did you mean `{key}` in [{table}]?");
    }
    let known = format!("known here: {}", here.join(", "));
    match neighbour.and_then(|(kind, of)| Some((kind, of().into_iter().find(of_word)?.0))) {
        Some((kind, table)) if table.is_empty() => format!("`{word}` belongs to {kind}; {known}"),
        Some((kind, table)) => format!("`{word}` belongs to [{table}] of {kind}; {known}"),
        None => known,
    }
}

/// What others call a key: symbols of ISO 21771 and names of other programs.
const NAMES: &[(&str, &[&str])] = &[
    ("teeth", &["z", "number_of_teeth", "num_teeth", "tooth_count"]),
    ("normal_module_mm", &["m", "mn", "m_n", "modul"]),
    ("helix_angle_deg", &["beta"]),
    ("normal_pressure_angle_deg", &["alpha", "alpha_n"]),
    ("face_width_mm", &["b", "width"]),
    ("profile_shift", &["x", "addendum_modification"]),
    ("centre_distance_mm", &["a", "axis_distance", "center_distance"]),
    ("young_mpa", &["e", "youngs_modulus", "elastic_modulus", "e_modulus"]),
    ("poisson", &["nu", "poisson_ratio"]),
    ("density_kg_m3", &["rho"]),
    ("torque_nm", &["t", "moment", "load_nm"]),
    ("speed_rpm", &["n", "rpm", "omega"]),
];

/// No key is longer, bytes.
const LONGEST: usize = 64;

/// The one key of `known` that `word` is another name or a part of: `module` of `normal_module_mm`.
fn called<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    if word.len() > LONGEST {
        return None;
    }
    let small = word.to_lowercase();
    let names = |key: &str| NAMES.iter().any(|(own, others)| *own == key && others.contains(&small.as_str()));
    if let Some(key) = known.iter().find(|key| names(key)) {
        return Some(key);
    }
    // Whole parts alone: `mod` is no module.
    let framed = format!("_{small}_");
    let mut parts = known.iter().filter(|key| small.len() > 2 && format!("_{key}_").contains(&framed));
    let first = parts.next()?;
    parts.next().is_none().then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A part of several keys stands for none of them.
    #[test]
    fn a_part_of_one_key_alone_is_another_name_of_it() {
        assert_eq!(called("angle", &["helix_angle_deg", "width_mm"]), Some("helix_angle_deg"));
        assert_eq!(called("angle", &["helix_angle_deg", "pressure_angle_deg"]), None);
    }
}
