//! A pair in motion as the gearbox of two held shafts.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::path::Path;

use analysis::{
    Context, Ending, NoObserver,
    lumped::LumpedAnalysis,
    motion::{MotionAnalysis, MotionSpectrum},
    solve,
};
use scene::{
    Model, Scene, SceneBuilder,
    gearbox::{Gearbox, GearboxOfPair, gearbox_of_moving_pair, gearbox_of_pair},
};

/// Dynamic transmission error (um) at the rows of a pair, its spectrum where that is of all rows, and steps between two rows.
fn alone(scene: &Scene) -> (Vec<f64>, Option<MotionSpectrum>, u32) {
    if scene.analysis.model == Model::Mapped {
        let found = LumpedAnalysis::new(scene).solve().unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        // The first row is the start.
        let errors = found.rows.series(1..usize::MAX, |r| r.transmission_error_um).unwrap();
        return (errors, None, found.headline.steps_per_row);
    }
    let found = MotionAnalysis::new(scene).solve().unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let motion = scene.motion.as_ref().unwrap();
    let cycle_s = 60.0 / (f64::from(scene.driver_teeth()) * scene.operation.speed_rpm);
    let steps = f64::from(motion.steps_per_resonance) * found.headline.mesh_resonance_hz * cycle_s;
    let per_row = (steps / f64::from(motion.steps_per_mesh_cycle)).ceil().max(1.0);
    (found.rows.series(0..usize::MAX, |r| r.dte_um).unwrap(), found.spectrum, per_row as u32)
}

/// The same of its gearbox, the row at the start left out.
fn as_gearbox(scene: &Scene, per_row: u32) -> (Vec<f64>, MotionSpectrum) {
    let (errors, spectrum) = moved(scene, &gearbox_of_moving_pair(scene, per_row).unwrap().unwrap());
    (errors, spectrum.unwrap())
}

/// The same of the text of a gearbox file; no spectrum of a run-up.
fn moved(scene: &Scene, text: &str) -> (Vec<f64>, Option<MotionSpectrum>) {
    let folder = tempfile::tempdir().unwrap();
    let file = Gearbox::parse(text, &folder.path().join("held.toml")).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let found = solve(&file, Context::new(&mut NoObserver)).and_then(Ending::finished);
    let moved = found.unwrap_or_else(|e| panic!("{}: {e}", scene.name)).motion.unwrap();
    let errors = moved.rows.series(1..usize::MAX, |row| 1e3 * row.meshes[0].transmission_error).unwrap();
    (errors, moved.spectrum)
}

/// Largest difference of both over the peak to peak, of rows and of lines of the spectrum.
fn off(scene: &Scene) -> f64 {
    let (wanted, spectrum, per_row) = alone(scene);
    let (found, lines) = as_gearbox(scene, per_row);
    // A settled motion on maps has its start among its rows.
    let count = found.len().min(wanted.len());
    assert!(found.len() - count <= 1 && wanted.len() == count, "{}: {} rows", scene.name, found.len());
    let [low, high] = wanted.iter().fold([f64::MAX, f64::MIN], |[l, h], x| [l.min(*x), h.max(*x)]);
    let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
    let of_lines = spectrum.map_or(0.0, |own| {
        assert_eq!(own.orders, lines.orders, "{}", scene.name);
        apart(&own.amplitudes[0], &lines.amplitudes[0])
    });
    apart(&found, &wanted).max(of_lines) / (high - low)
}

/// A small pair in motion, with what is changed of it.
pub fn small(changes: impl Fn(SceneBuilder) -> SceneBuilder) -> Scene {
    let base = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0).torque_nm(300.0);
    let meshed = ["pinion.mesher", "wheel.mesher"].iter().fold(base, |scene, gear| {
        let keys = [("order", 1), ("sector_teeth", 1), ("elements_profile", 2), ("elements_thickness", 2)];
        let all = keys.iter().chain(&[("elements_face", 3), ("elements_rim", 1)]);
        all.fold(scene, |scene, (key, value)| scene.set(&format!("{gear}.{key}"), *value))
    });
    let moving = meshed
        .set("operation.speed_rpm", 3000.0)
        .set("contact.slices", 8)
        .set("analysis.kind", "dynamic")
        .set("analysis.positions_per_cycle", 8)
        .set("analysis.cycles", 1)
        .set("drive.by", "speed")
        .set("motion.run", "span")
        .set("motion.method", "newmark")
        .set("motion.steps_per_mesh_cycle", 32);
    changes(moving).build().unwrap_or_else(|e| panic!("{e}"))
}

