//! What steps change of a steady motion lies within `step_error_percent`.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use analysis::motion::MotionAnalysis;
use scene::{Scene, SceneBuilder};

/// A spur pair of 30 and 42 teeth beside a superharmonic of its mesh resonance.
fn spur(speed_rpm: f64, steps_per_resonance: u32) -> Scene {
    let base = Scene::builder().pinion(30, 0.0).wheel(42).normal_module_mm(3.0).face_width_mm(15.0).torque_nm(200.0);
    let on = |scene: SceneBuilder, gear: &str| {
        let keys = [("profile", 2), ("fillet", 3), ("thickness", 2), ("face", 4), ("rim", 4)];
        keys.iter().fold(scene, |scene, (key, n)| scene.set(&format!("{gear}.mesher.elements_{key}"), *n))
    };
    on(on(base, "pinion"), "wheel")
        .set("operation.speed_rpm", speed_rpm)
        .set("contact.slices", 8)
        .set("analysis.kind", "dynamic")
        .set("motion.run", "steady")
        .set("motion.steps_per_resonance", steps_per_resonance)
        .build()
        .unwrap_or_else(|e| panic!("{e}"))
}

/// Peak to peak of the dynamic transmission error (um), and what steps change of it at the most (%).
fn moved(speed_rpm: f64, steps: u32) -> [f64; 2] {
    let headline = MotionAnalysis::new(&spur(speed_rpm, steps)).solve().unwrap_or_else(|e| panic!("{e}")).headline;
    [headline.peak_to_peak_dte_um, headline.certificate.step_error_percent.unwrap()]
}

/// Default steps (16 in a period of the mesh resonance) are some per cent off on both sides of the fourth superharmonic, and
/// say so: the bound holds, and is less than five times the error.
#[test]
fn steps_beside_a_superharmonic_tell_their_error() {
    for speed in [2988.0, 3215.0].into_iter().take(testing::cases(1, 2)) {
        let exact = moved(speed, 256)[0];
        for steps in [16, 32] {
            let [found, bound] = moved(speed, steps);
            let error = 100.0 * (exact / found - 1.0).abs();
            println!("{speed} rpm, {steps} steps: peak to peak {found:.2} um, off {error:.2} %, said {bound:.2} %");
            assert!(
                error < bound && bound < 5.0 * error,
                "{speed} rpm, {steps} steps: {error:.2} %, said {bound:.2} %"
            );
        }
    }
}
