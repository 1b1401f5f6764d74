//! Keys and tables without effect on the scene's model. They are rejected instead of ignored.

use std::ops::Range;

use toml::Spanned;

use super::check::{Rung, Torques};
use crate::schema::{RawGear, RawScene, StiffnessFrom};
use crate::source::Source;
use crate::{BodyScene, DriveBy, Model, Run, Scene, SceneError, SteadyBy};

type Checked<T> = Result<T, SceneError>;

fn span<T>(value: &Option<Spanned<T>>) -> Option<Range<usize>> {
    value.as_ref().map(Spanned::span)
}

/// Tables of models that are not the scene's.
pub(crate) fn check_tables(s: &Source<'_>, raw: &RawScene, model: Model) -> Checked<()> {
    let meshed = Rung::of(model).is_some_and(|r| r.mesh);
    let all = [
        ("mesh", span(&raw.mesh), meshed, "the models \"lumped8\", \"lumped12\" and \"shaft18\""),
        ("lumped8", span(&raw.lumped8), model == Model::Lumped8, "`model = \"lumped8\"`"),
        ("lumped12", span(&raw.lumped12), model == Model::Lumped12, "`model = \"lumped12\"`"),
        ("shaft18", span(&raw.shaft18), model == Model::Shaft18, "`model = \"shaft18\"`"),
        ("pinion.shaft", span(&raw.pinion.shaft), model == Model::Shaft18, "`model = \"shaft18\"`"),
        ("wheel.shaft", span(&raw.wheel.shaft), model == Model::Shaft18, "`model = \"shaft18\"`"),
        ("impact", span(&raw.impact), model == Model::Impact, "`model = \"impact\"`"),
    ];
    for (name, at, fits, whose) in all {
        if let (Some(at), false) = (at, fits) {
            let what = format!("[{name}] belongs to {whose}");
            return Err(s.conflict(&at, what, "leave it out, or say so in [analysis]"));
        }
    }
    turning(s, raw, model)
}

/// A model whose gears move along fixed coordinates: `free` may say the same, and no more.
pub(crate) fn check_free_coordinates(s: &Source<'_>, raw: &RawGear, rung: Rung, body: &BodyScene) -> Checked<()> {
    let listed = raw.body.as_ref().and_then(|b| b.get_ref().free.as_ref()).and_then(|free| free.first());
    match (listed, rung.moves) {
        (Some(word), Some(moves)) if body.free != moves => {
            let what = format!("`free` means nothing to the model \"{}\", whose coordinates are fixed", rung.name);
            Err(s.conflict(&word.span(), what, "leave it out"))
        }
        _ => Ok(()),
    }
}

/// Springs against the turn, which only lumped gears have.
fn turning(s: &Source<'_>, raw: &RawScene, model: Model) -> Checked<()> {
    let bearings = [&raw.pinion, &raw.wheel].into_iter().filter_map(|g| g.bearing.as_ref());
    for bearing in bearings.map(Spanned::get_ref) {
        let keys = [
            (
                "stiffness_rz_nmm_per_rad",
                span(&bearing.stiffness_rz_nmm_per_rad),
                matches!(model, Model::Lumped8 | Model::Lumped12),
                "the models \"lumped8\" and \"lumped12\"",
            ),
            (
                "damping_rz_nmms_per_rad",
                span(&bearing.damping_rz_nmms_per_rad),
                model == Model::Lumped8,
                "the model \"lumped8\"",
            ),
        ];
        for (key, at, fits, whose) in keys {
            if let (Some(at), false) = (at, fits) {
                return Err(s.conflict(&at, format!("`{key}` belongs to {whose}"), "leave it out"));
            }
        }
    }
    Ok(())
}

