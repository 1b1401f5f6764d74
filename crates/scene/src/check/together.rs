//! Checks of combinations of keys.

use toml::Spanned;

use super::{Checked, accuracy_in_time};
use crate::{
    Coupling, DriveBy, Kind, Method, Model, Quantity, Run, Scene, SceneError, models, motion::begins_unloaded,
    schema::RawScene, source::Source,
};

/// What can only be judged with the whole scene in view.
pub(super) fn together(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    if scene.analysis.model == Model::Iso {
        nominal_flanks(s, raw)?;
    }
    if scene.wheel.is_internal() {
        internal(s, raw, scene)?;
    }
    if scene.analysis.kind == Kind::Dynamic {
        in_time(s, raw, scene)?;
    }
    if !scene.accuracy.is_none() {
        accuracy(s, raw, scene)?;
    }
    window(s, raw, scene)?;
    bore(s, raw, scene)?;
    of_method(s, raw, scene)?;
    of_model(s, raw, scene)
}

/// What goes together with `[accuracy]`.
fn accuracy(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let table = raw.accuracy.as_ref().map_or(0..0, Spanned::span);
    accuracy_in_time::quantities(s, &table, scene)?;
    if scene.analysis.kind == Kind::Dynamic {
        accuracy_in_time::motion(s, raw, scene)?;
    }
    let of_root = [Quantity::PinionRootStress, Quantity::WheelRootStress].into_iter();
    if let Some(asked) = of_root.filter(|q| scene.accuracy.of(*q).is_some()).find(|_| !scene.output.root_stress) {
        return Err(s.conflict(
            &table,
            format!("`{}` is asked for, but root stress is not computed", asked.key()),
            "say `root_stress = true` in [output]",
        ));
    }
    if !scene.is_auto() {
        return Ok(());
    }
    if scene.contact.method == Method::Nodal {
        let span = raw.contact.method.as_ref().map_or(table, Spanned::span);
        return Err(s.conflict(
            &span,
            "`model = \"auto\"` chooses slices, and `method` is \"nodal\"",
            "leave `method` out, or say `model = \"reduced\"`",
        ));
    }
    for (whose, gear) in [("pinion", &raw.pinion), ("wheel", &raw.wheel)] {
        let Some(mesher) = gear.mesher.as_ref().map(Spanned::get_ref) else { continue };
        let counts = [
            ("order", &mesher.order),
            ("elements_profile", &mesher.elements_profile),
            ("elements_fillet", &mesher.elements_fillet),
            ("elements_thickness", &mesher.elements_thickness),
            ("elements_face", &mesher.elements_face),
            ("elements_rim", &mesher.elements_rim),
        ];
        if let Some((key, word)) = counts.into_iter().find_map(|(key, value)| Some((key, value.as_ref()?))) {
            return Err(s.conflict(
                &word.span(),
                format!("`{key}` in [{whose}.mesher], but `model = \"auto\"` chooses the mesh"),
                format!("leave `{key}` out, or say `model = \"reduced\"`: its error is estimated all the same"),
            ));
        }
    }
    Ok(())
}

/// What internal pairs have: what a mesh answers, at rest and in motion; bounds at rest alone.
fn internal(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let teeth = raw.wheel.teeth.as_ref().map_or(0..0, Spanned::span);
    let span = |word: Option<std::ops::Range<usize>>| word.unwrap_or(teeth.clone());
    let refused = |span: std::ops::Range<usize>, what: String, advice: &str| Err(s.conflict(&span, what, advice));
    let (model, in_time) = (scene.analysis.model, scene.analysis.kind == Kind::Dynamic);
    let meshed = matches!(model, Model::Reduced | Model::ReducedModes | Model::Mapped | Model::Full | Model::Iso);
    if if scene.is_auto() { in_time } else { !meshed } {
        let when = if in_time { " in motion" } else { "" };
        let what = format!("the model \"{}\" does not know internal gears{when}", model.word());
        return refused(span(raw.analysis.model.as_ref().map(Spanned::span)), what, "use `model = \"reduced\"`");
    }
    if !scene.accuracy.is_none() && in_time {
        let what = "the bounds of [accuracy] in motion are those of external pairs".to_owned();
        return refused(span(raw.accuracy.as_ref().map(Spanned::span)), what, "leave [accuracy] out");
    }
    Ok(())
}

/// A window has no more teeth than the gears.
fn window(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    if let (Some(window), Some(word)) = (scene.analysis.window_teeth, &raw.analysis.window_teeth) {
        let teeth = scene.pinion.teeth.min(scene.wheel.teeth);
        if window > teeth {
            return Err(s.conflict(
                &word.span(),
                format!("`window_teeth` is {window}, but the smaller gear has {teeth} teeth"),
                "leave it out: the window follows from the contact ratio",
            ));
        }
    }
    Ok(())
}

