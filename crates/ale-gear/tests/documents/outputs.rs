//! docs/outputs.md against what the program writes: every column and key of every kind of run is in it, and every
//! column and key in it is written by one of them.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::markdown::Page;
use crate::quantities::{Documented, generalised, written_in};
use crate::util::{ISO_SCENE, Scratch, motion_scene, repository};

/// Every file that a run at rest can write; no stress in a model without meshes.
fn at_rest() -> String {
    motion_scene(0, "").split("kind = \"dynamic\"").next().unwrap().to_owned()
        + "positions_per_cycle = 2\n[output]\nroot_stress = true\ncontact_lines = true\n"
}

/// The scene at rest, rated with a spectrum of loads.
fn rated() -> String {
    let gear = "material = \"18CrNiMo7-6\"\nflank_roughness_rz_um = 4.8\nflank_roughness_ra_um = 0.6\nroot_roughness_rz_um = 20.0\n";
    at_rest()
        + "[rating]\nlife_h = 2e4\napplication_factor = 1.25\ntolerance_class = 6\nlubricant = \"mineral VG 220\"\n\
           spectrum = \"loads.csv\"\noil_temperature_c = 80.0\nlubrication = \"dip\"\nscuffing = true\n\
           structural_factor = 1.0\nmicropitting = true\nmaterial_factor = 1.0\n"
        + &format!("[rating.pinion]\n{gear}[rating.wheel]\n{gear}")
}

/// A span on a map, of a wheel that moves along one axis: a map has a dimension for each.
fn on_a_map() -> String {
    let free = "[wheel.body]\nfree = [\"y\"]\n[wheel.bearing]\nstiffness_y_n_per_mm = 1e6\n";
    motion_scene(1, "run = \"span\"\n").replace("kind = \"dynamic\"\n", "kind = \"dynamic\"\nmodel = \"mapped\"\n")
        + free
}

/// A span of both gears on bearings, with everything that a motion can write.
fn on_bearings() -> String {
    let gear = |name: &str| {
        format!(
            "[{name}.body]\nfree = [\"x\", \"y\", \"z\", \"rx\", \"ry\"]\n[{name}.bearing]\nstiffness_x_n_per_mm = 1e6\nstiffness_y_n_per_mm = 1e6\n\
             stiffness_z_n_per_mm = 1e6\nstiffness_rx_nmm_per_rad = 1e9\nstiffness_ry_nmm_per_rad = 1e9\n"
        )
    };
    motion_scene(1, "run = \"span\"\n[output]\nroot_stress = true\n") + &gear("pinion") + &gear("wheel")
}

const RAMP: &str =
    "run = \"ramp\"\n[motion.ramp]\nfrom_rpm = 2000.0\nto_rpm = 4000.0\nduration_s = 0.01\nwaterfall_cycles = 4\n";
const SWEEP: &str = "run = \"sweep\"\nperiodic_tolerance = 0.5\nwarm_up_cycles = 2\n[motion.sweep]\nfrom_rpm = 900.0\nto_rpm = 1000.0\nspeeds = 2\n";
const STUDY: &str = "[[case]]\nscene = \"iso.toml\"\nlabel = \"a\"\nvalue = 1\n[[case]]\nscene = \"iso.toml\"\nlabel = \"b\"\nvalue = 2\nset = [\"operation.torque_nm=100\"]\n\
    [[quantity]]\ncolumn = \"ste_um\"\n[[follow]]\ncolumn = \"ste_um\"\nbeside = [\"pairs_in_contact\"]\n";

/// A rung that is left and one that is taken.
const EXACT: &str = "[pinion]\nteeth = 24\nhelix_angle_deg = 15.0\n[wheel]\nteeth = 31\n[pair]\nnormal_module_mm = 3.0\n\
    face_width_mm = 15.0\n[operation]\ntorque_nm = 200.0\n[accuracy]\nmean_ste = \"50 %\"\npeak_to_peak_ste = \"20 %\"\n";

/// A model of motion that is left, and one that is taken.
const EXACT_MOTION: &str = "[pinion]\nteeth = 24\nhelix_angle_deg = 15.0\n[wheel]\nteeth = 31\n[pair]\nnormal_module_mm = 3.0\n\
    face_width_mm = 6.0\n[operation]\ntorque_nm = 80.0\nspeed_rpm = 2000.0\n[contact]\nslices = 8\nflanks = \"driving\"\n\
    [analysis]\nkind = \"dynamic\"\ncycles = 1\n[motion]\nperiodic_tolerance = 1e-3\n[accuracy]\npeak_to_peak_dte = \"60 %\"\n";

