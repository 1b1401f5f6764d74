//! A number that another unit would make sense of: which one, and what to write.

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

/// A number in the unit of its key that was written in another one.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherUnit {
    /// The number in the key's own unit.
    pub value: f64,
    /// What is what: `0.2618 rad are 15 degrees`.
    pub said: String,
}

/// What `value` behind `key` is where it was meant in another unit; of units that lead to what `fits` the first.
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

/// A number as people write it: without an exponent unless it would be long.
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
}
