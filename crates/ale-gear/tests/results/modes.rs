//! Elastic frequencies and normal modes, as a user meets them.

use crate::util::{MOTION_LINES, Scratch, column, motion_scene, remark_words};

fn summary(scene: &str) -> (serde_json::Value, String) {
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    answer(&scratch, &run.stdout)
}

/// A motion by steps far longer than all periods: the method takes the vibration away, and the certificate says that of
/// its energy nothing closes.
fn unresolved(scene: &str) -> (serde_json::Value, String) {
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
    assert_eq!(run.code, Some(1), "{}", run.stdout);
    assert!(run.stderr.contains("check failed: energy_residual"), "{}", run.stderr);
    let (summary, text) = answer(&scratch, &run.stdout);
    assert_eq!(summary["certificate_missed"].as_array().map(Vec::len), Some(1), "{}", summary["certificate_missed"]);
    (summary, text)
}

fn answer(scratch: &Scratch, stdout: &str) -> (serde_json::Value, String) {
    let summary = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    (summary, stdout.to_owned() + &scratch.read("o/history.csv"))
}

fn warns(summary: &serde_json::Value, word: &str) -> bool {
    summary["remarks"].as_array().unwrap().iter().any(|w| remark_words(w).contains(word))
}

/// One mesh cycle from the quasi-static start at a speed.
fn span(rpm: f64, motion: &str) -> String {
    motion_scene(1, &format!("run = \"span\"\n{motion}"))
        .replace("torque_nm = 150.0\n", &format!("torque_nm = 150.0\nspeed_rpm = {rpm:?}\n"))
}

/// The ratio is harmonic times mesh frequency over the lowest elastic frequency; the warning comes where what is left
/// out may change the answer, and names the remedy and its price.
#[test]
fn every_run_has_its_ratio_and_only_fast_ones_a_warning() {
    let number = |e: &serde_json::Value, key: &str| e[key].as_f64().unwrap_or_else(|| panic!("no {key}: {e}"));
    let ratio = |rpm: f64| {
        let (summary, text) = summary(&span(rpm, ""));
        let e = &summary["headline"]["elasticity"];
        let lowest = e["lowest_elastic_frequency_hz"].as_array().unwrap().iter().map(|f| f.as_f64().unwrap());
        let lowest = lowest.fold(f64::INFINITY, f64::min);
        assert!((5e3..1e5).contains(&lowest), "a steel gear of 90 mm at {lowest} Hz");
        let mesh = number(e, "highest_mesh_frequency_hz");
        assert!((mesh - rpm * 30.0 / 60.0).abs() < 1e-9 * mesh, "{mesh} Hz at {rpm}/min");
        let found = number(e, "mesh_harmonic_over_elastic");
        let wanted = number(e, "mesh_harmonic") * mesh / lowest;
        assert!((found / wanted - 1.0).abs() < 1e-12, "{found}, not {wanted}: {e}");
        assert!(text.contains("mesh harmonic over elastic frequency"), "{text}");
        let (change, limit) = (number(e, "change_over_peak_to_peak"), number(e, "limit_of_change"));
        assert!((limit - 1.0 / 15.0).abs() < 1e-12, "{limit}: what one harmonic changes at a quarter");
        let peak_to_peak = number(&summary["headline"], "peak_to_peak_dte_um");
        assert!((number(e, "change_of_peak_to_peak_um") / (change * peak_to_peak) - 1.0).abs() < 1e-12, "{e}");
        assert_eq!(warns(&summary, "`reduced+modes`"), change > limit, "{change}: {}", summary["remarks"]);
        assert_eq!(warns(&summary, " steps, "), change > limit, "no price: {}", summary["remarks"]);
        (found, change)
    };
    let (slow, fast) = (ratio(500.0), ratio(40_000.0));
    assert!(slow.0 < 0.25 && fast.0 > 0.25, "{slow:?} and {fast:?} are on one side of a quarter");
    assert!(slow.1 < 1.0 / 15.0 && fast.1 > 1.0 / 15.0, "{slow:?} and {fast:?} are on one side of the limit");
}

