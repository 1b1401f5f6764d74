//! Seats of bearings in shafts of a gearbox file, and shafts that do not rotate: impossible combinations.

use toml::Spanned;

use super::{
    file::{GearboxBearing, GearboxGear, GearboxShaft},
    schema::RawGearbox,
    shaft::length,
    values::Checked,
};
use crate::{Source, Word, units::shown};

/// Distance between two axes that is none: digits of a file, mm.
const ONE_AXIS: f64 = 1e-9;

/// Checks that seats in shafts have a place there, that a shaft that stands is held, and that nothing on it has to turn.
pub(super) fn seats(
    s: &Source<'_>,
    raw: &RawGearbox,
    (shafts, bearings): (&[GearboxShaft], &[GearboxBearing]),
) -> Checked<()> {
    let fixed = fixed_shaft(s, raw, shafts)?;
    for (table, own) in raw.bearing.iter().zip(bearings) {
        let span = table.get_ref().in_shaft.as_ref().map_or(table.span(), Spanned::span);
        let wrong = |said: String, advice: &str| Err(s.conflict(&span, said, advice));
        if own.stiffness[5][5] > 0.0 && !shafts[own.shaft].stands && !shafts[own.shaft].fixed {
            let said = format!("\"{}\" holds the turn of \"{}\", which turns", own.name, shafts[own.shaft].name);
            return wrong(
                said,
                "leave the stiffness of that turn out, or let the shaft stand (`stands = true`), or be `fixed`",
            );
        }
        if let (Some(axis), None) = (fixed, own.in_shaft) {
            let [axis, inner] = [axis, own.shaft].map(|shaft| &shafts[shaft]);
            let arm = (inner.origin[0] - axis.origin[0]).hypot(inner.origin[1] - axis.origin[1]);
            if arm > ONE_AXIS {
                let said = format!(
                    "\"{}\" holds \"{}\" in the housing {} mm beside the axis of \"{}\", which is fixed: seen from the carrier that place turns",
                    own.name,
                    inner.name,
                    shown(arm),
                    axis.name
                );
                return wrong(
                    said,
                    "seat it in the carrier or a pin with `in_shaft`; a stage of parallel shafts behind the planets goes into a file of its own",
                );
            }
        }
        if fixed.is_some() && own.in_shaft.is_none() && !own.is_round() {
            let said = format!(
                "\"{}\" in the housing is not the same all round, and the housing turns against the carrier",
                own.name
            );
            return wrong(
                said,
                "with a `fixed` shaft give x and y one stiffness, and no offset of the seat across the axis",
            );
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
            let said = format!(
                "the seat of \"{}\" is {} mm beside the axis of \"{}\", which turns",
                own.name,
                shown(arm),
                outer.name
            );
            return wrong(
                said,
                "shafts within turning shafts have one axis: the same x and y in `origin_mm`. A carrier is seen from itself: `stands = true`",
            );
        }
        let (place, end) = (inner.origin[2] + own.position - outer.origin[2], length(outer));
        if place < -ONE_AXIS * end || place > end * (1.0 + ONE_AXIS) {
            let said = format!(
                "the seat of \"{}\" is {} mm from z = 0 of \"{}\", which is {} mm long",
                own.name,
                shown(place),
                outer.name,
                shown(end)
            );
            return wrong(
                said,
                "both shafts are along z from their `origin_mm` on: lengthen the outer one, or move one of them",
            );
        }
    }
    let still = |own: &GearboxShaft| own.stands || own.fixed;
    for (table, (i, own)) in raw.shaft.iter().zip(shafts.iter().enumerate()).filter(|(_, (_, own))| still(own)) {
        let wrong = |said: String, advice: &str| Err(s.conflict(&table.span(), said, advice));
        let still = if own.stands { "stands" } else { "is fixed" };
        if own.held {
            return wrong(
                format!("\"{}\" {still} and is held: nothing of it moves", own.name),
                "leave it out, with `in_shaft` of the bearings in it",
            );
        }
        let holds = |b: &&GearboxBearing| (b.shaft == i || b.in_shaft == Some(i)) && b.stiffness[5][5] > 0.0;
        // Meshes may hold the turn of a carrier beside a fixed shaft.
        if !(own.stands && fixed.is_some() || bearings.iter().any(|b| holds(&b))) {
            return wrong(
                format!("\"{}\" {still}, and nothing holds its turn", own.name),
                "give one of its bearings `turn_stiffness_nm_per_rad`",
            );
        }
        let on_it = |word: &Word| word.as_ref().is_some_and(|w| *w.get_ref() == own.name);
        // A carrier that turns in space has loads; a fixed shaft has gears.
        let gears = raw.gear.iter().filter(|_| own.stands).map(|t| ("a gear is", &t.get_ref().shaft));
        let loads = own.fixed || fixed.is_none();
        let torques = raw.torque.iter().filter(|_| loads).map(|t| ("a torque is", &t.get_ref().shaft));
        let input = raw.input.iter().filter(|_| loads).map(|t| ("the input is", &t.get_ref().shaft));
        if let Some((what, _)) = gears.chain(torques).chain(input).find(|(_, word)| on_it(word)) {
            return wrong(
                format!("{what} on \"{}\", which {still}", own.name),
                "leave `stands` out, or put it on a shaft that turns; the torque of a carrier is what its bearing holds. With another shaft `fixed` the carrier takes input or load",
            );
        }
    }
    Ok(())
}

