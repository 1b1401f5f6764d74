//! From a file to a checked study.

use std::path::Path;

use super::{
    Study,
    check::check,
    columns::ColumnsOf,
    raw::{RawStudy, tables},
};
use crate::{DocumentKind, SceneError, Setting, Source, read_text};

impl Study {
    /// Reads and checks a study file and the scenes that it names, all of them with the keys of `settings` set otherwise;
    /// what a case sets itself holds before these. `columns` tells which columns the rows of a scene will have.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, with its place in the study file, in a scene or in a setting.
    pub fn read(file: &Path, settings: &[Setting], columns: ColumnsOf<'_>) -> Result<Self, SceneError> {
        let text = read_text(file).map_err(|source| SceneError::Read { file: file.to_owned(), source })?;
        Self::parse(&text, file, settings, columns)
    }

    /// Checks the text of a study file; `file` is what messages name and what paths are relative to.
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn parse(text: &str, file: &Path, settings: &[Setting], columns: ColumnsOf<'_>) -> Result<Self, SceneError> {
        let source = Source::of(file, text, tables);
        let raw: RawStudy = toml::from_str(text)
            .map_err(|e| source.explain(e.message(), e.span()))
            .map_err(|e| e.unless_another_kind(text, file, DocumentKind::Study))?;
        check(&source, raw, settings, columns)
    }
}
