//! Every pair of the scenes as a gearbox of two held shafts.
#![allow(clippy::print_stdout, reason = "the figure is what the test is for")]

use std::{
    path::{Path, PathBuf},
    sync::Mutex,
};

use analysis::{Context, Ending, GearCache, Kept, NoObserver, SharedModels, StaticAnalysis, remark::Remark, solve};
use contact::SliceResult;
use gearbox::MeshState;
use ltca::StaticPosition;
use reduction::{RecordKey, ReductionRecord};
use scene::{
    Scene,
    gearbox::{Gearbox, gearbox_of_pair},
};

/// The last reduced gears: pair and gearbox have the same ones, and so have many scenes.
#[derive(Default)]
struct Records(Mutex<Vec<(RecordKey, ReductionRecord)>>);

impl GearCache for Records {
    fn is_on(&self) -> bool {
        true
    }

    fn load(&self, key: &RecordKey) -> (Option<Kept<RecordKey, ReductionRecord>>, Option<Remark>) {
        let known = self.0.lock().unwrap();
        (known.iter().find(|(own, _)| own == key).map(|(own, record)| Kept::new(*own, record.clone())), None)
    }

    fn save(&self, key: &RecordKey, record: &ReductionRecord) -> Option<Remark> {
        let mut known = self.0.lock().unwrap();
        if known.len() == 8 {
            known.remove(0);
        }
        known.push((*key, record.clone()));
        None
    }
}

/// Positions of a mesh cycle.
const POSITIONS: usize = 3;
/// Tables of a scene that say what the pair is; the others say what is done with it, and what holds it.
const PAIR: [&str; 5] = ["pinion", "wheel", "pair", "material", "operation"];
const HOLDS: [&str; 3] = ["bearing", "body", "shaft"];
/// At rest by slices, which is what a gearbox takes.
const AT_REST: &str = "[contact]\nslices = 12\n[analysis]\nkind = \"static\"\npositions_per_cycle = 3\n";

/// Elements of the gears that the program meshes.
const COARSE: &str =
    "order = 1\nelements_profile = 4\nelements_fillet = 2\nelements_thickness = 2\nelements_face = 8\nelements_rim = 2";

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

/// All files below a folder that hold one pair.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut all: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    all.sort();
    let within = |path: PathBuf| if path.is_dir() { files(&path) } else { vec![path] };
    let is_pair = |path: &PathBuf| {
        let name = path.extension().is_some_and(|e| e == "toml");
        name && std::fs::read_to_string(path).unwrap().lines().any(|line| line == "[pair]")
    };
    all.into_iter().flat_map(within).filter(is_pair).collect()
}

/// Largest difference of two lists of numbers over the largest of the second, of which the first may have the beginning.
fn off(own: &[f64], wanted: &[f64]) -> f64 {
    let size = wanted.iter().fold(f64::MIN_POSITIVE, |m: f64, x| m.max(x.abs()));
    own.iter().zip(wanted).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs())) / size
}

/// Every number that both have, by name: how far the gearbox is from the pair.
fn differences(mesh: &MeshState, wanted: &StaticPosition) -> Vec<(&'static str, f64)> {
    let largest = |slices: &mut dyn Iterator<Item = &SliceResult>| slices.map(|s| s.pressure).fold(0.0, f64::max);
    // `max_pressure` of a position leaves the last nine digits of equal ones to chance.
    let pressures = [largest(&mut mesh.slices.iter()), largest(&mut wanted.pairs.iter().flat_map(|pair| &pair.slices))];
    let mut all = vec![
        ("transmission error", off(&[mesh.transmission_error], &[wanted.transmission_error])),
        ("largest pressure", off(&pressures[..1], &pressures[1..])),
        ("normal force", off(&[mesh.normal_force], &[wanted.pairs.iter().map(|p| p.normal_force).sum()])),
    ];
    for (i, wrench) in wanted.wrench.iter().enumerate() {
        all.push(("force", off(&mesh.force[i], &wrench.force)));
        // The gearbox tells the moment about a gear's own axis, which misalignment tilts.
        all.push(("tilting moment", off(&mesh.moment[i][..2], &wrench.moment)));
    }
    all
}

