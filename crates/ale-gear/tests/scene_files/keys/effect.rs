//! Every key has an effect: another value changes the result, or is refused.

use std::collections::BTreeMap;
use std::sync::Mutex;

use ale_gear::scene::all_keys;
use serde_json::Value;

use super::rows::{Base, tables};
use crate::util::{ISO_SCENE, Run, Scratch, motion_scene, repository};

/// Words of a run with the key at the case's value, and with it at the other one.
struct Case {
    base: Base,
    before: Vec<String>,
    other: String,
}

/// The case of a key, with what its row says put in for its table.
fn case(key: &str) -> Option<Case> {
    tables().into_iter().find_map(|(table, words, rows)| {
        let own = key.strip_prefix(table.as_str())?;
        let (_, base, list, value) = rows.iter().find(|row| row.0 == own)?;
        let all = words.split("; ").chain(list.split("; ")).filter(|w| !w.is_empty());
        let before = all.map(|w| w.replace('~', &table)).collect();
        Some(Case { base: *base, before, other: format!("{key}={value}") })
    })
}

/// The scene of a case.
fn scene(base: Base) -> String {
    let seed =
        |number: &str| std::fs::read_to_string(repository().join(format!("scenes/seeds/{number}.toml"))).unwrap();
    let mesher =
        "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n";
    let tiny = ISO_SCENE.replace("[wheel]\n", &format!("{mesher}[wheel]\n{mesher}"));
    let reduced = tiny.replace("model = \"iso\"\n", "positions_per_cycle = 3\n");
    let few_slices = "[contact]\nslices = 4\n";
    match base {
        Base::Iso => format!("{tiny}positions_per_cycle = 4\n"),
        Base::Reduced => reduced,
        Base::Files => reduced.replace(mesher, "mesh = \"sector.msh\"\n").replacen(
            "[wheel]\nmesh = \"sector.msh\"",
            "[wheel]\nmesh = \"sector_wheel.msh\"",
            1,
        ),
        Base::Motion => motion_scene(0, "run = \"span\"\n") + few_slices,
        Base::Modes => {
            motion_scene(1, "warm_up_cycles = 1\n")
                .replace("kind = \"dynamic\"\n", "kind = \"dynamic\"\nmodel = \"reduced+modes\"\n")
                + few_slices
        }
        Base::Lumped8 => seed("004"),
        Base::Lumped12 => seed("003"),
        Base::Shaft18 => seed("002"),
        Base::Impact => seed("001"),
        Base::Ring => format!(
            "[pinion]\nteeth = 36\nhelix_angle_deg = 0.0\n{mesher}[wheel]\nteeth = -93\ntip_diameter_mm = -182.5\n{mesher}[pair]\nnormal_module_mm = 2.0\n\
             face_width_mm = 15.0\n[operation]\ntorque_nm = 100.0\n[analysis]\npositions_per_cycle = 2\n{few_slices}"
        ),
        Base::Flanks => {
            ISO_SCENE.replace("model = \"iso\"\n", "model = \"impact\"\ncycles = 1\npositions_per_cycle = 2\n")
                + few_slices
                + "[motion]\nrun = \"span\"\nsteps_per_mesh_cycle = 8\n[load]\ntable_s_nm = [[0.0, 150.0], [0.0008, 150.0], [0.0009, -150.0]]\n"
        }
    }
}

/// What makes the seeds' scenes short.
fn short(base: Base) -> &'static [&'static str] {
    match base {
        Base::Lumped8 => &["analysis.cycles=2", "motion.warm_up_cycles=12"],
        Base::Lumped12 | Base::Shaft18 => &["analysis.cycles=2", "motion.warm_up_cycles=4"],
        Base::Motion | Base::Modes => &["analysis.cycles=1"],
        Base::Impact => &[
            "contact.slices=5",
            "analysis.positions_per_cycle=2",
            "motion.steps_per_mesh_cycle=16",
            "motion.ramp.duration_s=0.003",
            "motion.ramp.after_s=0.001",
        ],
        _ => &[],
    }
}

/// What a user sees of a run, but for times and for the echo of the input.
fn seen(scratch: &Scratch, run: Run) -> String {
    let mut all = format!("{:?}\n{}", run.code, run.stderr);
    let folder = scratch.path().join("o");
    if !folder.is_dir() {
        return all;
    }
    let mut names: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().path()).collect();
    names.sort();
    for path in names {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let content = match name.as_str() {
            "report.html" | "report.json.gz" => String::new(),
            "summary.json" => summary(&std::fs::read_to_string(&path).unwrap()),
            _ => String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned(),
        };
        all += &format!("== {name}\n{content}\n");
    }
    std::fs::remove_dir_all(folder).unwrap();
    all
}

fn summary(text: &str) -> String {
    let mut summary: Value = serde_json::from_str(text).unwrap();
    let map = summary.as_object_mut().unwrap();
    for echo in ["inputs", "cost", "first_result_s"] {
        map.remove(echo);
    }
    // Whether gears came from the cache depends on what ran before.
    if let Some(model) = map.get_mut("model").and_then(Value::as_object_mut) {
        model.remove("gears_from_cache");
    }
    summary.to_string()
}

