//! All inputs of a scene's model, collected once; any number of models can be built from them.

use answer::Remark;
use std::{f64::consts::TAU, sync::Arc};

use ::lumped::{
    LumpedError,
    shaft18::{ShaftMechanism, ShaftSystem},
};
use geometry::GearPair;
use integrate::Mechanism;
use scene::{Driver, Model, MotionScene, Scene};

use super::{
    LumpedHeadline,
    elastic_pair::ElasticPair,
    excitation::{ExcitationSource, MeshExcitation},
    impact,
    integration::MeshFrequencies,
    lumped_pair,
    mechanism::{BoxedMechanism, Formulas, StaticPoint},
    shafts,
};
use crate::{AnalysisError, error::in_scene, plausible::refuse};

/// A scene with its pair and, where its model has a mesh stiffness, that stiffness over the cycle.
pub(crate) struct LumpedInputs {
    pub scene: Scene,
    pub pair: GearPair,
    excitation: Option<MeshExcitation>,
    elastic: Option<Arc<ElasticPair>>,
}

/// A model, ready to run.
pub(crate) struct LumpedSystem {
    pub model: BoxedMechanism,
    /// Resonance of the gears' inertias on the mean mesh stiffness, Hz; 0: the mesh has no one stiffness.
    pub resonance_hz: f64,
    pub remarks: Vec<Remark>,
    /// The system of shafts, where it is one: for the continuum beside it.
    pub shafts: Option<ShaftSystem>,
}

impl LumpedSystem {
    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.model.mass().nrows()
    }

    /// The loaded pair in the limit of zero speed at evenly spaced phases; `None` if it has no equilibrium.
    pub fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
        self.model.static_cycle(phases)
    }
}

impl LumpedInputs {
    /// Inputs of a scene whose model has few coordinates.
    ///
    /// # Errors
    /// The errors of the pair's geometry, and of the reduced model if it provides the mesh cycle.
    pub fn gather(scene: &Scene, source: &mut ExcitationSource<'_>) -> Result<Self, AnalysisError> {
        let pair = scene.gear_pair()?;
        if let Some(own) = &scene.shaft18 {
            shafts::check_held(scene, own, &pair).map_err(in_scene(scene))?;
        }
        let plane = match scene.analysis.model {
            Model::Shaft18 => shafts::plane(scene, &pair),
            _ => lumped_pair::plane(scene, &pair),
        };
        let excitation = scene.mesh.as_ref().map(|mesh| source.of(scene, mesh, &pair, &plane)).transpose()?;
        let has_gears = scene.analysis.model.has_reduced_gears();
        // Gears that are reduced are judged where they are made; a stiffness that is given bends as it says.
        if scene.impact.is_some() {
            refuse(scene, &pair)?;
        }
        let elastic = has_gears.then(|| source.elastic_pair(scene)).transpose()?;
        Ok(Self { scene: scene.clone(), pair, excitation, elastic })
    }

    /// These inputs in a scene that differs only in quantities on which pair and excitation do not depend: speed, load,
    /// damping, clearance.
    pub fn in_scene(&self, scene: Scene) -> Self {
        let Self { pair, excitation, elastic, .. } = self;
        Self { scene, pair: pair.clone(), excitation: excitation.clone(), elastic: elastic.clone() }
    }

    /// Builds the model; every model built is the same.
    ///
    /// # Errors
    /// [`AnalysisError::Lumped`] for values that are not valid for the model.
    pub fn build(&self) -> Result<LumpedSystem, AnalysisError> {
        let Self { scene, pair, excitation, elastic } = self;
        let complain = in_scene::<LumpedError>(scene);
        let none = || crate::error::unasked(scene, "model of the ladder");
        if let Some(gears) = elastic {
            let (model, resonance_hz) = gears.model(scene, pair)?;
            let remarks = gears.remarks.clone();
            return Ok(LumpedSystem { model, resonance_hz, remarks, shafts: None });
        }
        if let Some(own) = &scene.impact {
            let (model, remarks) = impact::impact(scene, own, pair).map_err(complain)?;
            return Ok(LumpedSystem {
                model: BoxedMechanism::new(Formulas(model)),
                resonance_hz: 0.0,
                remarks,
                shafts: None,
            });
        }
        // The scene's checks let no other model come here.
        let (Some(mesh), Some(excitation)) = (&scene.mesh, excitation) else { return Err(none()) };
        let remarks = excitation.remarks.clone();
        if let Some(own) = &scene.shaft18 {
            let (system, resonance) = shafts::system(scene, own, mesh, pair, excitation).map_err(complain)?;
            let model = BoxedMechanism::new(Formulas(ShaftMechanism::new(&system).map_err(complain)?));
            return Ok(LumpedSystem { model, resonance_hz: resonance / TAU, remarks, shafts: Some(system) });
        }
        let (lumped, bodies) = lumped_pair::lumped_pair(scene, mesh, pair, excitation).map_err(complain)?;
        let resonance_hz = lumped.natural_frequency() / TAU;
        let model = if let Some(own) = &scene.lumped8 {
            lumped_pair::eight(scene, own, mesh, pair, lumped, &bodies).map(|m| BoxedMechanism::new(Formulas(m)))
        } else if let Some(own) = &scene.lumped12 {
            lumped_pair::twelve(scene, own, lumped).map(|m| BoxedMechanism::new(Formulas(m)))
        } else {
            return Err(none());
        };
        Ok(LumpedSystem { model: model.map_err(complain)?, resonance_hz, remarks, shafts: None })
    }

    /// Remarks about a run, in addition to those of the model itself.
    pub fn remarks_of(&self, motion: &MotionScene, headline: &LumpedHeadline) -> Vec<Remark> {
        self.elastic.as_ref().map_or_else(Vec::new, |gears| gears.remarks_of(&self.scene, motion, headline))
    }

    /// Remark about effects that a run at many speeds does not examine.
    pub fn left_out_of_sweeps(&self) -> Option<Remark> {
        let quasi_static = self.elastic.is_some() && self.scene.modes.is_none();
        quasi_static.then(crate::remark::inertia_not_judged)
    }

    /// Mesh frequency at the scene's speed (for a ramp at its final speed), and the resonance of a model.
    pub fn frequencies(&self, motion: &MotionScene, resonance_hz: f64) -> MeshFrequencies {
        let speed = motion.ramp.map_or(self.scene.operation.speed_rpm, |r| r.to_rpm);
        MeshFrequencies { mesh_hz: speed / 60.0 * f64::from(self.scene.driver_teeth()), resonance_hz }
    }

    /// F_bn = T / (r_b cos b_b) of the mean load on the driven gear, N.
    pub fn static_normal_force(&self) -> f64 {
        let driven = match self.scene.operation.driver {
            Driver::Pinion => &self.pair.wheel,
            Driver::Wheel => &self.pair.pinion,
        };
        self.scene.operation.torque() / (driven.base_radius().abs() * self.pair.base_helix_angle().cos())
    }
}
