//! What a sweep is asked for.

use std::{fmt, sync::Arc};

use scene::{MotionScene, Run, Scene, SweepScene, SweepWay, plan::SectionEvery};

use super::super::LumpedRow;
use crate::{AnalysisError, inputs::motion_of};

/// A number of a row with its name.
#[derive(Clone)]
pub struct LumpedQuantity {
    /// Name with unit.
    pub name: String,
    value: Arc<dyn Fn(&LumpedRow) -> f64 + Send + Sync>,
}

impl fmt::Debug for LumpedQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("LumpedQuantity").field(&self.name).finish()
    }
}

impl LumpedQuantity {
    /// Quantity of a name and what it stands for.
    pub fn new(name: impl Into<String>, value: impl Fn(&LumpedRow) -> f64 + Send + Sync + 'static) -> Self {
        Self { name: name.into(), value: Arc::new(value) }
    }

    /// The dynamic transmission error, um, as the column `dte_um` has it.
    pub fn transmission_error() -> Self {
        Self::new("dte_um", |row| row.transmission_error_um)
    }

    /// Value of the quantity in a row.
    pub fn of(&self, row: &LumpedRow) -> f64 {
        (self.value)(row)
    }
}

/// What a sweep is asked for.
#[derive(Debug, Clone)]
pub struct SweepOptions {
    /// The key that changes, with dots.
    pub key: String,
    /// Which way its values are gone through.
    pub ways: Vec<SweepWay>,
    /// How often a section has a point.
    pub every: SectionEvery,
    /// The quantity whose section is taken.
    pub quantity: LumpedQuantity,
    /// Points of a section, >= 1.
    pub points: u32,
    /// Stretches of a mesh cycle over which the Lyapunov exponent is found; 0: it is not.
    pub stretches: u32,
}

impl SweepOptions {
    /// The sweep over speed that a scene with `run = "sweep"` asks for, with its scenes.
    pub fn over_speed(scene: &Scene, speeds: &SweepScene, quantity: LumpedQuantity) -> (Vec<(f64, Scene)>, Self) {
        let at = |speed_rpm: f64| {
            let mut own = scene.clone();
            own.operation.speed_rpm = speed_rpm;
            (speed_rpm, own)
        };
        let options = Self {
            key: "operation.speed_rpm".into(),
            ways: speeds.ways.clone(),
            every: SectionEvery::MeshCycle,
            quantity,
            points: scene.analysis.cycles.max(1),
            stretches: 0,
        };
        (speeds.all_rpm().into_iter().map(at).collect(), options)
    }

    /// The scene of one value as it is run: to the periodic state, then as many cycles as the section takes.
    pub(super) fn settled(&self, scene: &Scene) -> Result<Scene, AnalysisError> {
        let motion = motion_of(scene)?.clone();
        let mut own = scene.clone();
        own.analysis.cycles = self.points.saturating_mul(self.every.cycles(scene));
        own.motion = Some(MotionScene {
            run: Run::Steady,
            duration_s: None,
            ramp: None,
            sweep: None,
            continuation: None,
            basins: None,
            ..motion
        });
        Ok(own)
    }
}
