//! Plans whose values depend on the preceding ones.

use toml::Spanned;

use super::{
    SectionEvery, Start,
    check::{fits, setting},
    read::{base_of, words_of},
    schema::{RawVary, VARY},
};
use crate::{Document, SceneError, Setting, SweepWay, Whole};

/// A plan whose values do not all start separately: its options with checked ranges. Whether its keys exist is checked
/// by the analysis.
#[derive(Debug, Clone)]
pub struct StartedPlan {
    /// Kind of start; not [`Start::Each`].
    pub start: Start,
    /// Document that is varied.
    pub document: Document,
    /// Keys that are set to other values for all values of the plan.
    pub settings: Vec<Setting>,
    /// Keys and their values, as after `--vary`.
    pub keys: Vec<String>,
    /// Column of the section.
    pub of: Option<String>,
    /// Directions in which values are taken; `None`: not given.
    pub ways: Vec<SweepWay>,
    /// Interval between points of a section.
    pub every: Option<SectionEvery>,
    /// Number of points of a section.
    pub cycles: Option<u32>,
    /// Largest number of mesh cycles before the section.
    pub settle: Option<u32>,
    /// Number of mesh cycles over which the largest Lyapunov exponent is computed.
    pub lyapunov: Option<u32>,
}

impl StartedPlan {
    /// The options of a document whose values do not all start separately; `None` if they do.
    ///
    /// # Errors
    /// [`SceneError`]: the first error in its options.
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