/// At low speed modes follow the load at once: the transmission error is the one without them, whatever the boundary.
#[test]
fn slow_gears_do_not_see_their_modes() {
    // Steps far longer than all periods, by a method that takes such motion away at once.
    // The driver is held: of gears that are both free such a step may miss the contact and fly away (and says so).
    let slow = span(50.0, "method = \"generalised-alpha\"\nspectral_radius = 0.0\n[drive]\nby = \"speed\"\n");
    let dte = |scene: &str| {
        let (summary, text) = unresolved(scene);
        let csv = text.split_once("time_s,").map(|(_, rows)| format!("time_s,{rows}")).unwrap();
        (summary, column(&csv, "dte_um"))
    };
    let (_, without) = dte(&slow);
    for table in ["count = 3", "below_hz = 45000.0\nboundary = \"consistent\"\nfixed_modes = 1"] {
        let (summary, with) = dte(&slow.replace(
            MOTION_LINES,
            &format!("model = \"reduced+modes\"\n[modes]\n{table}\ndamping_ratio = 0.02\n{MOTION_LINES}"),
        ));
        let kept = &summary["headline"]["elasticity"]["kept_modes"];
        assert!(kept["count"].as_array().unwrap().iter().all(|n| n.as_u64() >= Some(1)), "{table}: {kept}");
        assert_eq!(with.len(), without.len());
        let swing = without.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], e| [l.min(*e), h.max(*e)]);
        let worst = with.iter().zip(&without).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 0.01 * (swing[1] - swing[0]), "{table}: {worst} um off, of {swing:?}");
    }
}

/// What does not go together is told with line and hint.
#[test]
fn wrong_modes_are_told_with_line_and_hint() {
    let says = |from: (&str, &str), text: &str| {
        let scene = motion_scene(1, "");
        assert!(scene.contains(from.0));
        let scene = scene.replacen(from.0, from.1, 1);
        let scratch = Scratch::new().file("a.toml", &scene);
        let run = scratch.ale_gear(["run", "a.toml", "--out", "o"]);
        let said = run.complaint();
        assert!(said.ends_with(text) && said.starts_with("ale-gear: a.toml:"), "{}for\n{scene}", run.stderr);
        assert_eq!((run.code, scratch.names().len()), (Some(2), 1));
    };
    let table = |keys: &str| format!("model = \"reduced+modes\"\n[modes]\n{keys}\n{MOTION_LINES}");
    let modes = |keys: &str, text: &str| says((MOTION_LINES, &table(keys)), text);
    modes("cuont = 3", ":23: unknown key `cuont`\nhint: did you mean `count`?\n");
    modes(
        "count = 3\nbelow_hz = 2e4",
        ":24: `count` and `below_hz` both say which modes are kept\nhint: keep one of them\n",
    );
    modes(
        "fixed_modes = 3",
        ":23: `fixed_modes` belongs to `boundary = \"consistent\"`\nhint: leave it out: a massless boundary takes the modes of the \
         whole mesh\n",
    );
    modes(
        "count = 0",
        ":23: `count` is 0, allowed is 1 .. 1000\nhint: `count` means: the lowest so many modes of each gear\n",
    );
    says(
        (MOTION_LINES, &format!("[modes]\ncount = 3\n{MOTION_LINES}")),
        ":21: [modes] belongs to `model = \"reduced+modes\"`\nhint: leave it out, or say so in [analysis]\n",
    );
    says(
        ("kind = \"dynamic\"\n", "kind = \"static\"\nmodel = \"reduced+modes\"\n"),
        ": `model = \"reduced+modes\"` needs `kind = \"dynamic\"`: modes are motion, and nothing moves here\nhint: say `kind = \
         \"dynamic\"` in [analysis], or use `model = \"reduced\"`: at rest both are the same\n",
    );
}
