//! `[modes]` of a gearbox file: which normal modes of its gears vibrate.

use super::{schema::RawGearbox, values::Checked};
use crate::{ModesScene, Source, motion, schema::RawModes};

/// The modes that are asked for, as a pair of the model `reduced+modes` has them; nothing where there is no table.
pub(super) fn modes(s: &Source<'_>, raw: &RawGearbox) -> Checked<Option<ModesScene>> {
    let Some(table) = &raw.modes else { return Ok(None) };
    let refused = |what: &str, advice: &str| Err(s.conflict(&table.span(), what, advice));
    if raw.motion.is_some() {
        return refused(
            "[modes] with [motion]: gears of a motion in time are rigid beside their teeth",
            "leave [motion] out for a vibration with modes of the gears, or leave [modes] out",
        );
    }
    if raw.vibration.is_none() {
        return refused("[modes] belongs to a vibration", "add [vibration], or leave it out");
    }
    let own = table.get_ref();
    let words = RawModes {
        count: own.count.clone(),
        below_hz: own.below_hz.clone(),
        boundary: own.boundary.clone(),
        fixed_modes: own.fixed_modes.clone(),
        ..RawModes::default()
    };
    motion::modes(s, &words).map(Some)
}
