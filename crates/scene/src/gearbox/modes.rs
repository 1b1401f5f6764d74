//! `[modes]` of a gearbox file: the normal modes of its gears that can vibrate.

use super::{
    motion::GearboxMotion,
    schema::{MeshModel, RawGearbox},
    values::Checked,
};
use crate::{ModesScene, Source, schema::RawModes};

/// The modes that are asked for, as a pair of the model `reduced+modes` has them; nothing where there is no table.
pub(super) fn modes(s: &Source<'_>, raw: &RawGearbox, moves: Option<&GearboxMotion>) -> Checked<Option<ModesScene>> {
    let Some(table) = &raw.modes else { return Ok(None) };
    let refused = |what: &str, advice: &str| Err(s.conflict(&table.span(), what, advice));
    if raw.motion.is_none() && raw.vibration.is_none() {
        return refused("[modes] belongs to a vibration or a motion", "add [vibration] or [motion], or leave it out");
    }
    if let Some(motion) = moves.filter(|motion| motion.mesh != MeshModel::Exact) {
        let word = motion.mesh.word();
        let said = format!("[modes] with a motion of `mesh = \"{word}\"`: modes move in the exact contact alone");
        return refused(&said, "take `mesh = \"exact\"` in [motion], or leave [modes] or [motion] out");
    }
    if let (None, Some(damping)) = (moves, &table.get_ref().damping_ratio) {
        let said = "`damping_ratio` of [modes] is that of a motion";
        return Err(s.conflict(&damping.span(), said, "leave it out: a vibration has its own in [vibration]"));
    }
    let own = table.get_ref();
    let words = RawModes {
        count: own.count.clone(),
        below_hz: own.below_hz.clone(),
        boundary: own.boundary.clone(),
        fixed_modes: own.fixed_modes.clone(),
        damping_ratio: own.damping_ratio.clone(),
    };
    crate::motion::modes(s, &words).map(Some)
}
