//! Detects numbers that make sense in another unit: which unit, and what to write.

/// Another unit that users write in keys whose names end so: the factor to the key's own, its name, the key's own.
type Unit = (&'static str, f64, &'static str, &'static str);

/// Units that keys have in their names; of several that fit the first one is told.
const UNITS: &[Unit] = &[
    ("_deg", 180.0 / std::f64::consts::PI, "rad", "degrees"),
    ("young_mpa", 1e-6, "Pa", "MPa"),
    ("young_mpa", 1e3, "GPa", "MPa"),
    ("density_kg_m3", 1e12, "t/mm^3", "kg/m^3"),
    ("density_kg_m3", 1e9, "kg/mm^3", "kg/m^3"),
    ("density_kg_m3", 1e3, "g/cm^3", "kg/m^3"),
    ("poisson", 1e-2, "%", ""),
    ("_n_per_mm", 1e-3, "N/m", "N/mm"),
    ("_n_per_mm", 1e3, "N/um", "N/mm"),
    ("_mm", 1e3, "m", "mm"),
    ("_mm", 1e-3, "um", "mm"),
    ("_um", 1e3, "mm", "um"),
    ("_nm", 1e-3, "N mm", "N m"),
    ("_rpm", 30.0 / std::f64::consts::PI, "rad/s", "1/min"),
    ("_kg_m2", 1e-6, "kg mm^2", "kg m^2"),
    ("_kg", 1e3, "t", "kg"),
    ("_kg", 1e-3, "g", "kg"),
];

/// Units that keys name at their ends, and what people write for them. Behind `_per_` nothing but what has it counts.
const OWN: &[(&str, &[&str])] = &[
    ("_n_per_mm", &["N/mm"]),
    ("_kg_m2", &["kg m^2"]),
    ("_kg_m3", &["kg/m^3"]),
    ("_deg", &["degrees", "deg", "\u{b0}"]),
    ("_hz", &["Hz", "1/s"]),
    ("_kg", &["kg"]),
    ("_kn", &["kN"]),
    ("_mm", &["mm"]),
    ("_mpa", &["MPa", "N/mm^2"]),
    ("_nm", &["N m"]),
    ("_rpm", &["1/min", "rpm", "min^-1"]),
    ("_um", &["um"]),
    ("_h", &["h"]),
    ("_n", &["N"]),
    ("_s", &["s"]),
];

/// Further units that people write behind a number: the key's own, what is written, and the factor to the own one.
const WRITTEN: &[(&str, &str, f64)] = &[
    ("mm", "cm", 10.0),
    ("mm", "in", 25.4),
    ("mm", "inch", 25.4),
    ("um", "nm", 1e-3),
    ("um", "m", 1e6),
    ("s", "ms", 1e-3),
    ("s", "us", 1e-6),
    ("s", "min", 60.0),
    ("s", "h", 3600.0),
    ("h", "min", 1.0 / 60.0),
    ("h", "d", 24.0),
    ("Hz", "kHz", 1e3),
    ("Hz", "rpm", 1.0 / 60.0),
    ("Hz", "1/min", 1.0 / 60.0),
    ("1/min", "Hz", 60.0),
    ("1/min", "1/s", 60.0),
    ("N", "kN", 1e3),
    ("kN", "N", 1e-3),
    ("N m", "kN m", 1e3),
    ("MPa", "Pa", 1e-6),
    ("MPa", "kPa", 1e-3),
    ("MPa", "GPa", 1e3),
    ("degrees", "'", 1.0 / 60.0),
];

/// The unit of a key; nothing of one that names none, `None` of one whose unit is not known here.
pub(crate) fn own_unit(key: &str) -> Option<&'static str> {
    let name = key.rsplit('.').next().unwrap_or(key);
    let known =
        OWN.iter().find(|(ending, _)| name.ends_with(ending) && (ending.contains("_per_") || !name.contains("_per_")));
    match known {
        Some((_, names)) => names.first().copied(),
        None if name.contains("_per_") => None,
        None => Some(""),
    }
}

/// A number as it is written behind `key` that has a unit behind it; `None` of a unit that does not lead to the key's own.
pub(crate) fn in_written_unit(key: &str, value: f64, written: &str) -> Option<OtherUnit> {
    let plain = |unit: &str| {
        let signs = [
            ("\u{b5}", "u"),
            ("\u{3bc}", "u"),
            ("\u{b2}", "^2"),
            ("\u{b3}", "^3"),
            ("\u{b7}", ""),
            ("*", ""),
            (" ", ""),
        ];
        signs.iter().fold(unit.to_owned(), |text, (sign, instead)| text.replace(sign, instead))
    };
    let (own, wanted) = (own_unit(key)?, plain(written));
    let is = |unit: &str| plain(unit) == wanted;
    let name = key.rsplit('.').next().unwrap_or(key);
    let exact = |factor: f64| format!("{:.12e}", value * factor).parse().unwrap_or(value * factor);
    let of = |factor: f64, other: &str| {
        let meant = exact(factor);
        OtherUnit { value: meant, said: format!("{} are {}", spaced(value, other), spaced(meant, own)) }
    };
    let names = OWN.iter().find(|(_, names)| names.first() == Some(&own)).map_or(&[][..], |(_, names)| names);
    if names.iter().any(|unit| is(unit)) {
        return Some(OtherUnit { value, said: "the unit is in the key".into() });
    }
    let of_key = UNITS.iter().filter(|unit| unit.3 == own && (!own.is_empty() || name.ends_with(unit.0)));
    let known = of_key.map(|&(_, factor, other, _)| (own, other, factor));
    let share = ("", "%", 1e-2);
    let mut all = known.chain(WRITTEN.iter().copied()).chain([share]);
    let found = all.find(|(unit, other, _)| *unit == own && is(other)).map(|(_, other, factor)| of(factor, other));
    let is_own = || names.iter().any(|unit| plain(unit).eq_ignore_ascii_case(&wanted));
    found.or_else(|| is_own().then(|| OtherUnit { value, said: "the unit is in the key".into() }))
}

