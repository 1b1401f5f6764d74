//! The text of a document that is run: a pair's scene or a gearbox file.

use std::path::{Path, PathBuf};

use crate::{DocumentKind, Scene, SceneError, Setting, gearbox::Gearbox, read_text};

/// The text of a file, read once: a pipe can be read no second time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DocumentText {
    file: PathBuf,
    text: String,
}

impl DocumentText {
    /// Reads a file.
    ///
    /// # Errors
    /// [`SceneError::Read`].
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        let text = read_text(file).map_err(|source| SceneError::Read { file: file.to_owned(), source })?;
        Ok(Self { file: file.to_owned(), text })
    }

    /// Kind of the document by its tables; `None` where it has none of a known kind, or is no TOML.
    pub fn kind(&self) -> Option<DocumentKind> {
        DocumentKind::of(&self.text)
    }

    /// The scene that it is, with some of its keys set otherwise.
    ///
    /// # Errors
    /// As of [`Scene::parse_with`].
    pub fn scene(&self, settings: &[Setting]) -> Result<Scene, SceneError> {
        Scene::parse_with(&self.text, &self.file, settings)
    }

    /// The gearbox file that it is, with some of its keys set otherwise.
    ///
    /// # Errors
    /// As of [`Gearbox::parse_with`].
    pub fn gearbox(&self, settings: &[Setting]) -> Result<Gearbox, SceneError> {
        Gearbox::parse_with(&self.text, &self.file, settings)
    }
}
