//! The model `mapped` beside `reduced`, of one scene.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use analysis::{
    lumped::{KeySweep, LumpedAnalysis, LumpedQuantity, SweepOptions},
    motion::MotionAnalysis,
};
use scene::{Scene, SceneBuilder, SweepWay, plan::SectionEvery};

/// A small pair at a speed at which it vibrates, until it repeats itself.
pub fn small(model: &str) -> SceneBuilder {
    moving(model)
        .set("motion.run", "steady")
        .set("motion.warm_up_cycles", 400)
        .set("motion.periodic_tolerance", 1e-3)
        .set("motion.mesh_damping_ratio", 0.08)
}

/// A pair in motion by a model, whatever is run.
fn moving(model: &str) -> SceneBuilder {
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
        .set("motion.steps_per_mesh_cycle", 32)
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
/// rotate alone and with one whose bearings deflect and that tilts.
#[test]
fn it_moves_as_the_reduced_model() {
    for change in [|s: SceneBuilder| s, on_bearings] {
        let exact = MotionAnalysis::new(&built(change(small("reduced")))).solve().unwrap_or_else(|e| panic!("{e}"));
        let scene = built(change(small("mapped")));
        let mapped = LumpedAnalysis::new(&scene).solve().unwrap_or_else(|e| panic!("{e}"));
        analysis::certificate::verdict(mapped.certificate(), &scene).unwrap_or_else(|e| panic!("{e}"));
        let (a, b) = (&exact.headline, &mapped.headline);
        let [range, mean] = [a.peak_to_peak_dte_um, a.mean_dte_um];
        let off = (b.peak_to_peak_dte_um / range - 1.0).abs();
        assert!(off < 5e-3, "peak to peak {range} um, on the map {} um", b.peak_to_peak_dte_um);
        let off = (b.mean_dte_um - mean).abs() / mean.abs();
        assert!(off < 1e-3, "mean {mean} um, on the map {} um", b.mean_dte_um);
        let [first, last] = [0, mapped.rows.len() - 1].map(|row| mapped.rows.get(row).unwrap().unwrap());
        assert!(first.displacement.len() == first.velocity.len() && last.time > first.time);
        assert_eq!(first.displacement.len(), scene.gears()[1].body.as_ref().map_or(0, |b| b.free.len()));
    }
}

/// Flanks that stand out let the driven gear lead at rest: the lag of the driving flanks is below zero, which is a place
/// and no size. The pair, whose coast flanks stand out as much, moves on its map as it does on the contact itself.
#[test]
fn a_pair_that_leads_at_rest_moves_on_its_map() {
    let leading = |model: &str| {
        let light = small(model).set("operation.torque_nm", 30.0).set("motion.warm_up_cycles", 50);
        let sloped = ["pinion", "wheel"].map(|gear| format!("{gear}.modification.profile_slope_um"));
        built(sloped.iter().fold(light, |scene, key| scene.set(key, -60.0)))
    };
    let exact = MotionAnalysis::new(&leading("reduced")).solve().unwrap_or_else(|e| panic!("{e}"));
    let mapped = LumpedAnalysis::new(&leading("mapped")).solve().unwrap_or_else(|e| panic!("{e}"));
    let at_rest = exact.headline.mean_ste_um;
    assert!(at_rest < 0.0, "the driven gear lags by {at_rest} um at rest");
    let [mean, range] = [exact.headline.mean_dte_um, exact.headline.peak_to_peak_dte_um];
    let off = (mapped.headline.mean_dte_um - mean).abs();
    assert!(off < 1e-2 * range, "mean {mean} um, on the map {} um", mapped.headline.mean_dte_um);
}

/// With friction, too: held at the driver, and on bearings that its forces deflect. A map with friction is off by up to a
/// thousandth of the deflection, here half a per cent of the peak to peak, beside half a per cent as without.
#[test]
fn it_rubs_as_the_reduced_model() {
    for change in [|s: SceneBuilder| s, on_bearings].into_iter().take(testing::cases(1, 2)) {
        let rough = |model: &str| {
            built(change(small(model)).set("contact.friction", 0.08).set("motion.steps_per_mesh_cycle", 96))
        };
        let exact = MotionAnalysis::new(&rough("reduced")).solve().unwrap_or_else(|e| panic!("{e}"));
        let mapped = LumpedAnalysis::new(&rough("mapped")).solve().unwrap_or_else(|e| panic!("{e}"));
        let smooth = LumpedAnalysis::new(&built(change(small("mapped")))).solve().unwrap_or_else(|e| panic!("{e}"));
        let [range, b, without] = [
            exact.headline.peak_to_peak_dte_um,
            mapped.headline.peak_to_peak_dte_um,
            smooth.headline.peak_to_peak_dte_um,
        ];
        println!("peak to peak {range} um, on the map {b} um, without friction {without} um");
        assert!((b / range - 1.0).abs() < 1e-2, "peak to peak {range} um, on the map {b} um");
        let off = (mapped.headline.mean_dte_um / exact.headline.mean_dte_um - 1.0).abs();
        assert!(off < 1e-3, "means are off by {off:e}");
        assert!((without / b - 1.0).abs() > 7e-3, "friction changes {without} um to {b} um");
    }
}

/// Cumulative pitch errors of a gear, um.
fn pitch_errors(teeth: u32, amount: f64) -> Vec<f64> {
    (0..teeth).map(|i| amount * (f64::from(teeth) + 2.4 * f64::from(i * i)).sin()).collect()
}

fn with_pitch_errors(scene: SceneBuilder, amount: f64) -> SceneBuilder {
    let pinion = scene.set("pinion.pitch_errors_um", pitch_errors(24, amount));
    pinion.set("wheel.pitch_errors_um", pitch_errors(31, amount))
}

/// Pitch errors of all teeth act on the map as in the contact itself, over more than a turn of the wheel; how far they are
/// off is told. On the coast flanks they turn their sign.
#[test]
fn pitch_errors_act_on_the_map_as_in_the_contact() {
    let turning = |model: &str| {
        let scene = moving(model).set("drive.by", "speed").set("motion.run", "span").set("analysis.cycles", 35);
        built(with_pitch_errors(scene.set("motion.mesh_damping_ratio", 0.1), 4.0))
    };
    let exact = MotionAnalysis::new(&turning("reduced")).solve().unwrap_or_else(|e| panic!("{e}"));
    let mapped = LumpedAnalysis::new(&turning("mapped")).solve().unwrap_or_else(|e| panic!("{e}"));
    let (a, b) = (&exact.headline, &mapped.headline);
    let told = mapped.remarks.iter().find(|said| said.code() == "pitch_errors_on_map").expect("their error is told");
    println!("{told}: {} beside {} um", b.peak_to_peak_dte_um, a.peak_to_peak_dte_um);
    let off = b.peak_to_peak_dte_um / a.peak_to_peak_dte_um - 1.0;
    assert!(off.abs() < 0.01, "peak to peak {} um, on the map {} um", a.peak_to_peak_dte_um, b.peak_to_peak_dte_um);
    let off = (b.mean_dte_um - a.mean_dte_um).abs();
    assert!(off < 2e-3 * a.mean_dte_um, "mean {} um, on the map {} um", a.mean_dte_um, b.mean_dte_um);
    let alike = built(moving("mapped").set("drive.by", "speed").set("motion.run", "span").set("analysis.cycles", 35));
    let alike = LumpedAnalysis::new(&alike).solve().unwrap_or_else(|e| panic!("{e}")).headline.peak_to_peak_dte_um;
    assert!(b.peak_to_peak_dte_um > 1.3 * alike, "{} um beside {alike} um without errors", b.peak_to_peak_dte_um);
}

/// A load that swings through zero presses the coast flanks: forces on either side and the way between them are those
/// of the contact itself.
#[test]
fn both_flanks_press_under_a_load_that_swings() {
    for amount in [0.0, 3.0].into_iter().take(testing::cases(1, 2)) {
        both_flanks_press(amount);
    }
}

fn both_flanks_press(errors: f64) {
    let swinging = |model: &str| {
        let scene = moving(model).set("operation.torque_nm", 100.0).set("operation.speed_rpm", 1000.0);
        let apart = scene.set("pinion.thickness_allowance_mm", 0.02).set("wheel.thickness_allowance_mm", 0.02);
        let loaded = apart.set("load.amplitude_nm", 200.0).set("load.frequency_hz", 300.0).set("drive.by", "speed");
        let all = loaded.set("motion.run", "span").set("analysis.cycles", 8).set("motion.mesh_damping_ratio", 0.1);
        built(if errors > 0.0 { with_pitch_errors(all, errors) } else { all })
    };
    let allowed = if errors > 0.0 { 2e-2 } else { 5e-3 };
    let exact = MotionAnalysis::new(&swinging("reduced")).solve().unwrap_or_else(|e| panic!("{e}"));
    let mapped = LumpedAnalysis::new(&swinging("mapped")).solve().unwrap_or_else(|e| panic!("{e}"));
    let (a, b) = (&exact.headline, &mapped.headline);
    let coast = [a.max_coast_normal_force_n, b.max_coast_normal_force_n.unwrap()];
    assert!(coast[0] > 1000.0, "the coast flanks press with {} N only", coast[0]);
    assert!((coast[1] / coast[0] - 1.0).abs() < allowed, "coast force {} N, on the map {} N", coast[0], coast[1]);
    let way = [a.peak_to_peak_dte_um, b.peak_to_peak_dte_um];
    assert!((way[1] / way[0] - 1.0).abs() < allowed, "peak to peak {} um, on the map {} um", way[0], way[1]);
    assert_eq!(a.certificate.flanks.rows_on_both_flanks, 0, "the backlash keeps the flanks apart");
    assert_eq!(a.certificate.flanks.flank_coupling_bound_um, 0.0);
}

/// Gears are made once for all values of a key that is the pair's, not the map's; each value has its own damping.
#[test]
fn a_sweep_over_damping_is_what_each_value_gives_alone() {
    let at = |ratio: f64| built(small("mapped").set("motion.mesh_damping_ratio", ratio));
    let scenes = [0.05, 0.2].map(|ratio| (ratio, at(ratio)));
    let options = SweepOptions {
        key: "motion.mesh_damping_ratio".into(),
        ways: vec![SweepWay::Apart],
        every: SectionEvery::MeshCycle,
        quantity: LumpedQuantity::new("dte_um", |row| row.transmission_error_um),
        points: 2,
        stretches: 0,
    };
    let swept = KeySweep::new(&scenes, &options).solve().unwrap_or_else(|e| panic!("{e}"));
    for (point, (ratio, scene)) in swept.points.iter().zip(&scenes) {
        let alone = LumpedAnalysis::new(scene).solve().unwrap_or_else(|e| panic!("{e}"));
        let [a, b] = [point.peak_to_peak(), alone.headline.peak_to_peak_dte_um];
        // As nearly as it was to repeat itself.
        assert!((a / b - 1.0).abs() < 1e-3, "damping ratio {ratio}: {a} um in the sweep, {b} um alone");
    }
    assert!(swept.points[1].peak_to_peak() < swept.points[0].peak_to_peak(), "more damping, less vibration");
}
