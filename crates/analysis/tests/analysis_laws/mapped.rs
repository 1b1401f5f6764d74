//! The model `mapped` beside `reduced`, of one scene.

use analysis::{AnalysisError, lumped::LumpedAnalysis, motion::MotionAnalysis};
use scene::{Scene, SceneBuilder};

/// A small pair on soft bearings, at a speed at which it vibrates.
fn small(model: &str) -> SceneBuilder {
    let base = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0).torque_nm(300.0);
    let meshed = ["pinion.mesher", "wheel.mesher"].iter().fold(base, |scene, gear| {
        let keys = [("order", 1), ("sector_teeth", 1), ("elements_profile", 3), ("elements_thickness", 4)];
        let all = keys.iter().chain(&[("elements_face", 4), ("elements_rim", 2)]);
        all.fold(scene, |scene, (key, value)| scene.set(&format!("{gear}.{key}"), *value))
    });
    meshed
        .set("operation.speed_rpm", 3000.0)
        .set("contact.slices", 12)
        .set("analysis.kind", "dynamic")
        .set("analysis.model", model)
        .set("analysis.positions_per_cycle", 8)
        .set("analysis.cycles", 2)
        .set("motion.run", "steady")
        .set("motion.warm_up_cycles", 400)
        .set("motion.periodic_tolerance", 1e-3)
        .set("motion.steps_per_mesh_cycle", 32)
        .set("motion.mesh_damping_ratio", 0.08)
}

fn on_bearings(scene: SceneBuilder) -> SceneBuilder {
    let all = [("x_n_per_mm", 3e5), ("y_n_per_mm", 2e5), ("rx_nmm_per_rad", 4e8), ("ry_nmm_per_rad", 6e8)];
    let sprung = all.iter().fold(scene, |s, (key, value)| s.set(&format!("wheel.bearing.stiffness_{key}"), *value));
    sprung.set("wheel.body.free", vec!["x", "y", "rx", "ry"]).set("wheel.bearing.damping_ratio", 0.05)
}

fn built(scene: SceneBuilder) -> Scene {
    scene.build().unwrap_or_else(|e| panic!("{e}"))
}

/// Peak to peak, mean and rows' order of the dynamic transmission error are those of the contact itself, with gears that
/// turn alone and with one that gives way and tilts.
#[test]
fn it_moves_as_the_reduced_model() {
    for change in [|s: SceneBuilder| s, on_bearings] {
        let exact = MotionAnalysis::new(&built(change(small("reduced")))).solve().unwrap_or_else(|e| panic!("{e}"));
        let scene = built(change(small("mapped")));
        let mapped = LumpedAnalysis::new(&scene).solve().unwrap_or_else(|e| panic!("{e}"));
        mapped.certificate().verdict(&scene).unwrap_or_else(|e| panic!("{e}"));
        let (a, b) = (&exact.headline, &mapped.headline);
        let [range, mean] = [a.peak_to_peak_dte_um, a.mean_dte_um];
        let off = (b.peak_to_peak_dte_um / range - 1.0).abs();
        assert!(off < 5e-3, "peak to peak {range} um, on the map {} um", b.peak_to_peak_dte_um);
        let off = (b.mean_dte_um - mean).abs() / mean.abs();
        assert!(off < 1e-3, "mean {mean} um, on the map {} um", b.mean_dte_um);
        let [first, last] = [&mapped.rows[0], &mapped.rows[mapped.rows.len() - 1]];
        assert!(first.displacement.len() == first.velocity.len() && last.time > first.time);
        assert_eq!(first.displacement.len(), scene.gears()[1].body.as_ref().map_or(0, |b| b.free.len()));
    }
}

/// What a map does not hold is refused with a hint.
#[test]
fn it_has_no_friction() {
    let scene = small("mapped").set("contact.friction", 0.05).build();
    assert!(scene.is_err(), "friction is in no map");
    let uneven = built(small("mapped").set("pinion.pitch_errors_um", vec![1.0; 24]));
    match LumpedAnalysis::new(&uneven).solve() {
        Err(AnalysisError::Motion { source, .. }) => assert!(source.to_string().contains("pitch errors"), "{source}"),
        other => panic!("{other:?}"),
    }
}
