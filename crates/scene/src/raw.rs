//! The words of a scene file with their types and places, nothing checked yet.

use serde::Deserialize;
use toml::{Spanned, de::DeTable};

use super::SceneError;
use super::ladder::{RawImpact, RawLumped8, RawLumped12, RawMesh, RawShaft, RawShaft18};
use super::motion::{RawBearing, RawBody, RawDrive, RawLoad, RawModes, RawMotion};
use super::setting;
use super::source::Source;

/// A number as written.
pub type Number = Option<Spanned<f64>>;
/// A whole number as written; signed, so that `-3` is out of range and not of a wrong type.
pub type Whole = Option<Spanned<i64>>;
/// A word as written.
pub type Word = Option<Spanned<String>>;

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
    pub drive: Option<Spanned<RawDrive>>,
    pub load: Option<Spanned<RawLoad>>,
    #[serde(default)]
    pub analysis: RawAnalysis,
    pub modes: Option<Spanned<RawModes>>,
    pub motion: Option<Spanned<RawMotion>>,
    pub mesh: Option<Spanned<RawMesh>>,
    pub lumped8: Option<Spanned<RawLumped8>>,
    pub lumped12: Option<Spanned<RawLumped12>>,
    pub impact: Option<Spanned<RawImpact>>,
    pub shaft18: Option<Spanned<RawShaft18>>,
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
    pub pitch_errors_um: Option<Spanned<Vec<Spanned<f64>>>>,
    pub pitch_errors_file: Word,
    pub mesh: Word,
    pub mesher: Option<Spanned<RawMesher>>,
    #[serde(default)]
    pub groups: RawGroups,
    #[serde(default)]
    pub material: RawMaterial,
    pub modification: Option<Spanned<RawModification>>,
    pub body: Option<Spanned<RawBody>>,
    pub bearing: Option<Spanned<RawBearing>>,
    pub shaft: Option<Spanned<RawShaft>>,
}

/// The keys of a flank's modification, once for both tables that they stand in: serde flattens no tables that refuse unknown keys.
macro_rules! flank_tables {
    ($($key:ident: $kind:ty,)*) => {
        /// Keys of both flanks, and the tables of either that replace them.
        #[derive(Debug, Default, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct RawModification {
            $(pub $key: $kind,)*
            #[serde(default)]
            pub drive: RawFlank,
            #[serde(default)]
            pub coast: RawFlank,
        }

        /// Modification of one flank.
        #[derive(Debug, Default, Clone, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct RawFlank {
            $(pub $key: $kind,)*
        }

        impl RawModification {
            /// Keys of one flank: its own, and where it has none those of both.
            pub fn over(&self, own: &RawFlank) -> RawFlank {
                let mut all = RawFlank { $($key: own.$key.clone().or_else(|| self.$key.clone()),)* };
                // A start is one thing, whichever way it is given.
                if own.tip_relief_start_diameter_mm.is_some() || own.tip_relief_start_roll_deg.is_some() {
                    all.tip_relief_start_diameter_mm = own.tip_relief_start_diameter_mm.clone();
                    all.tip_relief_start_roll_deg = own.tip_relief_start_roll_deg.clone();
                }
                if own.root_relief_start_diameter_mm.is_some() || own.root_relief_start_roll_deg.is_some() {
                    all.root_relief_start_diameter_mm = own.root_relief_start_diameter_mm.clone();
                    all.root_relief_start_roll_deg = own.root_relief_start_roll_deg.clone();
                }
                all
            }
        }
    };
}

flank_tables! {
    tip_relief_um: Number,
    tip_relief_start_diameter_mm: Number,
    tip_relief_start_roll_deg: Number,
    tip_relief_shape: Word,
    root_relief_um: Number,
    root_relief_start_diameter_mm: Number,
    root_relief_start_roll_deg: Number,
    root_relief_shape: Word,
    profile_crowning_um: Number,
    profile_slope_um: Number,
    lead_crowning_um: Number,
    lead_slope_um: Number,
    end_relief_lower_um: Number,
    end_relief_lower_length_mm: Number,
    end_relief_upper_um: Number,
    end_relief_upper_length_mm: Number,
    end_relief_shape: Word,
    bias_um: Number,
    topography: Word,
    evaluation_start_diameter_mm: Number,
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
    pub misalignment: Option<Spanned<RawMisalignment>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawMisalignment {
    pub deviation_um: Number,
    pub inclination_um: Number,
    pub in_plane_of_action_um: Number,
    pub across_plane_of_action_um: Number,
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
    pub reduction: Word,
    pub positions_per_cycle: Whole,
    pub cycles: Whole,
    pub window_teeth: Whole,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawOutput {
    pub root_stress: Option<Spanned<bool>>,
    pub contact_lines: Option<Spanned<bool>>,
    pub parquet: Option<Spanned<bool>>,
    pub vtu: Option<Spanned<bool>>,
    pub fields: Option<Vec<Spanned<String>>>,
    pub vtu_every: Whole,
}

/// The words of a scene file.
///
/// # Errors
/// Syntax, unknown keys and wrong types, each with its line.
pub(super) fn read(source: &Source<'_>) -> Result<RawScene, SceneError> {
    let explain = |e: toml::de::Error| source.explain(e.message(), e.span());
    with_tables(source, |root| RawScene::deserialize(toml::Deserializer::from(root)).map_err(explain))
}

/// Hands on the file's tables with what was set beside it put in; places are those of the source's text.
///
/// # Errors
/// Syntax, with its line, and what `work` complains of.
pub(super) fn with_tables<T>(
    source: &Source<'_>,
    work: impl FnOnce(Spanned<DeTable<'_>>) -> Result<T, SceneError>,
) -> Result<T, SceneError> {
    let explain = |e: toml::de::Error| source.explain(e.message(), e.span());
    let file_end = source.ranges.first().map_or(source.text.len(), |r| r.start - 1);
    // Each setting is read on its own, as far from the beginning as its line is: so its spans are those of the text.
    let padded: Vec<String> = source.ranges.iter().map(|r| " ".repeat(r.start) + &source.text[r.clone()]).collect();
    let mut root = DeTable::parse(&source.text[..file_end]).map_err(explain)?;
    for (setting, padded) in source.settings.iter().zip(&padded) {
        setting::put(root.get_mut(), padded, setting.key()).map_err(explain)?;
    }
    work(root)
}