/// What an analysis in time with a cheaper model can do.
pub(crate) fn check_in_time(s: &Source<'_>, raw: &RawScene, scene: &Scene, rung: Rung) -> Checked<()> {
    let name = rung.name;
    let mapped = scene.analysis.model == Model::Mapped;
    let fed = mapped || scene.mesh.as_ref().is_some_and(|m| m.stiffness_from == StiffnessFrom::Reduced);
    if !fed {
        unfed(s, raw, scene, name)?;
    }
    motion(s, raw, scene, rung)?;
    torques(s, raw, scene, rung)?;
    friction(s, raw, scene, rung)?;
    if rung.moves.is_none() {
        return Ok(());
    }
    for gear in [&raw.pinion, &raw.wheel] {
        let Some(bearing) = gear.bearing.as_ref().map(Spanned::get_ref) else { continue };
        let matrices = [
            ("stiffness_matrix_n_mm_rad", span(&bearing.stiffness_matrix_n_mm_rad)),
            ("damping_matrix_ns_mm_rad", span(&bearing.damping_matrix_ns_mm_rad)),
        ];
        let damping = [
            ("damping_ratio", span(&bearing.damping_ratio)),
            ("damping_x_ns_per_mm", span(&bearing.damping_x_ns_per_mm)),
            ("damping_y_ns_per_mm", span(&bearing.damping_y_ns_per_mm)),
            ("damping_z_ns_per_mm", span(&bearing.damping_z_ns_per_mm)),
            ("damping_rx_nmms_per_rad", span(&bearing.damping_rx_nmms_per_rad)),
            ("damping_ry_nmms_per_rad", span(&bearing.damping_ry_nmms_per_rad)),
        ];
        let rayleigh = scene.analysis.model == Model::Lumped12;
        let refused = matrices.into_iter().chain(damping.into_iter().filter(|_| rayleigh));
        if let Some((key, at)) = refused.filter_map(|(key, at)| Some((key, at?))).next() {
            let what = format!("`{key}` means nothing to the model \"{name}\"");
            let advice = if rayleigh {
                "its damping is Rayleigh's, `damping_ratio` in [lumped12]; its supports act direction by direction"
            } else {
                "its supports act direction by direction: give `stiffness_x_n_per_mm` and so on"
            };
            return Err(s.conflict(&at, what, advice));
        }
    }
    Ok(())
}

/// Words on flanks and meshes, for a model that sees none.
fn unfed(s: &Source<'_>, raw: &RawScene, scene: &Scene, name: &str) -> Checked<()> {
    let gears = [&raw.pinion, &raw.wheel];
    let tables = gears.iter().map(|g| ("modification", span(&g.modification)));
    let lists = gears.iter().map(|g| ("pitch_errors_um", span(&g.pitch_errors_um)));
    let files = gears.iter().map(|g| ("pitch_errors_file", span(&g.pitch_errors_file)));
    let meshes = gears.iter().flat_map(|g| [("mesh", span(&g.mesh))]);
    let rest = [
        ("misalignment", span(&raw.pair.misalignment)),
        ("penalty_mpa_per_mm", span(&raw.contact.penalty_mpa_per_mm)),
        ("gap", span(&raw.contact.gap)),
        ("points_per_face_edge", span(&raw.contact.points_per_face_edge)),
        ("window_teeth", span(&raw.analysis.window_teeth)),
        ("slices", span(&raw.contact.slices).filter(|_| scene.contact.slices != Some(32) && scene.impact.is_none())),
        ("corner_contact", span(&raw.contact.corner_contact).filter(|_| scene.contact.corner_contact != Some(true))),
        ("flanks", span(&raw.contact.flanks).filter(|_| scene.contact.flanks != crate::Flanks::Both)),
        ("method", span(&raw.contact.method).filter(|_| scene.contact.method != crate::Method::Slice)),
    ];
    // Rigid gears have flanks as they are ground.
    let ground = tables.chain(lists).chain(files).filter(|_| scene.impact.is_none());
    let all = ground.chain(meshes).chain(rest);
    match all.filter_map(|(key, at)| Some((key, at?))).next() {
        None => Ok(()),
        Some((key, at)) => Err(s.conflict(
            &at,
            format!("`{key}` means nothing to the model \"{name}\" as the scene has it"),
            if scene.mesh.is_some() {
                "leave it out, or say `stiffness_from = \"reduced\"` in [mesh]"
            } else {
                "leave it out: rigid gears touch along nominal flanks"
            },
        )),
    }
}

