//! Pitch errors of all gears of a gearbox: on maps beside the exact contact.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, fmt::Write};

use crate::{
    gearbox::column,
    util::{Scratch, repository},
};

/// Steps and rows a cycle of the first mesh.
const STEPS: usize = 20;

/// The two stages of the scenes, pitch errors of all four gears in files, as large as `amount` (um); their meshes are what
/// `mesh` says.
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
        "[motion]\nspeed_rpm = 1000.0\nmesh = \"{mesh}\"\ncycles = 54\nsteps_per_cycle = {STEPS}\nmethod = \"energy\"\n\
         mesh_damping_ratio = 0.1\nmodal_damping_ratio = 0.05\nhighest_frequency_hz = 1000.0\n"
    );
    scratch.file("two_stages.toml", format!("{rest}{motion}"))
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64).sqrt()
}

fn less(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn ripple(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    rms(&values.iter().map(|x| x - mean).collect::<Vec<_>>())
}

/// Amplitude of an order of a turn that `values` go through once.
fn amplitude(values: &[f64], order: f64) -> f64 {
    let n = values.len() as f64;
    let sum =
        |of: fn(f64) -> f64| values.iter().enumerate().map(|(i, x)| x * of(TAU * order * i as f64 / n)).sum::<f64>();
    2.0 * sum(f64::cos).hypot(sum(f64::sin)) / n
}

/// What pitch errors do to transmission errors, mesh forces and bearing forces on maps is what they do in the exact contact,
/// over a turn of the middle shaft, with their orders at the shaft and at the meshes; how far the offsets are off is told of
/// both meshes. What maps and exact contact are apart without pitch errors is taken off.
#[test]
fn pitch_errors_of_all_gears_act_on_maps_as_in_the_exact_contact() {
    let run = |mesh: &str, amount: f64| {
        let scratch = two_stages(mesh, amount);
        let run = scratch.ale_gear(["run", "two_stages.toml", "--out", "o", "--no-cache"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        (scratch.read("o/motion.csv"), scratch.read("o/summary.json"))
    };
    let [(mapped, summary), (exact, _)] = ["mapped", "exact"].map(|mesh| run(mesh, 2.0));
    let alike = ["mapped", "exact"].map(|mesh| run(mesh, 0.0).0);
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let told: Vec<&serde_json::Value> =
        summary["remarks"].as_array().unwrap().iter().filter(|said| said["code"] == "pitch_errors_on_map").collect();
    assert_eq!(told.len(), 2, "{told:?}");
    for said in &told {
        println!("{}", said["text"]);
    }
    for name in
        ["mesh_1_dte_um", "mesh_2_dte_um", "mesh_1_normal_force_n", "mesh_2_normal_force_n", "bearing_3_force_x_n"]
    {
        let [without, wanted_without] = alike.each_ref().map(|csv| column(csv, name));
        let [with, wanted_with] = [&mapped, &exact].map(|csv| column(csv, name));
        let (own, wanted) = (less(&with, &without), less(&wanted_with, &wanted_without));
        let (off, size) = (rms(&less(&own, &wanted)), ripple(&wanted));
        let apart = [rms(&less(&with, &wanted_with)), rms(&less(&without, &wanted_without))];
        println!(
            "{name}: pitch errors do {size:.3}, off by {:.1e}; all off by {apart:.3?}, mean {:.1}",
            off / size,
            rms(&wanted_with)
        );
        // Forces have the error of the map itself, some permille of the deflection times the stiffness.
        let mean = wanted_with.iter().sum::<f64>().abs() / wanted_with.len() as f64;
        let (of_order, of_all) = if name.ends_with("_um") { (0.03, 0.05 * size) } else { (0.1, 0.01 * mean) };
        // The middle shaft turns once in 53 cycles of the first mesh.
        let turn = 53 * STEPS;
        for order in [1.0, 2.0, 19.0, 53.0] {
            let [own, wanted] = [&own, &wanted].map(|x| amplitude(&x[x.len() - turn..], order));
            println!("  order {order} of the middle shaft: {own:.4}, exact {wanted:.4}");
            assert!((own - wanted).abs() < of_order * size, "{name}, order {order}: {own} beside {wanted}");
        }
        assert!(off < of_all, "{name}: off by {off}, allowed {of_all}");
    }
}