/// A number that was given in another unit than that of its key.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherUnit {
    /// The number in the key's own unit.
    pub value: f64,
    /// Text of the conversion: `0.2618 rad are 15 degrees`.
    pub said: String,
}

/// The conversion of `value` at `key` if it was intended in another unit; of several units whose result `fits`, the
/// first one.
pub fn in_another_unit(key: &str, value: f64, fits: impl Fn(f64) -> bool) -> Option<OtherUnit> {
    let name = key.rsplit('.').next().unwrap_or(key);
    UNITS.iter().filter(|unit| name.ends_with(unit.0)).find_map(|&(_, factor, other, own)| {
        let meant = short(value * factor);
        (value.is_finite() && value != 0.0 && fits(meant)).then(|| {
            let (from, to) = (spaced(value, other), spaced(meant, own));
            OtherUnit { value: meant, said: format!("{from} are {to}") }
        })
    })
}

/// Four digits, as whoever writes a number means it: 0.2618 rad are 15.0003 degrees.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// A number with its unit, as a file has it.
fn spaced(value: f64, unit: &str) -> String {
    let text = plain(value);
    if unit.is_empty() { text } else { format!("{text} {unit}") }
}

/// A number of a message: four digits, as people write it.
pub fn shown(value: f64) -> String {
    plain(short(value))
}

/// A number as people write it: without an exponent, unless it would be long.
pub fn plain(value: f64) -> String {
    if value != 0.0 && !(1e-4..1e7).contains(&value.abs()) { format!("{value:e}") } else { format!("{value}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_told_by_the_end_of_the_key() {
        let said = |key: &str, value: f64, [low, high]: [f64; 2]| {
            in_another_unit(key, value, |x| (low..=high).contains(&x)).map(|u| u.said)
        };
        let some = |text: &str| Some(text.to_owned());
        assert_eq!(said("pair.normal_pressure_angle_deg", 0.349, [5.0, 40.0]), some("0.349 rad are 20 degrees"));
        assert_eq!(said("young_mpa", 2.06e11, [1.0, 1e7]), some("2.06e11 Pa are 206000 MPa"));
        assert_eq!(said("density_kg_m3", 7.85e-9, [1.0, 1e5]), some("7.85e-9 t/mm^3 are 7850 kg/m^3"));
        assert_eq!(said("density_kg_m3", 7.85e-6, [1.0, 1e5]), some("7.85e-6 kg/mm^3 are 7850 kg/m^3"));
        assert_eq!(said("poisson", 30.0, [-0.9, 0.499]), some("30 % are 0.3"));
        assert_eq!(said("normal_module_mm", 0.0025, [0.01, 200.0]), some("0.0025 m are 2.5 mm"));
        assert_eq!(said("thickness_allowance_mm", 50.0, [0.0, 1.25]), some("50 um are 0.05 mm"));
        assert_eq!(said("teeth", 3.0, [5.0, 2000.0]), None);
        assert_eq!(said("young_mpa", f64::NAN, [1.0, 1e7]), None);
        assert_eq!(said("poisson", 1e5, [-0.9, 0.499]), None);
    }

    /// A number with a unit behind it comes to that of the key, or to nothing.
    #[test]
    fn a_written_unit_leads_to_that_of_the_key() {
        for (key, value, unit, wanted) in [
            ("motion.duration_s", 20.0, "ms", Some(0.02)),
            ("duration_s", 3.0, "\u{b5}s", Some(3e-6)),
            ("duration_s", 2.0, "min", Some(120.0)),
            ("face_width_mm", 2.0, "cm", Some(20.0)),
            ("face_width_mm", 2.0, "MM", Some(2.0)),
            ("tip_relief_um", 0.02, "mm", Some(20.0)),
            ("torque_nm", 150.0, "N\u{b7}m", Some(150.0)),
            ("torque_nm", 1.5, "kNm", Some(1500.0)),
            ("torque_nm", 150.0, "lbf ft", None),
            ("young_mpa", 206.0, "GPa", Some(206_000.0)),
            ("speed_rpm", 25.0, "Hz", Some(1500.0)),
            ("speed_rpm", 1500.0, "min^-1", Some(1500.0)),
            ("helix_angle_deg", 15.0, "\u{b0}", Some(15.0)),
            ("poisson", 30.0, "%", Some(0.3)),
            ("error_tolerance", 1.0, "%", Some(0.01)),
            ("stiffness_n_per_mm", 2.0, "N/um", Some(2000.0)),
            ("stiffness_n_per_mm", 2.0, "cm", None),
            ("sliding_mm_per_s", 2.0, "s", None),
            ("normal_module_mm", 1.0, "%", None),
        ] {
            let found = in_written_unit(key, value, unit).map(|other| other.value);
            assert_eq!(found, wanted, "{key} = {value} {unit}");
        }
    }
}
