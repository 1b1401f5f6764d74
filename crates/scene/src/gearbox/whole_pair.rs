//! A complete pair with everything besides its mesh, as far as a gearbox file can describe it.

use std::fmt::Write;

use super::of_pair::{Beside, LIGHT, NO_MASS, moving, two_shafts};
use crate::{
    Axis, BearingScene, Driver, GearScene, Model, MotionScene, RampScene, Run, Scene, SceneError, TorqueScene,
};

/// A gearbox file of a pair, and the parts of the scene that are not in it.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxOfPair {
    /// Text of the file.
    pub text: String,
    /// Parts of the scene that are not in the file, one text each.
    pub left: Vec<String>,
}

/// The gearbox file with the pair of a scene as its only mesh, on two shafts: held ones, or in the bearings of the
/// scene. In statics held shafts agree with the pair to 1e-9, position by position.
///
/// It includes friction, bodies, bearings of gears that are free in all five directions, and the motion of reduced and
/// mapped pairs. The steps between two rows are those of an approximate mesh resonance.
///
/// # Errors
/// [`SceneError`] for impossible gears, as in [`Scene::gear_pair`].
pub fn gearbox_of_pair(scene: &Scene) -> Result<GearboxOfPair, SceneError> {
    let scene = scene.standing_alone();
    let mut left = Vec::new();
    let names = ["pinion", "wheel"];
    let bearings = [0, 1].map(|g| bearing(scene.gears()[g], names[g], &mut left));
    let (motion, of_load) = match &scene.motion {
        Some(motion) => in_motion(&scene, motion, &mut left),
        None => (None, String::new()),
    };
    if !matches!(scene.analysis.model, Model::Reduced | Model::ReducedModes | Model::Mapped | Model::Auto) {
        left.push("the model: meshes of a gearbox are solved by slices".to_owned());
    }
    if !scene.accuracy.is_none() {
        left.push("[accuracy]: that of a gearbox has other quantities".to_owned());
    }
    let output = &scene.output;
    if output.root_stress || output.contact_lines || output.flank_orders || output.vtu || !output.derivatives.is_empty()
    {
        left.push(
            "[output]: root stress, contact lines, orders of flanks, ParaView files and derivatives are the pair's alone"
                .to_owned(),
        );
    }
    let mut said = vec!["Gearbox of one pair: at rest on held shafts it computes what the pair alone does.".to_owned()];
    if motion.is_some() {
        said.push("Steps between two rows: by a mesh resonance of solid gears with 20 N/(mm um).".to_owned());
    }
    let by_ratio = motion.as_ref().is_some_and(|text| text.contains("mesh_damping_ratio"));
    if by_ratio && bearings.iter().any(Option::is_some) {
        said.push(
            "`mesh_damping_ratio` is of the mesh stiffness of gears that have tilted in their bearings, in the pair of gears \
             that have not."
                .to_owned(),
        );
    }
    said.extend(left.iter().map(|own| format!("Left out: {own}.")));
    said.push(
        "To let a shaft deflect, take `held = true` out of it, state its sections, and add its bearings:".to_owned(),
    );
    said.extend(["[[bearing]]", "shaft = \"pinion\"", "position_mm = 5.0"].map(str::to_owned));
    said.push("stiffness_n_per_mm = [2.0e5, 2.0e5, 8.0e4]".to_owned());
    let of_shafts = match motion {
        Some(_) if bearings.iter().any(Option::is_some) => LIGHT,
        Some(_) => NO_MASS,
        None => "",
    };
    let text = two_shafts(&scene, &Beside { said, of_shafts, bearings, of_load })?;
    Ok(GearboxOfPair { text: text + motion.as_deref().unwrap_or_default(), left })
}

/// Keys of the bearing of a gear that is free as a shaft is; `None` where its shaft is held.
fn bearing(gear: &GearScene, name: &str, left: &mut Vec<String>) -> Option<String> {
    let free = gear.body.as_ref().map_or(&[][..], |body| &body.free);
    let own = &gear.bearing;
    if free != Axis::ALL {
        if !free.is_empty() {
            left.push(format!("[{name}.bearing]: a shaft that is not held is free in all five directions"));
        }
        return None;
    }
    let keys = stiffness(own)?;
    let BearingScene { damping_ratio, damping_matrix_ns_mm_rad, .. } = own;
    let [x, y, z, rx, ry] = own.dampings();
    if damping_matrix_ns_mm_rad.is_some() || rx.or(ry).is_some_and(|c| c != 0.0) {
        left.push(format!("damping of the tilts in [{name}.bearing]: that of a gearbox acts along x, y and z"));
    }
    let by_ratio = damping_matrix_ns_mm_rad.is_none() && own.dampings().iter().any(Option::is_none);
    if let Some(ratio) = damping_ratio.filter(|ratio| *ratio > 0.0 && by_ratio) {
        left.push(format!("`damping_ratio = {ratio:?}` in [{name}.bearing]: [motion] has `modal_damping_ratio`"));
    }
    let along = [x, y, z].map(|c| c.unwrap_or(0.0));
    let damping = if along == [0.0; 3] { String::new() } else { format!("damping_n_s_per_mm = {along:?}\n") };
    Some(keys + &damping)
}

