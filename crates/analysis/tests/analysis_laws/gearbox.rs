//! Gearbox files solved at rest.

use std::path::{Path, PathBuf};

use analysis::{
    AnalysisError, NoCache, NoObserver, StaticAnalysis,
    gearbox_at_rest::{GearboxResult, solve_gearbox},
};
use scene::{Scene, Setting, gearbox::Gearbox};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox")
}

fn solve(file: &Gearbox) -> Result<GearboxResult, AnalysisError> {
    solve_gearbox(file, &NoCache, &mut NoObserver)
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
    let factor = analysis::results::face_load_factor(16, &alone.history).unwrap();
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
    assert!(!error.is_without_result() && error.hint().is_some(), "{error}");
    assert!(error.to_string().contains("92 mm apart"), "{error}");
}
