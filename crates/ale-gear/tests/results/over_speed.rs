//! Motions over speed as a user runs them: which inertias count, what a ramp is made for, speeds without a solution, a
//! pair without backlash.

use crate::util::{Scratch, column, motion_scene as scene, remark_words, repository};
use serde_json::Value;

fn run(scratch: &Scratch, more: &[&str]) -> Value {
    let words = [&["run", "a.toml", "--out", "o"], more].concat();
    let run = scratch.command(&words);
    assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
    serde_json::from_str(&scratch.read("o/summary.json")).unwrap()
}

fn number(of: &Value, key: &str) -> f64 {
    of[key].as_f64().unwrap_or_else(|| panic!("no {key}: {of}"))
}

fn warned(summary: &Value, word: &str) -> bool {
    summary["remarks"].as_array().unwrap().iter().any(|w| remark_words(w).contains(word))
}

fn sweep(from: f64, to: f64, speeds: u32, ways: &str) -> String {
    format!(
        "run = \"sweep\"\nperiodic_tolerance = 1e-3\nmesh_damping_ratio = 0.15\nsweep = {{ from_rpm = {from:?}, to_rpm = {to:?}, speeds = {speeds}, ways = [{ways}] }}\n"
    )
}

/// Two equal gears: with both free the equivalent mass is half of that with the driver held, and the resonance sqrt(2)
/// times as high. A sweep finds its largest answer there with either drive, and the summary says which inertias count.
#[test]
fn a_sweep_with_both_gears_free_has_its_resonance_where_both_inertias_say() {
    let drive = |by: &str| {
        let scratch =
            Scratch::new().file("a.toml", scene(1, "run = \"span\"\n") + &format!("[drive]\nby = \"{by}\"\n"));
        let all = run(&scratch, &[])["headline"].clone();
        (number(&all, "mesh_resonance_hz"), all["inertia"].clone())
    };
    let [(free_hz, free), (held_hz, held)] = [drive("torque"), drive("speed")];
    assert!((free_hz / held_hz - 2f64.sqrt()).abs() < 1e-9, "{free_hz} and {held_hz} Hz");
    assert!((number(&held, "equivalent_mass_kg") / number(&free, "equivalent_mass_kg") - 2.0).abs() < 1e-9);
    assert_eq!(free["moving_gears"], serde_json::json!(["pinion", "wheel"]));
    assert_eq!(held["moving_gears"], serde_json::json!(["wheel"]));
    for inertia in [&free, &held] {
        assert_eq!(
            [number(inertia, "mesh_resonance_both_free_hz"), number(inertia, "mesh_resonance_driver_held_hz")],
            [free_hz, held_hz]
        );
    }
    // Thirty teeth: the mesh frequency is half of the speed in 1/min.
    let [low, high] = [held_hz, free_hz].map(|hz| 2.0 * hz);
    let scratch =
        Scratch::new().file("a.toml", scene(1, &sweep(low, high, 2, "\"apart\"")) + "[drive]\nby = \"torque\"\n");
    let summary = run(&scratch, &[]);
    let dte = |scratch: &Scratch| column(&scratch.read("o/resonance.csv"), "peak_to_peak_dte_um");
    let free = dte(&scratch);
    assert!(free[1] > 1.3 * free[0], "both free: {free:?} um at {low:.0} and {high:.0}/min");
    assert_eq!(summary["headline"]["failed"], serde_json::json!([]));
    let scratch =
        Scratch::new().file("a.toml", scene(1, &sweep(low, high, 2, "\"apart\"")) + "[drive]\nby = \"speed\"\n");
    run(&scratch, &[]);
    let held = dte(&scratch);
    assert!(held[0] > 1.3 * held[1], "driver held: {held:?} um at {low:.0} and {high:.0}/min");
    // One equation in the lag: at its own resonance either pair swings alike.
    assert!((free[1] / held[0] - 1.0).abs() < 0.02, "{} and {} um", free[1], held[0]);
}

