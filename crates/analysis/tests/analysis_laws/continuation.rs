//! Periodic motions along a key: what the branch says must be what motions in time do.

use analysis::branch::LossName;
use analysis::lumped::{
    ContinuationAnalysis, ContinuationResult, KeySweep, LumpedAnalysis, LumpedQuantity, SweepOptions,
};
use scene::{Scene, SceneBuilder, SweepWay, plan::SectionEvery};

/// A lightly damped, lightly loaded pair.
pub fn pair(model: &str, (helix_angle_deg, slices): (f64, i64)) -> SceneBuilder {
    let base = Scene::builder()
        .pinion(24, helix_angle_deg)
        .wheel(31)
        .normal_module_mm(3.0)
        .face_width_mm(20.0)
        .torque_nm(100.0);
    let meshed = ["pinion.mesher", "wheel.mesher"].iter().fold(base, |scene, gear| {
        let keys = [("order", 1), ("sector_teeth", 1), ("elements_profile", 3), ("elements_thickness", 4)];
        let all = keys.iter().chain(&[("elements_face", 4), ("elements_rim", 2)]);
        all.fold(scene, |scene, (key, value)| scene.set(&format!("{gear}.{key}"), *value))
    });
    meshed
        .set("pinion.thickness_allowance_mm", 0.03)
        .set("wheel.thickness_allowance_mm", 0.03)
        .set("operation.speed_rpm", 12000.0)
        .set("contact.slices", slices)
        .set("analysis.kind", "dynamic")
        .set("analysis.model", model)
        .set("analysis.positions_per_cycle", 8)
        .set("motion.mesh_damping_ratio", 0.04)
}

fn spur(model: &str) -> SceneBuilder {
    pair(model, (0.0, 8))
}

/// Two gears on springs, nothing holds their common turn; backlash, light load.
pub fn lumped8() -> SceneBuilder {
    let base = Scene::builder().pinion(17, 12.0).wheel(23).normal_module_mm(2.5).face_width_mm(14.0).torque_nm(60.0);
    let axes = [("x", 2e5), ("y", 2e5), ("z", 1e5)];
    let sprung = ["pinion", "wheel"].iter().fold(base, |scene, gear| {
        axes.iter().fold(scene, |s, (axis, k)| s.set(&format!("{gear}.bearing.stiffness_{axis}_n_per_mm"), *k))
    });
    sprung
        .set("operation.speed_rpm", 4000.0)
        .set("mesh.stiffness_n_per_um", 180.0)
        .set("mesh.stiffness_cos_n_per_um", vec![40.0, 5.0])
        .set("mesh.half_backlash_um", 30.0)
        .set("analysis.kind", "dynamic")
        .set("analysis.model", "lumped8")
        .set("motion.mesh_damping_ratio", 0.03)
}

pub fn followed(scene: SceneBuilder, [from, to]: [f64; 2]) -> (Scene, ContinuationResult) {
    let words = scene
        .set("motion.run", "continuation")
        .set("motion.continuation.from", from)
        .set("motion.continuation.to", to)
        .set("motion.steps_per_mesh_cycle", 256);
    let scene = words.build().unwrap_or_else(|e| panic!("{e}"));
    let found = ContinuationAnalysis::new(&scene).solve().unwrap_or_else(|e| panic!("{e}"));
    analysis::certificate::verdict(&found.facts.certificate, &scene).unwrap_or_else(|e| panic!("{e}"));
    (scene, found)
}

fn values(found: &ContinuationResult) -> Vec<String> {
    found.points.iter().map(|p| format!("{:.1}: {:.4}", p.value, p.peak_to_peak_dte_um)).collect()
}

/// Around a fold the branch of the map is that of the contact itself: folds within 0.2 %, amplitudes within 1 %; its
/// stable motions stay where they are when they are run in time.
#[test]
fn a_map_folds_where_the_contact_does() {
    let (way, helical) = ([15500.0, 18500.0], (15.0, 12));
    let (_, mapped) = followed(pair("mapped", helical).set("motion.continuation.phases", 192), way);
    let (_, reduced) = followed(
        pair("reduced", helical).set("motion.continuation.phases", 128).set("motion.continuation.time_points", 1),
        way,
    );
    // Where it jumps up, and where it jumps down; between phases at which contact begins, a branch may waver there.
    let jumps = |found: &ContinuationResult| {
        let folds = &found.headline.figures.folds;
        assert!(folds.len() >= 2, "{folds:?} {:?}", values(found));
        [folds[0], folds.iter().copied().fold(f64::INFINITY, f64::min)]
    };
    for (a, b) in jumps(&mapped).into_iter().zip(jumps(&reduced)) {
        assert!((a / b - 1.0).abs() < 2e-3, "a fold at {b} 1/min lies at {a} on the map");
    }
    let [a, b] = [&mapped, &reduced].map(|found| &found.headline.largest);
    let off = (a.peak_to_peak_dte_um / b.peak_to_peak_dte_um - 1.0).abs();
    assert!(off < 1e-2, "largest {b:?}, on the map {a:?}");
    for found in [&mapped, &reduced] {
        assert!(found.headline.figures.unstable > 0 && found.headline.figures.parting > 0, "{:?}", found.headline);
        let difference = found.headline.figures.difference_in_time.unwrap();
        assert!(difference < 1e-2, "in time {:?}", found.in_time);
    }
}

