//! Checks of bodies, bearings and shafts of the gears, and of other tables for motion.

use toml::Spanned;

use super::Checked;
use crate::{
    DriveScene, GearScene, Model, ModesScene, MotionScene, ShaftScene, TorqueScene, models, motion,
    schema::{RawGear, RawScene},
    source::Source,
};

/// What a table says, if it is there.
fn table_of<T>(table: &Option<Spanned<T>>) -> Option<&T> {
    table.as_ref().map(Spanned::get_ref)
}

/// Bodies and bearings of both gears.
pub(super) fn bodies(s: &Source<'_>, raw: &RawScene, model: Model, gears: [&mut GearScene; 2]) -> Checked<()> {
    let rung = models::Rung::of(model);
    for (of, (said, whose)) in gears.into_iter().zip([(&raw.pinion, "pinion"), (&raw.wheel, "wheel")]) {
        let mut body = table_of(&said.body).map(|b| motion::body(s, b)).transpose()?.unwrap_or_default();
        let mut free_at = said.body.as_ref().map(Spanned::span);
        if let Some((rung, moves)) = rung.and_then(|r| Some((r, r.moves?))) {
            models::check_free_coordinates(s, said, rung, &body)?;
            body.free = moves.to_vec();
            free_at = raw.analysis.model.as_ref().map(Spanned::span);
        }
        of.bearing = motion::bearing(s, table_of(&said.bearing), &body.free, free_at, whose)?;
        if model == Model::Lumped12 {
            // Its damping is Rayleigh's.
            of.bearing.damping_ratio = None;
        }
        of.body = Some(body);
    }
    Ok(())
}

/// The table on motion, as the model takes it.
pub(super) fn in_time(s: &Source<'_>, raw: &RawScene, model: Model) -> Checked<MotionScene> {
    let (cycles, turn) = (&raw.analysis.cycles, &raw.analysis.turn);
    let length = [cycles.as_ref().map(|own| ("cycles", own.span())), turn.as_ref().map(|own| ("turn", own.span()))];
    let said = motion::motion(s, table_of(&raw.motion).unwrap_or(&Default::default()), length)?;
    // Only a mesh that says so has a damping of its own.
    let damped = models::Rung::of(model).is_none_or(|r| r.mesh_damping);
    Ok(MotionScene { mesh_damping_ratio: said.mesh_damping_ratio.filter(|_| damped), ..said })
}

/// What drives the driver.
pub(super) fn drive(s: &Source<'_>, raw: &RawScene, model: Model) -> Checked<DriveScene> {
    motion::drive(s, table_of(&raw.drive).unwrap_or(&Default::default()), model)
}

/// What the torque on the driven gear is beside its mean.
pub(super) fn load(s: &Source<'_>, raw: &RawScene) -> Checked<TorqueScene> {
    motion::load(s, table_of(&raw.load).unwrap_or(&Default::default()))
}

/// The shaft of a gear, which the model of shafts wants.
pub(super) fn shaft(s: &Source<'_>, raw: &RawGear, whose: &str, model: &Spanned<String>) -> Checked<ShaftScene> {
    match &raw.shaft {
        Some(table) => models::shaft(s, table),
        None => Err(s.conflict(
            &model.span(),
            format!("the model \"shaft18\" wants the shaft of the {whose}"),
            format!("give [{whose}.shaft] with `segments_mm`, `gear_at_mm` and supports"),
        )),
    }
}

/// The table of modes goes with the model that keeps them, and with no other.
pub(super) fn normal_modes(s: &Source<'_>, raw: &RawScene, model: Model) -> Checked<Option<ModesScene>> {
    match (model, &raw.modes) {
        (Model::ReducedModes, None) => motion::modes(s, &Default::default()).map(Some),
        (Model::ReducedModes, Some(words)) => motion::modes(s, words.get_ref()).map(Some),
        (_, None) => Ok(None),
        (_, Some(words)) => Err(s.conflict(
            &words.span(),
            "[modes] belongs to `model = \"reduced+modes\"`",
            "leave it out, or say so in [analysis]",
        )),
    }
}

/// Tables on motion mean nothing to an analysis without time.
pub(super) fn refuse_motion_tables(s: &Source<'_>, raw: &RawScene) -> Checked<()> {
    let of_gear = "mass and inertia of a gear stand in its [[gear]] of the gearbox file, as `mass_kg`";
    let of_shaft = "bearings stand in [[bearing]] of the gearbox file";
    let tables = [
        ("[pinion.body]", raw.pinion.body.as_ref().map(Spanned::span), of_gear),
        ("[pinion.bearing]", raw.pinion.bearing.as_ref().map(Spanned::span), of_shaft),
        ("[wheel.body]", raw.wheel.body.as_ref().map(Spanned::span), of_gear),
        ("[wheel.bearing]", raw.wheel.bearing.as_ref().map(Spanned::span), of_shaft),
        ("[drive]", raw.drive.as_ref().map(Spanned::span), "`drive` stands in [motion] of the gearbox file"),
        ("[load]", raw.load.as_ref().map(Spanned::span), "loads over time stand in [[torque]] of the gearbox file"),
        ("[motion]", raw.motion.as_ref().map(Spanned::span), "[motion] stands in the gearbox file"),
    ];
    let Some((name, span, there)) = tables.into_iter().find_map(|(name, span, there)| Some((name, span?, there)))
    else {
        return Ok(());
    };
    if s.is_of_mesh {
        let said = format!("{name} of the pair of a mesh: a gearbox says itself what moves");
        return Err(s.conflict(&span, said, format!("leave it out: {there}")));
    }
    let said = format!("{name} belongs to an analysis in time");
    Err(s.conflict(&span, said, "leave it out, or say `kind = \"dynamic\"` in [analysis]"))
}