/// What knows how a bore is held.
fn bore(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let model = scene.analysis.model;
    for (gear, table) in scene.gears().into_iter().zip([&raw.pinion.bore, &raw.wheel.bore]) {
        let Some(table) = table else { continue };
        let refused = |what: String, advice: &str| Err(s.conflict(&table.span(), what, advice));
        if !scene.accuracy.is_none() {
            let what = "`bore` says how a bore is held, and the bounds of [accuracy] are those of rigid bores";
            return refused(what.into(), "leave [accuracy] out, or this table");
        }
        if !model.has_reduced_gears() && model != Model::Full {
            let what = format!("`bore` means nothing to the model \"{}\", which has no mesh", model.word());
            return refused(what, "leave it out, or use `model = \"reduced\"`");
        }
        if model == Model::Full && gear.bore.coupling == Coupling::Distributing {
            let what =
                "the model \"full\" does not know bores that are held by their means (coupling \"distributing\")";
            return refused(what.into(), "use `model = \"reduced\"`, or the coupling \"kinematic\"");
        }
    }
    Ok(())
}

/// What belongs to one method of contact.
fn of_method(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let nodal_only = [
        ("penalty_mpa_per_mm", raw.contact.penalty_mpa_per_mm.as_ref().map(Spanned::span)),
        ("gap", raw.contact.gap.as_ref().map(Spanned::span)),
        ("points_per_face_edge", raw.contact.points_per_face_edge.as_ref().map(Spanned::span)),
    ];
    let nodal_key = nodal_only.into_iter().find_map(|(key, span)| Some((key, span?)));
    if let (Method::Slice, Some((key, span))) = (scene.contact.method, nodal_key) {
        return Err(s.conflict(
            &span,
            format!("`{key}` means nothing to slices"),
            "leave it out, or use `method = \"nodal\"`",
        ));
    }
    if let (Method::Nodal, Some(slices)) = (scene.contact.method, &raw.contact.slices) {
        return Err(s.conflict(
            &slices.span(),
            "`slices` means nothing to the method \"nodal\"",
            "leave it out, or use `method = \"slice\"`",
        ));
    }
    if let Some(word) = raw.output.contact_lines.as_ref().filter(|w| *w.get_ref() && !scene.has_slices()) {
        return Err(s.conflict(
            &word.span(),
            "`contact_lines` lists slices, and this scene has none",
            "leave it out, or use the method \"slice\" and the model \"reduced\" or \"full\"",
        ));
    }
    if let (Method::Nodal, Some(corner)) = (scene.contact.method, &raw.contact.corner_contact) {
        return Err(s.conflict(
            &corner.span(),
            "`corner_contact` means nothing to the method \"nodal\", whose points press wherever the flanks touch",
            "leave it out, or use `method = \"slice\"`",
        ));
    }
    Ok(())
}

/// What belongs to some models.
fn of_model(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    if let (Some(friction), Model::Full | Model::Iso) = (&raw.contact.friction, scene.analysis.model)
        && scene.contact.friction != 0.0
    {
        return Err(s.conflict(
            &friction.span(),
            "only the model \"reduced\" has friction",
            "leave it out, or use `model = \"reduced\"`",
        ));
    }
    if let (Some(asked), true, Model::Iso) = (&raw.output.root_stress, scene.output.root_stress, scene.analysis.model) {
        return Err(s.conflict(
            &asked.span(),
            "`root_stress` needs a mesh, and the model \"iso\" has none",
            "leave it out, or use `model = \"reduced\"`",
        ));
    }
    if let (Some(offset), Model::Lumped12) = (&raw.pair.mid_face_offset_mm, scene.analysis.model)
        && scene.pair.mid_face_offset_mm != Some(0.0)
    {
        return Err(s.conflict(
            &offset.span(),
            "the model \"lumped12\" has both mid-faces at one height: its force pair is about them",
            "leave `mid_face_offset_mm` out, or use \"shaft18\", \"impact\" or \"reduced\", which have it",
        ));
    }
    if let (Some(penalty), Model::Iso) = (&raw.contact.penalty_mpa_per_mm, scene.analysis.model) {
        return Err(s.conflict(
            &penalty.span(),
            "`penalty_mpa_per_mm` means nothing to the model \"iso\", which has no contact points",
            "leave it out, or use `model = \"reduced\"`",
        ));
    }
    Ok(())
}

/// An analysis in time.
fn in_time(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let rung = models::Rung::of(scene.analysis.model);
    possible(s, raw, scene, rung.is_some())?;
    if let Some(rung) = rung {
        models::check_in_time(s, raw, scene, rung)?;
    }
    let linear = rung.is_some_and(|r| r.mesh && !r.backlash);
    if let (Some(torque), true, false) = (&raw.operation.torque_nm, scene.operation.torque_nm == 0.0, linear) {
        return Err(s.conflict(
            &torque.span(),
            "`torque_nm` is 0: a motion begins under load, and its scales are taken from it",
            "give the torque that the motion begins with; `table_s_nm` in [load] may take it away later",
        ));
    }
    let with_flanks = scene.analysis.model.is_reduced() || scene.analysis.model == Model::Mapped;
    if let (true, Some(load), Some(law)) = (with_flanks, raw.load.as_ref(), &scene.load)
        && law.at_start(scene.operation.torque_nm) == 0.0
    {
        let load = load.get_ref();
        let table = load.table_s_nm.as_ref().map(|rows| (rows.span(), "table_s_nm"));
        let amplitude = load.amplitude_nm.as_ref().map(|number| (number.span(), "amplitude_nm"));
        if let Some((span, key)) = table.or(amplitude) {
            return Err(begins_unloaded(s, &span, key));
        }
    }
    of_run(s, raw, scene)
}

