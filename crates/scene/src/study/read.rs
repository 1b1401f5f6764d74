//! Reads a file and makes a checked study.

use std::path::Path;

use super::{
    Study,
    check::check,
    columns::ColumnsOf,
    schema::{RawStudy, tables},
};
use crate::{Document, DocumentKind, SceneError, Setting, Source};

impl Study {
    /// Reads and checks a study file and the scenes that it names, with the keys in `settings` set to other values in
    /// all of them. A case's own settings have priority. `columns` gives the columns that the rows of a scene will
    /// have.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the study file, in a scene or in a setting.
    pub fn read(file: &Path, settings: &[Setting], columns: ColumnsOf<'_>) -> Result<Self, SceneError> {
        Self::of(&Document::read(file)?, settings, columns)
    }

    /// Checks the text of a study file. `file` is used in messages, and paths are relative to its folder.
    ///
    /// # Errors
    /// The errors of [`Study::read`].
    pub fn parse(text: &str, file: &Path, settings: &[Setting], columns: ColumnsOf<'_>) -> Result<Self, SceneError> {
        Self::of(&Document::new(text.to_owned(), file), settings, columns)
    }

    fn of(document: &Document, settings: &[Setting], columns: ColumnsOf<'_>) -> Result<Self, SceneError> {
        let source = Source::of(document, tables);
        let raw: RawStudy = source.words(DocumentKind::Study)?;
        check(&source, raw, settings, columns)
    }
}
