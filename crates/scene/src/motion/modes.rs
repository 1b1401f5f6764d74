//! `[modes]`: which normal modes of the gears move beside the rigid bodies.

use serde::{Deserialize, Serialize};
use toml::Spanned;

use crate::{
    SceneError,
    raw::{Number, Whole, Word},
    schema,
    source::Source,
};

/// The words of the table, nothing checked yet.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawModes {
    pub count: Whole,
    pub below_hz: Number,
    pub boundary: Word,
    pub fixed_modes: Whole,
    pub damping_ratio: Number,
}

/// Normal modes of both gears.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ModesScene {
    /// So many of each gear, the lowest; exactly one of the two is there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// All up to this frequency, Hz.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub below_hz: Option<f64>,
    /// Whether the flanks have inertia of their own.
    pub boundary: Boundary,
    /// Modes with the flanks held behind a consistent boundary; of a cyclic gear of every harmonic.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fixed_modes: Option<u32>,
    /// Damping ratio of every mode.
    pub damping_ratio: f64,
}

/// Inertia of the flanks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Boundary {
    /// None but what the modes carry: modes of the whole mesh, what they leave of the compliance answers at once.
    Massless,
    /// The mesh's own, condensed to the flanks (Craig and Bampton).
    Consistent,
}

/// The table that goes with `model = "reduced+modes"`.
pub(crate) fn modes(s: &Source<'_>, raw: &RawModes) -> Result<ModesScene, SceneError> {
    let conflict = |span: std::ops::Range<usize>, what: &str, advice: &str| Err(s.conflict(&span, what, advice));
    if let (Some(_), Some(bound)) = (&raw.count, &raw.below_hz) {
        return conflict(bound.span(), "`count` and `below_hz` both say which modes are kept", "keep one of them");
    }
    let choices = [("massless", Boundary::Massless), ("consistent", Boundary::Consistent)];
    let boundary = s.choice("boundary", &raw.boundary, &choices)?;
    let consistent = boundary == Boundary::Consistent;
    if let Some(fixed) = raw.fixed_modes.as_ref().map(Spanned::span).filter(|_| !consistent) {
        let what = "`fixed_modes` belongs to `boundary = \"consistent\"`";
        return conflict(fixed, what, "leave it out: a massless boundary takes the modes of the whole mesh");
    }
    let below_hz = s.optional_of(&schema::MODES, "below_hz", &raw.below_hz)?;
    Ok(ModesScene {
        count: below_hz.is_none().then(|| s.whole_of(&schema::MODES, "count", &raw.count)).transpose()?,
        below_hz,
        boundary,
        fixed_modes: consistent.then(|| s.whole_of(&schema::MODES, "fixed_modes", &raw.fixed_modes)).transpose()?,
        damping_ratio: s.number_of(&schema::MODES, "damping_ratio", &raw.damping_ratio)?,
    })
}
