//! Gearboxes over a range of speeds as a user meets them: run-ups, and branches of periodic motions.

use crate::{
    gearbox::{column, two_stages},
    util::{Scratch, repository},
};

/// A run-up: the speed goes from one to the other over all cycles, orders stand over the speed, and where the speed
/// changes slowly and away from resonance they are the forced response at that speed; the page is made again to the same
/// bytes, and two folders are compared.
#[test]
fn a_run_up_shows_the_orders_of_every_mesh() {
    let scratch = two_stages();
    let motion =
        "[motion]\nspeed_rpm = 1450.0\nto_speed_rpm = 1550.0\nmesh = \"spring\"\ncycles = 220\nsteps_per_cycle = 40\n";
    let text = scratch.read("two_stages.toml");
    let (before, _) = text.split_once("[motion]").unwrap();
    let vibration = ["from_rpm = 400.0", "to_rpm = 6000.0", "speeds = 57"].into_iter();
    let wanted = ["from_rpm = 1450.0", "to_rpm = 1550.0", "speeds = 3"];
    let before = vibration.zip(wanted).fold(before.to_owned(), |text, (from, to)| text.replace(from, to));
    // The speed is given, as by a machine of any inertia.
    let before = before.replace("input = \"free\"", "input = \"held\"");
    let scratch = scratch.file("run_up.toml", before + motion);
    let run = scratch.ale_gear(["run", "run_up.toml", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let rows = scratch.read("o/motion.csv");
    let speed = column(&rows, "input_speed_rpm");
    assert_eq!(speed.len(), 220 * 40 + 1);
    assert!((speed[0] + 1450.0).abs() < 1e-6 && (speed[220 * 40] + 1550.0).abs() < 1e-6, "clockwise: {}", speed[0]);
    let turned = column(&rows, "mesh_1_cycles");
    assert!((turned[220 * 40] - turned[0] - 220.0).abs() < 1e-6);
    let orders = scratch.read("o/motion_orders.csv");
    let response = scratch.read("o/response.csv");
    let of = |csv: &str, name: &str, mesh: f64, order: f64| -> Vec<[f64; 2]> {
        let [meshes, all, speeds, values] =
            ["exciting_mesh", "exciting_order", "input_rpm", name].map(|name| column(csv, name));
        let rows = (0..values.len()).filter(|i| meshes[*i] == mesh && all[*i] == order);
        rows.map(|i| [speeds[i], values[i]]).collect()
    };
    // The first mesh hardly swings here: its force is a difference of others.
    let found = of(&orders, "mesh_2_normal_force_n", 2.0, 1.0);
    let steady = of(&response, "mesh_2_dynamic_force_n", 2.0, 1.0);
    assert!(found.len() > 4 && steady.len() == 3, "{} stretches, {} speeds", found.len(), steady.len());
    let ([speed, middle], [at, wanted]) = (found[found.len() / 2], steady[1]);
    assert!(
        (speed / at - 1.0).abs() < 0.01 && (middle / wanted - 1.0).abs() < 0.05,
        "{middle} N at {speed}/min beside {wanted} N"
    );
    // The waterfall has lines where orders of the faster mesh are, with their amplitudes.
    let waterfall = scratch.read("o/waterfall.csv");
    let line = |name: &str, order: f64| -> Vec<f64> {
        let (orders, values) = (column(&waterfall, "mesh_order"), column(&waterfall, name));
        (0..values.len()).filter(|i| (orders[*i] - order).abs() < 1e-3).map(|i| values[i]).collect()
    };
    for name in ["mesh_1_dte_um", "mesh_2_normal_force_n", "bearing_3_force_n"] {
        for order in [1.0, 2.0] {
            let (found, wanted) = (line(name, order), of(&orders, name, 1.0, order));
            assert!(
                found.len() == wanted.len() && found.len() > 4,
                "{} lines, {} stretches",
                found.len(),
                wanted.len()
            );
            for (found, [speed, wanted]) in found.into_iter().zip(wanted) {
                assert!((found / wanted - 1.0).abs() < 0.02, "{name}: {found}, not {wanted}, at {speed}/min");
            }
        }
    }
    // Teeth are 17/53 and 19/47: the meshes come back together after 53 cycles of the first.
    let section = scratch.read("o/section.csv");
    assert_eq!(column(&section, "input_speed_rpm").len(), 1 + 220 / 53);
    for mesh in 1..=2 {
        let name = format!("mesh_{mesh}_cycles");
        let (points, every) = (column(&section, &name), [53.0, 19.0][mesh - 1]);
        assert!(points.iter().enumerate().all(|(k, c)| (c - points[0] - every * k as f64).abs() < 1e-6), "{points:?}");
    }
    let (dte, all) = (column(&section, "mesh_2_dte_um"), column(&rows, "mesh_2_dte_um"));
    assert!((0..dte.len()).all(|k| (dte[k] / all[k * 53 * 40] - 1.0).abs() < 1e-9), "points are not rows");
    let told: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    assert_eq!(told["motion"]["common_period_cycles"].as_u64(), Some(53));
    let number = |key: &str| told["headline"][key].as_f64().unwrap();
    let duration = 220.0 / (17.0 * 25.0);
    assert!((number("run_up_s") / duration - 1.0).abs() < 1e-9, "{} s, not {duration}", number("run_up_s"));
    assert!((number("run_up_load_torque_nm") / (740.0 * 17.0 * 19.0 / 53.0 / 47.0) - 1.0).abs() < 1e-9);
    // What takes a tenth of the load and more is told.
    let [short, fast] = ["motion.cycles=12", "motion.to_speed_rpm=3000"];
    let run = scratch.ale_gear(["run", "run_up.toml", "--set", short, "--set", fast, "--out", "s"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(
        run.stdout.contains("the speed changes within 0.0") && run.stdout.contains("that takes up to"),
        "{}",
        run.stdout
    );
    let page = scratch.read("o/report.html");
    assert!(page.contains("Mesh orders in the transmission error"));
    for what in ["the DTE of mesh first", "the normal force of mesh second", "the force of bearing"] {
        assert!(page.contains(&format!("Waterfall of {what}")), "no picture of {what}");
    }
    let again = scratch.ale_gear(["report", "o", "-o", "again.html"]);
    assert_eq!(again.code, Some(0), "{}", again.stderr);
    assert!(scratch.read("again.html") == page, "the page made again has other bytes");
    let beside = scratch.ale_gear(["compare", "o", "o"]);
    assert_eq!(beside.code, Some(0), "{}", beside.stderr);
    assert!(beside.stdout.contains("peak to peak STE 2 [µm]"), "{}", beside.stdout);
    let wrong = scratch.read("run_up.toml").replace("to_speed_rpm", "drive = \"torque\"\nto_speed_rpm");
    let scratch = scratch.file("wrong.toml", wrong);
    let run = scratch.ale_gear(["run", "wrong.toml", "--out", "w"]);
    assert!(run.code == Some(2) && run.stderr.contains("a result where a torque drives"), "{}", run.stderr);
}

/// A run-up without a vibration has the natural frequencies and lines of one, and every motion its energy row by row.
#[test]
fn a_run_up_has_natural_frequencies_and_energy() {
    let scratch = two_stages();
    let text = scratch.read("two_stages.toml");
    let (rest, _) = text.split_once("[vibration]").unwrap();
    let motion =
        "[motion]\nspeed_rpm = 1450.0\nto_speed_rpm = 2000.0\nmesh = \"spring\"\ncycles = 12\nsteps_per_cycle = 40\n";
    // From standstill, which is no speed of a vibration.
    let vibration = "[vibration]\nfrom_rpm = 1e-3\nto_rpm = 2100.0\nspeeds = 21\ninput = \"held\"\n";
    let scratch = scratch.file("led.toml", format!("{rest}{motion}")).file("swings.toml", format!("{rest}{vibration}"));
    for name in ["led", "swings"] {
        let run = scratch.ale_gear(["run", &format!("{name}.toml"), "--out", name]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
    }
    let [led, swings] = ["led", "swings"].map(|folder| scratch.read(&format!("{folder}/campbell.csv")));
    let names: Vec<&str> = led.lines().next().unwrap().split(',').collect();
    assert_eq!(Some(names.join(",").as_str()), swings.lines().next());
    assert!(names.contains(&"mode_20_hz") && names.contains(&"mesh_2_order_5_hz"), "{names:?}");
    let speeds = column(&led, "input_rpm");
    assert_eq!((speeds.len(), speeds[0], speeds[20]), (21, 0.0, 2100.0));
    for name in names {
        let [own, wanted] = [&led, &swings].map(|csv| column(csv, name)[20]);
        assert!((own / wanted - 1.0).abs() < 1e-9, "{name}: {own} beside {wanted}");
    }
    assert!(scratch.read("led/report.html").contains("Campbell diagram"));
    let meetings = column(&scratch.read("led/crossings.csv"), "input_rpm");
    assert!(!meetings.is_empty() && meetings.iter().all(|rpm| (0.0..=2100.0).contains(rpm)), "{meetings:?}");
    let energy = scratch.read("led/energy.csv");
    assert_eq!(column(&energy, "time_s"), column(&scratch.read("led/motion.csv"), "time_s"));
    let [kinetic, elastic, supplied, parametric, dissipated, residual] =
        ["kinetic", "elastic", "supplied", "parametric", "dissipated", "residual"]
            .map(|name| column(&energy, &format!("{name}_mj")));
    let size = |of: &[f64]| of.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let largest = [&kinetic, &elastic, &supplied, &parametric].map(|of| size(of)).into_iter().fold(0.0, f64::max);
    for i in 0..kinetic.len() {
        let gained = kinetic[i] + elastic[i] - kinetic[0] - elastic[0];
        let open = gained - (supplied[i] + parametric[i] - dissipated[i] + residual[i]);
        assert!(open.abs() < 1e-9 * largest, "row {i}: {open} of {largest} mJ");
    }
    assert!(dissipated.windows(2).all(|two| two[0] <= two[1]) && dissipated[480] > 0.0, "{dissipated:?}");
    assert!(size(&residual) < 1e-3 * largest, "{} of {largest} mJ", size(&residual));
}

/// The branch over the speed of the shipped box: a row a motion, folds with an unstable part between them, motions in time that
/// stay on it; tables, page and summary say the same. The page is made again to the same bytes.
#[test]
fn a_branch_over_the_speed_is_written() {
    let file = repository().join("scenes/gearbox/resonance_curve.toml").display().to_string();
    let scratch = Scratch::new();
    let run = scratch.ale_gear(["run", &file, "--no-cache", "--out", "o"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let told: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    let branch = &told["branch"];
    let rows = scratch.read("o/branch.csv");
    let [speed, stable, errors] = ["input_rpm", "stable", "mesh_1_peak_to_peak_dte_um"].map(|name| column(&rows, name));
    assert_eq!(branch["motions"].as_u64(), Some(speed.len() as u64));
    assert_eq!(branch["unstable"].as_u64().unwrap() as usize, stable.iter().filter(|s| **s == 0.0).count());
    let folds: Vec<f64> = branch["folds"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    let turns = scratch.read("o/bifurcations.csv");
    let listed =
        turns.lines().filter(|l| l.starts_with("fold,")).map(|l| l.split(',').nth(1).unwrap().parse().unwrap());
    assert_eq!(listed.collect::<Vec<f64>>(), folds);
    assert!(folds.len() >= 2 && branch["unstable"].as_u64() > Some(2), "{branch}");
    let largest = errors.iter().copied().fold(0.0, f64::max);
    assert_eq!(told["headline"]["branch_peak_to_peak_dte_um"][0].as_f64(), Some(largest));
    assert_eq!(branch["meshes"][0]["largest"]["peak_to_peak_dte_um"].as_f64(), Some(largest));
    assert_eq!(told["headline"]["branch_folds"].as_f64(), Some(folds.len() as f64));
    let in_time = scratch.read("o/in_time.csv");
    let [found, wanted] =
        ["mesh_1_peak_to_peak_dte_um", "mesh_1_branch_peak_to_peak_dte_um"].map(|name| column(&in_time, name));
    assert!(found.len() == 4 && found.iter().zip(&wanted).all(|(a, b)| (a / b - 1.0).abs() < 0.02), "{in_time}");
    for check in ["harmonic_residual", "harmonic_tail", "range_left_out", "multiplier_error", "mesh_1_map_excess"] {
        assert!(told["certificate_checks"][check]["value"].is_f64(), "{check}: {}", told["certificate_checks"]);
    }
    assert!(run.stdout.contains("motions with loss of contact"), "{}", run.stdout);
    let page = scratch.read("o/report.html");
    assert!(page.contains("Largest Floquet multiplier") && page.contains("Periodic motions, mesh stage"));
    let again = scratch.ale_gear(["report", "o", "-o", "again.html"]);
    assert_eq!(again.code, Some(0), "{}", again.stderr);
    assert!(scratch.read("again.html") == page, "the page made again has other bytes");
    // What has no branch is told by the words of the file.
    let wrong = [
        ("motion.mesh=exact", "the exact contact has no continuation"),
        ("motion.cycles=5", "`cycles` belongs to a motion that writes rows"),
        ("motion.run=span", "[motion.continuation] belongs to a branch"),
        ("motion.to_speed_rpm=12000", "the speed stays"),
        ("motion.continuation.most_harmonics=3", "below `harmonics`"),
        ("motion.drive=torque", "a result where a torque drives"),
        ("motion.drive=balanced", "keeps its speed"),
    ];
    for (word, said) in wrong {
        let run = scratch.ale_gear(["run", &file, "--set", word, "--out", "w"]);
        assert!(run.code == Some(2) && run.stderr.contains(said), "{word}: {}", run.stderr);
    }
}

/// Two meshes of 17 and 19 teeth on the middle shaft come back after thousands of cycles: there is no branch.
#[test]
fn a_branch_of_a_long_period_is_refused() {
    let scratch = two_stages();
    let text = scratch.read("two_stages.toml");
    let (before, _) = text.split_once("[motion]").unwrap();
    let (before, _) = before.split_once("[vibration]").unwrap_or((before, ""));
    let motion = "[motion]\nrun = \"continuation\"\nspeed_rpm = 1000.0\nto_speed_rpm = 1100.0\nmesh = \"spring\"\n";
    let scratch = scratch.file("long.toml", before.to_owned() + motion);
    let run = scratch.ale_gear(["run", "long.toml", "--out", "o"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("`most_harmonics = 18`"), "{}", run.stderr);
    // With as many the branch begins; where these leave out more than any `tail` allows, none and no more harmonics are asked for.
    let keep = ["--set", "motion.continuation.most_harmonics=1", "--set", "motion.continuation.harmonics=1"];
    let few = scratch.command(&[&["run", "long.toml", "--out", "o"][..], &keep].concat());
    assert!(few.code == Some(1) && few.stderr.contains("hint: begin at another speed"), "{}", few.stderr);
    assert!(!few.stderr.contains("most_harmonics") && !few.stderr.contains("take fewer"), "{}", few.stderr);
}
