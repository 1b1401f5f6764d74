//! Digests of what a run is made of: whoever goes on from a checkpoint must have the same.

use std::{
    collections::BTreeMap,
    fmt::{Debug, Write},
    path::{Path, PathBuf},
};

use answer::leaves;
use scene::{
    Scene,
    gearbox::{Gearbox, GearboxMotion},
};
use serde::{Deserialize, Serialize};

/// A document whose run can be gone on from: what it is made of.
pub trait Resumable {
    /// Where it stands; messages name it.
    fn file(&self) -> &Path;

    /// What messages call one that says something else.
    fn another(&self) -> &'static str;

    /// What it says, part by part with its name, but for how long it runs where that changes nothing before, and for how
    /// often it leaves a checkpoint.
    fn parts(&self) -> Vec<(String, String)>;

    /// Files that it names, each with the scene that names it and the BLAKE3 of its bytes.
    fn files(&self) -> Vec<(&Scene, &Path, String)>;
}

impl Resumable for Scene {
    fn file(&self) -> &Path {
        &self.file
    }

    fn another(&self) -> &'static str {
        "another scene"
    }

    fn parts(&self) -> Vec<(String, String)> {
        let mut same = self.clone();
        same.analysis.cycles = 0;
        if let Some(motion) = &mut same.motion {
            motion.checkpoint_every_cycles = None;
        }
        keys("", &same)
    }

    fn files(&self) -> Vec<(&Scene, &Path, String)> {
        Scene::files(self).into_iter().map(|(path, blake3)| (self, path, blake3)).collect()
    }
}

/// Every key of a scene with its value, behind `before`.
fn keys(before: &str, scene: &Scene) -> Vec<(String, String)> {
    let mut all = Vec::new();
    // A struct of numbers, texts and tables: there is nothing that JSON could refuse.
    let value = serde_json::to_value(scene).unwrap_or_default();
    leaves(before, &value, &mut |key, value| all.push((key.to_owned(), value.to_string())));
    all
}

/// A part by its name. Numbers of `{:?}` are the shortest that are read as the same.
fn part(name: impl Into<String>, value: &impl Debug) -> (String, String) {
    (name.into(), format!("{value:?}"))
}

impl Resumable for Gearbox {
    fn file(&self) -> &Path {
        &self.file
    }

    fn another(&self) -> &'static str {
        "another gearbox file"
    }

    /// Files of shafts and housings have been read into them, and planets are written out among shafts, bearings and meshes.
    /// What is asked beside the motion, and which files are written, does not matter.
    fn parts(&self) -> Vec<(String, String)> {
        let Self {
            name,
            shafts,
            bearings,
            gears,
            meshes,
            input,
            torques,
            housing,
            accuracy,
            vibration,
            modes,
            motion,
            ..
        } = self;
        let mut all = vec![part("name", name)];
        all.extend(shafts.iter().map(|own| part(format!("shaft.{}", own.name), own)));
        all.extend(bearings.iter().map(|own| part(format!("bearing.{}", own.name), own)));
        all.extend(gears.iter().map(|own| part(format!("gear.{}", own.name), own)));
        for mesh in meshes {
            all.push(part(format!("mesh.{}", mesh.name), &(mesh.gears, mesh.timing)));
            all.extend(keys(&format!("mesh.{}.scene", mesh.name), &mesh.scene));
        }
        all.push(part("input", input));
        all.extend(torques.iter().enumerate().map(|(i, own)| part(format!("torque.{i}"), own)));
        all.push(part("housing", housing));
        all.push(part("analysis.positions_per_cycle", &self.positions_per_cycle));
        all.push(part("analysis.cycles", &self.cycles));
        all.push(part("analysis.shaft_elements", &self.shaft_elements));
        all.push(part("accuracy", accuracy));
        all.push(part("vibration", vibration));
        all.push(part("modes", modes));
        all.extend(motion.iter().flat_map(of_motion));
        all
    }

    fn files(&self) -> Vec<(&Scene, &Path, String)> {
        let of = |scene| Scene::files(scene).into_iter().map(move |(path, blake3)| (scene, path, blake3));
        self.meshes.iter().flat_map(|mesh| of(&mesh.scene)).collect()
    }
}