/// Both gears free is the default, of every run; a torque of its own still drives a span, and is refused where the run
/// says the speed.
#[test]
fn both_gears_are_free_unless_the_scene_holds_the_driver() {
    let by_default = Scratch::new().file("a.toml", scene(2, "run = \"span\"\n"));
    let summary = run(&by_default, &[]);
    assert_eq!(summary["inputs"]["drive"]["by"], "torque");
    let history = by_default.read("o/history.csv");
    let [pinion, wheel] = ["pinion_speed_rpm", "wheel_speed_rpm"].map(|n| column(&history, n));
    let swing = |of: &[f64]| of.iter().map(|n| (n.abs() - 1000.0).abs()).fold(0.0, f64::max);
    assert!(
        swing(&pinion) > 1e-3 && (swing(&pinion) / swing(&wheel) - 1.0).abs() < 1e-6,
        "{} and {}/min",
        swing(&pinion),
        swing(&wheel)
    );
    for (p, w) in pinion.iter().zip(&wheel) {
        // Equal gears: what one gains the other loses.
        assert!(((p - w) / 2000.0 - 1.0).abs() < 1e-12, "{p} and {w}/min");
    }
    let own = scene(2, &sweep(900.0, 1000.0, 2, "\"up\"")) + "[drive]\nby = \"torque\"\ntorque_nm = 150.0\n";
    let refused = Scratch::new().file("a.toml", own).ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(refused.stderr.contains("leave the torque out: it then balances the load"), "{}", refused.stderr);
}

/// A run-up through the resonance: the headline is the largest mesh cycle with its speed, not the mean over all of
/// them, and the files follow every cycle and order over speed.
#[test]
fn the_headline_of_a_run_up_is_its_largest_cycle_and_where() {
    let ramp = "run = \"ramp\"\nmesh_damping_ratio = 0.03\nramp = { from_rpm = 3000, to_rpm = 14000, duration_s = 0.03, waterfall_cycles = 8 }\n";
    let scratch = Scratch::new().file("a.toml", scene(0, ramp).replace("resonance = 0", "resonance = 10"));
    let summary = run(&scratch, &[]);
    let headline = &summary["headline"];
    let largest = &headline["ramp"]["peak_to_peak_dte_um"];
    let (value, mean) = (number(largest, "value"), number(&headline["ramp"], "mean_peak_to_peak_dte_um"));
    assert_eq!(number(headline, "peak_to_peak_dte_um"), value);
    assert!(value > 1.3 * mean, "largest {value} um, mean {mean} um");
    let cycles = scratch.read("o/cycles.csv");
    let all = column(&cycles, "peak_to_peak_dte_um");
    assert_eq!(all.len() as u64, headline["cycles"].as_u64().unwrap());
    let at = (0..all.len()).max_by(|&a, &b| all[a].total_cmp(&all[b])).unwrap();
    assert_eq!((all[at], column(&cycles, "driver_speed_rpm")[at]), (value, number(largest, "driver_speed_rpm")));
    assert!((number(largest, "mesh_frequency_hz") / (0.5 * number(largest, "driver_speed_rpm")) - 1.0).abs() < 1e-12);
    // The cuts are lines of the waterfall.
    let (cuts, waterfall) = (scratch.read("o/order_cuts.csv"), scratch.read("o/waterfall.csv"));
    let (orders, lines) = (column(&waterfall, "mesh_order"), column(&waterfall, "dte_um"));
    for (h, of) in headline["dte_harmonics_um"].as_array().unwrap().iter().enumerate() {
        let own = |name: &str, all: &str| column(all, name);
        let cut = own(&format!("dte_order_{}_um", h + 1), &cuts);
        let line: Vec<f64> =
            orders.iter().zip(&lines).filter(|(o, _)| **o == (h + 1) as f64).map(|(_, a)| *a).collect();
        assert_eq!(cut, line, "order {}", h + 1);
        assert_eq!(cut.iter().copied().fold(0.0, f64::max), of.as_f64().unwrap(), "order {}", h + 1);
    }
    // A mesh order meets the resonance within the ramp.
    let resonance = number(headline, "mesh_resonance_hz");
    let critical = headline["critical_speeds"].as_array().unwrap();
    let met = critical.iter().find(|c| c["excitation"] == "mesh order 1" && c["meets"] == "mesh resonance").unwrap();
    assert!((number(met, "driver_speed_rpm") / (2.0 * resonance) - 1.0).abs() < 1e-9, "{met}");
    let page = scratch.read("o/report.html");
    for title in [
        "Order cuts of the DTE",
        "Campbell diagram",
        "Peak to peak of the DTE in each mesh cycle",
        "Over speed",
        "of mesh frequency",
    ] {
        assert!(page.contains(title), "no {title}");
    }
    assert!(!page.contains("time [ms], last mesh cycles"));
}

