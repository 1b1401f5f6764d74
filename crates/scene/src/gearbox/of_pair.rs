//! The gearbox that is equivalent to a pair: two held shafts.

use std::fmt::Write;

use crate::{
    BodyScene, DriveBy, DriveScene, Driver, Model, ModesScene, MotionScene, Run, Scene, SceneError, Sense, TorqueScene,
    schema::{Integration, LEAST_SLICES},
};

/// Tables of a scene that say what the pair is and how its flanks press; the others say what is done with it.
const OF_PAIR: [&str; 6] = ["pinion", "wheel", "pair", "operation", "contact", "rating"];
/// Tables of a gear that hold it, which the shafts do here.
const HOLDS: [&str; 3] = ["bearing", "body", "shaft"];
/// Density of shafts in motion, kg/m^3: a pair has no inertia but that of its gears.
pub(super) const NO_MASS: &str = "density_kg_m3 = 1e-9\n";
/// The same of shafts that are not held: so light a shaft has frequencies beside which those of gears in their bearings are not
/// lost in round-off, and 1e-7 of the mass of a steel one.
pub(super) const LIGHT: &str = "density_kg_m3 = 1e-3\n";
/// Settings of the maps of a pair in motion: largest force over the mean, and error.
const MAPS: &str = "map_overload = 6.0\nmap_tolerance = 3e-5\n";

/// What a gearbox of one pair has beside its mesh.
#[derive(Debug, Default)]
pub(super) struct Beside<'a> {
    /// Lines of its beginning, each a comment.
    pub said: Vec<String>,
    /// Keys of both shafts.
    pub of_shafts: &'a str,
    /// Bearings in place of a held shaft, at the gear.
    pub bearings: [Option<String>; 2],
    /// Keys of the load.
    pub of_load: String,
}

/// Text of the gearbox file with the pair of a moving scene as its only mesh, on two held shafts, with its `[motion]`.
/// Each row has `steps_per_row` steps; a pair derives this number from its mesh resonance. `None` if a gearbox of held
/// shafts does not support the scene: gears on bearings, lumped gears, a torque over time, a ramp, many speeds, a span
/// in seconds.
///
/// # Errors
/// [`SceneError`] for impossible gears, as in [`Scene::gear_pair`].
pub fn gearbox_of_moving_pair(scene: &Scene, steps_per_row: u32) -> Result<Option<String>, SceneError> {
    let Some(motion) = scene.motion.as_ref().and_then(|motion| moving(scene, motion, steps_per_row)) else {
        return Ok(None);
    };
    let beside = Beside { of_shafts: NO_MASS, ..Beside::default() };
    Ok(Some(two_shafts(&scene.standing_alone(), &beside)? + &motion))
}

/// `[motion]` of the gearbox of a pair.
pub(super) fn moving(scene: &Scene, motion: &MotionScene, steps_per_row: u32) -> Option<String> {
    let mesh = match scene.analysis.model {
        Model::Reduced | Model::ReducedModes => "exact",
        Model::Mapped => "mapped",
        _ => return None,
    };
    let run = match motion.run {
        // A map that nearly repeats itself is taken to its periodic state.
        Run::Steady if scene.analysis.model == Model::Mapped => "shooting",
        Run::Steady => "steady",
        Run::Shooting => "shooting",
        Run::Span => "span",
        _ => return None,
    };
    let drive = match &scene.drive {
        Some(DriveScene { by: DriveBy::Torque, torque }) if torque.is_none() => "balanced",
        Some(DriveScene { by: DriveBy::Torque, .. }) => return None,
        _ => "speed",
    };
    let is_held = |gear: &crate::GearScene| gear.body.as_ref().is_none_or(|body| body.free.is_empty());
    let steady = scene.load.as_ref().is_none_or(TorqueScene::is_none);
    if !(scene.gears().into_iter().all(is_held) && steady) {
        return None;
    }
    let per_cycle = motion.steps_per_mesh_cycle * steps_per_row;
    let length = motion.duration_s.filter(|_| run == "span");
    let length =
        length.map_or_else(|| format!("cycles = {}", scene.analysis.cycles), |t| format!("duration_s = {t:?}"));
    let mut text = format!(
        "\n[motion]\nrun = \"{run}\"\nspeed_rpm = {:?}\ndrive = \"{drive}\"\nmesh = \"{mesh}\"\n{length}\n\
         steps_per_cycle = {per_cycle}\nsteps_per_row = {steps_per_row}\nmethod = \"{}\"\nstop_at_events = {}\n\
         modal_damping_ratio = 0.0\n",
        scene.operation.speed_rpm,
        motion.method.word(),
        motion.stop_at_events
    );
    let numbers = [
        ("spectral_radius", motion.spectral_radius.filter(|_| motion.method == Integration::GeneralisedAlpha)),
        ("error_tolerance", motion.error_tolerance),
        ("periodic_tolerance", motion.periodic_tolerance.filter(|_| run != "span")),
        ("mesh_damping_ratio", motion.mesh_damping_ratio),
        ("mesh_damping_ns_per_mm2", motion.mesh_damping_ns_per_mm2),
    ];
    for (key, value) in numbers {
        if let Some(value) = value {
            let _ = writeln!(text, "{key} = {value:?}");
        }
    }
    if let Some(cycles) = motion.warm_up_cycles.filter(|_| run != "span") {
        let _ = writeln!(text, "warm_up_cycles = {cycles}");
    }
    if mesh == "mapped" {
        text += MAPS;
    }
    if let Some(modes) = scene.modes.filter(|_| scene.analysis.model == Model::ReducedModes) {
        text += &kept(&modes);
    }
    Some(text)
}

