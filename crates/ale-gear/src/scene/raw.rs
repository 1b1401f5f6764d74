//! The words of a scene file with their types and places, nothing checked yet.

use serde::Deserialize;
use toml::Spanned;

use super::SceneError;
use super::source::Source;

/// A number as written.
pub(super) type Number = Option<Spanned<f64>>;
/// A whole number as written; signed, so that `-3` is out of range and not of a wrong type.
pub(super) type Whole = Option<Spanned<i64>>;
/// A word as written.
pub(super) type Word = Option<Spanned<String>>;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawScene {
    pub name: Option<String>,
    #[serde(default)]
    pub pinion: RawGear,
    #[serde(default)]
    pub wheel: RawGear,
    #[serde(default)]
    pub pair: RawPair,
    #[serde(default)]
    pub material: RawMaterial,
    #[serde(default)]
    pub operation: RawOperation,
    #[serde(default)]
    pub contact: RawContact,
    #[serde(default)]
    pub analysis: RawAnalysis,
    #[serde(default)]
    pub output: RawOutput,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawGear {
    pub teeth: Whole,
    pub helix_angle_deg: Number,
    pub bore_diameter_mm: Number,
    pub profile_shift: Number,
    pub tip_diameter_mm: Number,
    pub tip_edge_radius_mm: Number,
    pub thickness_allowance_mm: Number,
    pub mesh: Word,
    pub mesher: Option<Spanned<RawMesher>>,
    #[serde(default)]
    pub groups: RawGroups,
    #[serde(default)]
    pub material: RawMaterial,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawGroups {
    pub bore: Word,
    pub flank_left: Word,
    pub flank_right: Word,
    pub cut_0: Word,
    pub cut_1: Word,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawMesher {
    pub order: Whole,
    pub elements_profile: Whole,
    pub elements_fillet: Whole,
    pub elements_thickness: Whole,
    pub elements_face: Whole,
    pub elements_rim: Whole,
    pub sector_teeth: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawPair {
    pub normal_module_mm: Number,
    pub normal_pressure_angle_deg: Number,
    pub face_width_mm: Number,
    pub centre_distance_mm: Number,
    pub addendum_coefficient: Number,
    pub dedendum_coefficient: Number,
    pub root_radius_coefficient: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawMaterial {
    pub young_mpa: Number,
    pub poisson: Number,
    pub density_kg_m3: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawOperation {
    pub driver: Word,
    pub rotation: Word,
    pub torque_nm: Number,
    pub speed_rpm: Number,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawContact {
    pub method: Word,
    pub slices: Whole,
    pub penalty_mpa_per_mm: Number,
    pub gap: Word,
    pub points_per_face_edge: Whole,
    pub flanks: Word,
    pub friction: Number,
    pub corner_contact: Option<toml::Spanned<bool>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawAnalysis {
    pub kind: Word,
    pub model: Word,
    pub positions_per_cycle: Whole,
    pub cycles: Whole,
    pub window_teeth: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawOutput {
    pub vtu: Option<bool>,
    pub fields: Option<Vec<Spanned<String>>>,
    pub vtu_every: Whole,
}

/// The words of a scene file.
///
/// # Errors
/// Syntax, unknown keys and wrong types, each with its line.
pub(super) fn read(source: &Source<'_>) -> Result<RawScene, SceneError> {
    toml::from_str(source.text).map_err(|e| source.explain(e.message(), e.span()))
}
