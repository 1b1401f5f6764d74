//! Which wave and which tooth makes which order of the transmission error: linear shares against runs without them.
#![allow(clippy::print_stdout, reason = "the figures are what the tests are for")]

use std::f64::consts::TAU;
use std::fmt::Write as _;

use analysis::{
    StaticAnalysis, StaticResult,
    flank_orders::{FlankOrders, FlankPart, TeLine},
    motion::MotionAnalysis,
};
use scene::{Scene, SceneBuilder};

const TEETH: u32 = 30;
const GHOST: f64 = 61.0;

/// Depths (um) of all teeth of a gear over roll angle (rad) and tooth, as a file.
fn topography(folder: &std::path::Path, name: &str, of: impl Fn(u32, f64) -> f64) -> String {
    let mut text = "tooth, roll_deg, -10, 10\n".to_owned();
    for tooth in 0..TEETH {
        for i in 0..240 {
            let roll = 12.0 + 0.085 * f64::from(i);
            let depth = of(tooth, roll.to_radians());
            let _ = writeln!(text, "{tooth}, {roll}, {depth}, {depth}");
        }
    }
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_string_lossy().into_owned()
}

fn scene(topography: &str, torque_nm: f64) -> Scene {
    turn(topography, torque_nm).set("output.flank_orders", true).build().unwrap()
}

fn turn(topography: &str, torque_nm: f64) -> SceneBuilder {
    let mut builder = Scene::builder().pinion(TEETH, 0.0).wheel(TEETH).normal_module_mm(3.0).face_width_mm(20.0);
    for gear in ["pinion", "wheel"] {
        builder = builder.set(&format!("{gear}.thickness_allowance_mm"), 0.05);
        for (key, count) in [
            ("order", 1),
            ("elements_profile", 2),
            ("elements_thickness", 2),
            ("elements_face", 2),
            ("elements_rim", 1),
        ] {
            builder = builder.set(&format!("{gear}.mesher.{key}"), count);
        }
    }
    builder
        .torque_nm(torque_nm)
        .set("pinion.modification.drive.topography", topography)
        .set("analysis.turn", "pinion")
        .set("analysis.positions_per_cycle", 8)
        .set("contact.slices", 6)
}

fn solved(topography: &str, torque_nm: f64) -> (FlankOrders, StaticResult) {
    let scene = scene(topography, torque_nm);
    assert_eq!(scene.analysis.cycles, TEETH, "one turn of the pinion");
    let result = StaticAnalysis::new(&scene).solve().unwrap();
    (FlankOrders::of(&result.scene, &result.pair, &result.history).unwrap(), result)
}

fn line(found: &FlankOrders, order: f64) -> &TeLine {
    found.lines.iter().find(|l| (l.order[0] - order).abs() < 1e-9).unwrap()
}

/// Complex amplitude of an order of the pinion's turn.
fn of_order(result: &StaticResult, order: f64) -> [f64; 2] {
    let te: Vec<f64> = result.history.positions.iter().map(|p| 1e3 * p.transmission_error).collect();
    let at = |i: usize| TAU * order * i as f64 / te.len() as f64;
    [f64::cos, f64::sin].map(|f| 2.0 * te.iter().enumerate().map(|(i, x)| x * f(at(i))).sum::<f64>() / te.len() as f64)
}

/// A ghost order under slopes that scatter: its wave is found on the flanks, and what it makes of the order under load is
/// what a run without it lacks; so is what one tooth makes.
#[test]
fn shares_are_what_a_run_without_them_lacks() {
    let folder = tempfile::tempdir().unwrap();
    let wave = |tooth: u32, u: f64| 0.3 * (GHOST * (u - TAU * f64::from(tooth) / f64::from(TEETH)) + 0.7).cos();
    let slope = |tooth: u32, u: f64| 0.8 * f64::from(tooth * tooth).sin() * (u - 0.38) / 0.1;
    let file = |name: &str, of: &dyn Fn(u32, f64) -> f64| topography(folder.path(), name, of);
    for torque in [300.0, 60.0].into_iter().take(testing::cases(1, 2)) {
        let (with, whole) = solved(&file("with.csv", &|k, u| wave(k, u) + slope(k, u)), torque);
        let (_, less_wave) = solved(&file("less.csv", &|k, u| slope(k, u)), torque);
        let (_, less_tooth) =
            solved(&file("tooth.csv", &|k, u| if k == 7 { 0.0 } else { wave(k, u) + slope(k, u) }), torque);
        let own = line(&with, GHOST);
        assert!((own.wave_um[0] - 0.3).abs() < 0.005, "{own:?}");
        let lacks = |less: &StaticResult, order: f64| {
            let [a, b] = [of_order(&whole, order), of_order(less, order)];
            (a[0] - b[0]).hypot(a[1] - b[1])
        };
        let part = |order: f64, part: FlankPart| {
            let own = with.shares.iter().find(|s| (s.order[0] - order).abs() < 1e-9 && s.part == part);
            *own.unwrap_or_else(|| panic!("no {part:?} in order {order}"))
        };
        let ghost = part(GHOST, FlankPart::Wave(GHOST as u32));
        let wanted = lacks(&less_wave, GHOST);
        println!(
            "{torque} N m: wave 61 makes {:.4} um of {:.4}, runs {wanted:.4}; share {:.3}",
            ghost.amplitude_um, own.ste_um, ghost.share
        );
        assert!((ghost.amplitude_um / wanted - 1.0).abs() < 0.03, "{} um, runs {wanted} um", ghost.amplitude_um);
        assert!((ghost.share - 1.0).abs() < 0.1, "{ghost:?}");
        // One tooth in thirty: what it makes of the turn's low orders, where no stiffness hides it.
        let low = with.shares.iter().find(|s| s.part == FlankPart::Tooth(7)).copied();
        let low = low.unwrap_or_else(|| panic!("tooth 7 makes nothing: {:?}", with.shares));
        let wanted = lacks(&less_tooth, low.order[0]);
        println!("tooth 7 makes {:.4} um of order {}, runs {wanted:.4}", low.amplitude_um, low.order[0]);
        assert!((low.amplitude_um / wanted - 1.0).abs() < 0.05, "{} um, runs {wanted} um", low.amplitude_um);
    }
}

