//! Analyses in time beyond the plain one: normal modes in every one of them, steps by error, a driver by torque, gears
//! on bearings, a start from standstill.

use crate::util::{MOTION_LINES, Scratch, column, motion_scene as scene};
use serde_json::Value;

fn run(scratch: &Scratch, out: &str, more: &[&str]) -> Value {
    let mut words = vec!["run", "a.toml", "--out", out];
    words.extend(more);
    let run = scratch.command(&words);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{}", run.stdout);
    serde_json::from_str(&scratch.read(&format!("{out}/summary.json"))).unwrap()
}

fn certificate(summary: &Value, key: &str) -> f64 {
    summary["headline"]["certificate"][key].as_f64().unwrap_or_else(|| panic!("no {key}: {}", summary["headline"]))
}

/// The scene with two normal modes of each gear.
fn with_modes(scene: &str) -> String {
    let table = format!("model = \"reduced+modes\"\n[modes]\ncount = 2\ndamping_ratio = 0.05\n{MOTION_LINES}");
    assert!(scene.contains(MOTION_LINES));
    scene.replace(MOTION_LINES, &table)
}

/// With modes a run that was cut goes on to the bytes of the one that was not.
#[test]
fn a_run_with_modes_that_was_cut_goes_on_byte_for_byte() {
    let motion = "run = \"span\"\ncheckpoint_every_cycles = 1\nmesh_damping_ratio = 0.2\n";
    let scratch = Scratch::new().file("a.toml", with_modes(&scene(4, motion)));
    let summary = run(&scratch, "whole", &[]);
    assert!(certificate(&summary, "least_contact_force_n") >= 0.0, "a flank pulls");
    let cut = scratch.command(&["run", "a.toml", "--out", "cut", "--stop-after-cycles", "2"]);
    assert_eq!(cut.code, Some(0), "{}", cut.stderr);
    run(&scratch, "cut", &["--resume", "-j", "1"]);
    for file in ["history.csv", "energy.csv", "spectrum.csv"] {
        assert!(scratch.read(&format!("whole/{file}")) == scratch.read(&format!("cut/{file}")), "{file} differs");
    }
}

/// With modes a run-up ends at its speed, its rows keep their number, and energy closes.
#[test]
fn a_run_up_with_modes_reaches_its_speed() {
    let ramp = "run = \"ramp\"\nramp = { from_rpm = 1500, to_rpm = 3000, duration_s = 0.004, waterfall_cycles = 4 }\n";
    let scratch = Scratch::new().file("a.toml", with_modes(&scene(0, ramp)));
    let summary = run(&scratch, "o", &[]);
    let speed = column(&scratch.read("o/history.csv"), "pinion_speed_rpm");
    assert_eq!(speed.len() as u64, 16 * summary["headline"]["cycles"].as_u64().unwrap());
    assert!(speed[speed.len() - 1] > 2800.0, "{speed:?}");
    let open = certificate(&summary, "ledger_residual_over_turnover");
    assert!(open.abs() < 1e-6, "energy open by {open:e}");
    assert_eq!(summary["headline"]["elasticity"]["kept_modes"]["count"], serde_json::json!([2, 2]));
}

/// With modes a sweep finds periodic states, the same bytes with any number of threads.
#[test]
fn a_sweep_with_modes_does_not_see_the_number_of_threads() {
    let sweep = "run = \"sweep\"\nperiodic_tolerance = 3e-2\nmesh_damping_ratio = 0.3\n\
                 sweep = { from_rpm = 4000, to_rpm = 5000, speeds = 2, ways = [\"up\", \"apart\"] }\n";
    let slow = with_modes(&scene(1, sweep)).replace("per_mesh_cycle = 16", "per_mesh_cycle = 8");
    let scratch = Scratch::new().file("a.toml", slow);
    let summary = run(&scratch, "one", &["-j", "1"]);
    run(&scratch, "two", &["-j", "2"]);
    assert!(scratch.read("one/resonance.csv") == scratch.read("two/resonance.csv"), "resonance.csv differs");
    assert_eq!(summary["headline"]["not_periodic_rpm"], serde_json::json!([]), "{}", summary["headline"]);
}

/// Steps by error: a hundred times less error allowed brings the transmission error nearer to that of fine steps, and
/// the count of steps up.
#[test]
fn a_tolerance_on_the_error_decides_the_steps() {
    let span = "run = \"span\"\nmesh_damping_ratio = 0.2\n";
    let dte = |more: &str| {
        let scratch = Scratch::new().file("a.toml", scene(1, &format!("{span}{more}")));
        let summary = run(&scratch, "o", &[]);
        (column(&scratch.read("o/history.csv"), "dte_um"), certificate(&summary, "steps"))
    };
    let (fine, _) =
        dte("steps_per_resonance = 400\n".replace("steps_per_resonance", "error_tolerance = 1e-9 #").as_str());
    let off = |rows: &[f64]| rows.iter().zip(&fine).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let [(loose, few), (tight, many)] = [dte("error_tolerance = 1e-3\n"), dte("error_tolerance = 1e-5\n")];
    assert_eq!([loose.len(), tight.len()], [16, 16], "rows stand at their places whatever the steps");
    assert!(many > few, "{many} steps for the smaller error, {few} for the larger one");
    assert!(off(&tight) < 0.5 * off(&loose) && off(&tight) < 0.02, "off by {} and {} um", off(&tight), off(&loose));
}

