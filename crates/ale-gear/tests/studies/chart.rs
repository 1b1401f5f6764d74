//! `ale-gear chart` end to end on a small scene: every point is a run, or says why it is none.

use crate::util::{ISO_SCENE, Scratch, chart_rows, fields, five_teeth};

#[test]
fn every_point_is_a_run_or_says_why_not() {
    let page = "# Cost\n<!-- chart small -->\nold\n<!-- end -->\nrest\n";
    let scratch = Scratch::new().file("a.toml", five_teeth()).file("page.md", page);
    // Without a limit of time, which slow machines meet, and without CalculiX, which some have: `other_programs` asks
    // for that.
    let words = ["chart", "a.toml", "--out", "o", "--quick", "--into", "page.md", "--limit-s", "1e9"];
    let nothing = tempfile::tempdir().unwrap();
    let run = Scratch::done(scratch.program().args(words).env("PATH", nothing.path()));
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    assert_eq!(scratch.names(), ["a.toml", "o", "page.md"]);
    let csv = scratch.read("o/chart.csv");
    let mut measured = Vec::new();
    for row in chart_rows(&csv) {
        if row["first_cycle_s"] == "NaN" {
            let without_program = row["way"] == "CalculiX" && row["note"].starts_with("CalculiX is not installed");
            assert!(without_program, "a point that could be run is none: {row:?}");
            continue;
        }
        let value = |name: &str| row[name].parse::<f64>();
        for name in ["offline_s", "cycle_s", "first_cycle_s", "position_s", "mean_ste_um", "error_mean_ste"] {
            assert!(value(name).is_ok_and(f64::is_finite), "{name} in {row:?}");
        }
        measured.push((row["way"].clone(), value("mean_ste_um").unwrap(), value("positions_run").unwrap()));
    }
    let cheap = ["lumped8", "lumped12", "shaft18", "impact", "lumped12, fed by slice"];
    for way in cheap.into_iter().chain(["iso", "slice", "slice, general reduction", "nodal", "full", "reference"]) {
        assert!(measured.iter().any(|(name, ..)| name == way), "no point of {way}:\n{csv}");
    }
    own_bounds_stand_beside_the_errors(&csv);
    // Each of them computes the same gears: nothing is off by a unit, a sign or a factor.
    for (way, ste, _) in &measured {
        // Rigid gears, whose dent has the stiffness of two balls, yield three times as much.
        let most = if way == "impact" { 60.0 } else { 20.0 };
        assert!((5.0..most).contains(ste), "{way}: {ste} um");
    }
    let page = scratch.read("page.md");
    assert!(page.starts_with("# Cost\n<!-- chart small -->\n") && page.ends_with("<!-- end -->\nrest\n"), "{page}");
    assert!(page.contains("| iso |") && !page.contains("old"), "{page}");
    let page = scratch.read("o/report.html");
    assert!(page.contains("<svg") && page.contains("<table>") && !page.contains("src=\"http"), "picture and tables");
    let svg = scratch.read("o/work_precision.svg");
    assert_eq!(svg.matches(">Error of ").count() + svg.matches("\nError of ").count(), 6, "six panels");
}

/// Every meshed model and `iso` says how far it may be off and whether the reference lies inside; models with rigid
/// gears say that they have no bounds.
fn own_bounds_stand_beside_the_errors(csv: &str) {
    for row in chart_rows(csv).iter().filter(|row| row["first_cycle_s"] != "NaN") {
        let value = |name: &str| row[name].parse::<f64>();
        if row["way"].starts_with("lumped") || ["shaft18", "impact"].contains(&row["way"].as_str()) {
            assert!(row["no_bounds"].contains("rigid gears") && row["holds_mean_ste"].is_empty(), "{row:?}");
            continue;
        }
        let [least, most] = ["least_error_mean_ste", "most_error_mean_ste"].map(|name| value(name).unwrap());
        assert!(least <= 0.0 && most >= 0.0 && most > least, "{row:?}");
        let error = value("error_mean_ste").unwrap();
        let inside = (least - 1e-12..=most + 1e-12).contains(&error);
        assert_eq!(row["holds_mean_ste"], inside.to_string(), "{row:?}");
    }
}