/// A wave that is the same at all heights of a helical gear crosses the contact lines: what it makes of the transmission error is
/// little, and its share says so.
#[test]
fn a_wave_across_the_contact_lines_makes_little() {
    let folder = tempfile::tempdir().unwrap();
    let wave = |tooth: u32, roll: f64| 0.3 * (GHOST * (roll - TAU * f64::from(tooth) / f64::from(TEETH))).cos();
    let file = topography(folder.path(), "wave.csv", wave);
    let scene = turn(&file, 150.0).set("pinion.helix_angle_deg", 20.0).set("contact.slices", 24);
    let scene = scene.set("output.flank_orders", true).build().unwrap();
    let result = StaticAnalysis::new(&scene).solve().unwrap();
    let found = FlankOrders::of(&result.scene, &result.pair, &result.history).unwrap();
    let own = line(&found, GHOST);
    let part = FlankPart::Wave(GHOST as u32);
    let share = found.shares.iter().find(|s| (s.order[0] - GHOST).abs() < 1e-9 && s.part == part).unwrap();
    println!("{own:?}: {share:?}");
    assert!((own.wave_um[0] - 0.3).abs() < 0.01 && own.ste_um < 0.15, "{own:?}");
    assert!((share.amplitude_um / own.flanks_um - 1.0).abs() < 0.1 && (share.share - 1.0).abs() < 0.15, "{share:?}");
}

/// An equal deviation of all flanks f is a transmission error f/cos beta_b: rates by the gaps of a position add up to
/// 1/cos beta_b, also with friction and several pairs.
#[test]
fn rates_by_gaps_add_up_to_a_turn_of_all() {
    for (beta, friction) in [(0.0, 0.0), (20.0, 0.0), (20.0, 0.08)] {
        let scene = Scene::builder()
            .pinion(24, beta)
            .wheel(31)
            .normal_module_mm(3.0)
            .face_width_mm(20.0)
            .torque_nm(200.0)
            .set("contact.friction", friction)
            .set("contact.slices", 8)
            .set("analysis.positions_per_cycle", 5)
            .set("pinion.pitch_errors_um", vec![0.5; 24])
            .set("output.flank_orders", true)
            .build()
            .unwrap();
        let result = StaticAnalysis::new(&scene).solve().unwrap();
        let wanted = 1.0 / result.pair.base_helix_angle().cos();
        for p in &result.history.positions {
            let sum: f64 = p.pairs.iter().flat_map(|pair| &pair.gap_rates).sum();
            assert!(
                (sum / wanted - 1.0).abs() < 2e-3,
                "beta {beta}, friction {friction}, phase {}: {sum}, not {wanted}",
                p.mesh_phase
            );
        }
    }
}

