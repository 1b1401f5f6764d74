//! What a pair's motion keeps beside its rows.

use analysis::{facts::MeshFacts, motion::MotionCheckpoint};
use gearbox::motion::GearboxMemory;
use integrate::Checkpoint;
use scene::Scene;
use serde::{Deserialize, Serialize};
use study::FlankPattern;

use super::{
    CheckpointError,
    growing::Kept,
    rows::{ENERGY_FILE, HISTORY},
    store::{FARTHEST_TOOTH, Stored, StoredState, foreign},
};

/// Teeth of a window at the most; scenes ask for 25 or fewer.
const WIDEST: usize = 1000;

/// State of a pair's motion.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct PairState {
    meshes: String,
    /// Teeth of the window.
    window: usize,
    /// The motion, and how far it has come.
    motion: Checkpoint<GearboxMemory>,
    /// The files of rows.
    pub rows: [Kept; 2],
    /// What the flanks were pressed by so far.
    patterns: [FlankPattern; 2],
}

impl PairState {
    /// State of a motion between such meshes.
    pub fn new(
        meshes: &[MeshFacts],
        MotionCheckpoint { window, motion, patterns }: MotionCheckpoint,
        rows: [Kept; 2],
    ) -> Self {
        Self { meshes: text_of_meshes(meshes), window, motion, rows, patterns }
    }

    /// What the analysis goes on from.
    pub fn checkpoint(&self) -> MotionCheckpoint {
        let Self { window, motion, patterns, .. } = self.clone();
        MotionCheckpoint { window, motion, patterns }
    }
}

impl StoredState for PairState {
    const KIND: &'static str = "motion of a pair";

    fn rows(&self) -> Vec<(&'static str, &Kept)> {
        [HISTORY, ENERGY_FILE].into_iter().zip(&self.rows).collect()
    }

    fn consistent(&self) -> Result<(), &'static str> {
        if !(1..=WIDEST).contains(&self.window) {
            return Err("a window of so many teeth");
        }
        if !self.motion.is_consistent() {
            return Err("velocities of other coordinates");
        }
        if self.motion.memory.farthest_tooth() > FARTHEST_TOOTH {
            return Err("a window beyond all cycles");
        }
        Ok(())
    }
}

impl Stored<PairState> {
    /// Whether it belongs to a run with the meshes that the program made of the scene: else it must not go on.
    ///
    /// # Errors
    /// [`CheckpointError::Foreign`].
    pub fn check_meshes(&self, scene: &Scene, meshes: &[MeshFacts]) -> Result<(), CheckpointError> {
        if self.state.meshes == text_of_meshes(meshes) { Ok(()) } else { Err(foreign(&scene.file, "other meshes")) }
    }
}

fn text_of_meshes(meshes: &[MeshFacts]) -> String {
    serde_json::to_string(meshes).unwrap_or_default()
}
