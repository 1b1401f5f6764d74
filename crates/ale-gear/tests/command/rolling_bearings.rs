//! `ale-gear run` on rolling bearings, as a user and as its harshest user meets it.

use crate::util::{Scratch, repository};

/// The scene with its pairs.
fn scene() -> Scratch {
    let folder = repository().join("scenes/gearbox");
    let copy = |scratch: Scratch, name: &str| scratch.file(name, std::fs::read(folder.join(name)).unwrap());
    ["rolling_bearings.toml", "first_stage.toml", "second_stage.toml"].into_iter().fold(Scratch::new(), copy)
}

/// The scene at rest alone, quickly, with some words put otherwise.
fn changed(changes: Changes<'_>) -> Scratch {
    let scratch = scene();
    let text = scratch.read("rolling_bearings.toml");
    let rest = text.find("[vibration]").unwrap();
    let mut text = text[..rest].replace("positions_per_cycle = 8", "positions_per_cycle = 2");
    for (from, to) in changes {
        assert!(text.contains(from), "{from} is not in the scene");
        text = text.replacen(from, to, 1);
    }
    scratch.file("box.toml", text)
}

/// Words of the scene, and what stands there instead.
type Changes<'a> = &'a [(&'a str, &'a str)];

/// Column of a file with commas.
fn column(csv: &str, name: &str) -> Vec<f64> {
    let mut lines = csv.lines();
    let at = lines.next().unwrap().split(',').position(|n| n == name).unwrap_or_else(|| panic!("no column {name}"));
    lines.map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect()
}