/// The one shaft that is fixed in space, and that nothing is asked for which a turning frame would change.
fn fixed_shaft(s: &Source<'_>, raw: &RawGearbox, shafts: &[GearboxShaft]) -> Checked<Option<usize>> {
    let mut all = (0..shafts.len()).filter(|i| shafts[*i].fixed);
    let Some(first) = all.next() else { return Ok(None) };
    if let Some(second) = all.next() {
        let said = format!("\"{}\" and \"{}\" are fixed in space", shafts[first].name, shafts[second].name);
        return Err(s.conflict(&raw.shaft[second].span(), said, "one shaft is `fixed`: the stage turns around it"));
    }
    let wrong = |said: &str, advice: &str| {
        Err(s.conflict(
            &raw.shaft[first].span(),
            format!("\"{}\" is fixed in space {said}", shafts[first].name),
            advice,
        ))
    };
    if !shafts.iter().any(|own| own.stands) {
        return wrong("and no carrier stands in its own frame", "give the carrier as a shaft with `stands = true`");
    }
    if shafts[first].stands {
        return wrong("and stands in the frame of the carrier", "a carrier at rest stands: leave `fixed` out");
    }
    let told =
        [("[housing]", raw.housing.is_some()), ("[modes] in a [motion]", raw.modes.is_some() && raw.motion.is_some())];
    match told.into_iter().find(|(_, asked)| *asked) {
        Some((what, _)) => wrong(
            &format!("beside {what}, which knows no frame that turns"),
            "leave it out; or see the stage from its carrier with speeds n - n_c: no `fixed`, the carrier's turn held",
        ),
        None => Ok(Some(first)),
    }
}

/// Checks that bearings in bores are where their gears are, one in each.
pub(super) fn in_bores(
    s: &Source<'_>,
    raw: &RawGearbox,
    (bearings, gears): (&[GearboxBearing], &[GearboxGear]),
) -> Checked<()> {
    for (i, (table, own)) in raw.bearing.iter().zip(bearings).enumerate() {
        let (Some(number), Some(word)) = (own.in_bore_of, &table.get_ref().in_bore_of) else { continue };
        let gear = &gears[number];
        let off = (gear.position - own.position).abs().max((gear.seat - own.position).abs());
        if gear.shaft != own.shaft || off > ONE_AXIS {
            let said =
                format!("\"{}\" is in the bore of \"{}\", and not on its shaft at its mid-face", own.name, gear.name);
            let advice = "`shaft` and `position_mm` of both are the same, and the gear has no other `seat_mm`; what carries the bearing goes into `in_shaft`";
            return Err(s.conflict(&word.span(), said, advice));
        }
        if bearings[..i].iter().any(|other| other.in_bore_of == Some(number)) {
            let said = format!("two bearings are in the bore of \"{}\"", gear.name);
            return Err(s.conflict(&word.span(), said, "give one bearing two `rows`, `row_distance_mm` apart"));
        }
    }
    Ok(())
}
