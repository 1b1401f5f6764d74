//! Checks raw values and makes a scene: ranges, defaults, combinations, features that this version does not have.

mod accuracy_in_time;
mod bore;
mod continuation;
mod derivatives;
mod gear;
mod motion;
mod pitch_errors;
mod rating;
mod tables;
mod together;

use super::{
    Analysis, Kind, Material, Run, Scene, SceneError, Setting, models, schema::RawScene, source::Source, spanned::Over,
};
use gear::{Hand, gear, pair};
use motion::{bodies, drive, in_time, load, normal_modes, refuse_motion_tables, shaft};
use tables::{accuracy, analysis, contact, of_turn, operation, output};
use together::together;

type Checked<T> = Result<T, SceneError>;

/// Every complaint is made here, before any work starts or any file is written.
pub(super) fn scene(source: &Source<'_>, mut raw: RawScene) -> Checked<Scene> {
    all_given(source, &raw)?;
    Material::read(source, &raw.material, f64::INFINITY)?;
    for gear in [&mut raw.pinion, &mut raw.wheel] {
        gear.material = gear.material.over(&raw.material);
    }
    let pair = pair(source, &raw.pair, [&raw.pinion, &raw.wheel])?;
    let root_stress = raw.output.root_stress.as_ref().is_some_and(|on| *on.get_ref());
    let face_elements = |width, order| pair.face_elements(width, order, root_stress);
    let mut pinion = gear(source, &raw.pinion, Hand::Own, &pair, face_elements)?;
    let hand = Hand::Against(pinion.helix_angle_deg);
    let mut wheel = gear(source, &raw.wheel, hand, &pair, face_elements)?;
    let accuracy = accuracy(source, &raw)?;
    let analysis = analysis(source, &raw.analysis, !accuracy.is_none())?;
    let analysis = of_turn(source, &raw.analysis, analysis, [pinion.teeth, wheel.teeth])?;
    models::check_tables(source, &raw, analysis.model)?;
    let dynamic = analysis.kind == Kind::Dynamic;
    if dynamic {
        bodies(source, &raw, analysis.model, [&mut pinion, &mut wheel])?;
    } else {
        refuse_motion_tables(source, &raw)?;
    }
    let modes = normal_modes(source, &raw, analysis.model)?;
    let in_time = dynamic.then(|| in_time(source, &raw, analysis.model)).transpose()?;
    let models::ModelTables { mesh, lumped8, lumped12, shaft18, impact } =
        models::model_tables(source, &raw, analysis.model)?;
    if let Some(word) = raw.analysis.model.as_ref().filter(|_| shaft18.is_some()) {
        pinion.shaft = Some(shaft(source, &raw.pinion, "pinion", word)?);
        wheel.shaft = Some(shaft(source, &raw.wheel, "wheel", word)?);
    }
    let in_seconds = in_time.as_ref().is_some_and(|m| m.run == Run::Ramp || m.duration_s.is_some());
    let cycles = if in_seconds { 0 } else { analysis.cycles };
    let scene = Scene {
        name: source.title(&raw.name)?,
        file: source.file.to_owned(),
        written: source.written(),
        set: source.settings.iter().map(Setting::word).collect(),
        operation: operation(source, &raw.operation)?,
        contact: contact(source, &raw.contact, analysis.kind)?,
        drive: dynamic.then(|| drive(source, &raw, analysis.model)).transpose()?,
        load: dynamic.then(|| load(source, &raw)).transpose()?,
        analysis: Analysis { cycles, ..analysis },
        accuracy,
        modes,
        motion: in_time,
        mesh,
        lumped8,
        lumped12,
        impact,
        shaft18,
        rating: rating::rating(source, &raw)?,
        output: output(source, &raw.output)?,
        pinion,
        wheel,
        pair,
    };
    together(source, &raw, &scene)?;
    rating::together(source, &raw, &scene)?;
    derivatives::check(source, &raw, &scene)?;
    Ok(scene)
}

fn all_given(source: &Source<'_>, raw: &RawScene) -> Checked<()> {
    let own_widths = raw.pinion.face_width_mm.is_some() && raw.wheel.face_width_mm.is_some();
    let needed = [
        ("`[pinion] teeth`", raw.pinion.teeth.is_none()),
        ("`[pinion] helix_angle_deg`", raw.pinion.helix_angle_deg.is_none()),
        ("`[wheel] teeth`", raw.wheel.teeth.is_none()),
        ("`[pair] normal_module_mm`", raw.pair.normal_module_mm.is_none()),
        ("`[pair] face_width_mm`", raw.pair.face_width_mm.is_none() && !own_widths),
        ("`[operation] torque_nm`", raw.operation.torque_nm.is_none()),
    ];
    let keys: Vec<String> = needed.into_iter().filter(|(_, gone)| *gone).map(|(key, _)| key.to_owned()).collect();
    if keys.is_empty() { Ok(()) } else { Err(SceneError::Missing { file: source.file.to_owned(), keys }) }
}