/// What a motion is made of, by the keys of the file.
fn of_motion(motion: &GearboxMotion) -> Vec<(String, String)> {
    let GearboxMotion {
        speed_rpm,
        to_speed_rpm,
        drive,
        input_torque,
        mesh,
        cycles,
        duration,
        steps_per_cycle,
        steps_per_row,
        waterfall_cycles,
        scheme,
        error_tolerance,
        stop_at_events,
        settle,
        shoots,
        mesh_damping,
        modal_damping_ratio,
        highest_frequency_hz,
        map_tolerance,
        map_overload,
        checkpoint_every_cycles: _,
    } = motion;
    // A ramp is another one where it is longer.
    let (cycles, duration) = (to_speed_rpm.map(|_| *cycles), to_speed_rpm.and(*duration));
    vec![
        part("motion.speed_rpm", speed_rpm),
        part("motion.to_speed_rpm", to_speed_rpm),
        part("motion.drive", drive),
        part("motion.input_torque_nm", &input_torque.map(|nmm| 1e-3 * nmm)),
        part("motion.mesh", mesh),
        part("motion.cycles", &cycles),
        part("motion.duration_s", &duration),
        part("motion.steps_per_cycle", steps_per_cycle),
        part("motion.steps_per_row", steps_per_row),
        part("motion.waterfall_cycles", waterfall_cycles),
        part("motion.method", scheme),
        part("motion.error_tolerance", error_tolerance),
        part("motion.stop_at_events", stop_at_events),
        part("motion.periodic_tolerance and warm_up_cycles", settle),
        part("motion.run = \"shooting\"", shoots),
        part("motion.mesh_damping", mesh_damping),
        part("motion.modal_damping_ratio", modal_damping_ratio),
        part("motion.highest_frequency_hz", highest_frequency_hz),
        part("motion.map_tolerance", map_tolerance),
        part("motion.map_overload", map_overload),
    ]
}

/// A document as it was checked, and the files that it names.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputDigests {
    parts: Vec<(String, String)>,
    files: Vec<FileDigest>,
}

/// What was in a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct FileDigest {
    /// As the scene names it.
    path: String,
    /// BLAKE3 of its bytes, hexadecimal.
    blake3: String,
}

/// What became of the inputs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Change {
    /// The document says something else: what, in words.
    Document(String),
    /// A file has other content.
    File(PathBuf),
}

impl InputDigests {
    /// Digests of a document as everything was when it was read.
    pub fn of(document: &dyn Resumable) -> Self {
        let digest =
            |(_, path, blake3): (&Scene, &Path, String)| FileDigest { path: path.display().to_string(), blake3 };
        Self { parts: document.parts(), files: document.files().into_iter().map(digest).collect() }
    }

    /// What is another now, if anything, of the document that both are of.
    pub(crate) fn change(&self, now: &Self, document: &dyn Resumable) -> Option<Change> {
        if self.parts != now.parts {
            return Some(Change::Document(self.differences(now)));
        }
        // Of the same document the names are the same.
        let at = self.files.iter().zip(&now.files).position(|(then, now)| then != now)?;
        document.files().get(at).map(|(scene, path, _)| Change::File(scene.resolve(path)))
    }

    /// What a document said and says, part by part: the first few that differ.
    fn differences(&self, now: &Self) -> String {
        let (mut said, mut more) = (String::new(), 0);
        let by_name = |all: &'_ [(String, String)]| -> BTreeMap<String, String> { all.iter().cloned().collect() };
        let (then, now_by_name) = (by_name(&self.parts), by_name(&now.parts));
        let gone = self.parts.iter().filter(|(name, _)| !now_by_name.contains_key(name));
        for (name, _) in now.parts.iter().chain(gone) {
            let [before, after] = [then.get(name), now_by_name.get(name)];
            if before == after {
                continue;
            }
            more += 1;
            if more > TOLD {
                continue;
            }
            let value = |own: Option<&String>| own.map_or("not stated".to_owned(), Clone::clone);
            let (before, after) = (value(before), value(after));
            // Writing into a text does not fail.
            let _ = if before.len().max(after.len()) > LONGEST {
                write!(said, "; `{name}` is another one")
            } else {
                write!(said, "; `{name}` was {before} and is {after}")
            };
        }
        if more > TOLD {
            let _ = write!(said, "; {} more", more - TOLD);
        }
        said.trim_start_matches("; ").to_owned()
    }
}

/// Differences that are told at the most, and bytes of a value that is told.
const TOLD: usize = 3;
const LONGEST: usize = 40;