/// The same with a ring for its wheel.
fn ring(pair: SceneBuilder) -> SceneBuilder {
    let teeth = pair.set("pinion.teeth", 20).set("wheel.teeth", -52).set("pair.addendum_coefficient", 0.85);
    teeth.set("pinion.profile_shift", 0.3).set("wheel.profile_shift", -0.1)
}

/// The same with normal modes of both gears.
fn modes(pair: SceneBuilder) -> SceneBuilder {
    // Rows are the steps: a pair with modes takes steps by their highest frequency.
    pair.set("analysis.model", "reduced+modes").set("motion.steps_per_resonance", 0).set("modes.count", 4)
}

type Change = fn(SceneBuilder) -> SceneBuilder;

/// Several keys in a case; [`ONE_KEY`] has them one by one, and more of them.
const SEVERAL_KEYS: [(&str, f64, Change); 9] = [
    ("newmark without damper", 1e-8, |s| s.set("motion.mesh_damping_ns_per_mm2", 0.0)),
    ("energy, events, wheel drives", 1e-7, |s| {
        let stops = s.set("motion.stop_at_events", true).set("motion.method", "energy");
        stops.set("operation.driver", "wheel")
    }),
    ("rk4, damper, clockwise, driving flanks", 1e-8, |s| {
        let damped = s.set("motion.method", "rk4").set("motion.mesh_damping_ns_per_mm2", 0.2);
        damped.set("operation.rotation", "cw").set("contact.flanks", "driving")
    }),
    ("dormand-prince, balanced, friction", 1e-8, |s| {
        let method = s.set("motion.method", "dormand-prince");
        method.set("drive.by", "torque").set("contact.friction", 0.05)
    }),
    ("ring drives, generalised-alpha, friction", 1e-8, |s| {
        let turned = ring(s).set("operation.driver", "wheel").set("contact.friction", 0.05);
        turned.set("motion.method", "generalised-alpha")
    }),
    ("modes, friction, generalised-alpha", 1e-8, |s| {
        modes(s).set("contact.friction", 0.05).set("motion.method", "generalised-alpha")
    }),
    ("modes, shooting", 1e-8, |s| {
        let shot = modes(s).set("motion.run", "shooting").set("motion.mesh_damping_ratio", 0.1);
        shot.set("motion.periodic_tolerance", 1e-11)
    }),
    // With both flanks a gearbox keeps the mass of both, a pair that of the driving ones: two models, 4e-4 apart.
    ("modes with mass of the flanks", 1e-8, |s| {
        let kept = modes(s).set("modes.boundary", "consistent").set("modes.fixed_modes", 1);
        kept.set("contact.flanks", "driving")
    }),
    ("mapped", 1e-8, |s| {
        let maps = s.set("analysis.model", "mapped").set("contact.flanks", "driving");
        maps.set("motion.run", "steady").set("motion.periodic_tolerance", 1e-11)
    }),
];

/// One key in a case.
const ONE_KEY: [(&str, f64, Change); 14] = [
    ("generalised-alpha", 1e-8, |s| s.set("motion.method", "generalised-alpha")),
    ("rk4", 1e-8, |s| s.set("motion.method", "rk4")),
    ("dormand-prince", 1e-8, |s| s.set("motion.method", "dormand-prince")),
    ("energy", 1e-7, |s| s.set("motion.method", "energy").set("motion.mesh_damping_ns_per_mm2", 0.0)),
    ("shooting", 1e-8, |s| s.set("motion.run", "shooting").set("motion.periodic_tolerance", 1e-11)),
    ("damper", 1e-8, |s| s.set("motion.mesh_damping_ns_per_mm2", 0.2)),
    ("balanced", 1e-8, |s| s.set("drive.by", "torque")),
    ("friction", 1e-8, |s| s.set("contact.friction", 0.05)),
    ("wheel drives", 1e-8, |s| s.set("operation.driver", "wheel")),
    ("clockwise", 1e-8, |s| s.set("operation.rotation", "cw")),
    ("driving flanks", 1e-8, |s| s.set("contact.flanks", "driving")),
    ("ring", 1e-8, ring),
    ("modes", 1e-8, modes),
    ("modes, friction", 1e-8, |s| modes(s).set("contact.friction", 0.05)),
];

