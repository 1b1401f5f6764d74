//! Matrices and tables of the contact of two gears, which all their meshes have in common.

use std::sync::Arc;

use ale::ToothWindow;
use contact::{ContactOptions, ContactSet};
use geometry::GearPair;
use ltca::StaticError;
use reduction::ElasticGear;

use crate::GearboxError;

/// What an `ExactMesh` has in common with others of the same gears.
#[derive(Debug)]
pub struct MeshOfGears {
    pub(crate) pair: GearPair,
    pub(crate) gears: Arc<[ElasticGear; 2]>,
    pub(crate) options: ContactOptions,
    pub(crate) set: ContactSet,
}

impl MeshOfGears {
    /// Flanks of a window; `None` where its gears are others, or its contact is another.
    pub(crate) fn set(
        &self,
        pair: &GearPair,
        gears: &Arc<[ElasticGear; 2]>,
        window: &ToothWindow,
        options: &ContactOptions,
    ) -> Result<Option<ContactSet>, GearboxError> {
        // Slices are cut anew; where the gears stand, and how they rub, no table knows.
        let ContactOptions { offsets, wheel_turn, friction, slices, .. } = self.options.clone();
        let alike = ContactOptions { offsets, wheel_turn, friction, slices, ..options.clone() };
        if !Arc::ptr_eq(&self.gears, gears) || alike != self.options {
            return Ok(None);
        }
        let same = self.pair == *pair && slices == options.slices;
        let set = if same {
            self.set.in_window(pair, gears, window, options)
        } else {
            self.set.modified(pair, gears, window, options)
        };
        Ok(set.map_err(StaticError::from)?)
    }
}