/// What this version can do in time.
fn possible(s: &Source<'_>, raw: &RawScene, scene: &Scene, on_ladder: bool) -> Checked<()> {
    let with_flanks = scene.analysis.model.is_reduced() || scene.is_auto();
    if let (Some(word), false, false) = (&raw.analysis.model, with_flanks, on_ladder) {
        return Err(not_yet(s, "model", word, "another model in time", "use `model = \"reduced\"`"));
    }
    if let (Some(word), Method::Nodal) = (&raw.contact.method, scene.contact.method) {
        return Err(not_yet(s, "method", word, "pressed points in time", "use `method = \"slice\"`"));
    }
    // Of quasi-static elasticity the forces on the flanks tell all; normal modes bend teeth besides.
    let stress = scene.output.root_stress && scene.analysis.model != Model::Reduced;
    let fields = [
        ("root_stress", stress, raw.output.root_stress.as_ref().map(Spanned::span)),
        ("contact_lines", scene.output.contact_lines, raw.output.contact_lines.as_ref().map(Spanned::span)),
        ("vtu", scene.output.vtu && !scene.can_write_fields(), raw.output.vtu.as_ref().map(Spanned::span)),
    ];
    if let Some((key, _, Some(span))) = fields.into_iter().find(|(_, asked, _)| *asked) {
        return Err(SceneError::NotYet {
            place: s.place(&span),
            key: format!("{key} = true"),
            what: "fields and stresses of an analysis in time".into(),
            instead: "leave it out, or use `kind = \"static\"` for them".into(),
        });
    }
    Ok(())
}

/// What the run asked for can have.
fn of_run(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    super::continuation::check(s, raw, scene)?;
    of_drive(s, raw, scene)
}

/// Shooting, ramps and sweeps say the speed: a torque that balances the load holds it, one of its own does not.
fn of_drive(s: &Source<'_>, raw: &RawScene, scene: &Scene) -> Checked<()> {
    let sweeps = scene.motion.as_ref().filter(|m| m.run != Run::Steady && m.run != Run::Span);
    let (Some(_), Some(drive), Some(table)) = (sweeps, &scene.drive, &raw.drive) else { return Ok(()) };
    // Lumped gears turn freely against each other, and their torques balance; rigid ones would lose speed to friction.
    let own =
        if scene.impact.is_some() { true } else { scene.analysis.model.has_reduced_gears() && !drive.torque.is_none() };
    if drive.by == DriveBy::Torque && own {
        let balances = if scene.impact.is_some() { "" } else { ", or leave the torque out: it then balances the load" };
        return Err(s.conflict(
            &table.span(),
            "shooting, ramps, sweeps, continuations and basins give the speed of the driver, and here a torque drives it",
            format!("use `run = \"span\"` or \"steady\", or drive `by = \"speed\"`{balances}"),
        ));
    }
    Ok(())
}

/// The model "iso" knows nominal flanks on parallel axes only.
fn nominal_flanks(s: &Source<'_>, raw: &RawScene) -> Checked<()> {
    let tables = [("modification", &raw.pinion.modification), ("modification", &raw.wheel.modification)];
    let tables = tables.into_iter().filter_map(|(key, table)| table.as_ref().map(|t| (key, t.span())));
    let misaligned = raw.pair.misalignment.iter().map(|t| ("misalignment", t.span()));
    let lists = [&raw.pinion, &raw.wheel].into_iter().filter_map(|g| g.pitch_errors_um.as_ref());
    let files = [&raw.pinion, &raw.wheel].into_iter().filter_map(|g| g.pitch_errors_file.as_ref());
    let lists = lists.map(|l| ("pitch_errors_um", l.span()));
    let files = files.map(|f| ("pitch_errors_file", f.span()));
    match tables.chain(misaligned).chain(lists).chain(files).next() {
        None => Ok(()),
        Some((key, span)) => Err(s.conflict(
            &span,
            format!("`{key}` means nothing to the model \"iso\", which takes nominal flanks on parallel axes"),
            "leave it out, or use `model = \"reduced\"`",
        )),
    }
}

fn not_yet(s: &Source<'_>, key: &str, word: &Spanned<String>, what: &str, instead: &str) -> SceneError {
    SceneError::NotYet {
        place: s.place(&word.span()),
        key: format!("{key} = \"{}\"", word.get_ref()),
        what: what.into(),
        instead: instead.into(),
    }
}