/// Shafts held, a pair in motion is its own gearbox, row by row: with every method, drive, way and side, friction and
/// dampers. Both are machines of one program: what is held here is that the file of a gearbox says the same as the scene, so
/// that one case may hold several keys. What motions are held against is in `gearbox_laws`. What is left is round-off of
/// places, which the discrete gradient (`energy`) divides by its path.
#[test]
fn a_pair_in_motion_is_a_gearbox_of_held_shafts() {
    let count = testing::cases(SEVERAL_KEYS.len(), SEVERAL_KEYS.len() + ONE_KEY.len());
    let mut wrong = Vec::new();
    for (name, bound, change) in SEVERAL_KEYS.into_iter().chain(ONE_KEY).take(count) {
        let found = off(&small(change));
        println!("{name}: {found:.1e} of the peak to peak, bound {bound:.0e}");
        wrong.extend((found.is_nan() || found > bound).then_some(name));
    }
    assert!(wrong.is_empty(), "off by more: {wrong:?}");
}

/// So are pairs of the scenes that run from the start on; others that move settle first, and end where they repeat
/// themselves to what they ask for.
#[test]
fn moving_pairs_of_the_scenes_are_gearboxes_of_held_shafts() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/envelope");
    let all = [
        ("F06-rotation.toml", 3e-7),
        ("F24-explicit-limit.toml", 1e-8),
        ("F33-leakage.toml", 1e-7),
        ("F20-step-at-impact.toml", 1e-8),
        ("F23-numerical-damping.toml", 1e-8),
        ("F30-restart.toml", 1e-8),
    ];
    let mut wrong = Vec::new();
    for &(name, bound) in &all[..testing::cases(3, all.len())] {
        let scene = Scene::read(&scenes.join(name)).unwrap_or_else(|e| panic!("{e}"));
        let found = off(&scene);
        println!("{name}: {found:.1e} of the peak to peak, bound {bound:.0e}");
        wrong.extend((found.is_nan() || found > bound).then_some(name));
    }
    assert!(wrong.is_empty(), "off by more: {wrong:?}");
}

/// The same with rows at every step.
fn rows_are_steps(pair: SceneBuilder) -> SceneBuilder {
    pair.set("motion.steps_per_resonance", 0).set("motion.steps_per_mesh_cycle", 128)
}

/// The same with its wheel in bearings.
fn in_bearings(pair: SceneBuilder) -> SceneBuilder {
    let free = pair.set("wheel.body.free", vec!["x", "y", "z", "rx", "ry"]);
    let along = ["x", "y", "z"].iter().fold(free, |s, axis| {
        let held = s.set(&format!("wheel.bearing.stiffness_{axis}_n_per_mm"), 2e5);
        held.set(&format!("wheel.bearing.damping_{axis}_ns_per_mm"), 2.0)
    });
    let tilts = along.set("wheel.bearing.stiffness_rx_nmm_per_rad", 1e8);
    // A gearbox has no damping of tilts.
    tilts.set("wheel.bearing.stiffness_ry_nmm_per_rad", 2e8).set("wheel.bearing.damping_ratio", 0.0)
}

