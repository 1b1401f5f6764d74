//! Gearbox files solved at rest.

use std::path::{Path, PathBuf};

use analysis::{AnalysisError, Blame, Context, NoObserver, StaticAnalysis, gearbox::GearboxResult};
use scene::{Scene, Setting, gearbox::Gearbox};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox")
}

fn solve(file: &Gearbox) -> Result<GearboxResult, AnalysisError> {
    analysis::solve(file, Context::new(&mut NoObserver))?.finished()
}

/// The pair of the first stage on two shafts that are held.
fn held(key_deg: f64, more: &str) -> String {
    let shaft = |name: &str, x: f64| {
        format!(
            "[[shaft]]\nname = \"{name}\"\norigin_mm = [{x:?}, 0.0, 0.0]\nheld = true\n\
             [[shaft.section]]\nlength_mm = 100.0\nouter_diameter_mm = 20.0\n"
        )
    };
    let gear = |name: &str, key: f64| {
        format!("[[gear]]\nname = \"{name}\"\nshaft = \"{name}\"\nposition_mm = 50.0\nkey_deg = {key:?}\n")
    };
    let mesh = "[[mesh]]\nscene = \"first_stage.toml\"\nset = [\"contact.slices=16\"]\npinion = \"a\"\nwheel = \"b\"\n";
    let load =
        "[input]\nshaft = \"a\"\nposition_mm = 0.0\n[[torque]]\nshaft = \"b\"\nposition_mm = 0.0\ntorque_nm = 300.0\n";
    let run = "[analysis]\npositions_per_cycle = 4\n";
    [shaft("a", 0.0), shaft("b", 91.0), gear("a", key_deg), gear("b", 0.0), mesh.into(), load.into(), run.into()]
        .concat()
        + more
}

/// Shafts held, a gearbox of one pair is the scene of that pair: transmission error, pressure and K_Hbeta at every
/// position of the cycle to 1e-9.
#[test]
fn a_held_gearbox_of_one_pair_is_the_scene_of_the_pair() {
    let file = folder().join("held.toml");
    let of = |key: f64| solve(&Gearbox::parse(&held(key, ""), &file).unwrap()).unwrap_or_else(|e| panic!("{e}"));
    // A key that brings the beginning of the turn to that of a mesh cycle.
    let start = of(0.0).positions[0].meshes[0].cycles;
    let found = of(-start * 360.0 / 17.0);
    let settings = ["contact.slices=16", "analysis.positions_per_cycle=4"].map(|s| Setting::parse(s).unwrap());
    let scene = Scene::read_with(&folder().join("first_stage.toml"), &settings).unwrap();
    let alone = StaticAnalysis::new(&scene).solve().unwrap();
    assert_eq!(found.positions.len(), alone.history.positions.len());
    for (own, wanted) in found.positions.iter().zip(&alone.history.positions) {
        let mesh = &own.meshes[0];
        assert!((mesh.cycles - mesh.cycles.round() - wanted.mesh_phase).abs() < 1e-9 || wanted.mesh_phase > 0.4);
        let off = mesh.transmission_error / wanted.transmission_error - 1.0;
        assert!(off.abs() < 1e-9, "phase {}: transmission error off by {off:.1e}", wanted.mesh_phase);
        let pressure = mesh.slices.iter().map(|s| s.pressure).fold(0.0, f64::max);
        assert!((pressure / wanted.max_pressure - 1.0).abs() < 1e-9, "phase {}: {pressure} MPa", wanted.mesh_phase);
    }
    let factor = analysis::results::face_load_factor(16, &alone.history.positions).unwrap();
    let own = found.meshes[0].face_load_factor.unwrap();
    assert!((own / factor - 1.0).abs() < 1e-9, "K_Hbeta {own} beside {factor}");
    assert_eq!(found.meshes[0].misalignment, [0.0; 2]);
}

/// The two stages of the scenes: forces in balance to 1e-9, torques by the teeth, phases by the count, every number of
/// the result there.
#[test]
fn the_two_stages_of_the_scenes_are_in_balance() {
    let file = Gearbox::read(&folder().join("two_stages.toml")).unwrap();
    let found = solve(&file).unwrap_or_else(|e| panic!("{e}"));
    assert!(found.certificate.iter().all(|share| *share < 1e-9), "{:?}", found.certificate);
    let wanted = 740e3 * (17.0 / 53.0) * (19.0 / 47.0);
    // Clockwise: the input turns, and is driven, about -z. Tilted axes take a part of a per cent.
    assert!((found.input_torque / -wanted - 1.0).abs() < 5e-3, "{} beside {wanted} N mm", found.input_torque);
    let cycles = |p: usize, m: usize| found.positions[p].meshes[m].cycles - found.positions[0].meshes[m].cycles;
    for p in 0..found.positions.len() {
        assert!((cycles(p, 0) - p as f64 / 8.0).abs() < 1e-9, "{}", cycles(p, 0));
        assert!((cycles(p, 1) - cycles(p, 0) * 19.0 / 53.0).abs() < 1e-9, "{}", cycles(p, 1));
    }
    for mesh in &found.meshes {
        let factor = mesh.face_load_factor.unwrap();
        assert!(factor > 1.0 && factor < 5.0, "{}: K_Hbeta {factor}", mesh.name);
        assert!(mesh.transmission_error[0] > 0.0 && mesh.transmission_error[1] > 0.0 && mesh.max_pressure > 0.0);
        assert!(mesh.misalignment[0] != 0.0);
    }
    assert!(found.outputs[0].mean > 0.0 && found.outputs[0].peak_to_peak > 0.0);
    // The axial forces of a shaft go where its fixed bearing is.
    for (i, b) in found.bearings.iter().enumerate() {
        assert!((b.force[2].abs() > 1.0) == (i % 2 == 0), "{}: {} N along the axis", b.name, b.force[2]);
    }
}