/// Words of [motion] that the cheaper models have no use for.
fn motion(s: &Source<'_>, raw: &RawScene, scene: &Scene, rung: Rung) -> Checked<()> {
    let (Some(words), Some(raw)) = (&scene.motion, raw.motion.as_ref().map(Spanned::get_ref)) else { return Ok(()) };
    let refuse = |at: Range<usize>, key: &str, advice: &str| {
        Err(s.conflict(&at, format!("`{key}` means nothing to the model \"{}\"", rung.name), advice))
    };
    let mapped = scene.analysis.model == Model::Mapped;
    let ramps = words.run == Run::Ramp && (scene.impact.is_some() || mapped);
    let known = ramps || matches!(words.run, Run::Steady | Run::Span | Run::Sweep | Run::Continuation | Run::Basins);
    if let (Some(word), false) = (&raw.run, known) {
        return Err(SceneError::NotYet {
            place: s.place(&word.span()),
            key: format!("run = \"{}\"", word.get_ref()),
            what: format!("this analysis of the model \"{}\"", rung.name),
            instead: "use `run = \"steady\"`, \"span\" or \"sweep\"".into(),
        });
    }
    let by = raw.sweep.as_ref().and_then(|w| w.get_ref().steady_by.as_ref());
    let shoots = words.sweep.as_ref().is_some_and(|w| w.steady_by == SteadyBy::Shooting);
    if let (Some(by), true) = (by, shoots) {
        return refuse(by.span(), "steady_by", "leave it out: a cheap model gets there in a moment by waiting");
    }
    if let (Some(at), false) = (span(&raw.mesh_damping_ratio), rung.mesh_damping) {
        let advice = match scene.analysis.model {
            Model::Impact => "give `damping_ns_per_mm` in [impact]",
            _ => "give `damping_ratio` in [lumped12]",
        };
        return refuse(at, "mesh_damping_ratio", advice);
    }
    if let Some(at) = span(&raw.mesh_damping_ns_per_mm2).filter(|_| !mapped) {
        return refuse(at, "mesh_damping_ns_per_mm2", "give `mesh_damping_ratio`");
    }
    if let (Some(at), true) = (span(&raw.checkpoint_every_cycles), words.checkpoint_every_cycles != Some(0)) {
        return refuse(at, "checkpoint_every_cycles", "leave it out: a cheap model is run again in a moment");
    }
    let lines = raw.ramp.as_ref().and_then(|r| span(&r.get_ref().waterfall_cycles));
    if let (Some(at), true) = (lines, words.ramp.is_some_and(|r| r.waterfall_cycles != 16)) {
        return refuse(at, "waterfall_cycles", "leave it out: of a ramp of this model the last speed has a spectrum");
    }
    if let (Some(at), true) =
        (span(&raw.steps_per_resonance), scene.impact.is_some() && words.steps_per_resonance != 16)
    {
        return refuse(at, "steps_per_resonance", "give `steps_per_mesh_cycle`: its mesh has no one stiffness");
    }
    Ok(())
}

/// Torques that a model cannot follow.
fn torques(s: &Source<'_>, raw: &RawScene, scene: &Scene, rung: Rung) -> Checked<()> {
    let (drive, load) = (raw.drive.as_ref().map(Spanned::get_ref), raw.load.as_ref().map(Spanned::get_ref));
    let tables = [drive.and_then(|d| span(&d.table_s_nm)), load.and_then(|l| span(&l.table_s_nm))];
    let harmonic = [drive.and_then(|d| span(&d.amplitude_nm)), load.and_then(|l| span(&l.amplitude_nm))];
    let by_torque = raw.drive.as_ref().map(Spanned::span);
    let by_torque = by_torque.filter(|_| scene.drive.as_ref().is_some_and(|d| d.by == DriveBy::Torque));
    let refused = match rung.torques {
        Torques::Any => None,
        Torques::Series => tables.into_iter().flatten().next().map(|at| ("`table_s_nm`", at)),
        Torques::Steady => {
            let of = |key, list: [Option<Range<usize>>; 2]| list.into_iter().flatten().next().map(|at| (key, at));
            let by = by_torque.map(|at| ("[drive] `by = \"torque\"`", at));
            of("`table_s_nm`", tables).or(of("`amplitude_nm`", harmonic)).or(by)
        }
    };
    match refused {
        None => Ok(()),
        Some((key, at)) => {
            let what = format!("{key} means nothing to the model \"{}\"", rung.name);
            let advice = match rung.torques {
                Torques::Steady => "its torques are steady and balance each other: leave it out",
                _ => "give `amplitude_nm` and `frequency_hz`, or use the model \"reduced\"",
            };
            Err(s.conflict(&at, what, advice))
        }
    }
}

/// Friction where there is none, or of another kind.
fn friction(s: &Source<'_>, raw: &RawScene, scene: &Scene, rung: Rung) -> Checked<()> {
    match &raw.contact.friction {
        Some(friction) if !rung.lines && scene.analysis.model != Model::Mapped && scene.contact.friction != 0.0 => {
            let what = format!("`friction` means nothing to the model \"{}\"", rung.name);
            let advice = match scene.analysis.model {
                Model::Impact => "give `static_friction` and `dynamic_friction` in [impact]",
                _ => "leave it out: this model has none",
            };
            Err(s.conflict(&friction.span(), what, advice))
        }
        _ => Ok(()),
    }
}
