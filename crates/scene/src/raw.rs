//! The words of a scene file with their types and places, nothing checked yet.

use super::{
    DocumentKind, SceneError,
    document::Document,
    schema::{RawScene, meaning, tables},
    setting::Setting,
    source::Source,
};

/// A scene with what was set beside it.
pub(super) fn source<'a>(document: &'a Document, settings: &'a [Setting]) -> Source<'a> {
    Source::of(document, tables).with_meanings(meaning).with_settings(settings)
}

/// The words of a scene file.
///
/// # Errors
/// Syntax, unknown keys and wrong types, each with its line.
pub(super) fn read(source: &Source<'_>) -> Result<RawScene, SceneError> {
    source.words(DocumentKind::Scene)
}
