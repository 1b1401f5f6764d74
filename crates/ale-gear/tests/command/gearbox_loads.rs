//! Loads of a gearbox that change with time.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use crate::{
    gearbox::column,
    util::{Scratch, repository},
};

/// A shipped gearbox after its run: its file, the folder with the result `o`, what the summary says of the motion, and the
/// energy that it leaves over.
fn moved(name: &str) -> (String, Scratch, serde_json::Value, f64) {
    moved_with(name, &[])
}

/// The same with keys that are set beside the file.
fn moved_with(name: &str, keys: &[&str]) -> (String, Scratch, serde_json::Value, f64) {
    let file = repository().join("scenes/gearbox").join(name).display().to_string();
    let scratch = Scratch::new();
    let words: Vec<&str> = keys.iter().flat_map(|key| ["--set", key]).collect();
    let run = scratch.command(&[&["run", &file, "--out", "o", "--no-cache"], &words[..]].concat());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let told: serde_json::Value = serde_json::from_str(&scratch.read("o/summary.json")).unwrap();
    let left = told["motion"]["energy"]["relative_residual"].as_f64().unwrap();
    (file, scratch, told["motion"].clone(), left)
}

/// An engine whose torque pulses by more than its mean: rows have its torque at every instant, the teeth rattle, the energy is
/// accounted for. What has no meaning is told with the key.
#[test]
fn an_engine_lets_the_teeth_rattle() {
    let (file, scratch, told, left) = moved("engine.toml");
    assert!(left.abs() < 1e-9, "{left}");
    let parted = ["contact_losses", "coast_contacts"].map(|key| told["meshes"][0][key].as_u64().unwrap());
    println!("energy left {left:e}, contact lost {parted:?} times");
    assert!(parted.iter().all(|n| *n > 0), "{parted:?}");
    let rows = scratch.read("o/motion.csv");
    let given = |t: f64| 100.0 * 24.0 / 31.0 + 150.0 * (std::f64::consts::TAU * 50.0 * t).sin();
    for (t, torque) in column(&rows, "time_s").into_iter().zip(column(&rows, "input_torque_nm")) {
        assert!((torque - given(t)).abs() < 1e-6, "{torque} N m at {t} s, not {}", given(t));
    }
    // Where the speed wanders no row is at the end of a mesh cycle: the section is between them.
    let section = column(&scratch.read("o/section.csv"), "mesh_1_cycles");
    let begun = section[0];
    assert!(section.len() > 40, "{} points", section.len());
    let off = section.iter().enumerate().map(|(k, c)| (c - begun - k as f64).abs()).fold(0.0, f64::max);
    assert!(off < 1e-9, "a point is {off} cycles off");
    let wrong: [(&[&str], &str); 4] = [
        (&["motion.drive=speed"], "`amplitude_nm` of an input of given speed"),
        (&["input.table_s_nm=[[0.0, 80.0]]"], "`amplitude_nm` is beside a table"),
        (&["input.phase_deg=0", "motion.run=steady"], "under a torque the speed wanders"),
        (&["input.frequency_hz=0"], "frequency_hz"),
    ];
    for (keys, said) in wrong {
        let words: Vec<&str> = keys.iter().flat_map(|key| ["--set", key]).collect();
        let run = scratch.command(&[&["run", &file, "--out", "w"], &words[..]].concat());
        assert!(run.code == Some(2) && run.stderr.contains(said), "{keys:?}: {}", run.stderr);
    }
}

/// On maps, and with friction on all flanks, torque goes back as in the contact itself: flanks part on both sides, strike as
/// hard, lose as much, and the energy is accounted for. The short form is `torque_reverses_through_backlash_on_maps` of
/// `gearbox_laws`, without documents.
#[test]
#[ignore = "20 s: the maps of two stages with friction on both flanks"]
fn torque_reverses_on_maps_as_in_the_contact() {
    let rough = ["mesh.0.scene.contact.friction=0.05", "mesh.1.scene.contact.friction=0.05"];
    let [exact, mapped] = ["exact", "mapped"].map(|mesh| {
        let mesh = format!("motion.mesh={mesh}");
        moved_with("reversal.toml", &[&[mesh.as_str()], &rough[..]].concat())
    });
    assert!(mapped.3.abs() < 1e-9, "{}", mapped.3);
    for mesh in 0..2 {
        let of = |told: &serde_json::Value, key: &str| told["meshes"][mesh][key].as_f64().unwrap();
        for key in ["contact_losses", "coast_contacts"] {
            assert!(of(&mapped.2, key) > 0.0, "mesh {mesh}: {key}");
        }
        assert!(of(&mapped.2, "map_excess") < 1.0, "mesh {mesh} uses {} of its map", of(&mapped.2, "map_excess"));
        for (key, allowed) in [("max_normal_force_n", 2e-2), ("peak_to_peak_dte_um", 5e-3)] {
            let [a, b] = [&exact.2, &mapped.2].map(|told| of(told, key));
            println!("mesh {mesh}, {key}: {a}, on maps {b}");
            assert!((b / a - 1.0).abs() < allowed, "mesh {mesh}, {key}: {a}, on maps {b}");
        }
    }
    let [a, b] = [&exact.2, &mapped.2].map(|told| told["energy"]["dissipated_mj"].as_f64().unwrap());
    println!("lost {a} mJ, on maps {b} mJ");
    assert!((b / a - 1.0).abs() < 1e-2, "lost {a} mJ, on maps {b} mJ");
}

/// A load that becomes a drive sends torque back through the backlash of both stages: all flanks part, the coast flanks
/// press, the input brakes, and the energy is accounted for.
#[test]
fn a_load_that_reverses_goes_through_the_backlash_of_both_stages() {
    let (_, scratch, told, left) = moved("reversal.toml");
    println!("{} {}", told["energy"], told["meshes"]);
    assert!(left.abs() < 1e-9, "{left}");
    let rows = scratch.read("o/motion.csv");
    for mesh in 0..2 {
        let count = |key: &str| told["meshes"][mesh][key].as_u64().unwrap();
        let parted = [count("contact_losses"), count("coast_contacts")];
        assert!(parted.iter().all(|n| *n > 0), "mesh {mesh}: {parted:?}");
        // Both flanks of a pair stand 0.06 mm and more apart.
        let te = column(&rows, &format!("mesh_{}_dte_um", mesh + 1));
        let ends = te.iter().fold([f64::MAX, f64::MIN], |[a, b], x| [a.min(*x), b.max(*x)]);
        assert!(ends[1] - ends[0] > 60.0, "mesh {mesh} goes {ends:?} um");
    }
    // At first the input drives, clockwise; at last the load does, by the numbers of teeth.
    let torque = column(&rows, "input_torque_nm");
    assert!(torque[0] < 0.0, "{} N m", torque[0]);
    let last = &torque[torque.len() - 80..];
    println!("{:?}", torque.iter().step_by(20).map(|t| t.round()).collect::<Vec<_>>());
    let mean = last.iter().sum::<f64>() / last.len() as f64;
    let wanted = 400.0 * 17.0 * 19.0 / 53.0 / 47.0;
    assert!((0.5 * wanted..1.5 * wanted).contains(&mean), "{mean} N m at last, not {wanted}");
}
