//! Checks what a continuation can follow (motions that are periodic in mesh cycles, along a key of the model), and the
//! models that can have basins.

use std::ops::Range;

use toml::Spanned;

use crate::schema::{RawScene, StiffnessFrom};
use crate::source::Source;
use crate::{ContinuationKey, Model, Scene, SceneError};

type Checked<T> = Result<T, SceneError>;

fn span<T>(value: &Option<Spanned<T>>) -> Option<Range<usize>> {
    value.as_ref().map(Spanned::span)
}

/// Refuses what has no branch of periodic motions.
pub(super) fn check(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let Some(of_scene) = scene.motion.as_ref().filter(|m| m.continuation.is_some() || m.basins.is_some()) else {
        return Ok(());
    };
    let Some(motion) = raw.motion.as_ref().map(Spanned::get_ref) else { return Ok(()) };
    let run = span(&motion.run).unwrap_or(0..0);
    let model = scene.analysis.model;
    if !matches!(model, Model::Mapped | Model::Reduced | Model::Lumped8 | Model::Lumped12 | Model::Shaft18) {
        let advice = "use one of the models \"mapped\", \"reduced\", \"lumped8\", \"lumped12\" and \"shaft18\"";
        let what = match of_scene.continuation {
            Some(_) => "this model has no continuation: its motion has no smooth equations",
            None => "this model has no search for basins: its states are no plane",
        };
        return Err(s.conflict(&run, what, advice));
    }
    let Some(words) = of_scene.continuation else { return Ok(()) };
    own_periods(s, raw, scene)?;
    let table = motion.continuation.as_ref().map(Spanned::get_ref);
    let at = table.and_then(|t| span(&t.key)).unwrap_or(run.clone());
    let refuse = |what: &str, advice: &str| Err(s.conflict(&at, what, advice));
    let fed = scene.mesh.as_ref().is_some_and(|m| m.stiffness_from == StiffnessFrom::Reduced);
    match words.key {
        ContinuationKey::Torque if fed => {
            let advice = "use `model = \"mapped\"`, or give the stiffness as a series";
            return refuse("the mesh stiffness that the reduced model feeds is that of one torque", advice);
        }
        ContinuationKey::Damping if motion.mesh_damping_ns_per_mm2.is_some() => {
            return refuse(
                "`mesh_damping_ns_per_mm2` says how the mesh is damped",
                "give `mesh_damping_ratio` in its place",
            );
        }
        ContinuationKey::Damping if model == Model::Lumped12 => {
            return refuse("the damping of \"lumped12\" is Rayleigh's", "follow the speed or the torque");
        }
        ContinuationKey::HalfBacklash if !matches!(model, Model::Lumped8 | Model::Shaft18) => {
            let what = "`half_backlash_um` is a key of the models \"lumped8\" and \"shaft18\"";
            return refuse(what, "use one of them, or follow another key");
        }
        _ => {}
    }
    let least = words.from.min(words.to);
    if matches!(words.key, ContinuationKey::Speed | ContinuationKey::Torque) && least <= 0.0 {
        let end = table.and_then(|t| span(if words.from <= words.to { &t.from } else { &t.to })).unwrap_or(at.clone());
        let what = format!("`{}` of 0 leaves no motion", words.key.word());
        return Err(s.conflict(&end, what, "begin and end above 0"));
    }
    Ok(())
}

/// What has a period of its own, beside the mesh cycle.
fn own_periods(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let load = raw.load.as_ref().map(Spanned::get_ref);
    let drive = raw.drive.as_ref().map(Spanned::get_ref);
    let gears = [&raw.pinion, &raw.wheel];
    let lumped8 = raw.lumped8.as_ref().map(Spanned::get_ref);
    let swings = [
        ("amplitude_nm", load.and_then(|l| span(&l.amplitude_nm))),
        ("table_s_nm", load.and_then(|l| span(&l.table_s_nm))),
        ("amplitude_nm", drive.and_then(|d| span(&d.amplitude_nm))),
        ("table_s_nm", drive.and_then(|d| span(&d.table_s_nm))),
        ("speed_fluctuation_hz", lumped8.and_then(|l| span(&l.speed_fluctuation_hz))),
    ];
    let shafts = gears.iter().filter_map(|g| g.shaft.as_ref()).map(Spanned::get_ref);
    let run_outs = shafts.map(|shaft| ("run_out_um", span(&shaft.run_out_um)));
    let flanks = scene.analysis.model.has_reduced_gears();
    let lists = gears.iter().map(|g| ("pitch_errors_um", span(&g.pitch_errors_um)));
    let files = gears.iter().map(|g| ("pitch_errors_file", span(&g.pitch_errors_file)));
    let errors = lists.chain(files).filter(|_| flanks);
    match swings.into_iter().chain(run_outs).chain(errors).find_map(|(key, at)| Some((key, at?))) {
        None => Ok(()),
        Some((key, at)) => Err(s.conflict(
            &at,
            format!(
                "`{key}` has a period of its own, and a continuation follows motions that come back after mesh cycles"
            ),
            "leave it out, or use `run = \"span\"`",
        )),
    }
}