/// Stiffness of a bearing whose directions are all held.
fn stiffness(own: &BearingScene) -> Option<String> {
    if let Some(matrix) = &own.stiffness_matrix_n_mm_rad {
        return Some(format!("matrix_n_mm_rad = {matrix:?}\n"));
    }
    let [x, y, z, rx, ry] = own.stiffnesses();
    let (along, tilts) = ([x?, y?, z?], [1e-3 * rx?, 1e-3 * ry?]);
    Some(format!("stiffness_n_per_mm = {along:?}\ntilt_stiffness_nm_per_rad = {tilts:?}\n"))
}

/// `[motion]` of the gearbox, and keys of its load; none of motions that a gearbox does not have.
fn in_motion(scene: &Scene, motion: &MotionScene, left: &mut Vec<String>) -> (Option<String>, String) {
    let mut plain = scene.clone();
    plain.load = None;
    for gear in [&mut plain.pinion, &mut plain.wheel] {
        if let Some(body) = &mut gear.body {
            body.free.clear();
        }
    }
    if let Some(drive) = &mut plain.drive
        && !drive.torque.is_none()
    {
        left.push("the torque in [drive]: `drive = \"torque\"` in [motion] has one".to_owned());
        drive.torque = TorqueScene::default();
    }
    let (mut asked, mut drive) = (motion.clone(), "\ndrive = ".to_owned());
    if let Some(ramp) = motion.ramp {
        drive = over_time(&mut plain, ramp, left) + &drive;
        (asked.run, asked.duration_s) = (Run::Span, Some(ramp.duration_s));
    }
    let steps = steps_per_row(&plain, &asked);
    let Some(text) = moving(&plain, &asked, steps).map(|text| text.replacen("\ndrive = ", &drive, 1)) else {
        left.push(match motion.run {
            Run::Continuation => "[motion]: a continuation of a gearbox has `to_speed_rpm`".to_owned(),
            _ => "[motion]: its model, run or length exists for pairs only; write [motion] of the gearbox anew"
                .to_owned(),
        });
        return (None, String::new());
    };
    let Some(load) = scene.load.as_ref().filter(|load| !load.is_none()) else { return (Some(text), String::new()) };
    if motion.run != Run::Span {
        left.push("[load]: a torque over time acts in a motion of `run = \"span\"`".to_owned());
        return (Some(text), String::new());
    }
    let mut keys = String::new();
    let numbers =
        [("amplitude_nm", load.amplitude_nm), ("frequency_hz", load.frequency_hz), ("phase_deg", load.phase_deg)];
    for (key, value) in numbers.into_iter().filter_map(|(key, value)| Some((key, value?))) {
        // Writing into a text does not fail.
        let _ = writeln!(keys, "{key} = {value:?}");
    }
    if let Some(rows) = &load.table_s_nm {
        let _ = writeln!(keys, "table_s_nm = {rows:?}");
    }
    (Some(text), keys)
}

/// The line of a ramp's last speed, with its first one put into the scene.
fn over_time(plain: &mut Scene, ramp: RampScene, left: &mut Vec<String>) -> String {
    let RampScene { from_rpm, to_rpm, before_s, after_s, .. } = ramp;
    plain.operation.speed_rpm = from_rpm;
    if before_s > 0.0 || after_s > 0.0 {
        left.push(
            "`before_s` and `after_s` in [motion.ramp]: the speed of a gearbox changes from its start to its end"
                .to_owned(),
        );
    }
    format!("\nto_speed_rpm = {to_rpm:?}")
}

/// Stiffness of a mesh, N/mm a mm of face width: 20 N/(mm um), about that of ISO 6336-1.
const ROUGH_STIFFNESS: f64 = 2e4;
/// Density of steel, t/mm^3.
const STEEL: f64 = 7.85e-9;
/// Steps between two rows at the most.
const MOST_STEPS: f64 = 1000.0;

/// Steps between two rows that give the mesh resonance as many as the scene asks for: of solid gears.
///
/// ```text
/// f = sqrt(k/m_e) / 2 pi,   m = rho pi r^2 b / 2 on the reference circle, of the driven gear or of both in series
/// ```
fn steps_per_row(scene: &Scene, motion: &MotionScene) -> u32 {
    if motion.error_tolerance.is_some() || motion.steps_per_resonance == 0 {
        return 1;
    }
    let widths = scene.face_widths_mm();
    let mass = |g: usize| {
        let gear = scene.gears()[g];
        let radius =
            0.5 * scene.pair.normal_module_mm * f64::from(gear.teeth) / gear.helix_angle_deg.to_radians().cos();
        let disc = 0.5 * STEEL * std::f64::consts::PI * radius.powi(2) * widths[g];
        disc + gear.body.as_ref().map_or(0.0, |body| body.added_inertia()) / radius.powi(2)
    };
    let driven = usize::from(scene.operation.driver == Driver::Pinion);
    let by_torque = scene.drive.as_ref().is_some_and(|drive| drive.by == crate::DriveBy::Torque);
    let mass = if by_torque { (mass(0).recip() + mass(1).recip()).recip() } else { mass(driven) };
    let resonance_hz = (ROUGH_STIFFNESS * scene.common_face_width_mm() / mass).sqrt() / std::f64::consts::TAU;
    let speed_rpm = motion.ramp.map_or(scene.operation.speed_rpm, |ramp| 0.5 * (ramp.from_rpm + ramp.to_rpm));
    let row_hz = f64::from(scene.driver_teeth()) * speed_rpm / 60.0 * f64::from(motion.steps_per_mesh_cycle);
    let steps = (f64::from(motion.steps_per_resonance) * resonance_hz / row_hz).ceil();
    // What is no number is one step.
    if steps.is_finite() { steps.clamp(1.0, MOST_STEPS) as u32 } else { 1 }
}
