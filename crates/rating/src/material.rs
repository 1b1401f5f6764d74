//! Materials of gears: endurance limits after ISO 6336-5, and what else the ratings ask of them.

use serde::{Deserialize, Serialize};

use crate::{RatingError, table};

/// Groups of materials that ISO 6336 tells apart (ISO 6336-5, table 1; abbreviations of ISO 6336-2, table 2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MaterialGroup {
    /// St: normalised low-carbon steels, R_m below 800 MPa.
    Structural,
    /// V: through-hardened wrought steels, R_m of 800 MPa and above.
    ThroughHardened,
    /// GG, GGG (ferritic): grey cast iron, nodular cast iron with a ferritic structure.
    CastIron,
    /// GGG (perlitic, bainitic), GTS (perlitic): nodular and black malleable cast iron.
    NodularIron,
    /// Eh: case-hardened wrought steels.
    CaseHardened,
    /// IF: flame- or induction-hardened steels and nodular iron.
    InductionHardened,
    /// NT, NV (nitrided): gas-nitrided nitriding and through-hardening steels.
    Nitrided,
    /// NV (nitrocarburised): nitrocarburised through-hardening and case-hardening steels.
    Nitrocarburised,
}

impl MaterialGroup {
    /// Whether the surface is hardened.
    pub fn is_surface_hardened(self) -> bool {
        matches!(self, Self::CaseHardened | Self::InductionHardened | Self::Nitrided | Self::Nitrocarburised)
    }
}

/// A material of a gear; units are in the names.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Name that documents use.
    pub name: String,
    /// Group.
    pub group: MaterialGroup,
    /// Allowable stress number for contact sigma_Hlim, MPa.
    pub contact_limit_mpa: f64,
    /// Nominal stress number for bending sigma_Flim, MPa, for load from one side.
    pub root_limit_mpa: f64,
    /// Yield stress sigma_S or 0.2 % proof stress, MPa; of cast iron the tensile strength.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yield_stress_mpa: Option<f64>,
    /// Hardness of the surface, HV.
    pub surface_hardness_hv: f64,
    /// Thermal conductivity lambda_M, W/(m K).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thermal_conductivity_w_per_m_k: Option<f64>,
    /// Specific heat c_M, J/(kg K).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub specific_heat_j_per_kg_k: Option<f64>,
    /// Whether the roots are shot-peened.
    #[serde(default)]
    pub is_shot_peened: bool,
    /// Where the numbers come from.
    pub source: String,
}

/// A table of materials.
#[derive(Debug, Clone, PartialEq)]
pub struct Materials(Vec<Material>);

impl Materials {
    /// The table that the program brings.
    pub fn built_in() -> &'static Self {
        static TABLE: std::sync::LazyLock<Materials> = std::sync::LazyLock::new(|| {
            // The file is part of the program, and a test reads it.
            Materials::parse(include_str!("../data/materials.toml")).unwrap_or(Materials(Vec::new()))
        });
        &TABLE
    }

    /// The table of a file: `[[material]]` tables with the fields of [`Material`].
    ///
    /// # Errors
    /// [`RatingError::Table`].
    pub fn parse(text: &str) -> Result<Self, RatingError> {
        let all = table::rows(text, "material", |m: &Material| &m.name)?;
        for m in &all {
            let positive = [
                ("contact_limit_mpa", Some(m.contact_limit_mpa)),
                ("root_limit_mpa", Some(m.root_limit_mpa)),
                ("yield_stress_mpa", m.yield_stress_mpa),
                ("surface_hardness_hv", Some(m.surface_hardness_hv)),
                ("thermal_conductivity_w_per_m_k", m.thermal_conductivity_w_per_m_k),
                ("specific_heat_j_per_kg_k", m.specific_heat_j_per_kg_k),
            ];
            let bad = |value: &f64| !(*value > 0.0 && value.is_finite());
            if let Some((key, value)) = positive.into_iter().find_map(|(key, v)| Some((key, v.filter(bad)?))) {
                let what = format!("material \"{}\": `{key}` is {value}, allowed is a positive number", m.name);
                return Err(RatingError::Table { line: 0, what });
            }
        }
        Ok(Self(all))
    }

    /// The material of a name.
    pub fn find(&self, name: &str) -> Option<&Material> {
        self.0.iter().find(|m| m.name == name)
    }

    /// All names in the order of the table.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|m| &*m.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table of the program is read, and every surface is as hard as its group.
    #[test]
    fn the_built_in_table_is_whole() {
        let text = include_str!("../data/materials.toml");
        let table = Materials::parse(text).unwrap();
        assert_eq!(&table, Materials::built_in());
        assert!(table.names().count() >= 10);
        for m in &table.0 {
            assert_eq!(m.group.is_surface_hardened(), m.surface_hardness_hv > 450.0, "{}", m.name);
            assert!(m.root_limit_mpa < m.contact_limit_mpa, "{}", m.name);
        }
    }

    /// A damaged table says what and where.
    #[test]
    fn damaged_tables_are_refused() {
        let row = "[[material]]\nname = \"a\"\ngroup = \"case_hardened\"\ncontact_limit_mpa = 1500\n\
                   root_limit_mpa = 430\nsurface_hardness_hv = 700\nsource = \"x\"\n";
        assert!(Materials::parse(row).is_ok());
        for (text, said) in [
            (format!("{row}{row}"), "\"a\" stands twice"),
            (row.replace("1500", "-1"), "`contact_limit_mpa` is -1"),
            (row.replace("case_hardened", "steel"), "unknown variant `steel`"),
            (row.replace("source", "sauce"), "unknown field `sauce`"),
            (row.replace("[[material]]", "[[metal]]"), "unknown key `metal`"),
            ("x".into(), "key"),
        ] {
            let error = Materials::parse(&text).unwrap_err().to_string();
            assert!(error.contains(said), "{error}");
        }
    }
}
