//! Seats of bearings in shafts of a gearbox file, and shafts that stand: what cannot be together.

use toml::Spanned;

use super::{
    file::{GearboxBearing, GearboxShaft},
    schema::RawGearbox,
    shaft::length,
    values::Checked,
};
use crate::{Source, Word};

/// Distance between two axes that is none: digits of a file, mm.
const ONE_AXIS: f64 = 1e-9;

/// That seats in shafts have a place there, that a shaft that stands is held, and that nothing on it has to turn.
pub(super) fn seats(
    s: &Source<'_>,
    raw: &RawGearbox,
    (shafts, bearings): (&[GearboxShaft], &[GearboxBearing]),
) -> Checked<()> {
    for (table, own) in raw.bearing.iter().zip(bearings) {
        let span = table.get_ref().in_shaft.as_ref().map_or(table.span(), Spanned::span);
        let wrong = |said: String, advice: &str| Err(s.conflict(&span, said, advice));
        if own.stiffness[5][5] > 0.0 && !shafts[own.shaft].stands {
            let said = format!("\"{}\" holds the turn of \"{}\", which turns", own.name, shafts[own.shaft].name);
            return wrong(said, "leave the stiffness of that turn out, or let the shaft stand (`stands = true`)");
        }
        let Some(seat) = own.in_shaft else { continue };
        let [inner, outer] = [own.shaft, seat].map(|shaft| &shafts[shaft]);
        if own.shaft == seat {
            return wrong(
                format!("\"{}\" is between \"{}\" and itself", own.name, inner.name),
                "name another shaft with `in_shaft`",
            );
        }
        if let Some(held) = [inner, outer].into_iter().find(|shaft| shaft.held) {
            let said = format!(
                "\"{}\" is between two shafts, and \"{}\" is held, rigid in rigid bearings",
                own.name, held.name
            );
            return wrong(said, "leave `held` out and give that shaft bearings, or leave `in_shaft` out");
        }
        let arm = (inner.origin[0] - outer.origin[0]).hypot(inner.origin[1] - outer.origin[1]);
        if arm > ONE_AXIS && !outer.stands {
            let said =
                format!("the seat of \"{}\" is {arm} mm beside the axis of \"{}\", which turns", own.name, outer.name);
            return wrong(
                said,
                "shafts within turning shafts have one axis: the same x and y in `origin_mm`. A carrier is seen from itself: `stands = true`",
            );
        }
        let (place, end) = (inner.origin[2] + own.position - outer.origin[2], length(outer));
        if place < -ONE_AXIS * end || place > end * (1.0 + ONE_AXIS) {
            let said = format!(
                "the seat of \"{}\" is {place} mm from z = 0 of \"{}\", which is {end} mm long",
                own.name, outer.name
            );
            return wrong(
                said,
                "both shafts are along z from their `origin_mm` on: lengthen the outer one, or move one of them",
            );
        }
    }
    for (table, (i, own)) in raw.shaft.iter().zip(shafts.iter().enumerate()).filter(|(_, (_, own))| own.stands) {
        let wrong = |said: String, advice: &str| Err(s.conflict(&table.span(), said, advice));
        if own.held {
            return wrong(
                format!("\"{}\" stands and is held: nothing of it moves", own.name),
                "leave it out, with `in_shaft` of the bearings in it",
            );
        }
        let holds = |b: &&GearboxBearing| (b.shaft == i || b.in_shaft == Some(i)) && b.stiffness[5][5] > 0.0;
        if !bearings.iter().any(|b| holds(&b)) {
            return wrong(
                format!("\"{}\" stands, and nothing holds its turn", own.name),
                "give one of its bearings `turn_stiffness_nm_per_rad`",
            );
        }
        let on_it = |word: &Word| word.as_ref().is_some_and(|w| *w.get_ref() == own.name);
        let gears = raw.gear.iter().map(|t| ("a gear is", &t.get_ref().shaft));
        let torques = raw.torque.iter().map(|t| ("a torque is", &t.get_ref().shaft));
        let input = raw.input.iter().map(|t| ("the input is", &t.get_ref().shaft));
        if let Some((what, _)) = gears.chain(torques).chain(input).find(|(_, word)| on_it(word)) {
            return wrong(
                format!("{what} on \"{}\", which stands", own.name),
                "leave `stands` out, or put it on a shaft that turns; the torque of a carrier is what its bearing holds",
            );
        }
    }
    Ok(())
}
