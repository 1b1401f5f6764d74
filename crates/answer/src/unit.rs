//! The unit that a name ends with.

/// Endings of names and their units, the longest first where one ends with another.
const UNITS: [(&str, &str); 38] = [
    ("n_per_mm_um", "N/(mm um)"),
    ("mm_s_per_rpm", "mm/s at 1/min"),
    ("n_mm_rad", "N, mm, rad"),
    ("urad_per_s", "urad/s"),
    ("per_cent", "%"),
    ("kg_m2", "kg m2"),
    ("n_s_per_mm", "N s/mm"),
    ("n_per_um", "N/um"),
    ("n_per_mm", "N/mm"),
    ("um_per_s", "um/s"),
    ("m_per_s", "m/s"),
    ("mm_s", "mm/s"),
    ("per_s", "1/s"),
    ("pct", "%"),
    ("nmm", "N mm"),
    ("nm", "N m"),
    ("urad", "urad"),
    ("mrad", "mrad"),
    ("rad", "rad"),
    ("deg", "deg"),
    ("mpa", "MPa"),
    ("rpm", "1/min"),
    ("hz", "Hz"),
    ("mj", "mJ"),
    ("um", "um"),
    ("mm2", "mm2"),
    ("mm", "mm"),
    ("kg", "kg"),
    ("mb", "MB"),
    ("percent", "%"),
    ("ms", "ms"),
    ("mpa_s", "mPa s"),
    ("h", "h"),
    ("c", "C"),
    ("k", "K"),
    ("s", "s"),
    ("n", "N"),
    ("w", "W"),
];

/// Unit of a column or key by the ending of its name, `""` for a number without unit.
///
/// `max_pressure_mpa` is in MPa. A rate `a_um_per_b_deg` is in `um/deg`. A name that goes on behind its unit, as
/// `d_ste_um_falling`, tells none.
///
/// ```
/// assert_eq!(answer::unit_of("max_pressure_mpa"), "MPa");
/// assert_eq!(answer::unit_of("mean_mesh_stiffness_n_per_um"), "N/um");
/// assert_eq!(answer::unit_of("d_ste_um_per_pinion_tip_relief_um"), "um/um");
/// assert_eq!(answer::unit_of("pairs_in_contact"), "");
/// ```
pub fn unit_of(name: &str) -> String {
    if let Some((end, unit)) = ending(name) {
        let ratio = name.split_once("_per_").filter(|(_, below)| !end.contains("_per_") && ending_alone(below));
        return match ratio {
            Some((above, below)) => format!("{}/{}", unit_of(above), unit_of(below)),
            None => unit.to_owned(),
        };
    }
    name.split_once("_per_").map_or_else(String::new, |(above, _)| unit_of(above))
}

/// Units in ASCII, and as people read them.
const SHOWN: [(&str, &str); 7] = [
    ("um", "µm"),
    ("urad", "µrad"),
    ("N m", "N·m"),
    ("N mm", "N·mm"),
    ("N s", "N·s"),
    ("kg m2", "kg·m²"),
    ("1/min", "rpm"),
];

/// A text with its units as SI writes them: `µm` for `um`, `N·m` for `N m`; names and keys, as `ste_um`, stay.
///
/// ```
/// assert_eq!(answer::shown_units("STE [um], 150 N m at 1500 1/min"), "STE [µm], 150 N·m at 1500 rpm");
/// assert_eq!(answer::shown_units("stiffness [N/um], `ste_um` and an umlaut"), "stiffness [N/µm], `ste_um` and an umlaut");
/// ```
pub fn shown_units(text: &str) -> String {
    let is_part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '`');
    let mut shown = String::with_capacity(text.len() + 8);
    let mut rest = text;
    while let Some(next) = rest.chars().next() {
        // The longest first: `N mm` begins as `N m` does.
        let found = SHOWN
            .iter()
            .filter(|(unit, _)| rest.strip_prefix(unit).is_some_and(|behind| !is_part(behind.chars().next())));
        let found = found.max_by_key(|(unit, _)| unit.len()).filter(|_| !is_part(shown.chars().next_back()));
        let (taken, written) = match found {
            Some((unit, as_si)) => (unit.len(), *as_si),
            None => (next.len_utf8(), &rest[..next.len_utf8()]),
        };
        shown.push_str(written);
        rest = &rest[taken..];
    }
    shown
}

/// Ending of a name that is its unit, and the unit.
pub(crate) fn ending(name: &str) -> Option<(&'static str, &'static str)> {
    let of = |(ending, _): &&(&str, &str)| {
        name.strip_suffix(ending).is_some_and(|rest| rest.is_empty() || rest.ends_with('_'))
    };
    UNITS.iter().find(of).copied()
}

/// Whether what stands below `_per_` is a quantity with a name of its own, no bare unit.
fn ending_alone(below: &str) -> bool {
    ending(below).is_some_and(|(unit, _)| unit != below)
}
