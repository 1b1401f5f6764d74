//! Digests of what a run is made of: whoever goes on from a checkpoint must have the same.

use std::path::{Path, PathBuf};

use scene::{Scene, gearbox::Gearbox};
use serde::{Deserialize, Serialize};

/// A document whose run can be gone on from: what it is made of.
pub trait Resumable {
    /// Where it stands; messages name it.
    fn file(&self) -> &Path;

    /// What messages call one that says something else.
    fn another(&self) -> &'static str;

    /// What it says, but for how long it runs where that changes nothing before, and for how often it leaves a checkpoint.
    fn text(&self) -> String;

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

    fn text(&self) -> String {
        let mut same = self.clone();
        same.analysis.cycles = 0;
        if let Some(motion) = &mut same.motion {
            motion.checkpoint_every_cycles = None;
        }
        same.to_toml()
    }

    fn files(&self) -> Vec<(&Scene, &Path, String)> {
        Scene::files(self).into_iter().map(|(path, blake3)| (self, path, blake3)).collect()
    }
}

impl Resumable for Gearbox {
    fn file(&self) -> &Path {
        &self.file
    }

    fn another(&self) -> &'static str {
        "another gearbox file"
    }

    /// Numbers of `{:?}` are the shortest that are read as the same; files of shafts and housings have been read into
    /// them.
    fn text(&self) -> String {
        let Self { name, shafts, bearings, gears, meshes, input, torques, housing, vibration, .. } = self;
        let mut motion = self.motion;
        if let Some(own) = &mut motion {
            own.checkpoint_every_cycles = 0;
            // A ramp is another one where it is longer.
            own.cycles = if own.to_speed_rpm.is_some() { own.cycles } else { 0 };
        }
        let pairs: Vec<_> = meshes.iter().map(|m| (&m.name, m.gears, m.scene.to_toml())).collect();
        let rest = (self.positions_per_cycle, self.cycles, vibration, motion);
        format!("{:?}", ((name, shafts, bearings, gears), pairs, (input, torques, housing), rest))
    }

    fn files(&self) -> Vec<(&Scene, &Path, String)> {
        let of = |scene| Scene::files(scene).into_iter().map(move |(path, blake3)| (scene, path, blake3));
        self.meshes.iter().flat_map(|mesh| of(&mesh.scene)).collect()
    }
}

/// A document as it was checked, and the files that it names.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputDigests {
    text: String,
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
    /// The document says something else.
    Document,
    /// A file has other content.
    File(PathBuf),
}

impl InputDigests {
    /// Digests of a document as everything was when it was read.
    pub fn of(document: &dyn Resumable) -> Self {
        let digest =
            |(_, path, blake3): (&Scene, &Path, String)| FileDigest { path: path.display().to_string(), blake3 };
        Self { text: document.text(), files: document.files().into_iter().map(digest).collect() }
    }

    /// What is another now, if anything, of the document that both are of.
    pub(crate) fn change(&self, now: &Self, document: &dyn Resumable) -> Option<Change> {
        if self.text != now.text {
            return Some(Change::Document);
        }
        // Of the same document the names are the same.
        let at = self.files.iter().zip(&now.files).position(|(then, now)| then != now)?;
        document.files().get(at).map(|(scene, path, _)| Change::File(scene.resolve(path)))
    }
}
