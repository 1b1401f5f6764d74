//! Lubricants: viscosity over temperature, and how they did on the FZG test.

use serde::{Deserialize, Serialize};

use crate::{RatingError, table};

/// What an oil is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LubricantBase {
    /// Mineral oil.
    Mineral,
    /// Polyalphaolefin or ester.
    Polyalphaolefin,
    /// Polyglycol that does not dissolve in water.
    Polyglycol,
}

/// An oil; units are in the names.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lubricant {
    /// Name that documents use.
    pub name: String,
    /// Base.
    pub base: LubricantBase,
    /// Kinematic viscosity at 40 C, mm^2/s.
    pub viscosity_40c_mm2_per_s: f64,
    /// Kinematic viscosity at 100 C, mm^2/s.
    pub viscosity_100c_mm2_per_s: f64,
    /// Density at 15 C, kg/m^3.
    pub density_15c_kg_m3: f64,
    /// Load stage of the scuffing test FZG A/8.3/90 (ISO 14635-1) at which the oil failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scuffing_load_stage: Option<f64>,
    /// Load stage of the micropitting test (FVA 54/7) at which the oil failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub micropitting_load_stage: Option<f64>,
    /// Where the numbers come from.
    pub source: String,
}

impl Lubricant {
    /// Kinematic viscosity at a temperature in C, mm^2/s.
    ///
    /// ```text
    /// lg lg(nu + 0.7) = A - B lg T      through the values at 40 C and 100 C
    /// ```
    /// Source: ISO/TS 6336-22 (Walther; ASTM D341).
    pub fn kinematic_viscosity(&self, temperature_c: f64) -> f64 {
        let twice = |nu: f64| (nu + 0.7).log10().log10();
        let [low, high] = [40.0_f64, 100.0].map(|c| (c + 273.15).log10());
        let (at_low, at_high) = (twice(self.viscosity_40c_mm2_per_s), twice(self.viscosity_100c_mm2_per_s));
        let b = (at_low - at_high) / (high - low);
        let a = at_low + b * low;
        let inner = a - b * (temperature_c + 273.15).log10();
        10f64.powf(10f64.powf(inner)) - 0.7
    }

    /// Density at a temperature in C, kg/m^3: `rho_15 - 0.7 (theta + 273 - 289)`. Source: ISO/TS 6336-22.
    pub fn density(&self, temperature_c: f64) -> f64 {
        self.density_15c_kg_m3 - 0.7 * (temperature_c + 273.0 - 289.0)
    }

    /// Dynamic viscosity at a temperature in C, mPa s: `1e-3 nu rho`.
    pub fn dynamic_viscosity(&self, temperature_c: f64) -> f64 {
        1e-3 * self.kinematic_viscosity(temperature_c) * self.density(temperature_c)
    }
}

/// A table of lubricants.
#[derive(Debug, Clone, PartialEq)]
pub struct Lubricants(Vec<Lubricant>);

impl Lubricants {
    /// The table that the program brings.
    pub fn built_in() -> &'static Self {
        static TABLE: std::sync::LazyLock<Lubricants> = std::sync::LazyLock::new(|| {
            // The file is part of the program, and a test reads it.
            Lubricants::parse(include_str!("../data/lubricants.toml")).unwrap_or(Lubricants(Vec::new()))
        });
        &TABLE
    }

    /// The table of a file: `[[lubricant]]` tables with the fields of [`Lubricant`].
    ///
    /// # Errors
    /// [`RatingError::Table`].
    pub fn parse(text: &str) -> Result<Self, RatingError> {
        let all = table::rows(text, "lubricant", |l: &Lubricant| &l.name)?;
        for l in &all {
            let falls = l.viscosity_40c_mm2_per_s > l.viscosity_100c_mm2_per_s && l.viscosity_100c_mm2_per_s > 1.0;
            if !falls || !l.viscosity_40c_mm2_per_s.is_finite() {
                let what = format!(
                    "lubricant \"{}\": viscosities are {} mm^2/s at 40 C and {} mm^2/s at 100 C, the first is to be the larger and both above 1",
                    l.name, l.viscosity_40c_mm2_per_s, l.viscosity_100c_mm2_per_s
                );
                return Err(RatingError::Table { line: 0, what });
            }
            if !(500.0..2000.0).contains(&l.density_15c_kg_m3) {
                let what = format!(
                    "lubricant \"{}\": `density_15c_kg_m3` is {}, allowed is 500 .. 2000",
                    l.name, l.density_15c_kg_m3
                );
                return Err(RatingError::Table { line: 0, what });
            }
        }
        Ok(Self(all))
    }

    /// The lubricant of a name.
    pub fn find(&self, name: &str) -> Option<&Lubricant> {
        self.0.iter().find(|l| l.name == name)
    }

    /// All names in the order of the table.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|l| &*l.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table of the program is read; viscosity passes through both stated points and falls.
    #[test]
    fn viscosity_passes_through_its_points() {
        let table = Lubricants::parse(include_str!("../data/lubricants.toml")).unwrap();
        assert_eq!(&table, Lubricants::built_in());
        for oil in &table.0 {
            assert!((oil.kinematic_viscosity(40.0) / oil.viscosity_40c_mm2_per_s - 1.0).abs() < 1e-10);
            assert!((oil.kinematic_viscosity(100.0) / oil.viscosity_100c_mm2_per_s - 1.0).abs() < 1e-10);
            let course: Vec<f64> = (0..12).map(|k| oil.dynamic_viscosity(10.0 * f64::from(k))).collect();
            assert!(course.windows(2).all(|w| w[1] < w[0]), "{}", oil.name);
        }
    }

    /// Dynamic viscosity of the oil of NREL's third stage at 80 C: 30.09 mPa s (KISSsoft 03/2017, printed digits).
    #[test]
    fn viscosity_of_nrel_third_stage() {
        let oil = Lubricants::built_in().find("mineral VG 220").unwrap();
        assert!((oil.dynamic_viscosity(80.0) - 30.09).abs() < 0.005, "{}", oil.dynamic_viscosity(80.0));
    }
}
