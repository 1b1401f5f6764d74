//! The words of a gearbox file, nothing checked yet.

use serde::Deserialize;
use toml::Spanned;

use super::motion::RawMotion;
use crate::spanned::{Number, Numbers, Rows, Switch, Whole, Word, Words};

/// Every table with its keys.
const TABLES: &[(&str, &[&str])] = &[
    (
        "",
        &["name", "shaft", "bearing", "gear", "mesh", "input", "torque", "housing", "analysis", "vibration", "motion"],
    ),
    (
        "[shaft]",
        &["name", "origin_mm", "section", "rexs", "rexs_shaft", "young_mpa", "poisson", "density_kg_m3", "held"],
    ),
    ("[shaft.section]", &["length_mm", "outer_diameter_mm", "inner_diameter_mm"]),
    (
        "[bearing]",
        &[
            "name",
            "shaft",
            "position_mm",
            "stiffness_n_per_mm",
            "tilt_stiffness_nm_per_rad",
            "matrix_n_mm_rad",
            "damping_n_s_per_mm",
            "type",
            "bore_mm",
            "outer_diameter_mm",
            "static_rating_kn",
            "elements",
            "element_diameter_mm",
            "element_length_mm",
            "pitch_diameter_mm",
            "contact_angle_deg",
            "inner_conformity",
            "outer_conformity",
            "profile",
            "radial_clearance_um",
            "axial_clearance_um",
            "preload_n",
            "takes_thrust",
            "rows",
            "row_distance_mm",
            "arrangement",
        ],
    ),
    (
        "[gear]",
        &[
            "name",
            "shaft",
            "position_mm",
            "seat_mm",
            "key_deg",
            "mass_kg",
            "transverse_inertia_kg_m2",
            "polar_inertia_kg_m2",
        ],
    ),
    ("[mesh]", &["name", "scene", "set", "pinion", "wheel"]),
    ("input", &["shaft", "position_mm", "rotation", "inertia_kg_m2"]),
    ("[torque]", &["shaft", "position_mm", "torque_nm", "inertia_kg_m2"]),
    ("housing", &["matrix_n_mm_rad", "file", "matrix", "nodes", "turn_nodes"]),
    ("analysis", &["positions_per_cycle", "cycles"]),
    ("vibration", &["from_rpm", "to_rpm", "speeds", "orders", "damping_ratio", "modes", "input"]),
    ("motion", super::motion::KEYS),
];

/// The same, as messages look them up.
pub(super) fn tables() -> Vec<(String, Vec<&'static str>)> {
    TABLES.iter().map(|(name, keys)| ((*name).to_owned(), keys.to_vec())).collect()
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawGearbox {
    pub name: Option<String>,
    #[serde(default)]
    pub shaft: Vec<Spanned<RawShaft>>,
    #[serde(default)]
    pub bearing: Vec<Spanned<RawBearing>>,
    #[serde(default)]
    pub gear: Vec<Spanned<RawGear>>,
    #[serde(default)]
    pub mesh: Vec<Spanned<RawMesh>>,
    pub input: Option<Spanned<RawInput>>,
    #[serde(default)]
    pub torque: Vec<Spanned<RawTorque>>,
    pub housing: Option<Spanned<RawHousing>>,
    #[serde(default)]
    pub analysis: RawAnalysis,
    pub vibration: Option<Spanned<RawVibration>>,
    pub motion: Option<Spanned<RawMotion>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawShaft {
    pub name: Word,
    pub origin_mm: Numbers,
    #[serde(default)]
    pub section: Vec<Spanned<RawSection>>,
    pub rexs: Word,
    pub rexs_shaft: Word,
    pub young_mpa: Number,
    pub poisson: Number,
    pub density_kg_m3: Number,
    pub held: Switch,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawSection {
    pub length_mm: Number,
    pub outer_diameter_mm: Number,
    pub inner_diameter_mm: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawBearing {
    pub name: Word,
    pub shaft: Word,
    pub position_mm: Number,
    pub stiffness_n_per_mm: Numbers,
    pub tilt_stiffness_nm_per_rad: Numbers,
    pub matrix_n_mm_rad: Rows,
    pub damping_n_s_per_mm: Numbers,
    #[serde(rename = "type")]
    pub kind: Word,
    pub bore_mm: Number,
    pub outer_diameter_mm: Number,
    pub static_rating_kn: Number,
    pub elements: Whole,
    pub element_diameter_mm: Number,
    pub element_length_mm: Number,
    pub pitch_diameter_mm: Number,
    pub contact_angle_deg: Number,
    pub inner_conformity: Number,
    pub outer_conformity: Number,
    pub profile: Word,
    pub radial_clearance_um: Number,
    pub axial_clearance_um: Number,
    pub preload_n: Number,
    pub takes_thrust: Word,
    pub rows: Whole,
    pub row_distance_mm: Number,
    pub arrangement: Word,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawGear {
    pub name: Word,
    pub shaft: Word,
    pub position_mm: Number,
    pub seat_mm: Number,
    pub key_deg: Number,
    pub mass_kg: Number,
    pub transverse_inertia_kg_m2: Number,
    pub polar_inertia_kg_m2: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawMesh {
    pub name: Word,
    pub scene: Word,
    pub set: Words,
    pub pinion: Word,
    pub wheel: Word,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawInput {
    pub shaft: Word,
    pub position_mm: Number,
    pub rotation: Word,
    pub inertia_kg_m2: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawTorque {
    pub shaft: Word,
    pub position_mm: Number,
    pub torque_nm: Number,
    pub inertia_kg_m2: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawHousing {
    pub matrix_n_mm_rad: Rows,
    pub file: Word,
    pub matrix: Word,
    pub nodes: Option<Spanned<Vec<i64>>>,
    pub turn_nodes: Option<Spanned<Vec<i64>>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawAnalysis {
    pub positions_per_cycle: Whole,
    pub cycles: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawVibration {
    pub from_rpm: Number,
    pub to_rpm: Number,
    pub speeds: Whole,
    pub orders: Whole,
    pub damping_ratio: Number,
    pub modes: Whole,
    pub input: Word,
}
