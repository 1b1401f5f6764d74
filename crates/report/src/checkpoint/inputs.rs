//! Digests of what a run is made of: whoever goes on from a checkpoint must have the same.

use serde::{Deserialize, Serialize};

use scene::Scene;

use super::CheckpointError;

/// The scene as it was checked, and the files that it names.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct InputDigests {
    scene: String,
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
    /// The scene says something else.
    Scene,
    /// A file has other content, as the scene names it.
    File(String),
}

impl InputDigests {
    /// Of a scene as everything is now.
    ///
    /// # Errors
    /// [`CheckpointError::Input`].
    pub fn of(scene: &Scene) -> Result<Self, CheckpointError> {
        let digest = |path: &std::path::Path| -> Result<FileDigest, CheckpointError> {
            let unreadable = |cause| CheckpointError::Input { file: scene.resolve(path), cause };
            let content = scene.content(path).map_err(unreadable)?;
            Ok(FileDigest { path: path.display().to_string(), blake3: blake3::hash(&content).to_hex().to_string() })
        };
        Ok(Self { scene: text_of(scene), files: scene.files().into_iter().map(digest).collect::<Result<_, _>>()? })
    }

    /// What is another now, if anything.
    pub(crate) fn change(&self, now: &Self) -> Option<Change> {
        if self.scene != now.scene {
            return Some(Change::Scene);
        }
        // Of the same scene the names are the same.
        let other = self.files.iter().zip(&now.files).find(|(then, now)| then != now);
        other.map(|(_, now)| Change::File(now.path.clone()))
    }
}

/// The scene but for how many cycles are asked for: a run may be made longer.
fn text_of(scene: &Scene) -> String {
    let mut same = scene.clone();
    same.analysis.cycles = 0;
    if let Some(motion) = &mut same.motion {
        motion.checkpoint_every_cycles = None;
    }
    same.to_toml()
}
