//! What no teeth can do is no result: gears that jam are told, motions a module into the flanks fail.

use analysis::{StaticAnalysis, lumped::LumpedAnalysis};
use scene::{Scene, SceneBuilder};

fn built(scene: SceneBuilder) -> Scene {
    scene.build().unwrap_or_else(|e| panic!("{e}"))
}

pub fn small() -> SceneBuilder {
    let mut scene = Scene::builder().pinion(18, 14.0).wheel(31).normal_module_mm(2.5).face_width_mm(15.0);
    for gear in ["pinion", "wheel"] {
        let counts = [("order", 1), ("elements_profile", 2), ("elements_fillet", 2), ("elements_thickness", 2)];
        for (key, value) in counts.iter().chain(&[("elements_face", 3), ("elements_rim", 1)]) {
            scene = scene.set(&format!("{gear}.mesher.{key}"), *value);
        }
    }
    scene.torque_nm(100.0).set("contact.slices", 8).set("analysis.positions_per_cycle", 2)
}

/// Axes that are out of parallel by more than the backlash wedge the teeth: flanks on both sides carry more than the
/// torque asks for. A run at rest says so with the forces; with backlash, or with the driving flanks alone, it says
/// nothing.
#[test]
fn flanks_that_jam_are_told() {
    let said = |flanks: &str, allowance_mm: f64| {
        let askew = small().set("contact.flanks", flanks).set("pair.misalignment.in_plane_of_action_um", 80.0);
        let thinned = ["pinion", "wheel"]
            .iter()
            .fold(askew, |s, gear| s.set(&format!("{gear}.thickness_allowance_mm"), allowance_mm));
        let remarks = StaticAnalysis::new(&built(thinned)).solve().unwrap_or_else(|e| panic!("{e}")).history.remarks;
        remarks.into_iter().find(|w| w.code() == "jammed").map(|w| w.to_string())
    };
    let told = said("both", 0.0).expect("flanks on both sides press");
    assert!(told.contains("in 2 of 2 positions") && told.contains("thickness_allowance_mm"), "{told}");
    assert_eq!(said("driving", 0.0), None, "the coast flanks are not looked at");
    assert_eq!(said("both", 0.1), None, "the backlash keeps them apart");
}

/// A load that is a thousand times too large for its springs takes flanks a module and more into each other: numbers come
/// out, and the certificate fails. The same pair under its own load holds.
#[test]
fn a_module_into_the_flanks_is_no_result() {
    let of = |torque_nm: f64| {
        let base = Scene::builder().pinion(18, 14.0).wheel(31).normal_module_mm(2.5).face_width_mm(15.0);
        let mut scene =
            base.torque_nm(torque_nm).set("operation.speed_rpm", 1500.0).set("mesh.stiffness_n_per_um", 200.0);
        for gear in ["pinion", "wheel"] {
            for axis in ["x", "y", "z"] {
                scene = scene.set(&format!("{gear}.bearing.stiffness_{axis}_n_per_mm"), 1e5);
            }
        }
        let moving = scene.set("analysis.kind", "dynamic").set("analysis.model", "lumped8").set("motion.run", "steady");
        let scene = built(moving.set("motion.mesh_damping_ratio", 0.06).set("motion.warm_up_cycles", 20));
        let result = LumpedAnalysis::new(&scene).solve().unwrap_or_else(|e| panic!("{e}"));
        (
            result.headline.max_dte_um,
            analysis::certificate::verdict(result.certificate(), &scene).map_err(|e| e.to_string()),
        )
    };
    let (_, held) = of(100.0);
    assert_eq!(held, Ok(()));
    let (largest_um, held) = of(1e5);
    assert!(largest_um > 2500.0, "{largest_um} um");
    assert!(held.as_ref().is_err_and(|said| said.contains("flank_excursion")), "{held:?}");
}
