//! Whether the pair will hold: the checked table `[rating]`.

use rating::{Lubricant, Lubricants, Material, Materials, Spectrum};
use serde::Serialize;

use crate::{data_file::DataFile, schema::RatingEdition};

/// What a rating is made for and with.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RatingScene {
    /// Edition of ISO 6336.
    pub edition: RatingEdition,
    /// Required life, h.
    pub life_h: f64,
    /// K_A.
    pub application_factor: f64,
    /// K_Hbeta; `None`: of the solved load distribution.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub face_load_factor: Option<f64>,
    /// K_V; `None`: method B.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dynamic_factor: Option<f64>,
    /// K_Halpha and K_Falpha; `None`: method B.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub transverse_load_factor: Option<f64>,
    /// ISO 1328-1:2013 tolerance class.
    pub tolerance_class: u32,
    /// f_pb, um; `None`: of the class.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base_pitch_deviation_um: Option<f64>,
    /// f_falpha, um; `None`: of the class.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile_form_deviation_um: Option<f64>,
    /// C_a, um; `None`: of running-in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip_relief_um: Option<f64>,
    /// C_R.
    pub gear_blank_factor: f64,
    /// Whether some pits are allowed.
    pub limited_pitting: bool,
    /// Z_NT and Y_NT at 1e10 load cycles.
    pub long_life_factor: f64,
    /// Loads over the life.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<DataFile<Spectrum>>,
    /// Name of the lubricant.
    pub lubricant: String,
    /// File with lubricants in place of the program's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lubricants: Option<DataFile<Lubricants>>,
    /// File with materials in place of the program's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub materials: Option<DataFile<Materials>>,
    /// Gear 1.
    pub pinion: RatedGearScene,
    /// Gear 2.
    pub wheel: RatedGearScene,
}

/// What is rated of a gear.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RatedGearScene {
    /// Name of its material.
    pub material: String,
    /// R_z of the flanks, um.
    pub flank_roughness_rz_um: f64,
    /// R_z of the roots, um.
    pub root_roughness_rz_um: f64,
    /// Load on the flank that is loaded less over that of the other.
    pub reversed_load_ratio: f64,
    /// Times that each tooth is loaded in a turn.
    pub meshes_per_turn: u32,
}

impl RatingScene {
    /// Pinion and wheel.
    pub fn gears(&self) -> [&RatedGearScene; 2] {
        [&self.pinion, &self.wheel]
    }

    /// The table of materials.
    pub fn material_table(&self) -> &Materials {
        self.materials.as_ref().map_or_else(|| Materials::built_in(), DataFile::values)
    }

    /// The table of lubricants.
    pub fn lubricant_table(&self) -> &Lubricants {
        self.lubricants.as_ref().map_or_else(|| Lubricants::built_in(), DataFile::values)
    }

    /// Materials of pinion and wheel; `None` where the table has no such name, which a scene that was read is refused for.
    pub fn material_of(&self, gear: usize) -> Option<&Material> {
        self.material_table().find(&self.gears()[gear].material)
    }

    /// The lubricant; `None` likewise.
    pub fn oil(&self) -> Option<&Lubricant> {
        self.lubricant_table().find(&self.lubricant)
    }
}
