//! The result folder of the model `iso`: which files, which columns, and the physics that any model must show.

use std::collections::HashMap;

use crate::util::{ISO_SCENE, Scratch};

type Columns = HashMap<String, Vec<f64>>;

fn columns(csv: &str) -> Columns {
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let mut columns: Columns = names.iter().map(|n| ((*n).to_owned(), Vec::new())).collect();
    for line in lines {
        let values: Vec<f64> = line.split(',').map(|v| v.parse().unwrap()).collect();
        assert_eq!(values.len(), names.len(), "{line}");
        for (name, value) in names.iter().zip(values) {
            columns.get_mut(*name).unwrap().push(value);
        }
    }
    columns
}

fn run(scene: &str) -> (Scratch, Columns, serde_json::Value) {
    let scratch = Scratch::new().file("a.toml", scene);
    let run = scratch.ale_gear(["run", "a.toml", "--out", "deep/er/o"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    let table = columns(&scratch.read("deep/er/o/history.csv"));
    let summary = serde_json::from_str(&scratch.read("deep/er/o/summary.json")).unwrap();
    (scratch, table, summary)
}

#[test]
fn history_has_the_documented_columns() {
    let (scratch, ..) = run(ISO_SCENE);
    let csv = scratch.read("deep/er/o/history.csv");
    assert_eq!(
        csv.lines().next().unwrap(),
        "time_s,pinion_angle_deg,mesh_phase,ste_um,kinematic_te_um,mesh_stiffness_n_per_um,mesh_stiffness_tangent_n_per_um,\
         contact_line_length_mm,geometric_line_length_mm,pairs_in_contact,\
         pinion_force_x_n,pinion_force_y_n,pinion_force_z_n,\
         pinion_moment_x_nmm,pinion_moment_y_nmm,pinion_moment_z_nmm,\
         wheel_force_x_n,wheel_force_y_n,wheel_force_z_n,wheel_moment_x_nmm,wheel_moment_y_nmm,wheel_moment_z_nmm,\
         normal_force_pair_-1_n,normal_force_pair_0_n,normal_force_pair_1_n,\
         max_pressure_mpa,strain_energy_nmm,friction_power_loss_w,tooth_changes,torque_residual,complementarity_residual,\
         action_reaction_residual,window_edge_load,iterations"
    );
    assert_eq!(csv.lines().count(), 33);
}

#[test]
fn a_result_folder_is_complete_and_replaces_its_forerunner() {
    let (scratch, _, summary) = run(ISO_SCENE);
    let folder = scratch.path().join("deep/er/o");
    let again = scratch.ale_gear(["run", "a.toml", "--out", "deep/er/o", "--torque-nm", "300"]);
    assert_eq!(again.code, Some(0), "{}", again.stderr);
    let mut names: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["history.csv", "report.html", "report.json.gz", "summary.json"]);
    assert_eq!(std::fs::read_dir(folder.parent().unwrap()).unwrap().count(), 1, "a temporary folder is left");
    let later: serde_json::Value = serde_json::from_str(&scratch.read("deep/er/o/summary.json")).unwrap();
    assert_eq!(later["inputs"]["operation"]["torque_nm"], 300.0);
    // Above 100 N/mm the standard is linear: twice the torque, twice the error.
    let ste = |s: &serde_json::Value| s["headline"]["mean_ste_um"].as_f64().unwrap();
    assert!((ste(&later) / ste(&summary) - 2.0).abs() < 1e-12);
    assert!(again.stdout.contains("mean STE") && again.stdout.contains("peak MB"), "{}", again.stdout);
}

/// A page that needs nothing beside itself: no reference to any other file or host.
#[test]
fn the_report_stands_alone() {
    let (scratch, ..) = run(ISO_SCENE);
    let page = scratch.read("deep/er/o/report.html");
    assert_eq!(page.matches("<svg").count(), 8, "six charts, the transverse section with its mesh");
    for forbidden in ["src=", "href=", "@import", "url("] {
        assert!(!page.contains(forbidden), "the page loads something by {forbidden}");
    }
    assert!(page.contains("ale-gear run a.toml --out DIR") && page.contains("helix_angle_deg = 20.0"));
}

/// Equilibrium at every position, either driver, either sense: the driven gear's torque is the applied one and
/// works against the motion, forces cancel, axial over transverse base force is tan(beta_b), the pairs' forces
/// add up, and the tilting moments about any common point balance.
#[test]
fn forces_balance_for_either_driver_and_sense() {
    let (beta, alpha_n) = (20_f64.to_radians(), 20_f64.to_radians());
    let tan_base_helix = (beta.sin() * alpha_n.cos()).asin().tan();
    let centre = 95.775_999_522_832_08;
    for (driver, rotation) in [("pinion", "ccw"), ("pinion", "cw"), ("wheel", "ccw"), ("wheel", "cw")] {
        let operation = format!("[operation]\ndriver = \"{driver}\"\nrotation = \"{rotation}\"");
        let (_, c, _) = run(&ISO_SCENE.replace("[operation]", &operation));
        let driven = if driver == "pinion" { "wheel" } else { "pinion" };
        // The pinion turns by `sense`, the wheel against it; load on the driven gear is against its own motion.
        let sense = if rotation == "ccw" { 1.0 } else { -1.0 };
        let push = if driven == "wheel" { -sense } else { sense };
        for (row, _) in c["time_s"].iter().enumerate() {
            let v = |name: &str| c[name][row];
            let torque = v(&format!("{driven}_moment_z_nmm"));
            assert!((torque - push * 150e3).abs() < 1e-9 * 150e3, "{driver} {rotation}: {torque}");
            for axis in ["x", "y", "z"] {
                let sum = v(&format!("pinion_force_{axis}_n")) + v(&format!("wheel_force_{axis}_n"));
                assert!(sum.abs() < 1e-9, "{axis}: {sum}");
            }
            let transverse = v("wheel_force_x_n").hypot(v("wheel_force_y_n"));
            assert!((v("wheel_force_z_n").abs() / transverse - tan_base_helix).abs() < 1e-6);
            let total = (-1..=1).map(|k| v(&format!("normal_force_pair_{k}_n"))).sum::<f64>();
            assert!((total - 3547.3).abs() < 0.1, "{total}");
            // About the pinion's centre: wheel's own moment plus (a, 0, 0) x force on the wheel.
            let tilting = v("pinion_moment_y_nmm") + v("wheel_moment_y_nmm") - centre * v("wheel_force_z_n");
            assert!(tilting.abs() < 1e-6, "{tilting}");
        }
    }
}

/// The contact-line length averages to eps_alpha b / cos(beta_b).
#[test]
fn line_length_averages_to_the_closed_form() {
    let (_, c, summary) = run(&ISO_SCENE.replace("[analysis]", "[analysis]\npositions_per_cycle = 4096"));
    let mean = c["contact_line_length_mm"].iter().sum::<f64>() / 4096.0;
    let want = summary["geometry"]["mean_line_length_mm"].as_f64().unwrap();
    assert!((mean / want - 1.0).abs() < 1e-6, "{mean} mm, not {want} mm");
}

/// A mesh cycle holds the tooth change that closes it; summary, table and page say where it is, and that it changes
/// nothing.
#[test]
fn the_cycle_that_is_shown_holds_a_tooth_change() {
    let mesher =
        "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }";
    let reduced = ISO_SCENE
        .replace("model = \"iso\"", "model = \"reduced\"\npositions_per_cycle = 8")
        .replace("thickness_allowance_mm = 0.05", &format!("thickness_allowance_mm = 0.05\n{mesher}"));
    for cycles in [1, 3] {
        let (scratch, _, summary) = run(&reduced.replace("[analysis]", &format!("[analysis]\ncycles = {cycles}")));
        let h = &summary["headline"];
        let of = |key: &str| h["tooth_change"][key].as_f64().unwrap();
        assert_eq!((h["tooth_changes"].as_u64(), of("mesh_cycles")), (Some(cycles), 1.0), "{h}");
        assert!((of("pinion_angle_deg") - 6.0).abs() < 1e-9, "half a pitch of 12 deg past the middle: {h}");
        let teeth = ["outgoing_pinion_tooth", "oncoming_pinion_tooth"].map(of);
        assert!(
            (teeth[0] - teeth[1]).rem_euclid(30.0) == 27.0 || (teeth[1] - teeth[0]).rem_euclid(30.0) == 27.0,
            "{h}"
        );
        assert!(of("max_ste_jump_um") < 1e-9 && of("max_normal_force_jump_n") < 1e-6, "{h}");
        let page = scratch.read("deep/er/o/report.html");
        assert!(page.contains("first at 1.000 cycles, 6.00 deg"), "{cycles} cycles: not on the page");
    }
}

/// Columns of pairs mean the same in every mesh cycle, so three cycles repeat the first one.
#[test]
fn every_cycle_repeats_the_first() {
    let (_, c, _) = run(&ISO_SCENE.replace("[analysis]", "[analysis]\ncycles = 3\npositions_per_cycle = 8"));
    for (name, values) in &c {
        let repeats = !matches!(name.as_str(), "time_s" | "pinion_angle_deg");
        for row in (0..16).filter(|_| repeats && !name.ends_with("residual")) {
            let (a, b) = (values[row], values[row + 8]);
            assert!((a - b).abs() <= 1e-8 * (1.0 + a.abs()), "{name}, row {row}: {a}, a cycle later {b}");
        }
    }
}

/// The bending of the bodies stands beside ISO's own stiffness: the transmission error is their sum, and spur gears
/// have none of it.
#[test]
fn bodies_bend_beside_the_stiffness_of_the_standard() {
    let parts = |scene: &str| {
        let (.., summary) = run(scene);
        let bodies: f64 =
            summary["model"]["axial_bending_ste_um"].as_array().unwrap().iter().filter_map(|x| x.as_f64()).sum();
        let own = summary["model"]["iso_mean_ste_closed_form_um"].as_f64().unwrap();
        let least = summary["headline"]["min_ste_um"].as_f64().unwrap();
        (bodies, own, summary["headline"]["mean_ste_um"].as_f64().unwrap(), least)
    };
    let (bodies, own, mean, _) = parts(ISO_SCENE);
    assert!(bodies > 0.05 * own, "{bodies} um of {own}");
    // Over the cycle the mean of 1/L is a little above 1 over the mean of L.
    let ratio = (mean - bodies) / own;
    assert!((1.0..1.02).contains(&ratio), "{mean} - {bodies} um, by the standard {own}");
    let (bodies, own, mean, least) = parts(&ISO_SCENE.replace("helix_angle_deg = 20.0", "helix_angle_deg = 0.0"));
    assert_eq!(bodies, 0.0);
    assert!(least < own && own < mean, "{least}, {own}, {mean}");
}

/// The nominal root stress of the standard is always there, whatever the model: the same value, in summary, table and
/// report; that of a mesh where it is asked for, and else the word that asks.
#[test]
fn the_root_stress_of_the_standard_stands_beside() {
    let stress = |summary: &serde_json::Value| summary["iso_root_stress"]["pinion"]["nominal_root_stress_mpa"].as_f64();
    let (scratch, _, summary) = run(ISO_SCENE);
    let of_iso = stress(&summary).expect("a root stress");
    // Beside 119.3 MPa of resolved finite elements.
    assert!((of_iso / 119.3 - 1.0).abs() < 0.1, "{of_iso} MPa");
    assert!(scratch.read("deep/er/o/report.html").contains("nominal root stress by ISO 6336-3"));
    let meshed = crate::util::motion_scene(0, "");
    let meshed = meshed.split("kind = \"dynamic\"").next().unwrap().to_owned() + "positions_per_cycle = 2\n";
    let (scratch, _, plain) = run(&meshed);
    assert_eq!((stress(&plain), &plain["headline"]["root_stress"]), (Some(of_iso), &serde_json::Value::Null));
    assert!(scratch.read("deep/er/o/report.html").contains("output.root_stress=true"), "how to ask for the other one");
    let asked = run(&(meshed + "[output]\nroot_stress = true\n")).2;
    assert_eq!(stress(&asked), Some(of_iso));
    assert!(asked["headline"]["root_stress"]["pinion"]["max_principal"]["stress_mpa"].as_f64().unwrap() > 0.0);
    // A rim that the standard does not cover: said, not made up.
    let thin = run(&ISO_SCENE.replacen("bore_diameter_mm = 60.0", "bore_diameter_mm = 86.0", 1)).2;
    assert_eq!(stress(&thin), None);
    let said = thin["remarks"].to_string();
    assert!(said.contains("no nominal root stress after ISO 6336-3: rim thickness over tooth height = 0.16"), "{said}");
}
