//! Reads a file and makes a checked gearbox.

use std::path::Path;

use super::{
    Gearbox,
    check::check,
    pair_setting::{PairSetting, is_of_pair},
    schema::{RawGearbox, tables},
};
use crate::{Document, DocumentKind, SceneError, Setting, Source};

impl Gearbox {
    /// All keys of a gearbox file with the names of their tables: `shaft.section.length_mm`.
    pub fn keys() -> Vec<String> {
        let of = |(table, keys): (String, Vec<&'static str>)| {
            let table = table.trim_matches(['[', ']']).to_owned();
            keys.into_iter().map(move |key| if table.is_empty() { key.to_owned() } else { format!("{table}.{key}") })
        };
        tables().into_iter().flat_map(of).collect()
    }

    /// Reads and checks a gearbox file and the scenes of its meshes.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the gearbox file or in a scene.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        Document::read(file)?.gearbox(&[])
    }

    /// Checks the text of a gearbox file. `file` is used in messages, and paths are relative to its folder.
    ///
    /// # Errors
    /// The errors of [`Gearbox::read`].
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        Self::parse_with(text, file, &[])
    }

    /// Gearbox of a text with some keys set to other values: `gear.0.position_mm`, `vibration.speeds`. If a key is set
    /// twice, the last setting counts.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the file or the setting.
    pub fn parse_with(text: &str, file: &Path, settings: &[Setting]) -> Result<Self, SceneError> {
        Document::new(text.to_owned(), file).gearbox(settings)
    }

    /// Gearbox of a text with the scenes of some names as texts: before they are written.
    pub(crate) fn parse_beside(text: &str, file: &Path, beside: &[(String, String)]) -> Result<Self, SceneError> {
        let document = Document::new(text.to_owned(), file);
        read(&source(&document).with_beside(beside), &[])
    }
}

impl Document {
    /// The gearbox of the document, with some keys set to other values.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the file or the setting.
    pub fn gearbox(&self, settings: &[Setting]) -> Result<Gearbox, SceneError> {
        let (of_pairs, own): (Vec<&Setting>, Vec<&Setting>) = settings.iter().partition(|s| is_of_pair(s));
        let own: Vec<Setting> = own.into_iter().cloned().collect();
        let of_pairs: Vec<PairSetting> = of_pairs.into_iter().map(PairSetting::of).collect();
        let read = read(&source(self).with_settings(&own), &of_pairs)?;
        Ok(Gearbox { set: settings.iter().map(Setting::word).collect(), ..read })
    }
}

/// A gearbox file; keys of a pair are told as such.
fn source(document: &Document) -> Source<'_> {
    Source::of(document, tables).with_neighbour(("the scene of a pair", crate::schema::tables))
}

fn read(source: &Source<'_>, of_pairs: &[PairSetting]) -> Result<Gearbox, SceneError> {
    let raw: RawGearbox = source.words(DocumentKind::Gearbox)?;
    check(source, raw, of_pairs)
}