/// A command that ends as it should.
fn done(scratch: &Scratch, words: &[String]) {
    let done = scratch.command(&words.iter().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(done.code, Some(0), "{words:?}: {}", done.stderr);
}

/// One folder of every kind, in a folder of its own each.
fn every_kind() -> Scratch {
    let scratch = Scratch::new()
        .file("iso.toml", ISO_SCENE)
        .file("rest.toml", at_rest())
        .file("rated.toml", rated())
        .file("loads.csv", "torque_nm,speed_rpm,share\n150,1000,0.5\n50,1000,0.5\n")
        .file("span.toml", on_bearings())
        .file("mapped.toml", on_a_map())
        .file("ramp.toml", motion_scene(0, RAMP))
        .file("resonance.toml", motion_scene(1, SWEEP))
        .file("exact.toml", EXACT)
        .file("exact_motion.toml", EXACT_MOTION)
        .file("study.toml", STUDY);
    let mut runs: Vec<Vec<String>> = Vec::new();
    let mut run = |words: &[&str]| runs.push(words.iter().map(ToString::to_string).collect());
    for scene in ["iso", "rest", "rated", "exact", "exact_motion", "span", "ramp", "resonance"] {
        run(&["run", &format!("{scene}.toml"), "--out", &format!("out-{scene}")]);
    }
    let modes = ["--set", "analysis.model=reduced+modes", "--set", "modes.count=1"];
    run(&[&["run", "ramp.toml", "--out", "out-modes"], &modes[..]].concat());
    let key = "pinion.modification.lead_crowning_um";
    run(&["run", "rest.toml", "--out", "out-derivatives", "--derivatives", key, "--set", "output.root_stress=false"]);
    let uneven = format!("pinion.pitch_errors_um=[{}5]", "0,".repeat(29));
    let orders = ["--set", &uneven, "--set", "output.flank_orders=true", "--set", "output.root_stress=false"];
    run(&[&["run", "rest.toml", "--out", "out-orders", "--set", "analysis.turn=pinion"], &orders[..]].concat());
    run(&["run", "mapped.toml", "--out", "out-mapped"]);
    let seed = |number: &str| repository().join(format!("scenes/seeds/{number}.toml")).display().to_string();
    let soon = ["--set", "analysis.cycles=2", "--set", "motion.warm_up_cycles=2"];
    let start = ["--set", "motion.ramp.duration_s=0.004", "--set", "motion.ramp.after_s=0.01"];
    for (number, words) in [("001", &start[..]), ("002", &soon), ("003", &soon), ("004", &soon)] {
        run(&[&["run", &seed(number), "--out", &format!("out-{number}")], words].concat());
    }
    let key = [
        "--vary",
        "operation.speed_rpm=900:1000:2",
        "--start",
        "carry",
        "--cycles",
        "6",
        "--settle",
        "20",
        "--lyapunov",
        "10",
    ];
    run(&[&["vary", &seed("004"), "--out", "out-sweep"], &key[..]].concat());
    let curve =
        ["--vary", "operation.speed_rpm=900:1000", "--start", "branch", "--set", "motion.continuation.longest_step=1"];
    let lightly = ["--set", "motion.continuation.time_points=1"];
    run(&[&["vary", &seed("004"), "--out", "out-curve"], &curve[..], &lightly].concat());
    let basins = ["--start", "basin", "--vary", "start_um=-1:1:2", "--vary", "start_mm_s=-1:1:2"];
    run(&[&["vary", &seed("004"), "--out", "out-basins"], &basins[..]].concat());
    run(&["run", "study.toml", "--out", "out-study"]);
    let key = ["--vary", "operation.torque_nm=100:200:2", "--of", "ste_um"];
    run(&[&["vary", "iso.toml", "--out", "out-sweep-at-rest"], &key[..]].concat());
    let words = ["--vary", "operation.torque_nm~normal:200:5", "--output", "mean_ste_um", "--samples", "2"];
    run(&[&["vary", "iso.toml", "--out", "out-vary"], &words[..]].concat());
    let bounds = "pinion.modification.lead_crowning_um=0:10";
    let words = ["--vary", bounds, "--evaluations", "2", "--front", "1", "--set", "output.root_stress=false"];
    run(&[&["optimise", "rest.toml", "--out", "out-optimise"], &words[..]].concat());
    run(&["envelope", "--only", "F14,d", "--out", "out-envelope"]);
    let stages = repository().join("scenes/gearbox/two_stages.toml").display().to_string();
    run(&["run", &stages, "--out", "out-gearbox"]);
    let rolling = repository().join("scenes/gearbox/rolling_bearings.toml").display().to_string();
    run(&["run", &rolling, "--set", "motion.to_speed_rpm=1600", "--out", "out-rolling"]);
    let rated = repository().join("scenes/gearbox/rated.toml").display().to_string();
    run(&["run", &rated, "--out", "out-rated-gearbox"]);
    let accurate = repository().join("scenes/gearbox/accurate.toml").display().to_string();
    run(&["run", &accurate, "--out", "out-accurate"]);
    let elastic = repository().join("scenes/gearbox/elastic_gears.toml").display().to_string();
    run(&["run", &elastic, "--out", "out-elastic"]);
    let pair = repository().join("scenes/gearbox/elastic_pair.toml").display().to_string();
    run(&["run", &pair, "--set", "motion.cycles=1", "--out", "out-exact-gearbox"]);
    let mapped = repository().join("scenes/gearbox/in_housing.toml").display().to_string();
    run(&["run", &mapped, "--set", "motion.cycles=2", "--out", "out-mapped-gearbox"]);
    let branch = repository().join("scenes/gearbox/resonance_curve.toml").display().to_string();
    // Its first part, before the resonance.
    let part = ["--set", "motion.continuation.time_points=1", "--set", "motion.to_speed_rpm=11000"];
    run(&[&["run", &branch, "--out", "out-branch"], &part[..]].concat());
    let planets = repository().join("scenes/gearbox/planetary_stage.toml").display().to_string();
    run(&["run", &planets, "--set", "analysis.positions_per_cycle=1", "--out", "out-planets"]);
    let idler = repository().join("scenes/gearbox/idler.toml").display().to_string();
    run(&["run", &idler, "--set", "analysis.positions_per_cycle=1", "--out", "out-idler"]);
    let bolts = repository().join("scenes/gearbox/ring_on_bolts.toml").display().to_string();
    run(&["run", &bolts, "--set", "analysis.positions_per_cycle=1", "--out", "out-bolts"]);
    let ring = "[pinion]\nteeth = 36\nhelix_angle_deg = 0.0\n[wheel]\nteeth = -93\ntip_diameter_mm = -182.5\n[pair]\n\
                normal_module_mm = 2.0\nface_width_mm = 15.0\n[operation]\ntorque_nm = 100.0\n[analysis]\npositions_per_cycle = 2\n";
    std::fs::write(scratch.path().join("ring.toml"), ring).unwrap();
    run(&["run", "ring.toml", "--out", "out-ring"]);
    // Much of a run is one thread's.
    let (command, next) = (|words: &[String]| done(&scratch, words), AtomicUsize::new(0));
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while let Some(words) = runs.get(next.fetch_add(1, Ordering::Relaxed)) {
                    command(words);
                }
            });
        }
    });
    command(&["compare", "out-iso", "out-rest", "--out", "out-compare"].map(String::from));
    scratch
}

