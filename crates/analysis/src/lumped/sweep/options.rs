//! Options of a sweep.

use std::{fmt, sync::Arc};

use scene::{MotionScene, Run, Scene, SweepScene, SweepWay, plan::SectionEvery};

use super::super::LumpedRow;
use crate::{AnalysisError, inputs::motion_of};

/// A named quantity of a row.
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
    /// A quantity with its name and its value.
    pub fn new(name: impl Into<String>, value: impl Fn(&LumpedRow) -> f64 + Send + Sync + 'static) -> Self {
        Self { name: name.into(), value: Arc::new(value) }
    }

    /// The dynamic transmission error, um, as in the column `dte_um`.
    pub fn transmission_error() -> Self {
        Self::new("dte_um", |row| row.transmission_error_um)
    }

    /// Value of the quantity in a row.
    pub fn of(&self, row: &LumpedRow) -> f64 {
        (self.value)(row)
    }
}

/// Options of a sweep.
#[derive(Debug, Clone)]
pub struct SweepOptions {
    /// The key that varies, as a dotted path.
    pub key: String,
    /// Directions in which its values are taken.
    pub ways: Vec<SweepWay>,
    /// Interval of the points of a section.
    pub every: SectionEvery,
    /// The quantity of the section.
    pub quantity: LumpedQuantity,
    /// Number of points of a section, >= 1.
    pub points: u32,
    /// Number of mesh cycles over which the Lyapunov exponent is computed; 0: it is not computed.
    pub stretches: u32,
}

impl SweepOptions {
    /// The sweep over speed of a scene with `run = "sweep"`, with its scenes.
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
