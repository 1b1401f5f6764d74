//! Raw values of a scene file with their types and places, unchecked.

use super::{
    DocumentKind, SceneError,
    document::Document,
    gearbox::tables as gearbox_tables,
    schema::{RawScene, meaning, tables},
    setting::Setting,
    source::Source,
};

/// A scene with what was set beside it.
pub(super) fn source<'a>(document: &'a Document, settings: &'a [Setting]) -> Source<'a> {
    let source = Source::of(document, tables).with_meanings(meaning).with_settings(settings);
    source.with_neighbour(("a gearbox file", gearbox_tables))
}

/// The words of a scene file.
///
/// # Errors
/// Syntax, unknown keys and wrong types, each with its line.
pub(super) fn read(source: &Source<'_>) -> Result<RawScene, SceneError> {
    source.words(DocumentKind::Scene)
}