/// A distance of axes that the pair does not have, and torques that no shaft takes, are wrong input and not a failed
/// search.
#[test]
fn a_gearbox_that_does_not_fit_is_wrong_input() {
    let text = held(0.0, "").replace("[91.0, 0.0, 0.0]", "[92.0, 0.0, 0.0]");
    let file = Gearbox::parse(&text, &folder().join("held.toml")).unwrap();
    let error = solve(&file).unwrap_err();
    assert!(error.blame() == Blame::Input && error.hint().is_some(), "{error}");
    assert!(error.to_string().contains("92 mm apart"), "{error}");
}

const VIBRATION: &str = "[vibration]\nfrom_rpm = 100.0\nto_rpm = 3000.0\nspeeds = 5\norders = 2\nmodes = 3\n";

/// Two gears of stated inertia on shafts that only turn: the one mode that is left is k cos^2 (r_b1^2/J_1 + r_b2^2/J_2)
/// with the mean stiffness that the result tells, and the shafts' own inertia.
#[test]
fn a_pair_that_only_turns_has_the_frequency_of_two_discs() {
    let inertia = |name: &str, value: f64| {
        let before = format!("[[gear]]\nname = \"{name}\"\n");
        (before.clone(), format!("{before}polar_inertia_kg_m2 = {value:?}\n"))
    };
    let text = [inertia("a", 0.002), inertia("b", 0.03)].into_iter().fold(held(0.0, VIBRATION), |text, (from, to)| {
        assert!(text.contains(&from));
        text.replace(&from, &to)
    });
    let found = solve(&Gearbox::parse(&text, &folder().join("held.toml")).unwrap()).unwrap_or_else(|e| panic!("{e}"));
    let swings = found.vibration.unwrap();
    let pair = &found.pairs[0];
    let shaft = 7.85e-9 * std::f64::consts::PI / 32.0 * 20f64.powi(4) * 100.0;
    let square: f64 = [(&pair.pinion, 2.0), (&pair.wheel, 30.0)]
        .map(|(g, j)| (g.base_radius() * pair.base_helix_angle().cos()).powi(2) / (j + shaft))
        .iter()
        .sum();
    let wanted = (swings.mesh_stiffness[0] * square).sqrt();
    let own = &swings.modes[0].modes;
    assert_eq!(own.len(), 1, "one coordinate against the other");
    // Off-diagonal entries of the tangent are those of one lever but for how the load lies over the width.
    assert!((own[0].frequency / wanted - 1.0).abs() < 1e-3, "{} beside {wanted} rad/s", own[0].frequency);
    // Some 14 N/(um mm) of face width.
    assert!((150e3..500e3).contains(&swings.mesh_stiffness[0]), "{} N/mm", swings.mesh_stiffness[0]);
    // The ring of the stated gear is that of its mesh but for the turn.
    assert_eq!(swings.gears.iter().map(|g| g.polar_inertia).collect::<Vec<_>>(), [2.0, 30.0]);
}

/// The two stages of the scenes swing: a mode at each shape of it, forces that balance, gears as heavy as their rings.
#[test]
fn the_two_stages_of_the_scenes_swing() {
    let file = Gearbox::read(&folder().join("two_stages.toml")).unwrap();
    let found = solve(&file).unwrap_or_else(|e| panic!("{e}"));
    let swings = found.vibration.unwrap();
    // Gear 1: a ring from bore to somewhere between root and tip.
    let ring = |outer: f64| 7.85e-9 * std::f64::consts::PI * 24.0 * 0.25 * (outer * outer - 25.0 * 25.0);
    let (root, tip) = (38.0, 50.0);
    assert!((ring(root)..ring(tip)).contains(&swings.gears[0].mass), "{} t", swings.gears[0].mass);
    assert_eq!(swings.gears[3].mass, 3.2e-3, "what is stated holds");
    assert_eq!((swings.speeds.len(), swings.orders.len(), swings.orders[0].len()), (57, 57, 6));
    assert_eq!(
        (swings.modes.len(), swings.modes[0].modes.len(), swings.campbell.diagram.frequencies.len()),
        (21, 12, 12)
    );
    // A turn of the input is 17 cycles of the first mesh and 17 19/53 of the second.
    let wanted = [17.0, 34.0, 51.0, 17.0 * 19.0 / 53.0];
    for (line, wanted) in swings.campbell.lines.iter().zip(wanted) {
        assert!((line.order / wanted - 1.0).abs() < 1e-12, "{line:?}");
    }
    assert!(!swings.campbell.diagram.resonances.is_empty());
    for (rms, orders) in swings.rms.iter().zip(&swings.orders) {
        for mesh in 0..2 {
            let square: f64 = orders.iter().map(|o| 0.5 * o.mesh_forces[mesh].norm_sqr()).sum();
            assert!((rms.mesh_forces[mesh] / square.sqrt() - 1.0).abs() < 1e-12, "no two orders have one frequency");
            assert!(rms.mesh_forces[mesh] > 0.0);
        }
    }
    // Both meshes feel each other.
    assert!(swings.orders.iter().flatten().all(|o| o.mesh_forces[1 - o.mesh].norm() > 0.0));
    let mean = found.meshes.iter().map(|m| m.normal_force).fold(0.0, f64::max);
    let (_, peak) = swings.peak(|r| r.mesh_forces[0]).unwrap();
    assert!(peak < mean, "vibration beyond the load is not linear: {peak} of {mean} N");
}
