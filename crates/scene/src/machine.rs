//! The machine that a document describes: one pair of gears, or a gearbox.

use std::path::Path;

use crate::{Document, DocumentKind, Scene, SceneError, Setting, gearbox::Gearbox};

/// The machine that a document describes.
#[derive(Debug, Clone, PartialEq)]
pub enum Machine {
    /// One pair of gears.
    Pair(Box<Scene>),
    /// Shafts, bearings and meshes.
    Gearbox(Box<Gearbox>),
}

impl Machine {
    /// Path of its document.
    pub fn file(&self) -> &Path {
        match self {
            Self::Pair(scene) => &scene.file,
            Self::Gearbox(file) => &file.file,
        }
    }

    /// The scene of its pair; `None` for a gearbox.
    pub fn pair(&self) -> Option<&Scene> {
        match self {
            Self::Pair(scene) => Some(scene),
            Self::Gearbox(_) => None,
        }
    }
}

impl Document {
    /// The machine, with some keys set to other values.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the file or the setting.
    pub fn machine(&self, settings: &[Setting]) -> Result<Machine, SceneError> {
        match self.base_kind() {
            Some(DocumentKind::Gearbox) => Ok(Machine::Gearbox(Box::new(self.gearbox(settings)?))),
            _ => Ok(Machine::Pair(Box::new(self.scene(settings)?))),
        }
    }
}
