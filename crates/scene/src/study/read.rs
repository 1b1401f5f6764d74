//! From a file to a checked study.

use std::path::Path;

use super::{
    Study,
    check::check,
    columns::ColumnsOf,
    schema::{RawStudy, tables},
};
use crate::{Document, DocumentKind, SceneError, Setting, Source};

impl Study {
    /// Reads and checks a study file and the scenes that it names, all of them with the keys of `settings` set otherwise;
    /// what a case sets itself holds before these. `columns` tells which columns the rows of a scene will have.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, with its place in the study file, in a scene or in a setting.
    pub fn read(file: &Path, settings: &[Setting], columns: ColumnsOf<'_>) -> Result<Self, SceneError> {
        Self::of(&Document::read(file)?, settings, columns)
    }

    /// Checks the text of a study file; `file` is what messages name and what paths are relative to.
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn parse(text: &str, file: &Path, settings: &[Setting], columns: ColumnsOf<'_>) -> Result<Self, SceneError> {
        Self::of(&Document::new(text.to_owned(), file), settings, columns)
    }

    fn of(document: &Document, settings: &[Setting], columns: ColumnsOf<'_>) -> Result<Self, SceneError> {
        let source = Source::of(document, tables);
        let raw: RawStudy = source.words(DocumentKind::Study)?;
        check(&source, raw, settings, columns)
    }
}
