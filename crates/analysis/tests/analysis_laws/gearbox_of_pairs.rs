//! Every pair of the scenes as a gearbox of two held shafts.
#![allow(clippy::print_stdout, reason = "the figure is what the test is for")]

use std::path::{Path, PathBuf};

use analysis::{Context, Ending, NoObserver, StaticAnalysis, solve};
use contact::SliceResult;
use fem::{
    Material,
    beam::{BeamPiece, BeamSection},
};
use gearbox::{Disc, MeshState, Shaft, Structure, Train};
use geometry::Sense;
use ltca::StaticPosition;
use scene::{Driver, Scene, gearbox::Gearbox};

/// Positions of a mesh cycle.
const POSITIONS: usize = 3;
/// Tables of a scene that say what the pair is; the others say what is done with it, and what holds it.
const PAIR: [&str; 5] = ["pinion", "wheel", "pair", "material", "operation"];
const HOLDS: [&str; 3] = ["bearing", "body", "shaft"];
/// At rest by slices, which is what a gearbox takes.
const AT_REST: &str = "[contact]\nslices = 12\n[analysis]\nkind = \"static\"\npositions_per_cycle = 3\n";

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

/// The driver's key, rad, with which the pair begins where a run by itself does: at the beginning of mesh cycle 0.
fn key(scene: &Scene) -> f64 {
    let pair = scene.gear_pair().unwrap();
    let section = BeamSection::new(20.0, 0.0, Material::STEEL).unwrap();
    let shaft = |name: &str, x: f64| Shaft {
        name: name.into(),
        origin: [x, 0.0, 0.0],
        pieces: vec![BeamPiece { length: 100.0, section }],
        longest_element: 100.0,
    };
    let structure = Structure {
        shafts: vec![shaft("pinion", 0.0), shaft("wheel", pair.centre_distance())],
        discs: vec![Disc::seat("pinion", 0, 50.0), Disc::seat("wheel", 1, 50.0)],
        ..Structure::default()
    };
    let mesh = gearbox::Mesh { name: "pair".into(), discs: [0, 1], pair };
    let train = Train::new(&structure, &[mesh], &[0.0; 2], driver(scene), sense_of_input(scene)).unwrap();
    let (start, on) = (train.cycles(0.0)[0], train.cycles(1.0)[0]);
    -start / (on - start)
}

fn driver(scene: &Scene) -> usize {
    usize::from(scene.operation.driver == Driver::Wheel)
}

fn sense_of_input(scene: &Scene) -> Sense {
    let ccw = (scene.operation.rotation == Sense::Ccw) == (driver(scene) == 0);
    if ccw { Sense::Ccw } else { Sense::Cw }
}

/// The gearbox file of a scene: both shafts held, the driver's turned, the other one loaded.
fn held(scene: &Scene) -> String {
    let apart = scene.gear_pair().unwrap().centre_distance();
    let shaft = |name: &str, x: f64| {
        format!(
            "[[shaft]]\nname = \"{name}\"\norigin_mm = [{x:?}, 0.0, 0.0]\nheld = true\n\
             [[shaft.section]]\nlength_mm = 100.0\nouter_diameter_mm = 20.0\n"
        )
    };
    let names = ["pinion", "wheel"];
    let gear = |i: usize| {
        let key_deg = if i == driver(scene) { key(scene).to_degrees() } else { 0.0 };
        let name = names[i];
        format!("[[gear]]\nname = \"{name}\"\nshaft = \"{name}\"\nposition_mm = 50.0\nkey_deg = {key_deg:?}\n")
    };
    let mesh = "[[mesh]]\nscene = \"pair.toml\"\npinion = \"pinion\"\nwheel = \"wheel\"\n".to_owned();
    let sense = if sense_of_input(scene) == Sense::Ccw { "ccw" } else { "cw" };
    let (driver, driven) = (names[driver(scene)], names[1 - driver(scene)]);
    let load = format!(
        "[input]\nshaft = \"{driver}\"\nposition_mm = 0.0\nrotation = \"{sense}\"\n\
         [[torque]]\nshaft = \"{driven}\"\nposition_mm = 0.0\ntorque_nm = {:?}\n",
        scene.operation.torque_nm
    );
    let run = format!("[analysis]\npositions_per_cycle = {POSITIONS}\n");
    [shaft(names[0], 0.0), shaft(names[1], apart), gear(0), gear(1), mesh, load, run].concat()
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
/// and pressure at every position, K_Hbeta.
#[test]
fn every_pair_of_the_scenes_is_a_gearbox_of_held_shafts() {
    let mut worst = ("", 0.0, String::new());
    let files = files(&scenes());
    assert!(files.len() > 50, "{} scenes", files.len());
    // Many scenes do different things with one pair.
    let mut seen = std::collections::BTreeSet::new();
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
        let found = beside(&text).unwrap_or_else(|said| panic!("{name}: {said}"));
        for (what, off) in found {
            assert!(off < 1e-9, "{name}: {what} of the gearbox is off by {off:.1e}");
            if off > worst.1 {
                worst = (what, off, name.clone());
            }
        }
    }
    println!("{} pairs; largest difference {:.1e}: {} of {}", seen.len(), worst.1, worst.0, worst.2);
}

/// The pair of a scene, at rest.
fn pair_at_rest(path: &Path) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    let mut is_pair = true;
    let mut all = Vec::new();
    for line in text.lines() {
        if let Some(table) = line.strip_prefix('[') {
            let mut names = table.trim_end_matches(']').split('.');
            is_pair = PAIR.contains(&names.next().unwrap()) && !names.any(|name| HOLDS.contains(&name));
        }
        match line.strip_prefix("mesh = \"") {
            Some(mesh) => all.push(format!("mesh = \"{}/{mesh}", path.parent().unwrap().display())),
            None if is_pair => all.push(line.to_owned()),
            None => (),
        }
    }
    all.join("\n") + "\n" + AT_REST
}

/// How far the gearbox of a scene is from its pair.
fn beside(pair: &str) -> Result<Vec<(&'static str, f64)>, String> {
    let say = |e: &dyn std::fmt::Display| e.to_string();
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("pair.toml");
    std::fs::write(&own, pair).unwrap();
    let scene = Scene::read(&own).map_err(|e| say(&e))?;
    let alone = StaticAnalysis::new(&scene).solve().map_err(|e| say(&e))?;
    let file = Gearbox::parse(&held(&scene), &folder.path().join("held.toml")).map_err(|e| say(&e))?;
    let found = solve(&file, Context::new(&mut NoObserver)).and_then(Ending::finished).map_err(|e| say(&e))?;
    assert_eq!((found.positions.len(), alone.history.positions.len()), (POSITIONS, POSITIONS));
    let mut all = Vec::new();
    for (own, wanted) in found.positions.iter().zip(&alone.history.positions) {
        all.extend(differences(&own.meshes[0], wanted));
    }
    let factor = analysis::results::face_load_factor(12, &alone.history);
    if let (Some(own), Some(wanted)) = (found.meshes[0].face_load_factor, factor) {
        all.push(("K_Hbeta", off(&[own], &[wanted])));
    }
    Ok(all)
}
