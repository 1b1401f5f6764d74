//! The gearbox that a pair is the short form of: two held shafts.

use std::fmt::Write;

use crate::{Driver, Scene, SceneError, Sense};

/// Tables of a scene that say what the pair is and how its flanks press; the others say what is done with it.
const OF_PAIR: [&str; 5] = ["pinion", "wheel", "pair", "operation", "contact"];
/// Tables of a gear that hold it, which the shafts do here.
const HOLDS: [&str; 3] = ["bearing", "body", "shaft"];

/// Text of the gearbox file whose one mesh is the pair of a scene, on two held shafts: at rest the two agree to 1e-9, position by position.
///
/// Shafts are named `pinion` and `wheel`, have the bore of their gear as outer diameter and three face widths as length. The
/// key of the driver is the one with which position 0 is the beginning of a mesh cycle, as that of a pair is:
///
/// ```text
/// theta_1 = theta_m - sign(sense) pi/z_1
/// ```
/// theta_m: [`middle_angle`](geometry::GearPair::middle_angle). What the scene computes, measures and writes (`analysis`, `motion`,
/// `accuracy`, `output`) is left out, and friction, which a gearbox at rest does not have.
///
/// # Errors
/// [`SceneError`]: gears that cannot be, as [`Scene::gear_pair`] has it.
pub fn gearbox_of_pair(scene: &Scene) -> Result<String, SceneError> {
    let pair = scene.gear_pair()?;
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
    let bores = [scene.pinion.bore_diameter_mm, scene.wheel.bore_diameter_mm];
    let mut text = format!(
        "# Gearbox of one pair on two held shafts: it computes what the pair alone does.\n\
         # To let a shaft deflect, take `held = true` out of it, state its sections, and add its bearings:\n\
         # [[bearing]]\n# shaft = \"pinion\"\n# position_mm = 5.0\n# stiffness_n_per_mm = [2.0e5, 2.0e5, 8.0e4]\n\
         name = {}\n",
        toml::Value::from(scene.name.as_str())
    );
    for i in 0..2 {
        let name = names[i];
        // Writing into a text does not fail.
        let _ = write!(
            text,
            "\n[[shaft]]\nname = \"{name}\"\norigin_mm = [{:?}, 0.0, {:?}]\nheld = true\n[[shaft.section]]\nlength_mm = {length:?}\n\
             outer_diameter_mm = {:?}\n",
            apart[i], heights[i], bores[i]
        );
    }
    for i in 0..2 {
        let name = names[i];
        let _ = write!(
            text,
            "\n[[gear]]\nname = \"{name}\"\nshaft = \"{name}\"\nposition_mm = {:?}\nkey_deg = {:?}\n",
            0.5 * length,
            keys[i].to_degrees()
        );
    }
    let (driver, driven) = match driven_by {
        Driver::Pinion => (0, 1),
        Driver::Wheel => (1, 0),
    };
    let turns = if driver == 0 { sense } else { sense.opposite() };
    let word = if turns == Sense::Ccw { "ccw" } else { "cw" };
    let _ = write!(
        text,
        "\n[input]\nshaft = \"{}\"\nposition_mm = 0.0\nrotation = \"{word}\"\n\n\
         [[torque]]\nshaft = \"{}\"\nposition_mm = 0.0\ntorque_nm = {:?}\n\n\
         [analysis]\npositions_per_cycle = {}\n\n[[mesh]]\nname = \"pair\"\npinion = \"pinion\"\nwheel = \"wheel\"\n\n",
        names[driver], names[driven], scene.operation.torque_nm, scene.analysis.positions_per_cycle
    );
    Ok(text + &mesh_scene(scene))
}

/// The tables of the pair, below `[mesh.scene]`.
fn mesh_scene(scene: &Scene) -> String {
    let whole: toml::Table = toml::from_str(&scene.standing_alone().to_toml()).unwrap_or_default();
    let mut pair: toml::Table = whole.into_iter().filter(|(key, _)| OF_PAIR.contains(&key.as_str())).collect();
    for gear in ["pinion", "wheel"] {
        if let Some(toml::Value::Table(own)) = pair.get_mut(gear) {
            own.retain(|key, _| !HOLDS.contains(&key));
        }
    }
    if let Some(toml::Value::Table(own)) = pair.get_mut("contact") {
        own.remove("friction");
    }
    let table = |key: &str, value: toml::Table| toml::Table::from_iter([(key.to_owned(), toml::Value::Table(value))]);
    // A table of tables of numbers and words: there is nothing that TOML could refuse.
    toml::to_string(&table("mesh", table("scene", pair))).unwrap_or_default()
}