/// `[modes]` of the gearbox of a pair.
fn kept(modes: &ModesScene) -> String {
    let ModesScene { count, below_hz, boundary, fixed_modes, damping_ratio } = *modes;
    let mut text = format!("\n[modes]\nboundary = \"{}\"\ndamping_ratio = {damping_ratio:?}\n", boundary.word());
    let wholes = [("count", count), ("fixed_modes", fixed_modes)];
    for (key, value) in wholes.into_iter().filter_map(|(key, value)| Some((key, value?))) {
        let _ = writeln!(text, "{key} = {value}");
    }
    if let Some(hz) = below_hz {
        let _ = writeln!(text, "below_hz = {hz:?}");
    }
    text
}

/// Two shafts with a mesh, held where nothing else is said.
///
/// Shafts are named `pinion` and `wheel`, have the bore of their gear as outer diameter (that of a ring as inner one) and
/// three face widths as length. The key of the driver is the one with which position 0 is the beginning of a mesh cycle, as
/// that of a pair is:
///
/// ```text
/// theta_1 = theta_m - sign(sense) pi/z_1
/// ```
/// theta_m: [`middle_angle`](geometry::GearPair::middle_angle). A rating stays, at the speed of the scene.
pub(super) fn two_shafts(scene: &Scene, beside: &Beside<'_>) -> Result<String, SceneError> {
    let pair = scene.gear_pair()?;
    let mut scene = scene.clone();
    // Loads are those of the gearbox.
    let spectrum = scene.rating.as_mut().and_then(|own| own.spectrum.take());
    let scene = &scene;
    let driven_by = scene.operation.driver;
    let sense = scene.operation.rotation;
    let begins = pair.middle_angle(scene.side()) - sense.sign() as f64 * 0.5 * pair.pinion.pitch_angle();
    let keys = match driven_by {
        Driver::Pinion => [begins, 0.0],
        Driver::Wheel => [0.0, pair.wheel_angle(scene.side(), begins)],
    };
    let names = ["pinion", "wheel"];
    let widths = scene.face_widths_mm();
    let length = 3.0 * widths[0].max(widths[1]);
    let heights = [0.0, pair.mid_face_offset()];
    let apart = [0.0, pair.centre_distance()];
    let diameters = scene.gears().map(|gear| {
        let bore = gear.bore_diameter_mm.abs();
        // A ring sits within its shaft.
        if gear.is_internal() { format!("{:?}\ninner_diameter_mm = {bore:?}", 1.1 * bore) } else { format!("{bore:?}") }
    });
    let mut text: String = beside.said.iter().map(|line| format!("# {line}\n")).collect();
    // Writing into a text does not fail.
    let _ = writeln!(text, "name = {}", toml::Value::from(scene.name.as_str()));
    for i in 0..2 {
        let name = names[i];
        let held = if beside.bearings[i].is_none() { "held = true\n" } else { "" };
        let _ = write!(
            text,
            "\n[[shaft]]\nname = \"{name}\"\norigin_mm = [{:?}, 0.0, {:?}]\n{held}{}[[shaft.section]]\nlength_mm = {length:?}\n\
             outer_diameter_mm = {}\n",
            apart[i], heights[i], beside.of_shafts, diameters[i]
        );
        if let Some(bearing) = &beside.bearings[i] {
            let _ = write!(
                text,
                "\n[[bearing]]\nname = \"{name}\"\nshaft = \"{name}\"\nposition_mm = {:?}\n{bearing}",
                0.5 * length
            );
        }
    }
    for i in 0..2 {
        let name = names[i];
        let _ = write!(
            text,
            "\n[[gear]]\nname = \"{name}\"\nshaft = \"{name}\"\nposition_mm = {:?}\nkey_deg = {:?}\n{}",
            0.5 * length,
            keys[i].to_degrees(),
            stated_inertia(&scene.gears()[i].body)
        );
    }
    let (driver, driven) = match driven_by {
        Driver::Pinion => (0, 1),
        Driver::Wheel => (1, 0),
    };
    // A ring turns as its pinion does.
    let turns = if driver == 0 || pair.is_internal() { sense } else { sense.opposite() };
    let word = if turns == Sense::Ccw { "ccw" } else { "cw" };
    let added = scene.gears().map(|gear| gear.body.as_ref().map_or(0.0, |body| body.added_inertia_kg_m2));
    // A shaft that is not held does not twist between its gear and its machine: a pair has none there.
    let at = |gear: usize| if beside.bearings[gear].is_some() { 0.5 * length } else { 0.0 };
    let machine = |gear: usize| match added[gear] {
        0.0 => String::new(),
        inertia => format!("inertia_kg_m2 = {inertia:?}\n"),
    };
    let loads = spectrum.map_or_else(String::new, |file| {
        format!("spectrum = {}\n", toml::Value::from(file.path().display().to_string()))
    });
    let speed = scene.operation.speed_rpm;
    let rated = scene.rating.as_ref().map(|_| format!("[rating]\nspeed_rpm = {speed:?}\n{loads}\n"));
    let _ = write!(
        text,
        "\n[input]\nshaft = \"{}\"\nposition_mm = {:?}\nrotation = \"{word}\"\n{}\n\
         [[torque]]\nshaft = \"{}\"\nposition_mm = {:?}\ntorque_nm = {:?}\n{}{}\n\
         {}[analysis]\npositions_per_cycle = {}\n{}\n[[mesh]]\nname = \"pair\"\npinion = \"pinion\"\nwheel = \"wheel\"\n\n",
        names[driver],
        at(driver),
        machine(driver),
        names[driven],
        at(driven),
        scene.operation.torque_nm,
        machine(driven),
        beside.of_load,
        rated.unwrap_or_default(),
        scene.analysis.positions_per_cycle,
        // Of a motion they are those of its rows.
        if scene.motion.is_none() && (2..=10_000).contains(&scene.analysis.cycles) {
            format!("cycles = {}\n", scene.analysis.cycles)
        } else {
            String::new()
        }
    );
    Ok(text + &mesh_scene(scene))
}

