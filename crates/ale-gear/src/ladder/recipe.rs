//! All that a model of a scene is made of: gathered once, made as often as wanted.

use std::f64::consts::TAU;

use ::lumped::shaft18::{ShaftMechanism, ShaftSystem};
use geometry::GearPair;
use integrate::Mechanism;

use super::{
    complaint, impact, lumped,
    mesh_cycle::{Fed, Sources, mesh_cycle},
    model::{Model, StaticPoint},
    shafts,
};
use crate::{
    error::CommandError,
    scene::{Driver, Model as Name, MotionScene, Scene},
};

/// A scene with its pair and, where its model has a mesh stiffness, that stiffness over the cycle.
pub(crate) struct Recipe {
    pub scene: Scene,
    pub pair: GearPair,
    fed: Option<Fed>,
}

/// A model, ready to run.
pub(crate) struct Made {
    pub model: Model,
    /// Of the gears' inertias on the mean mesh stiffness, Hz; 0: the mesh has no one stiffness.
    pub resonance_hz: f64,
    pub warnings: Vec<String>,
    /// The system of shafts, where it is one: for the continuum beside it.
    pub shafts: Option<ShaftSystem>,
}

impl Made {
    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.model.mass().nrows()
    }

    /// The loaded pair as speed goes to zero, at evenly spaced phases; `None` where it finds nothing to rest on.
    pub fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
        self.model.static_cycle(phases)
    }
}

impl Recipe {
    /// Of a scene with a model of the ladder.
    ///
    /// # Errors
    /// Exit status 2 for a pair that is none; those of the reduced model where it feeds the mesh.
    pub fn gather(scene: &Scene, sources: &mut Sources<'_>) -> Result<Self, CommandError> {
        let pair = scene.gear_pair()?;
        let plane = match scene.analysis.model {
            Name::Shaft18 => shafts::plane(scene, &pair),
            _ => lumped::plane(scene, &pair),
        };
        let fed = scene.mesh.as_ref().map(|mesh| mesh_cycle(scene, mesh, &pair, &plane, sources)).transpose()?;
        Ok(Self { scene: scene.clone(), pair, fed })
    }

    /// The model; every one that is made is the same.
    ///
    /// # Errors
    /// Exit status 2 for what has no meaning to it.
    pub fn model(&self) -> Result<Made, CommandError> {
        let Self { scene, pair, fed } = self;
        let complain = |e: ::lumped::LumpedError| complaint(scene, &e);
        if let Some(own) = &scene.impact {
            let (model, warnings) = impact::impact(scene, own, pair).map_err(complain)?;
            return Ok(Made { model: Model::of(model), resonance_hz: 0.0, warnings, shafts: None });
        }
        let (Some(mesh), Some(fed)) = (&scene.mesh, fed) else {
            // The scene's checks let no other model come here.
            return Err(CommandError::input(format_args!("{}: no model of the ladder", scene.file.display()), None));
        };
        let warnings = fed.warnings.clone();
        if let Some(own) = &scene.shaft18 {
            let (system, resonance) = shafts::system(scene, own, mesh, pair, fed).map_err(complain)?;
            let model = Model::of(ShaftMechanism::new(&system).map_err(complain)?);
            return Ok(Made { model, resonance_hz: resonance / TAU, warnings, shafts: Some(system) });
        }
        let (lumped, bodies) = lumped::lumped_pair(scene, mesh, pair, fed).map_err(complain)?;
        let resonance_hz = lumped.natural_frequency() / TAU;
        let model = match (&scene.lumped8, &scene.lumped12) {
            (Some(own), _) => Model::of(lumped::eight(scene, own, mesh, pair, lumped, &bodies).map_err(complain)?),
            (None, Some(own)) => Model::of(lumped::twelve(scene, own, lumped).map_err(complain)?),
            (None, None) => {
                return Err(CommandError::input(
                    format_args!("{}: no model of the ladder", scene.file.display()),
                    None,
                ));
            }
        };
        Ok(Made { model, resonance_hz, warnings, shafts: None })
    }

    /// Teeth of the driver.
    pub fn driver_teeth(&self) -> u32 {
        [self.scene.pinion.teeth, self.scene.wheel.teeth][usize::from(self.scene.operation.driver == Driver::Wheel)]
    }

    /// Mesh frequency at the scene's speed, of a ramp at its last, Hz.
    pub fn mesh_frequency_hz(&self, words: &MotionScene) -> f64 {
        let speed = words.ramp.map_or(self.scene.operation.speed_rpm, |r| r.to_rpm);
        speed / 60.0 * f64::from(self.driver_teeth())
    }
}
