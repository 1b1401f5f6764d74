//! Pitch errors of all gears of a gearbox: on maps beside the exact contact.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, fmt::Write};

use crate::util::{Scratch, repository};

/// The two stages of the scenes, pitch errors of all four gears in files (um); their meshes are what `mesh` says.
fn two_stages(mesh: &str, amount: f64) -> Scratch {
    let read = |name: &str| std::fs::read_to_string(repository().join("scenes/gearbox").join(name)).unwrap();
    let mut scratch = Scratch::new();
    for (stage, teeth) in [("first", [17, 53]), ("second", [19, 47])] {
        let mut text = read(&format!("{stage}_stage.toml"));
        for (gear, z) in ["pinion", "wheel"].into_iter().zip(teeth) {
            let file = format!("{stage}_{gear}.txt");
            text = text.replace(&format!("[{gear}]\n"), &format!("[{gear}]\npitch_errors_file = \"{file}\"\n"));
            let errors = (0..z).fold(String::new(), |mut all, i| {
                let own = (f64::from(z) + 2.4 * f64::from(i * i)).sin() + (TAU * f64::from(i) / f64::from(z)).cos();
                writeln!(all, "{:.3}", amount * own).unwrap();
                all
            });
            scratch = scratch.file(&file, errors);
        }
        scratch = scratch.file(&format!("{stage}_stage.toml"), text);
    }
    let text = read("two_stages.toml");
    let (rest, _) = text.split_once("[vibration]").unwrap();
    let motion = format!(
        "[motion]\nspeed_rpm = 1000.0\nmesh = \"{mesh}\"\ncycles = 54\nsteps_per_cycle = 30\nmethod = \"energy\"\n\
         mesh_damping_ratio = 0.1\nmodal_damping_ratio = 0.05\nhighest_frequency_hz = 1000.0\n"
    );
    scratch.file("two_stages.toml", format!("{rest}{motion}"))
}

/// Column of a file with commas.
fn column(csv: &str, name: &str) -> Vec<f64> {
    let mut lines = csv.lines();
    let at = lines.next().unwrap().split(',').position(|n| n == name).unwrap_or_else(|| panic!("no column {name}"));
    lines.map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect()
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (n, sum) = values.fold((0.0, 0.0), |(n, sum), x| (n + 1.0, sum + x * x));
    (sum / n as f64).sqrt()
}

fn ripple(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    rms(values.iter().map(|x| x - mean))
}

/// Amplitude of an order of a turn that `values` go through once.
fn amplitude(values: &[f64], order: f64) -> f64 {
    let n = values.len() as f64;
    let sum =
        |of: fn(f64) -> f64| values.iter().enumerate().map(|(i, x)| x * of(TAU * order * i as f64 / n)).sum::<f64>();
    2.0 * sum(f64::cos).hypot(sum(f64::sin)) / n
}

/// Transmission errors and bearing forces on maps are those of the exact contact, over a turn of the middle shaft, with
/// their orders at the shaft and at the meshes; how far the offsets are off is told of both meshes.
#[test]
fn pitch_errors_of_all_gears_act_on_maps_as_in_the_exact_contact() {
    {
        let run = |mesh: &str| {
            let scratch = two_stages(mesh, 0.0);
            let run = scratch.ale_gear(["run", "two_stages.toml", "--out", "o", "--no-cache"]);
            assert_eq!(run.code, Some(0), "{}", run.stderr);
            scratch.read("o/motion.csv")
        };
        let (mapped, exact) = (run("mapped"), run("exact"));
        for name in ["mesh_1_dte_um", "mesh_2_dte_um", "mesh_1_normal_force_n", "mesh_2_normal_force_n"] {
            let [a, b] = [&mapped, &exact].map(|csv| column(csv, name));
            let mean = a.iter().zip(&b).map(|(a, b)| a - b).sum::<f64>() / a.len() as f64;
            let off = rms(a.iter().zip(&b).map(|(a, b)| a - b));
            println!("no errors {name}: off by {off:.3}, mean {mean:.3}, ripple {:.3}", ripple(&b));
        }
    }
    let run = |mesh: &str| {
        let scratch = two_stages(mesh, 2.0);
        let run = scratch.ale_gear(["run", "two_stages.toml", "--out", "o", "--no-cache"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        (scratch.read("o/motion.csv"), scratch.read("o/summary.json"))
    };
    let ((mapped, summary), (exact, _)) = (run("mapped"), run("exact"));
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let told: Vec<&serde_json::Value> =
        summary["remarks"].as_array().unwrap().iter().filter(|said| said["code"] == "pitch_errors_on_map").collect();
    assert_eq!(told.len(), 2, "{told:?}");
    for said in &told {
        println!("{}", said["text"]);
    }
    let both = |name: &str| [&mapped, &exact].map(|csv| column(csv, name));
    for name in
        ["mesh_1_dte_um", "mesh_2_dte_um", "mesh_1_normal_force_n", "mesh_2_normal_force_n", "bearing_3_force_x_n"]
    {
        let [a, b] = both(name);
        let off = rms(a.iter().zip(&b).map(|(a, b)| a - b)) / ripple(&b);
        let mean = a.iter().zip(&b).map(|(a, b)| a - b).sum::<f64>() / a.len() as f64;
        println!("{name}: off by {off:.1e} of a ripple of {:.3}, mean {mean:.3}", ripple(&b));
        assert!(off < 0.9, "{name}: off by {off:.1e} of the ripple");
        // The middle shaft turns once in 53 cycles of the first mesh.
        let turn = 53 * 30;
        let [a, b] = [&a, &b].map(|x| &x[x.len() - turn..]);
        for order in [1.0, 2.0, 19.0, 53.0] {
            let [own, wanted] = [a, b].map(|x| amplitude(x, order));
            println!("  order {order} of the middle shaft: {own:.4}, exact {wanted:.4}");
            assert!((own - wanted).abs() < 0.02 * ripple(b), "{name}, order {order}: {own} beside {wanted}");
        }
    }
}