/// Mass and inertia that a scene states of a gear.
fn stated_inertia(body: &Option<BodyScene>) -> String {
    let Some(body) = body else { return String::new() };
    let all = [
        ("mass_kg", body.mass_kg),
        ("transverse_inertia_kg_m2", body.transverse_inertia_kg_m2),
        ("polar_inertia_kg_m2", body.polar_inertia_kg_m2),
    ];
    all.iter().filter_map(|(key, value)| value.map(|x| format!("{key} = {x:?}\n"))).collect()
}

/// The tables of the pair, below `[mesh.scene]`.
fn mesh_scene(scene: &Scene) -> String {
    let whole: toml::Table = toml::from_str(&scene.to_toml()).unwrap_or_default();
    let mut pair: toml::Table = whole.into_iter().filter(|(key, _)| OF_PAIR.contains(&key.as_str())).collect();
    for gear in ["pinion", "wheel"] {
        if let Some(toml::Value::Table(own)) = pair.get_mut(gear) {
            own.retain(|key, _| !HOLDS.contains(&key));
        }
    }
    if let Some(toml::Value::Table(own)) = pair.get_mut("contact") {
        if scene.contact.friction == 0.0 {
            own.remove("friction");
        }
        // A number that the program has chosen is chosen again.
        if scene.contact.slices == Some(LEAST_SLICES) && scene.place_of(&["contact.slices"]).is_none() {
            own.remove("slices");
        }
    }
    let table = |key: &str, value: toml::Table| toml::Table::from_iter([(key.to_owned(), toml::Value::Table(value))]);
    // A table of tables of numbers and words: there is nothing that TOML could refuse.
    toml::to_string(&table("mesh", table("scene", pair))).unwrap_or_default()
}
