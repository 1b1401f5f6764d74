//! The pressure pattern of a motion on the driving flank of one tooth of each gear.

use gearbox::motion::PairInstant;
use geometry::GearPair;
use scene::{MotionScene, Scene};
use study::{FlankPattern, StudyError, Touch};

use crate::results::{GearPattern, on_flank, touch, untouched};

/// Touches of the mesh cycle under way, and the grids of all cycles before it.
#[derive(Debug, Clone)]
pub(super) struct PatternRecord {
    sense: f64,
    /// Engagements that are this near are one path: one and a half rows.
    reach: f64,
    touches: [Vec<Touch>; 2],
    grids: [FlankPattern; 2],
}

impl PatternRecord {
    /// Patterns of flanks without contact so far, or those of a checkpoint.
    ///
    /// # Errors
    /// [`StudyError`] if a flank has no height.
    pub fn new(
        scene: &Scene,
        motion: &MotionScene,
        pair: &GearPair,
        from: Option<[FlankPattern; 2]>,
    ) -> Result<Self, StudyError> {
        let grids = match from {
            Some(grids) => grids,
            None => [untouched(scene, pair, 0)?, untouched(scene, pair, 1)?],
        };
        let reach = 1.5 / f64::from(motion.steps_per_mesh_cycle);
        Ok(Self { sense: scene.operation.rotation.sign() as f64, reach, touches: Default::default(), grids })
    }

    /// Adds a row of the cycle.
    pub fn push(&mut self, now: &PairInstant) {
        let [driving, _] = &now.flanks;
        for pressed in &driving.slices {
            // A tooth that is one pitch ahead in the sense of rotation is one cycle further.
            let engagement = self.sense * pressed.pair as f64 + now.mesh.cycles;
            for (gear, touches) in self.touches.iter_mut().enumerate() {
                touches.push(touch(&pressed.slice, gear, engagement));
            }
        }
    }

    /// Ends the cycle: all its pairs together are one engagement of one tooth.
    ///
    /// # Errors
    /// [`StudyError`] if a result is not a finite number.
    pub fn end_cycle(&mut self) -> Result<(), StudyError> {
        for (touches, grid) in self.touches.iter_mut().zip(&mut self.grids) {
            grid.press(touches, self.reach)?;
            touches.clear();
        }
        Ok(())
    }

    /// The grids so far, for a checkpoint.
    pub fn grids(&self) -> &[FlankPattern; 2] {
        &self.grids
    }

    /// Patterns of pinion and wheel.
    pub fn patterns(&self, scene: &Scene, pair: &GearPair) -> [GearPattern; 2] {
        [0, 1].map(|gear| on_flank(scene, pair, gear, self.grids[gear].clone()))
    }
}
