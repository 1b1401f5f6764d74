//! Rating of the pair: the checked table `[rating]`.

use rating::{Lubricant, Lubricants, Material, Materials};

use crate::{
    data_file::DataFile,
    schema::{RatedGearScene, RatingScene},
};

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

    /// Materials of pinion and wheel; `None` if the table has no such name, which is an error when a scene is read.
    pub fn material_of(&self, gear: usize) -> Option<&Material> {
        self.material_table().find(&self.gears()[gear].material)
    }

    /// The lubricant; `None` in the same case.
    pub fn oil(&self) -> Option<&Lubricant> {
        self.lubricant_table().find(&self.lubricant)
    }
}
