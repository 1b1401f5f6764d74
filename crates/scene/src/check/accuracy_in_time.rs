//! Checks which values of a motion can have error bounds.

use std::ops::Range;

use toml::Spanned;

use super::Checked;
use crate::{DriveBy, Kind, Model, Run, Scene, SceneError, TorqueScene, schema::RawScene, source::Source};

/// Numbers of a motion belong to motions, those of a pair at rest to pairs at rest.
pub(super) fn quantities(s: &Source<'_>, table: &Range<usize>, scene: &Scene) -> Checked<()> {
    let dynamic = scene.analysis.kind == Kind::Dynamic;
    let asked = scene.accuracy.tolerances().iter().map(|(quantity, _)| *quantity);
    let Some(stranger) = asked.into_iter().find(|q| q.is_of_motion() != dynamic) else { return Ok(()) };
    let (whose, advice) = if dynamic {
        (
            "a pair at rest, and this scene is in motion",
            "ask for `rms_dte` or `peak_to_peak_dte` (`--accuracy peak_to_peak_dte=5%`), or say `kind = \"static\"`",
        )
    } else {
        (
            "a pair in motion, and this scene is at rest",
            "ask for `mean_ste` or `peak_to_peak_ste`, or say `kind = \"dynamic\"` in [analysis]",
        )
    };
    Err(s.conflict(table, format!("`{}` is a number of {whose}", stranger.key()), advice))
}

/// A motion at constant speed under a constant load, of elastic gears.
pub(super) fn motion(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let model = scene.analysis.model;
    if let (Some(word), false) = (&raw.analysis.model, model.is_reduced() || model == Model::Auto) {
        let instead = "use `model = \"auto\"`, which takes a cheaper model where that is exact enough, or \"reduced\"";
        return Err(not_yet(
            s,
            word.span(),
            format!("model = \"{}\"", word.get_ref()),
            "bounds of this model",
            instead,
        ));
    }
    let words = raw.motion.as_ref().map(Spanned::get_ref);
    if let Some(run) = words.and_then(|w| w.run.as_ref())
        && scene.motion.as_ref().is_some_and(|m| m.run != Run::Steady)
    {
        let (key, what) = (format!("run = \"{}\"", run.get_ref()), "bounds of a motion that is not steady");
        return Err(not_yet(s, run.span(), key, what, "use `run = \"steady\"`, or leave [accuracy] out"));
    }
    if let Some(tolerance) = words.and_then(|w| w.error_tolerance.as_ref()) {
        return Err(not_yet(
            s,
            tolerance.span(),
            "error_tolerance".into(),
            "bounds of a motion whose steps vary",
            "leave it out: with [accuracy] steps of equal length are held against steps of twice that length",
        ));
    }
    let kept = words.and_then(|w| w.checkpoint_every_cycles.as_ref());
    if let Some(every) = kept.filter(|_| scene.motion.as_ref().is_some_and(|m| m.checkpoint_every_cycles != Some(0))) {
        let key = "checkpoint_every_cycles".to_owned();
        let instead = "leave it out: a motion with bounds is run more than once";
        return Err(not_yet(s, every.span(), key, "checkpoints of a motion with bounds", instead));
    }
    let varies = |t: &TorqueScene| t.amplitude_nm.is_some() || t.table_s_nm.is_some();
    let driven = |d: &crate::DriveScene| d.by == DriveBy::Torque && !d.torque.is_none();
    let tables = [
        ("load", raw.load.as_ref().map(Spanned::span), scene.load.as_ref().is_some_and(varies)),
        ("drive", raw.drive.as_ref().map(Spanned::span), scene.drive.as_ref().is_some_and(driven)),
    ];
    if let Some((name, span)) = tables.into_iter().find_map(|(name, span, is)| Some((name, span.filter(|_| is)?))) {
        return Err(not_yet(
            s,
            span,
            format!("a torque in [{name}]"),
            "bounds of a motion that torques shake",
            "leave the torque out: load and speed are then constant; or leave [accuracy] out",
        ));
    }
    Ok(())
}

fn not_yet(s: &Source<'_>, span: Range<usize>, key: String, what: &str, instead: &str) -> SceneError {
    SceneError::NotYet { place: s.place(&span), key, what: what.into(), instead: instead.into() }
}