/// A motion of a pair without backlash is told what that means, and the key that gives it some; a pair with some is
/// not.
#[test]
fn a_pair_without_backlash_is_told_in_motion() {
    let span = scene(1, "run = \"span\"\n");
    let none = span.replace("thickness_allowance_mm = 0.05\n", "");
    assert_ne!(span, none);
    let summary = run(&Scratch::new().file("a.toml", &none), &[]);
    assert!(warned(&summary, "no backlash") && warned(&summary, "`thickness_allowance_mm`"), "{}", summary["remarks"]);
    assert!(number(&summary["geometry"], "backlash_mm").abs() < 1e-6);
    let summary = run(&Scratch::new().file("a.toml", &span), &[]);
    assert!(!warned(&summary, "no backlash"), "{}", summary["remarks"]);
}

/// One value of a sweep without a solution does not take the others with it: its row says why, and a warning says so;
/// where none has one, the command fails.
#[test]
fn a_value_without_a_solution_leaves_the_others_alone() {
    let seed = std::fs::read_to_string(repository().join("scenes/seeds/004.toml")).unwrap();
    let own: String = seed
        .lines()
        .filter(|l| !l.starts_with("spectral_radius") && !l.starts_with("method"))
        .map(|l| format!("{l}\n"))
        .collect();
    let swept = |from: &str| {
        let scratch = Scratch::new().file("a.toml", &own);
        let words = "vary a.toml --out o --quiet --start carry --cycles 2 --settle 20 --lyapunov 0 --set motion.steps_per_resonance=0";
        let mut words: Vec<&str> = words.split(' ').collect();
        let range = format!("mesh.stiffness_n_per_um={from}:1e9:3:log");
        words.extend(["--vary", &range, "--set", "motion.method=\"rk4\""]);
        let done = scratch.command(&words);
        (scratch, done)
    };
    // Steps that a soft mesh stands blow an explicit method up on a hard one.
    let (scratch, done) = swept("1e3");
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    let csv = scratch.read("o/sweep.csv");
    for way in ["up", "down"] {
        let rows: Vec<&str> = csv.lines().filter(|l| l.starts_with(&format!("{way},"))).collect();
        assert_eq!(rows.len(), 3, "{csv}");
        assert!(rows[0].ends_with(",solved,") && !rows[0].contains("NaN,NaN,NaN"), "{csv}");
        assert!(rows[2].contains(",failed,") && rows[2].contains("NaN,NaN,NaN"), "{csv}");
    }
    let summary: Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    let failed = summary["headline"]["failed"].as_array().unwrap();
    assert!(
        !failed.is_empty() && warned(&summary, &format!("{} of 6 points have no solution", failed.len())),
        "{}",
        summary["remarks"]
    );
    let (scratch, done) = swept("1e8");
    assert_eq!((done.code, scratch.names()), (Some(1), vec!["a.toml".to_owned()]), "{}", done.stderr);
    assert!(done.stderr.starts_with("ale-gear: mesh.stiffness_n_per_um = 100000000: "), "{}", done.stderr);
}