/// Shafts held, every pair of the scenes at rest is its own gearbox to 1e-9: transmission error, forces, moments
/// and pressure at every position, K_Hbeta. (Every other pair, unless all cases are tried.)
#[test]
fn every_pair_of_the_scenes_is_a_gearbox_of_held_shafts() {
    let mut worst = ("", 0.0, String::new());
    let files = files(&scenes());
    let records = Records::default();
    assert!(files.len() > 50, "{} scenes", files.len());
    // Many scenes do different things with one pair.
    let (mut seen, mut tried) = (std::collections::BTreeSet::new(), 0);
    for path in files {
        let name = path.strip_prefix(scenes()).unwrap().display().to_string();
        // A gearbox takes no mesh without load.
        if name.ends_with("F16-no-load.toml") {
            continue;
        }
        let text = pair_at_rest(&path);
        if !seen.insert(text.lines().filter(|line| !line.starts_with("name")).collect::<Vec<_>>().join("\n")) {
            continue;
        }
        if seen.len() % testing::cases(2, 1) != 0 {
            continue;
        }
        tried += 1;
        let found = beside(&text, &SharedModels::new(&records)).unwrap_or_else(|said| panic!("{name}: {said}"));
        for (what, off) in found {
            assert!(off < 1e-9, "{name}: {what} of the gearbox is off by {off:.1e}");
            if off > worst.1 {
                worst = (what, off, name.clone());
            }
        }
    }
    println!("{tried} pairs; largest difference {:.1e}: {} of {}", worst.1, worst.0, worst.2);
}

/// The pair of a scene, at rest; gears that the program meshes are coarse: how finely makes no difference to the law.
fn pair_at_rest(path: &Path) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    let (mut is_pair, mut is_mesher) = (true, false);
    let mut all = Vec::new();
    // Gears whose mesh is a file, or that are coarse already.
    let mut gear = String::new();
    let mut meshed = std::collections::BTreeSet::new();
    for line in text.lines() {
        if let Some(table) = line.strip_prefix('[') {
            let names: Vec<&str> = table.split(']').next().unwrap().split('.').collect();
            is_pair = PAIR.contains(&names[0]) && !names[1..].iter().any(|name| HOLDS.contains(name));
            is_mesher = names[1..] == ["mesher"];
            gear = names[0].to_owned();
            if is_mesher {
                meshed.insert(gear.clone());
                all.push(format!("{line}\n{COARSE}"));
                continue;
            }
        }
        match line.strip_prefix("mesh = \"") {
            Some(mesh) => {
                meshed.insert(gear.clone());
                all.push(format!("mesh = \"{}/{mesh}", path.parent().unwrap().display()));
            }
            None if is_mesher && (line.starts_with("order") || line.starts_with("elements_")) => (),
            None if is_pair => all.push(line.to_owned()),
            None => (),
        }
    }
    for gear in ["pinion", "wheel"].into_iter().filter(|gear| !meshed.contains(*gear)) {
        all.push(format!("[{gear}.mesher]\n{COARSE}"));
    }
    all.join("\n") + "\n" + AT_REST
}

/// How far the gearbox of a scene is from its pair.
fn beside(pair: &str, gears: &SharedModels<'_>) -> Result<Vec<(&'static str, f64)>, String> {
    let say = |e: &dyn std::fmt::Display| e.to_string();
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("pair.toml");
    std::fs::write(&own, pair).unwrap();
    let scene = Scene::read(&own).map_err(|e| say(&e))?;
    let alone = StaticAnalysis::new(&scene).with_shared(gears).solve().map_err(|e| say(&e))?;
    let file = Gearbox::parse(&gearbox_of_pair(&scene).map_err(|e| say(&e))?.text, &folder.path().join("held.toml"))
        .map_err(|e| say(&e))?;
    let found = solve(&file, Context::<Gearbox>::new(&mut NoObserver).with_models(gears))
        .and_then(Ending::finished)
        .map_err(|e| say(&e))?;
    assert_eq!((found.positions.len(), alone.history.positions.len()), (POSITIONS, POSITIONS));
    let mut all = Vec::new();
    for (own, wanted) in found.positions.iter().zip(&alone.history.positions) {
        all.extend(differences(&own.meshes[0], wanted));
    }
    let factor = analysis::results::face_load_factor(12, &alone.history.positions);
    if let (Some(own), Some(wanted)) = (found.meshes[0].face_load_factor, factor) {
        all.push(("K_Hbeta", off(&[own], &[wanted])));
    }
    Ok(all)
}