/// One turn of 30 teeth at 32 positions a mesh: flanks by tooth take at most 1.5 times what one flank for all teeth takes, the
/// best of three runs each, in turn.
#[test]
#[ignore = "half a minute, and times of a quiet machine"]
fn flanks_by_tooth_cost_half_as_much_again_at_most() {
    let folder = tempfile::tempdir().unwrap();
    let wave = |tooth: u32, roll: f64| 0.3 * (GHOST * (roll - TAU * f64::from(tooth) / f64::from(TEETH))).cos();
    let files = [("one.csv", false), ("by_tooth.csv", true)].map(|(name, by_tooth)| {
        topography(folder.path(), name, |tooth, roll| wave(if by_tooth { tooth } else { 0 }, roll))
    });
    for helix_deg in [0.0, 20.0] {
        let scenes = files.each_ref().map(|file| {
            let pair = Scene::builder().pinion(TEETH, helix_deg).wheel(TEETH).normal_module_mm(3.0).face_width_mm(20.0);
            let pair = ["pinion", "wheel"]
                .iter()
                .fold(pair, |pair, gear| pair.set(&format!("{gear}.thickness_allowance_mm"), 0.05));
            let pair = pair.torque_nm(150.0).set("pinion.modification.drive.topography", file.as_str());
            pair.set("analysis.turn", "pinion").set("analysis.positions_per_cycle", 32).build().unwrap()
        });
        let mut best = [f64::INFINITY; 2];
        for k in [0, 1, 0, 1, 0, 1] {
            let start = std::time::Instant::now();
            StaticAnalysis::new(&scenes[k]).solve().unwrap();
            best[k] = best[k].min(start.elapsed().as_secs_f64());
        }
        println!("helix {helix_deg} deg: {:.2} times", best[1] / best[0]);
        assert!(best[1] <= 1.5 * best[0], "{best:?} s");
    }
}

/// A wave with fewer than two positions a period shows at another order, and that is told, with the positions that would do.
#[test]
fn an_aliased_wave_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let wave = |tooth: u32, roll: f64| 0.3 * (GHOST * (roll - TAU * f64::from(tooth) / f64::from(TEETH))).cos();
    let file = topography(folder.path(), "wave.csv", wave);
    let told = |positions: u32| {
        let mut scene = scene(&file, 300.0);
        scene.analysis.positions_per_cycle = positions;
        let remarks = StaticAnalysis::new(&scene).solve().unwrap().history.remarks;
        remarks.into_iter().find(|own| own.code() == "aliased_wave").map(|own| own.to_string())
    };
    assert_eq!(told(8), None);
    let said = told(4).unwrap();
    assert!(said.contains("order 61") && said.contains("5 would do"), "{said}");
}

/// Whole turns of a slow motion have the order of a wave in the dynamic transmission error with the amplitude that it has at
/// rest, beside the wave itself; at rest, mesh cycles that are no whole turn are told.
#[test]
fn a_motion_has_the_orders_of_its_flanks() {
    let folder = tempfile::tempdir().unwrap();
    let wave = |tooth: u32, roll: f64| 0.3 * (GHOST * (roll - TAU * f64::from(tooth) / f64::from(TEETH))).cos();
    let file = topography(folder.path(), "wave.csv", wave);
    let at_rest = |cycles: Option<u32>| {
        let mut scene = scene(&file, 300.0);
        scene.analysis.cycles = cycles.unwrap_or(scene.analysis.cycles);
        scene.analysis.positions_per_cycle = if cycles.is_some() { 8 } else { 32 };
        StaticAnalysis::new(&scene).solve().unwrap()
    };
    let no_turn = |result: &StaticResult| result.history.remarks.iter().any(|own| own.code() == "orders_of_no_turn");
    let whole = at_rest(None);
    assert!(!no_turn(&whole) && no_turn(&at_rest(Some(31))));
    let moving = turn(&file, 300.0).set("analysis.kind", "dynamic").set("operation.speed_rpm", 300.0);
    let moving = moving.set("motion.steps_per_mesh_cycle", 32).build().unwrap();
    let moved = MotionAnalysis::new(&moving).solve().unwrap();
    let (spectrum, waves) = (moved.spectrum.unwrap(), moved.flank_waves);
    let line = spectrum.orders.iter().position(|o| (o * f64::from(TEETH) - GHOST).abs() < 1e-9).unwrap();
    let [own, wheel] = waves.amplitudes_um(spectrum.orders[line]);
    assert!((own - 0.3).abs() < 0.005 && wheel == 0.0, "{own}, {wheel}");
    let (dte, [a, b]) = (spectrum.amplitudes[0][line], of_order(&whole, GHOST));
    println!("order 61 at rest {:.4} um, in motion {dte:.4} um", a.hypot(b));
    assert!((dte / a.hypot(b) - 1.0).abs() < 0.03, "{dte} um in motion, {} um at rest", a.hypot(b));
}

/// Mesh cycles of a turn of either gear, and until the same teeth meet again.
#[test]
fn turns_are_counted_in_mesh_cycles() {
    let cycles = |word: &str| {
        let pair = Scene::builder().pinion(20, 0.0).wheel(30).normal_module_mm(3.0).face_width_mm(20.0);
        pair.torque_nm(100.0).set("analysis.turn", word).build().unwrap().analysis.cycles
    };
    assert_eq!(["pinion", "wheel", "hunting"].map(cycles), [20, 30, 60]);
}
