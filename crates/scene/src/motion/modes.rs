//! `[modes]`: which normal modes of the gears move beside the rigid bodies.

use serde::Serialize;
use toml::Spanned;

use crate::SceneError;
use crate::schema::{Boundary, RawModes};
use crate::source::Source;

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

/// The table that goes with `model = "reduced+modes"`.
pub(crate) fn modes(s: &Source<'_>, raw: &RawModes) -> Result<ModesScene, SceneError> {
    let conflict = |span: std::ops::Range<usize>, what: &str, advice: &str| Err(s.conflict(&span, what, advice));
    if let (Some(_), Some(bound)) = (&raw.count, &raw.below_hz) {
        return conflict(bound.span(), "`count` and `below_hz` both say which modes are kept", "keep one of them");
    }
    let boundary = choice!(s, raw.boundary)?;
    let consistent = boundary == Boundary::Consistent;
    if let Some(fixed) = raw.fixed_modes.as_ref().map(Spanned::span).filter(|_| !consistent) {
        let what = "`fixed_modes` belongs to `boundary = \"consistent\"`";
        return conflict(fixed, what, "leave it out: a massless boundary takes the modes of the whole mesh");
    }
    let below_hz = optional!(s, MODES, raw.below_hz)?;
    Ok(ModesScene {
        count: below_hz.is_none().then(|| value!(s, MODES, raw.count)).transpose()?,
        below_hz,
        boundary,
        fixed_modes: consistent.then(|| value!(s, MODES, raw.fixed_modes)).transpose()?,
        damping_ratio: value!(s, MODES, raw.damping_ratio)?,
    })
}
