//! What a document describes, whatever it is: one pair of gears, or a gearbox.

use std::path::Path;

use crate::{Document, DocumentKind, Scene, SceneError, Setting, gearbox::Gearbox};

/// What a document describes.
#[derive(Debug, Clone, PartialEq)]
pub enum Machine {
    /// One pair of gears.
    Pair(Box<Scene>),
    /// Shafts, bearings and meshes.
    Gearbox(Box<Gearbox>),
}

impl Machine {
    /// Where its document stands.
    pub fn file(&self) -> &Path {
        match self {
            Self::Pair(scene) => &scene.file,
            Self::Gearbox(file) => &file.file,
        }
    }

    /// The scene of its pair; `None` of a gearbox.
    pub fn pair(&self) -> Option<&Scene> {
        match self {
            Self::Pair(scene) => Some(scene),
            Self::Gearbox(_) => None,
        }
    }
}

impl Document {
    /// What it describes, with some of its keys set otherwise.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, with its place in the file or the setting.
    pub fn machine(&self, settings: &[Setting]) -> Result<Machine, SceneError> {
        match self.base_kind() {
            Some(DocumentKind::Gearbox) => Ok(Machine::Gearbox(Box::new(self.gearbox(settings)?))),
            _ => Ok(Machine::Pair(Box::new(self.scene(settings)?))),
        }
    }
}
