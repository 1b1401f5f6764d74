//! What a plan says whose values do not each start alone.

use toml::Spanned;

use super::{
    SectionEvery, Start,
    check::{fits, setting},
    read::{base_of, words_of},
    schema::{RawVary, VARY},
};
use crate::{Document, SceneError, Setting, SweepWay, Whole};

/// A plan whose values do not each start alone: its words, with their ranges checked. What keys they name is told by who
/// runs it.
#[derive(Debug, Clone)]
pub struct StartedPlan {
    /// Not [`Start::Each`].
    pub start: Start,
    /// What is varied.
    pub document: Document,
    /// Keys that all values have otherwise.
    pub settings: Vec<Setting>,
    /// Keys and their values, as behind `--vary`.
    pub keys: Vec<String>,
    /// Column whose section is taken.
    pub of: Option<String>,
    /// Which way values are gone through; none: not said.
    pub ways: Vec<SweepWay>,
    /// How often a section has a point.
    pub every: Option<SectionEvery>,
    /// Points of a section.
    pub cycles: Option<u32>,
    /// Mesh cycles before it at the most.
    pub settle: Option<u32>,
    /// Mesh cycles over which the largest Lyapunov exponent is found.
    pub lyapunov: Option<u32>,
}

impl StartedPlan {
    /// What a document says of values that do not start each alone; `None` where they do.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint about its words.
    pub fn of(document: &Document, more: &[Setting]) -> Result<Option<Self>, SceneError> {
        let own = words_of(document)?;
        let (s, raw) = (own.source(), own.raw()?);
        let start: Start = s.choice_of("start", &raw.vary.start)?;
        fits(&s, start, &raw)?;
        if start == Start::Each {
            return Ok(None);
        }
        let RawVary { keys, of, ways, once, cycles, settle, lyapunov, .. } = &raw.vary;
        let mut settings = raw.set.iter().flatten().map(|word| setting(&s, word)).collect::<Result<Vec<_>, _>>()?;
        settings.extend_from_slice(more);
        let whole = |key: &str, value: &Whole| value.as_ref().map(|_| s.whole_of(&VARY, key, value)).transpose();
        Ok(Some(Self {
            start,
            document: base_of(&s, &raw, document)?,
            settings,
            keys: keys.iter().flatten().map(|word| word.get_ref().clone()).collect(),
            of: of.clone().map(Spanned::into_inner),
            ways: s.choices_of("ways", ways)?,
            every: once.as_ref().map(|word| s.meaning_of("once", word)).transpose()?,
            cycles: whole("cycles", cycles)?,
            settle: whole("settle", settle)?,
            lyapunov: whole("lyapunov", lyapunov)?,
        }))
    }
}