#[test]
fn words_of_the_chart_are_checked_before_any_work() {
    let scratch = Scratch::new().file("a.toml", five_teeth()).file("page.md", "nothing to fill\n");
    for (words, text) in [
        (
            ["--limit-s", "0"],
            "ale-gear: `--limit-s` is 0, allowed is above 0\nhint: give seconds, such as `--limit-s 240`\n",
        ),
        (
            ["--into", "page.md"],
            "ale-gear: --into page.md: no `<!-- chart small -->`\n\
             hint: put the two lines `<!-- chart small -->` and `<!-- end -->` where the tables shall stand\n",
        ),
        (["--threads", "0"], "ale-gear: `--threads` is 0, allowed is 1 .. 1024\nhint: leave it out to use all cores\n"),
    ] {
        let run = scratch.ale_gear(["chart", "a.toml", "--out", "o", words[0], words[1]]);
        assert_eq!((run.stderr.as_str(), run.code), (text, Some(2)));
    }
    assert_eq!(scratch.names(), ["a.toml", "page.md"]);
}

/// Every method with every step has its row; those of second order come nearer to the reference with smaller steps, and
/// a scene at rest has no methods.
#[test]
fn methods_of_integration_have_their_chart() {
    let scratch = Scratch::new().file("a.toml", crate::util::motion_scene(1, "")).file("rest.toml", ISO_SCENE);
    let run = scratch.ale_gear(["chart", "a.toml", "--out", "o", "--methods", "--quick"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let csv = scratch.read("o/motion_precision.csv");
    let rows: Vec<Vec<String>> = csv.lines().skip(1).map(fields).collect();
    assert_eq!(rows.len(), 4 * 4, "{csv}");
    for method in ["energy", "generalised-alpha", "newmark"] {
        let errors: Vec<f64> = rows.iter().filter(|r| r[0] == method).map(|r| r[2].parse().unwrap()).collect();
        assert!(errors[3] < 0.5 * errors[1] && errors[3] < 0.5, "{method}: {errors:?} um");
    }
    assert!(scratch.read("o/motion_precision.svg").contains("Error against step"));
    let refused = scratch.ale_gear(["chart", "rest.toml", "--out", "p", "--methods"]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(refused.stderr.contains("`--methods` is for an analysis in time"), "{}", refused.stderr);
}

/// Every model has its curve over the scene's speeds, and comes the nearer to gears with normal modes the more of the
/// gears it knows; a scene without speeds has none.
#[test]
fn models_have_their_chart_over_speed() {
    let sweep = "run = \"sweep\"\nperiodic_tolerance = 1e-3\nwarm_up_cycles = 40\n\
                 [motion.sweep]\nfrom_rpm = 5000\nto_rpm = 7000\nspeeds = 2\nways = [\"up\"]\n[modes]\ncount = 2\n";
    let scene = crate::util::motion_scene(1, sweep)
        .replace("kind = \"dynamic\"\n", "kind = \"dynamic\"\nmodel = \"reduced+modes\"\n");
    let scratch = Scratch::new().file("a.toml", scene).file("steady.toml", crate::util::motion_scene(1, ""));
    let run = scratch.ale_gear(["chart", "a.toml", "--out", "o", "--resonance", "--quick"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let csv = scratch.read("o/resonance_precision.csv");
    let rows: Vec<Vec<String>> = csv.lines().skip(1).map(fields).collect();
    let error = |model: &str| -> f64 {
        let row = rows.iter().find(|r| r[0] == model).unwrap_or_else(|| panic!("no {model}:\n{csv}"));
        row[4].parse().unwrap_or_else(|_| panic!("no error of {model}:\n{csv}"))
    };
    assert_eq!(rows.len(), 7, "{csv}");
    let [modes, reduced, mapped] = ["reduced+modes", "reduced", "mapped"].map(error);
    let [fed, iso] = ["lumped12, fed by slice", "lumped8"].map(error);
    // Sixteen steps are few: what they leave is the error of all models that know the gears.
    assert!(modes < 0.12 && (reduced - mapped).abs() < 0.05 * reduced, "{csv}");
    assert!(reduced < 0.5 * fed && fed < 0.5 * iso, "{csv}");
    assert_eq!(scratch.read("o/resonance_curves.csv").lines().count(), 1 + 7 * 2);
    assert!(scratch.read("o/resonance_precision.svg").contains("Motions alone"));
    assert!(scratch.read("o/resonance_curves.svg").contains("reference"));
    let refused = scratch.ale_gear(["chart", "steady.toml", "--out", "p", "--resonance"]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(refused.stderr.contains("`--resonance` is for a sweep over speed"), "{}", refused.stderr);
}
