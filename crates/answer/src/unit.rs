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

fn ending(name: &str) -> Option<(&'static str, &'static str)> {
    let of = |(ending, _): &&(&str, &str)| {
        name.strip_suffix(ending).is_some_and(|rest| rest.is_empty() || rest.ends_with('_'))
    };
    UNITS.iter().find(of).copied()
}

/// Whether what stands below `_per_` is a quantity with a name of its own, no bare unit.
fn ending_alone(below: &str) -> bool {
    ending(below).is_some_and(|(unit, _)| unit != below)
}
