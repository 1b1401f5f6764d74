//! The table of accuracy of a gearbox file.

use super::{schema::RawGearbox, values::Checked};
use crate::{AccuracyScene, Quantity, Source};

/// What is asked; nothing where there is no table.
pub(super) fn accuracy(s: &Source<'_>, raw: &RawGearbox) -> Checked<AccuracyScene> {
    let Some(table) = &raw.accuracy else { return Ok(AccuracyScene::default()) };
    let asked = AccuracyScene::read(s, table.get_ref())?;
    let refused = |what: &str, advice: &str| Err(s.conflict(&table.span(), what, advice));
    if let (Some(_), false) = (&raw.motion, asked.is_none()) {
        return refused(
            "[accuracy] with [motion]: bounds are those of numbers at rest",
            "leave [motion] out for a run with bounds, then take its meshes and positions, or leave [accuracy] out",
        );
    }
    if asked.of(Quantity::NaturalFrequency).is_some() && raw.vibration.is_none() {
        return refused("`natural_frequency` is asked for, but no vibration", "add [vibration], or leave the key out");
    }
    if asked.of(Quantity::BearingForce).is_some() && raw.bearing.is_empty() {
        return refused("`bearing_force` is asked for, but there is no [[bearing]]", "leave the key out");
    }
    Ok(asked)
}
