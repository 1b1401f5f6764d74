//! The model of a scene as a function of a parameter.

use gearbox::GearboxError;
use integrate::{Forces, Mechanism, State};
use nalgebra::{DMatrix, DVector};
use periodic::PeriodicFamily;
use scene::{ContinuationKey, Scene};

use super::super::{
    LumpedInputs, LumpedRow,
    free_turn::free_turn,
    mechanism::{BoxedMechanism, ParameterChange},
};
use crate::{AnalysisError, error::in_scene, motion::RPM};

/// The model of a scene whose key has one value after the other.
pub(super) struct ModelFamily<'a> {
    inputs: &'a LumpedInputs,
    key: ContinuationKey,
    /// The scene with the value of now.
    scene: Scene,
    model: BoxedMechanism,
    /// Mesh cycles after which a motion comes back.
    cycles: u32,
    scale: DVector<f64>,
    free: Option<DVector<f64>>,
    /// When forces were asked for last, s.
    last: f64,
}

impl<'a> ModelFamily<'a> {
    /// Family of the model made from `inputs`, at the first value of the key.
    ///
    /// # Errors
    /// [`AnalysisError`] if the model cannot be made or has no equilibrium.
    pub fn new(inputs: &'a LumpedInputs, key: ContinuationKey, cycles: u32) -> Result<Self, AnalysisError> {
        let mut model = inputs.build()?.model;
        let free = free_turn(&mut model).map_err(in_scene(&inputs.scene))?.map(|turn| turn.direction().clone());
        let (scale, scene) = (model.scale(), inputs.scene.clone());
        Ok(Self { inputs, key, scene, model, cycles, scale, free, last: 0.0 })
    }

    /// The scene at a value of the key.
    pub fn scene_at(&self, value: f64) -> Scene {
        let mut scene = self.scene.clone();
        match self.key {
            ContinuationKey::Speed => scene.operation.speed_rpm = value,
            ContinuationKey::Torque => scene.operation.torque_nm = value,
            ContinuationKey::Damping => {
                if let Some(motion) = &mut scene.motion {
                    motion.mesh_damping_ratio = Some(value);
                }
            }
            ContinuationKey::HalfBacklash => {
                if let Some(mesh) = &mut scene.mesh {
                    mesh.half_backlash_um = Some(value);
                }
            }
        }
        scene
    }

    /// The current model, its inputs, and its scene.
    pub fn now(&mut self) -> (&mut BoxedMechanism, &LumpedInputs, &Scene) {
        (&mut self.model, self.inputs, &self.scene)
    }

    /// Mesh frequency, Hz.
    pub fn mesh_hz(&self) -> f64 {
        self.scene.operation.speed_rpm / 60.0 * f64::from(self.scene.driver_teeth())
    }

    /// Equilibrium position of the gears under the load.
    ///
    /// # Errors
    /// [`AnalysisError`] if there is none.
    pub fn rest(&mut self) -> Result<DVector<f64>, AnalysisError> {
        Ok(self.model.start().map_err(in_scene(&self.scene))?.q)
    }

    /// Rows of a motion in time order, from the beginning of a period.
    ///
    /// # Errors
    /// An error if the contact cannot be solved.
    pub fn rows(&mut self, states: impl Iterator<Item = State>) -> Result<Vec<LumpedRow>, AnalysisError> {
        let Self { model, scene, .. } = self;
        model.rewind().map_err(in_scene(scene))?;
        self.last = f64::INFINITY;
        let mut row = |state: State| {
            let found = model.row(&state)?;
            model.accepted(state.time, &state.q, &state.v)?;
            Ok(found)
        };
        states
            .map(|state| {
                let time = state.time;
                row(state).map_err(GearboxError::at(time)).map_err(in_scene(scene))
            })
            .collect()
    }

    fn change(&self, value: f64) -> Option<ParameterChange> {
        match self.key {
            ContinuationKey::Speed => Some(ParameterChange::Speed(value * RPM)),
            ContinuationKey::Torque => Some(ParameterChange::Load(1e3 * value)),
            ContinuationKey::Damping => Some(ParameterChange::Damping(value)),
            ContinuationKey::HalfBacklash => None,
        }
    }
}

impl PeriodicFamily for ModelFamily<'_> {
    fn set_parameter(&mut self, value: f64) -> Result<(), AnalysisError> {
        let scene = self.scene_at(value);
        if scene != self.scene {
            self.scene = scene;
            let changed = self.change(value).is_some_and(|change| self.model.set(change));
            if !changed {
                self.model = self.inputs.in_scene(self.scene.clone()).build()?.model;
            }
        }
        Ok(())
    }

    fn period(&self) -> f64 {
        f64::from(self.cycles) / self.mesh_hz()
    }

    fn scale(&self) -> DVector<f64> {
        self.scale.clone()
    }

    fn frequency_slope(&self) -> Option<f64> {
        // 2 pi / T = speed z / period_cycles.
        let slope = RPM * f64::from(self.scene.driver_teeth()) / f64::from(self.cycles);
        (self.key == ContinuationKey::Speed).then_some(slope)
    }

    fn free_direction(&self) -> Option<DVector<f64>> {
        self.free.clone()
    }
}

impl Mechanism for ModelFamily<'_> {
    type Error = AnalysisError;

    fn mass(&self) -> &DMatrix<f64> {
        self.model.mass()
    }

    /// Times come in the order of a period, and then from its beginning: windows follow.
    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), AnalysisError> {
        let Self { model, last, scene, .. } = self;
        let mut found = || {
            if t < *last {
                model.rewind()?;
            }
            *last = t;
            model.forces(t, q, v, out)?;
            model.follow(t, q, v)
        };
        found().map_err(GearboxError::at(t)).map_err(in_scene(scene))
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, AnalysisError> {
        let Self { model, scene, .. } = self;
        model.potential(t, q).map_err(GearboxError::at(t)).map_err(in_scene(scene))
    }
}