fn folders(scratch: &Scratch) -> impl Iterator<Item = std::path::PathBuf> + '_ {
    scratch.names().into_iter().filter(|n| n.starts_with("out-")).map(|n| scratch.path().join(n))
}

/// Sections and tables whose quantities no run above writes: a chart takes minutes, and so does `full` of a study; the rated pair is within the standard;
/// fields of ParaView files have a test of their own, and inputs are not read here.
const NOT_TRIED: [&str; 7] = [
    "Files of ale-gear chart",
    "Files of ale-gear optimise",
    "*.vtu, gears.pvd",
    "key of at_rest",
    "key of full, a study",
    "key of inputs, a plan",
    "key of outside",
];

#[test]
fn what_is_written_is_documented_and_what_is_documented_is_written() {
    let scratch = every_kind();
    let page = Page::read(repository().join("docs/outputs.md"));
    let documented = Documented::by(&page);
    let missing: Vec<String> = folders(&scratch).flat_map(|folder| documented.missing(&folder)).collect();
    assert!(missing.is_empty(), "not in docs/outputs.md:\n{}", missing.join("\n"));

    let written: BTreeSet<String> = folders(&scratch)
        .flat_map(|folder| written_in(&folder))
        .flat_map(|(_, names)| names)
        .map(|name| generalised(&name))
        .collect();
    let unknown: Vec<String> = page
        .table_keys()
        .into_iter()
        .filter(|k| !NOT_TRIED.iter().any(|t| k.section == *t || k.title == *t))
        // Files and words of the command line have dots and hyphens.
        .filter(|k| k.name.chars().all(|c| c.is_ascii_alphanumeric() || "_<>".contains(c)))
        .filter(|k| {
            let general = generalised(&k.name);
            let stands_for = |w: &String| {
                let wanted = ["<column>", "<key>", "<output>", "<column>_<beside>"];
                wanted.iter().find_map(|end| k.name.strip_suffix(end)).is_some_and(|start| w.starts_with(start))
            };
            !written.contains(&general) && !written.iter().any(stands_for)
        })
        .map(|k| format!("{}: `{}` in \"{}\"", page.place(k.byte), k.name, k.section))
        .collect();
    assert!(unknown.is_empty(), "documented, but no run writes it:\n{}", unknown.join("\n"));
}
