//! `[modes]`: normal modes of the gears that vibrate in addition to the rigid bodies.

use toml::Spanned;

use crate::SceneError;
use crate::schema::{Boundary, ModesScene, RawModes};
use crate::source::Source;

/// The table that goes with `model = "reduced+modes"`.
pub(crate) fn modes(s: &Source<'_>, raw: &RawModes) -> Result<ModesScene, SceneError> {
    let conflict = |span: std::ops::Range<usize>, what: &str, advice: &str| Err(s.conflict(&span, what, advice));
    if let (Some(_), Some(bound)) = (&raw.count, &raw.below_hz) {
        return conflict(bound.span(), "`count` and `below_hz` both say which modes are kept", "keep one of them");
    }
    let boundary: Boundary = choice!(s, raw.boundary)?;
    let consistent = boundary == Boundary::Consistent;
    if let Some(fixed) = raw.fixed_modes.as_ref().map(Spanned::span).filter(|_| !consistent) {
        let what = "`fixed_modes` belongs to `boundary = \"consistent\"`";
        return conflict(fixed, what, "leave it out: a massless boundary takes the modes of the whole mesh");
    }
    let made = ModesScene::read(s, raw, f64::INFINITY)?;
    Ok(ModesScene {
        count: made.count.filter(|_| made.below_hz.is_none()),
        fixed_modes: made.fixed_modes.filter(|_| consistent),
        ..made
    })
}