/// The file that `init --of-pair` writes moves as the pair: with friction, a load over time, and the wheel in its bearings, to
/// what its light shaft weighs. What it does not have is named; so is a damping ratio, which is of the stiffness of gears that
/// have tilted in their bearings there, and in a pair of gears that have not.
#[test]
fn the_file_of_a_whole_pair_moves_as_the_pair() {
    let all: [(&str, f64, Change); 3] = [
        ("friction", 1e-8, |s| rows_are_steps(s).set("contact.friction", 0.05)),
        ("load over time", 1e-8, |s| rows_are_steps(s).set("load.amplitude_nm", 40.0).set("load.frequency_hz", 700.0)),
        ("bearings", 1e-6, |s| in_bearings(rows_are_steps(s)).set("motion.mesh_damping_ns_per_mm2", 0.08)),
    ];
    for (name, bound, change) in all {
        let scene = small(change);
        let GearboxOfPair { text, left } = gearbox_of_pair(&scene).unwrap();
        assert_eq!(left, [""; 0], "{name}");
        assert!(!text.contains("tilted in their bearings"), "{name}: {text}");
        let (wanted, _, _) = alone(&scene);
        let (found, _) = moved(&scene, &text);
        assert_eq!(found.len(), wanted.len(), "{name}");
        let [low, high] = wanted.iter().fold([f64::MAX, f64::MIN], |[l, h], x| [l.min(*x), h.max(*x)]);
        let off = found.iter().zip(&wanted).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs())) / (high - low);
        println!("{name}: {off:.1e} of the peak to peak");
        assert!(off < bound, "{name}: off by {off:.1e}");
    }
    let by_ratio = gearbox_of_pair(&small(in_bearings)).unwrap();
    assert!(
        by_ratio
            .text
            .contains("# `mesh_damping_ratio` is of the mesh stiffness of gears that have tilted in their bearings")
    );
    // What has no place in a gearbox file is named.
    let partly = small(|s| s.set("wheel.body.free", vec!["x"]).set("wheel.bearing.stiffness_x_n_per_mm", 1e6));
    let GearboxOfPair { text, left } = gearbox_of_pair(&partly).unwrap();
    assert!(
        left.iter().any(|own| own.contains("[wheel.bearing]")) && text.contains("# Left out: [wheel.bearing]"),
        "{left:?}"
    );
    assert!(text.contains("[motion]") && text.matches("held = true").count() >= 2, "{text}");
}

/// A ramp is the run-up of the gearbox that `init --of-pair` writes, row by row, whether it ends with a mesh cycle or not.
#[test]
fn a_ramp_of_a_pair_is_the_run_up_of_its_gearbox() {
    let of = |duration: f64| {
        let text =
            small(rows_are_steps).to_toml().replace("run = \"span\"", "run = \"ramp\"").replace("cycles = 1\n", "");
        let ramp = format!("\n[motion.ramp]\nfrom_rpm = 2000.0\nto_rpm = 4000.0\nduration_s = {duration:?}\n");
        Scene::parse(&(text + &ramp), Path::new("ramp.toml")).unwrap_or_else(|e| panic!("{e}"))
    };
    for duration in [4.0 / (24.0 * 3000.0 / 60.0), 0.003] {
        let scene = of(duration);
        let GearboxOfPair { text, left } = gearbox_of_pair(&scene).unwrap();
        assert_eq!(left, [""; 0], "{text}");
        assert!(text.contains("to_speed_rpm = 4000.0") && text.contains("duration_s = "), "{text}");
        let ([wanted, found], cycle) = ([alone(&scene).0, moved(&scene, &text).0], 128);
        assert_eq!([wanted.len(), found.len()], [4 * cycle; 2]);
        let [low, high] = wanted.iter().fold([f64::MAX, f64::MIN], |[l, h], x| [l.min(*x), h.max(*x)]);
        let off = found.iter().zip(&wanted).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs())) / (high - low);
        println!("{duration} s: {off:.1e} of the peak to peak");
        assert!(off < 1e-8, "{duration} s: off by {off:.1e}");
    }
}

/// What held shafts do not have is no gearbox: gears on bearings, torques over time.
#[test]
fn other_motions_of_pairs_have_no_gearbox() {
    let all: [Change; 3] = [
        |s| s.set("wheel.body.free", vec!["x"]).set("wheel.bearing.stiffness_x_n_per_mm", 1e6),
        |s| s.set("load.amplitude_nm", 10.0).set("load.frequency_hz", 10.0),
        |s| s.set("drive.by", "torque").set("drive.torque_nm", 10.0),
    ];
    for change in all {
        assert_eq!(gearbox_of_moving_pair(&small(change), 1).unwrap(), None);
    }
}