/// A driver by torque: with the torque that balances the load both gears keep their mean speed, with more they speed up
/// by torque over inertia.
#[test]
fn a_driver_by_torque_speeds_up_by_what_is_left_of_it() {
    let speeds = |torque: &str| {
        let motion = format!("run = \"span\"\nmesh_damping_ratio = 0.3\n[drive]\nby = \"torque\"\n{torque}");
        let scratch = Scratch::new().file("a.toml", scene(4, &motion));
        let summary = run(&scratch, "o", &[]);
        let open = certificate(&summary, "ledger_residual_over_turnover");
        assert!(open.abs() < 1e-6 && certificate(&summary, "least_contact_force_n") >= 0.0, "{summary}");
        let history = scratch.read("o/history.csv");
        (column(&history, "time_s"), column(&history, "pinion_speed_rpm"), summary)
    };
    let (_, balanced, _) = speeds("");
    let mean = balanced.iter().sum::<f64>() / balanced.len() as f64;
    assert!((mean / 1000.0 - 1.0).abs() < 1e-3, "the driver turns at {mean}/min on average, not 1000");
    let (time, driven, summary) = speeds("torque_nm = 200.0\n");
    // 50 N m on both inertias, equal gears.
    let inertia = |gear: &str| summary["motion"][gear]["polar_inertia_kg_m2"].as_f64();
    let gained = driven[driven.len() - 1] - 1000.0;
    assert!(
        gained > 0.0 && inertia("pinion").is_none_or(|i| i > 0.0),
        "{gained}/min gained in {} s",
        time[time.len() - 1]
    );
}

/// On bearings, all coordinates free: the bearings' forces balance those of the mesh in the mean, and the energy
/// closes.
#[test]
fn bearings_carry_the_forces_of_the_mesh() {
    let of_gear = |gear: &str| {
        format!(
            "[{gear}.body]\nfree = [\"x\", \"y\", \"z\", \"rx\", \"ry\"]\n[{gear}.bearing]\nstiffness_x_n_per_mm = 2e5\nstiffness_y_n_per_mm = 2e5\n\
             stiffness_z_n_per_mm = 1e5\nstiffness_rx_nmm_per_rad = 1e8\nstiffness_ry_nmm_per_rad = 1e8\ndamping_ratio = 0.3\n"
        )
    };
    let motion =
        format!("periodic_tolerance = 1e-3\nmesh_damping_ratio = 0.3\n{}{}", of_gear("pinion"), of_gear("wheel"));
    let scratch = Scratch::new().file("a.toml", scene(1, &motion));
    let summary = run(&scratch, "o", &[]);
    let history = scratch.read("o/history.csv");
    let mean = |name: &str| {
        let all = column(&history, name);
        all.iter().sum::<f64>() / all.len() as f64
    };
    for gear in ["pinion", "wheel"] {
        for axis in ["x", "y", "z"] {
            let [mesh, bearing] =
                [mean(&format!("{gear}_force_{axis}_n")), mean(&format!("{gear}_bearing_force_{axis}_n"))];
            assert!(
                (mesh + bearing).abs() < 0.02 * mean("normal_force_n"),
                "{gear} {axis}: mesh {mesh} N, bearing {bearing} N"
            );
        }
    }
    let open = certificate(&summary, "ledger_residual_over_turnover");
    assert!(open.abs() < 1e-6, "energy open by {open:e}");
}

/// A run-up may begin at rest: each row has the speed of its time, and the last one that which was asked for. Rows are
/// even in the turn, so the first ones are far apart in time.
#[test]
fn a_run_up_may_begin_at_rest() {
    let ramp = "run = \"ramp\"\nmesh_damping_ratio = 0.3\nramp = { from_rpm = 0, to_rpm = 2000, duration_s = 0.01, waterfall_cycles = 4 }\n";
    for method in ["energy", "generalised-alpha"] {
        let scratch = Scratch::new().file("a.toml", scene(0, &format!("method = \"{method}\"\n{ramp}")));
        let summary = run(&scratch, "o", &[]);
        let history = scratch.read("o/history.csv");
        let speed = column(&history, "pinion_speed_rpm");
        for (time, speed) in column(&history, "time_s").iter().zip(&speed) {
            let share = (time / 0.01).min(1.0);
            let asked = 2000.0 * share * share * (3.0 - 2.0 * share);
            assert!((speed - asked).abs() < 20.0, "{method}: {speed}/min at {time} s, asked for {asked}/min");
        }
        assert!((speed[speed.len() - 1] - 2000.0).abs() < 10.0, "{method}: {speed:?}");
        let dte = column(&history, "dte_um");
        assert!(dte.iter().all(|d| d.is_finite()), "{method}: {dte:?}");
        assert!(certificate(&summary, "least_contact_force_n") >= 0.0, "{method}: a flank pulls");
    }
}
