//! A solved cycle of a scene, samples of it, and further solutions on its reduced gears.

use ltca::{StaticHistory, StaticModel};
use scene::Scene;

use super::{Curves, Sample};
use crate::{AnalysisError, GearCache, NoObserver, NoSink, meshes, options, solver_error, static_cycle::CycleInputs};

/// A solved cycle with the gears on which it was solved: only positions, without remarks.
#[derive(Debug)]
pub struct SolvedCycle {
    scene: Scene,
    history: StaticHistory,
    model: StaticModel,
}

impl SolvedCycle {
    /// Solves a scene as given; no number of slices is chosen.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn new(scene: &Scene, cache: &dyn GearCache) -> Result<Self, AnalysisError> {
        let pair = scene.gear_pair()?;
        let meshes = meshes::known_pair_meshes(scene, &pair, cache)?;
        let inputs = CycleInputs { scene, cache, shared: None, pair: &pair, meshes: &meshes };
        // What cannot be kept in the cache is made again: nobody needs to hear of it.
        let solved = inputs.solve(&options(scene, &pair), &mut NoObserver, &mut NoSink)?;
        Ok(Self { scene: scene.clone(), history: solved.history, model: solved.model })
    }

    /// This cycle solved again with the same gears and other numbers of slices and positions.
    ///
    /// # Errors
    /// [`AnalysisError::Solver`].
    pub fn again(self, slices: u32, positions: u32) -> Result<Self, AnalysisError> {
        let Self { mut scene, model, .. } = self;
        scene.contact.slices = Some(slices);
        scene.analysis.positions_per_cycle = positions;
        let (pair, options) = (model.pair().clone(), model.options().clone());
        let options = options.with_contact(|c| c.slices = slices as usize);
        let fail = |e| solver_error(&scene, e);
        let mut model = StaticModel::new(pair, model.into_gears(), options).map_err(fail)?;
        let history = model.run(positions as usize, scene.analysis.cycles as usize, |_, _, _| ()).map_err(fail)?;
        Ok(Self { scene, history, model })
    }

    /// Values of every `stride`-th position.
    ///
    /// # Errors
    /// [`AnalysisError::Statistics`].
    pub fn sample(&self, stride: usize) -> Result<Sample, AnalysisError> {
        Ok(Sample::of(&self.scene, &self.history, stride)?)
    }

    /// Curves of all positions.
    pub fn curves(&self) -> Curves {
        Curves::of(&self.history, self.scene.analysis.cycles as usize)
    }
}
