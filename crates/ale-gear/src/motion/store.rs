//! Checkpoints on disk: what a run that was cut short goes on from.

use std::{
    fs,
    path::{Path, PathBuf},
};

use dynamics::pair_motion::Checkpoint;
use serde::{Deserialize, Serialize};
use study::FlankPattern;

use super::course::CourseState;
use crate::{error::CommandError, facts::MeshFacts, scene::Scene};

const STATE: &str = "state.json";
/// Grows with every change of what is stored.
const VERSION: u32 = 2;

/// A folder beside the results' that keeps rows and state of a run under way.
#[derive(Debug)]
pub(crate) struct CheckpointFolder(PathBuf);

/// What is in it beside the rows.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Stored {
    version: u32,
    program: String,
    scene: String,
    meshes: String,
    /// Teeth of the window.
    pub window: usize,
    /// The motion.
    pub motion: Checkpoint,
    /// How far the analysis has come.
    pub course: CourseState,
    /// Lengths of the files of rows.
    pub bytes: [u64; 2],
    /// What the flanks were pressed by so far.
    pub patterns: [FlankPattern; 2],
}

impl Stored {
    /// State of a run of this scene.
    pub fn new(
        scene: &Scene,
        meshes: &[MeshFacts],
        window: usize,
        motion: Checkpoint,
        course: CourseState,
        (bytes, patterns): ([u64; 2], [FlankPattern; 2]),
    ) -> Self {
        let program = env!("CARGO_PKG_VERSION").to_owned();
        let (scene, meshes) = (text_of(scene), text_of_meshes(meshes));
        Self { version: VERSION, program, scene, meshes, window, motion, course, bytes, patterns }
    }

    /// Whether it belongs to a run of this scene on these meshes: else it must not go on.
    pub fn check(&self, scene: &Scene, meshes: &[MeshFacts]) -> Result<(), CommandError> {
        let same_scene = self.scene == text_of(scene);
        let what = match () {
            () if self.version != VERSION || self.program != env!("CARGO_PKG_VERSION") => {
                "another version of this program"
            }
            () if !same_scene => "another scene",
            () if self.meshes != text_of_meshes(meshes) => "other meshes",
            () => return Ok(()),
        };
        Err(CommandError::input(
            format_args!("{}: the checkpoint belongs to {what}", scene.file.display()),
            Some("run without `--resume` to start from the beginning".into()),
        ))
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

fn text_of_meshes(meshes: &[MeshFacts]) -> String {
    serde_json::to_string(meshes).unwrap_or_default()
}

impl CheckpointFolder {
    /// The folder that belongs to a result folder: `OUT.checkpoint`.
    pub fn beside(out: &Path) -> Self {
        let mut name = out.as_os_str().to_owned();
        name.push(".checkpoint");
        Self(PathBuf::from(name))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Makes it, empty.
    pub fn start(&self) -> Result<(), CommandError> {
        let fail = |e: std::io::Error| CommandError::write(&self.0, &e);
        for file in [STATE, super::rows::HISTORY, super::rows::ENERGY_FILE] {
            match fs::remove_file(self.0.join(file)) {
                Err(e) if e.kind() != std::io::ErrorKind::NotFound => return Err(fail(e)),
                _ => {}
            }
        }
        fs::create_dir_all(&self.0).map_err(fail)
    }

    /// The state that is there.
    pub fn read(&self) -> Result<Stored, CommandError> {
        let path = self.0.join(STATE);
        let text = fs::read_to_string(&path).map_err(|e| {
            CommandError::input(
                format_args!("{}: cannot be read: {e}", path.display()),
                Some(
                    "`--resume` goes on from a run with `checkpoint_every_cycles` or `--stop-after-cycles` into the same folder"
                        .into(),
                ),
            )
        })?;
        serde_json::from_str(&text).map_err(|e| {
            CommandError::input(
                format_args!("{}: is no checkpoint: {e}", path.display()),
                Some("run without `--resume` to start from the beginning".into()),
            )
        })
    }

    /// Replaces the state: beside its place first, then renamed, so that a whole one is always there.
    pub fn write(&self, stored: &Stored) -> Result<(), CommandError> {
        let path = self.0.join(STATE);
        let text = serde_json::to_string(stored)
            .map_err(|e| CommandError::failed(format_args!("{}: {e}", path.display()), None))?;
        let new = self.0.join("state.json.new");
        let write = || -> std::io::Result<()> {
            fs::write(&new, &text)?;
            fs::rename(&new, &path)
        };
        write().map_err(|e| CommandError::write(&path, &e))
    }

    /// Takes it away once the results are whole.
    pub fn remove(&self) -> Result<(), CommandError> {
        fs::remove_dir_all(&self.0).map_err(|e| CommandError::write(&self.0, &e))
    }
}
