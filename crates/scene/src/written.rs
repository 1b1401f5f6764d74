//! What was written, kept beside what it means: for complaints that come later than the checks of the scene.

use std::{ops::Range, path::Path, sync::Arc};

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use super::{Place, Scene, Setting, origin::Origin, raw, source::Source};

/// The text of a scene with what was set beside it. Equal to any other: scenes are compared by what they mean.
#[derive(Debug, Clone)]
pub struct Written(Arc<Text>);

#[derive(Debug)]
struct Text {
    all: String,
    settings: Vec<Setting>,
    ranges: Vec<Range<usize>>,
    origin: Origin,
}

impl PartialEq for Written {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Written {
    pub(super) fn new(source: &Source<'_>) -> Self {
        let (all, settings, ranges) = (source.text.to_owned(), source.settings.to_vec(), source.ranges.to_vec());
        Self(Arc::new(Text { all, settings, ranges, origin: source.origin }))
    }

    /// Whether the scene stands in files or in the program.
    pub(super) fn origin(&self) -> Origin {
        self.0.origin
    }

    fn source<'a>(&'a self, file: &'a Path) -> Source<'a> {
        raw::source(file, &self.0.all, &self.0.settings, &self.0.ranges)
    }
}

impl Scene {
    /// Where the first of these keys is written that is: keys have dots (`pair.centre_distance_mm`), a table's own name
    /// stands for its heading. `None` where none of them is.
    pub fn place_of(&self, keys: &[&str]) -> Option<Place> {
        let source = self.written.source(&self.file);
        let first = |root: Spanned<DeTable<'_>>| Ok(keys.iter().find_map(|key| find(root.get_ref(), key)));
        let span = raw::with_tables(&source, first).ok().flatten()?;
        Some(source.place(&span))
    }
}

fn find(table: &DeTable<'_>, key: &str) -> Option<Range<usize>> {
    let (name, rest) = key.split_once('.').map_or((key, None), |(name, rest)| (name, Some(rest)));
    let value = table.get(name)?;
    match (rest, value.get_ref()) {
        (None, _) => Some(value.span()),
        (Some(rest), DeValue::Table(inner)) => find(inner, rest),
        (Some(_), _) => None,
    }
}