/// A folder with the scenes of all cases and the files that they name.
fn prepared() -> Scratch {
    let grid = "diameter_mm -9 0 9\n92 -5 0 -4\n96 -3 0 -2\n101 -6 -4 -5\n";
    let mut scratch = Scratch::new().file("grid.csv", grid).file("pitch.csv", "4\n".repeat(15) + &"-3\n".repeat(15));
    scratch = scratch.file("loads.csv", "torque_nm,speed_rpm,share\n150,1000,0.5\n50,1000,0.5\n");
    let table = |name: &str, old: &str, new: &str| {
        let file = repository().join("crates/rating/data").join(name);
        std::fs::read_to_string(file).unwrap().replace(old, new)
    };
    scratch = scratch.file("oils.toml", table("lubricants.toml", "_40c_mm2_per_s = 220.0", "_40c_mm2_per_s = 260.0"));
    scratch = scratch
        .file("steels.toml", table("materials.toml", "contact_limit_mpa = 1500.0", "contact_limit_mpa = 1550.0"));
    for base in [
        Base::Iso,
        Base::Reduced,
        Base::Motion,
        Base::Modes,
        Base::Lumped8,
        Base::Lumped12,
        Base::Shaft18,
        Base::Impact,
        Base::Flanks,
        Base::Ring,
    ] {
        scratch = scratch.file(&format!("{base:?}.toml"), scene(base));
    }
    let sector = scene(Base::Reduced).replace("order = 1", "sector_teeth = 1, order = 1");
    scratch = scratch.file("Sector.toml", sector);
    for (gear, name) in [("pinion", "sector.msh"), ("wheel", "sector_wheel.msh")] {
        let run = scratch.ale_gear(["mesh", "generate", "Sector.toml", "--gear", gear, "--output", name]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
    }
    // A coarser or finer mesh of the same gear; hands differ, so each gear has its own file.
    let other = scene(Base::Reduced)
        .replace("order = 1, elements_profile = 2", "sector_teeth = 1, order = 1, elements_profile = 3");
    scratch = scratch.file("Other.toml", other);
    scratch.file("Files.toml", scene(Base::Files))
}

/// Checkpoints leave nothing behind when all goes well: seen by a file that is in their way.
const IN_THE_WAY: &str = "o.checkpoint";

/// Keys that are tried in one scene, each with its case.
type Group = Vec<(String, Case)>;

/// All keys in groups of one scene each, so that what a scene shows without them is found once; and keys without a row.
fn groups() -> (Vec<Group>, Vec<String>) {
    let mut groups: BTreeMap<(Base, Vec<String>), Group> = BTreeMap::new();
    let mut faults = Vec::new();
    for key in all_keys() {
        match case(&key) {
            Some(case) => groups.entry((case.base, case.before.clone())).or_default().push((key, case)),
            None => faults.push(format!("{key}: has no row in tests/scene_files/keys/rows.rs")),
        }
    }
    (groups.into_values().collect(), faults)
}

/// Keys of one group that change nothing, each with the reason.
fn without_effect(scratch: &Scratch, group: Group) -> Vec<String> {
    let run = |base: Base, words: &[String]| {
        let file = format!("{base:?}.toml");
        let mut all = vec!["run", &file, "--out", "o", "--threads", "1"];
        // What says its length in seconds has no cycles.
        let seconds = words.iter().any(|w| w.starts_with("motion.ramp") || w.starts_with("motion.duration_s"));
        let short = if seconds && base == Base::Motion { &[] } else { short(base) };
        all.extend(short.iter().flat_map(|w| ["--set", w]));
        all.extend(words.iter().flat_map(|w| ["--set", w]));
        seen(scratch, scratch.command(&all))
    };
    let mut faults = Vec::new();
    let mut without = None;
    for (key, case) in group {
        if key.ends_with(".mesh") {
            let gear = &key[..key.len() - 5];
            let made = scratch.ale_gear(["mesh", "generate", "Other.toml", "--gear", gear, "--output", "other.msh"]);
            assert_eq!(made.code, Some(0), "{}", made.stderr);
        }
        let before: &String = without.get_or_insert_with(|| run(case.base, &case.before));
        let words = [&case.before[..], std::slice::from_ref(&case.other)].concat();
        if !before.starts_with("Some(0)") {
            faults.push(format!("{key}: the case itself fails with {:?}: {before}", case.before));
        } else if *before == run(case.base, &words) {
            faults.push(format!("{key}: {} changes nothing in {:?} with {:?}", case.other, case.base, case.before));
        }
    }
    faults
}

/// Every key that the schema lists has a row here, and another value of it changes what a user sees. Each run has one
/// thread, so cases share the machine.
#[test]
fn every_key_has_an_effect() {
    let (groups, mut faults) = groups();
    let left = Mutex::new(groups.into_iter());
    let work = || {
        let scratch = prepared().file(IN_THE_WAY, "");
        let mut faults = Vec::new();
        loop {
            let group = left.lock().unwrap().next();
            let Some(group) = group else { return faults };
            faults.extend(without_effect(&scratch, group));
        }
    };
    let workers = std::thread::available_parallelism().map_or(1, usize::from).min(8);
    std::thread::scope(|scope| {
        let all: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        faults.extend(all.into_iter().flat_map(|worker| worker.join().unwrap()));
    });
    assert!(faults.is_empty(), "{} keys without effect:\n{}", faults.len(), faults.join("\n"));
}
