//! The words of a scene file with their types and places, nothing checked yet.

use std::{ops::Range, path::Path};

use serde::Deserialize;
use toml::{Spanned, de::DeTable};

use super::SceneError;
use super::schema::{RawScene, meaning, tables};
use super::setting::{self, Setting};
use super::source::Source;

/// The text of a scene with what was set beside it.
pub(super) fn source<'a>(
    file: &'a Path,
    text: &'a str,
    settings: &'a [Setting],
    ranges: &'a [Range<usize>],
) -> Source<'a> {
    Source::of(file, text, tables).with_meanings(meaning).with_settings(settings, ranges)
}

/// The words of a scene file.
///
/// # Errors
/// Syntax, unknown keys and wrong types, each with its line.
pub(super) fn read(source: &Source<'_>) -> Result<RawScene, SceneError> {
    let explain = |e: toml::de::Error| source.explain(e.message(), e.span());
    with_tables(source, |root| RawScene::deserialize(toml::Deserializer::from(root)).map_err(explain))
}

/// Hands on the tables of a file with what was set beside it put in; places are those of the source's text.
///
/// # Errors
/// Syntax, with its line, and what `work` complains of.
pub(crate) fn with_tables<T>(
    source: &Source<'_>,
    work: impl FnOnce(Spanned<DeTable<'_>>) -> Result<T, SceneError>,
) -> Result<T, SceneError> {
    let explain = |e: toml::de::Error| source.explain(e.message(), e.span());
    let file_end = source.ranges.first().map_or(source.text.len(), |r| r.start - 1);
    // Each setting is read on its own, as far from the beginning as its line is: so its spans are those of the text.
    let padded: Vec<String> = source.ranges.iter().map(|r| " ".repeat(r.start) + &source.text[r.clone()]).collect();
    let mut root = DeTable::parse(&source.text[..file_end]).map_err(explain)?;
    for (setting, padded) in source.settings.iter().zip(&padded) {
        setting::put(root.get_mut(), padded, setting.key()).map_err(explain)?;
    }
    work(root)
}