/// The exponent of a motion that repeats itself is the rate at which its disturbances fade: ln of the largest Floquet
/// multiplier over the period. One comes from steps in time, the other from harmonics; the gears' free turn is in
/// neither.
#[test]
fn the_exponent_is_that_of_the_largest_multiplier() {
    let (scene, found) = followed(lumped8(), [4000.0, 5000.0]);
    for point in [&found.points[0], &found.points[found.points.len() - 1]] {
        let mut own = scene.clone();
        own.operation.speed_rpm = point.value;
        let options = SweepOptions {
            key: "operation.speed_rpm".into(),
            ways: vec![SweepWay::Apart],
            every: SectionEvery::MeshCycle,
            quantity: LumpedQuantity::new("dte_um", |row| row.transmission_error_um),
            points: 4,
            stretches: 400,
        };
        let swept = KeySweep::new(&[(point.value, own)], &options).solve().unwrap_or_else(|e| panic!("{e}"));
        let exponent = swept.points[0].lyapunov.unwrap().exponent;
        let mesh_hz = point.value / 60.0 * f64::from(scene.driver_teeth());
        let rate = point.largest_multiplier.ln() * mesh_hz;
        assert!((exponent / rate - 1.0).abs() < 0.02, "{} 1/min: {exponent} 1/s, not {rate}", point.value);
        let [low, high] = swept.points[0].extent;
        let off = ((high - low) / point.peak_to_peak_dte_um - 1.0).abs();
        assert!(off < 2e-3, "{} 1/min: {} um in time, {point:?}", point.value, high - low);
    }
}

/// A parametric resonance, twice the natural frequency: the motion of one mesh cycle loses its stability to one of two,
/// which is found with `period_cycles` = 2 and runs on in time.
#[test]
fn a_doubled_motion_begins_where_a_multiplier_leaves_at_minus_one() {
    let light = || spur("mapped").set("motion.mesh_damping_ratio", 0.01).set("operation.torque_nm", 30.0);
    let (_, one) = followed(light(), [40000.0, 33000.0]);
    let doubling = one.turns.iter().find(|turn| turn.loss == LossName::PeriodDoubling);
    let doubling = doubling.unwrap_or_else(|| panic!("no period doubling: {:?}", one.headline)).point.value;
    let options = SweepOptions {
        key: "operation.speed_rpm".into(),
        ways: vec![SweepWay::Apart],
        every: SectionEvery::MeshCycle,
        quantity: LumpedQuantity::new("dte_um", |row| row.transmission_error_um),
        points: 16,
        stretches: 0,
    };
    let at = |share: f64| {
        let scene = light().set("operation.speed_rpm", share * doubling).set("motion.warm_up_cycles", 3000);
        (share * doubling, scene.build().unwrap_or_else(|e| panic!("{e}")))
    };
    let scenes = [at(0.99), at(1.01)];
    let swept = KeySweep::new(&scenes, &options).solve().unwrap_or_else(|e| panic!("{e}"));
    let periods: Vec<_> = swept.points.iter().map(|p| p.period).collect();
    assert_eq!(periods, [Some(2), Some(1)], "periods in time beside {doubling} 1/min");
}

/// What has a period of its own, or no smooth equations, is refused.
#[test]
fn what_does_not_come_back_after_mesh_cycles_is_refused() {
    let begun = |scene: SceneBuilder| {
        let scene = scene.set("motion.run", "continuation").set("motion.continuation.from", 3000.0);
        scene.set("motion.continuation.to", 4000.0)
    };
    let refused = |scene: SceneBuilder, said: &str| {
        let error = begun(scene).build().expect_err(said).to_string();
        assert!(error.contains(said), "{error}, not `{said}`");
    };
    refused(spur("mapped").set("load.amplitude_nm", 20.0).set("load.frequency_hz", 300.0), "period of its own");
    refused(spur("reduced").set("pinion.pitch_errors_um", vec![1.0; 24]), "period of its own");
    refused(spur("reduced+modes"), "no continuation");
    refused(lumped8().set("motion.continuation.key", "mesh.half_backlash_um").set("analysis.model", "mapped"), "");
    refused(spur("mapped").set("motion.continuation.key", "mesh.half_backlash_um"), "lumped8");
}

/// A run that is taken to its periodic state by Newton's method comes to the motion that the branch has, in a part of the
/// mesh cycles that damping takes.
#[test]
fn a_steady_run_does_not_wait() {
    for (scene, most) in [(lumped8(), 12), (spur("mapped").set("operation.speed_rpm", 9000.0), 100)] {
        let scene = scene.set("motion.mesh_damping_ratio", 0.01).set("motion.steps_per_mesh_cycle", 256);
        let run = |tolerance: f64| {
            let own =
                scene.clone().set("motion.periodic_tolerance", tolerance).build().unwrap_or_else(|e| panic!("{e}"));
            LumpedAnalysis::new(&own).solve().unwrap_or_else(|e| panic!("{e}")).headline
        };
        let found = run(1e-9);
        let cycles = found.certificate.warm_up_cycles;
        assert!(cycles <= most, "{cycles} mesh cycles");
        let rough = run(1e-4);
        let off = (found.peak_to_peak_dte_um / rough.peak_to_peak_dte_um - 1.0).abs();
        assert!(off < 1e-3, "{} um, less exactly {} um", found.peak_to_peak_dte_um, rough.peak_to_peak_dte_um);
    }
}