/// Files, table and numbers are there and agree with each other; bodies are in balance; bits do not go with threads.
#[test]
fn a_gearbox_on_rolling_bearings_is_solved() {
    let scratch = scene();
    let run = scratch.ale_gear(["run", "rolling_bearings.toml", "--out", "o", "--no-cache"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    for word in ["element N", "loaded", "13 rollers of", "10 balls of", "estimated from bore"] {
        assert!(run.stdout.contains(word), "{word} is not in\n{}", run.stdout);
    }
    let positions = scratch.read("o/positions.csv");
    assert!(column(&positions, "body_balance").iter().all(|b| *b < 1e-9));
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    for i in 0..6 {
        let own = &summary["bearings"][i]["rolling"];
        let most =
            |name: &str| column(&positions, &format!("bearing_{}_{name}", i + 1)).into_iter().fold(0.0, f64::max);
        assert_eq!(own["max_element_force_n"].as_f64(), Some(most("element_force_n")));
        assert_eq!(own["max_hertz_pressure_mpa"].as_f64(), Some(most("hertz_pressure_mpa")));
        assert_eq!(own["max_loaded_elements"].as_f64(), Some(most("loaded_elements")));
        let stiffness: Vec<Vec<f64>> = serde_json::from_value(own["stiffness_n_mm_rad"].clone()).unwrap();
        assert!((0..2).all(|k| stiffness[k][k] > 1e4), "{stiffness:?}");
        // Cylindrical rollers alone hold nothing along z.
        assert_eq!(stiffness[2][2] == 0.0, i == 1, "{stiffness:?}");
    }
    assert_eq!(column(&positions, "bearing_2_force_z_n"), [0.0; 8]);
    let left = summary["motion"]["energy"]["relative_residual"].as_f64().unwrap();
    assert!(left.abs() < 1e-9, "{left}");
    // A motion begins where the gearbox stands: springs about the load have its forces.
    let motion = scratch.read("o/motion.csv");
    for axis in ["x", "y", "z"] {
        let name = format!("bearing_1_force_{axis}_n");
        let (rest, moved) = (column(&positions, &name), column(&motion, &name)[0]);
        let mean = rest.iter().sum::<f64>() / 8.0;
        assert!((moved - mean).abs() < 0.05 * 4000.0, "{name}: {moved} beside {mean} N");
    }
    let page = scratch.read("o/report.html");
    for head in ["element N", "Hertz MPa", "loaded"] {
        assert!(page.contains(head), "the page has no column {head}");
    }
    let again = scratch.ale_gear(["run", "rolling_bearings.toml", "--out", "o", "--no-cache", "-q", "-j", "1"]);
    assert_eq!(again.code, Some(0), "{}", again.stderr);
    assert!(scratch.read("o/positions.csv") == positions, "bits go with the number of threads");
    assert!(scratch.read("o/motion.csv") == motion, "bits of the motion go with the number of threads");
}

/// What no bearing is, and shafts that nothing holds, end with a message that names the bearing or the shaft.
#[test]
fn impossible_bearings_are_told() {
    let thrust = ("takes_thrust = \"-z\"", "takes_thrust = \"+z\"");
    let cases: [(Changes<'_>, i32, &str); 6] = [
        (
            &[("radial_clearance_um = 8.0", "radial_clearance_um = 5000.0")],
            2,
            "bearing fast, fixed: a radial clearance of 5000 µm",
        ),
        (&[("elements = 9", "elements = 40")], 2, "bearing fast, fixed: 40 rolling elements of 7.938 mm do not fit"),
        (
            &[("static_rating_kn = 27.0", "static_rating_kn = 27000.0")],
            2,
            "bearing fast, loose: a static load rating of 27000000 N",
        ),
        (&[("elements = 9", "elements = 1")], 2, "3 .. 500"),
        // Both rows of the middle shaft take thrust towards +z, and it goes to -z: told before any work.
        (&[thrust, ("rotation = \"cw\"", "rotation = \"ccw\"")], 2, "nothing takes -z on shaft middle"),
        (
            &[
                (
                    "type = \"deep-groove-ball\"\nelements = 9",
                    "type = \"cylindrical-roller\"\nelement_length_mm = 8.0\nelements = 9",
                ),
                ("inner_conformity = 0.515\nouter_conformity = 0.53\n", ""),
            ],
            2,
            "nothing holds shaft fast along z",
        ),
    ];
    for (changes, code, said) in cases {
        let scratch = changed(changes);
        let run = scratch.ale_gear(["run", "box.toml", "--out", "o", "--no-cache"]);
        assert_eq!(run.code, Some(code), "{changes:?}: {}\n{}", run.stderr, run.stdout);
        assert!(run.stderr.contains(said) && run.stderr.contains("hint: "), "{changes:?}: {}", run.stderr);
        assert!(!scratch.path().join("o").exists(), "{changes:?} left a folder");
    }
}

/// Light loads, wide play, heavy preload and shafts that are held: in balance, and said where something is off.
#[test]
fn odd_bearings_are_solved_and_said() {
    let cases: [(Changes<'_>, &str); 5] = [
        (&[("torque_nm = 740.0", "torque_nm = 0.01")], ""),
        (
            &[
                ("radial_clearance_um = 15.0", "radial_clearance_um = 300.0"),
                ("radial_clearance_um = 8.0", "radial_clearance_um = 60.0"),
            ],
            "",
        ),
        (&[("preload_n = 250.0", "preload_n = 2e6")], "beyond the 4200 MPa of the static rating"),
        (&[("name = \"slow\"\n", "name = \"slow\"\nheld = true\n")], "on a shaft that is held"),
        (&[("axial_clearance_um = 5.0", "axial_clearance_um = 5000.0")], "bearing middle, -z tilts by 9.0 mrad"),
    ];
    for (changes, said) in cases {
        let scratch = changed(changes);
        let run = scratch.ale_gear(["run", "box.toml", "--out", "o", "--no-cache"]);
        assert_eq!(run.code, Some(0), "{changes:?}: {}\n{}", run.stderr, run.stdout);
        assert!(run.stdout.contains(said), "{changes:?}: {}", run.stdout);
        let balance = column(&scratch.read("o/positions.csv"), "body_balance");
        assert!(balance.iter().all(|b| *b < 1e-7), "{changes:?}: {balance:?}");
    }
}

/// A bearing that is said by its designation alone has a life and a static safety; one note tells all that is estimated.
#[test]
fn designations_lead_to_lives_and_safeties() {
    let scratch = changed(&[]);
    let text = scratch.read("box.toml");
    let (begin, end) = (text.find("type = \"deep-groove-ball\"").unwrap(), text.find("damping_n_s_per_mm").unwrap());
    let text = format!("{}designation = \"6205\"\n{}\n[rating]\nspeed_rpm = 1500.0\n", &text[..begin], &text[end..]);
    let scratch = scratch.file("said.toml", text);
    let run = scratch.ale_gear(["run", "said.toml", "--out", "o", "--no-cache"]);
    assert_eq!(run.code, Some(0), "{}\n{}", run.stderr, run.stdout);
    let summary: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    let own = &summary["bearings"][0]["rolling"];
    assert_eq!(own["elements_per_row"], 9, "{own}");
    let number = |key: &str| own[key].as_f64().unwrap_or_else(|| panic!("{key}: {own}"));
    // 14.8 and 7.8 kN in a catalogue.
    assert!((number("dynamic_rating_kn") / 14.8 - 1.0).abs() < 0.2, "{own}");
    assert!((number("static_rating_kn") / 7.8 - 1.0).abs() < 0.2, "{own}");
    let safety = (4200.0 / number("max_hertz_pressure_mpa")).powi(3);
    assert!((number("static_safety") / safety - 1.0).abs() < 1e-12, "{own}");
    assert_eq!(summary["headline"]["bearing_static_safety"][0], own["static_safety"]);
    let life = summary["headline"]["bearing_life_h"].as_array().unwrap();
    assert!(life[0].as_f64().unwrap() > 1.0 && life[1].is_null(), "{life:?}");
    let estimated = run.stdout.matches("bearings are estimated from bore").count();
    assert!(estimated == 1 && run.stdout.contains("fast, fixed: 9 balls of"), "{}", run.stdout);
}
