//! One cycle of a scene and samples of it, and more of the same on the gears that it has reduced.

use ale::solve_widening;
use ltca::{StaticHistory, StaticModel, StaticOptions};
use scene::Scene;

use super::Sample;
use crate::{
    AnalysisError, GearCache, NoObserver, elastic_gears::elastic_gears, failure::Failure, meshes, options,
    solver_error, wider_window,
};

/// A solved cycle with the gears that it was solved on: positions alone, no warnings and no tooth change at its end.
#[derive(Debug)]
pub struct SolvedCycle {
    scene: Scene,
    history: StaticHistory,
    model: StaticModel,
}

impl SolvedCycle {
    /// Solves a scene as it stands: no number of slices is chosen.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn new(scene: &Scene, cache: &dyn GearCache) -> Result<Self, AnalysisError> {
        let pair = scene.gear_pair()?;
        let meshes = meshes::pair_meshes(scene, &pair)?;
        let asked = options(scene, &pair);
        let with = |window| StaticOptions { window, ..asked.clone() };
        let attempt = |window| -> Result<Self, Failure> {
            let options = with(window);
            let made = elastic_gears(scene, &pair, &options, &meshes, (cache, &NoObserver, &|| true))?;
            let model = StaticModel::new(pair.clone(), made.gears, options).map_err(Failure::Static)?;
            let solved = Self { scene: scene.clone(), history: StaticHistory::default(), model }.run();
            if let (Ok(solved), true) = (&solved, cache.is_on()) {
                // What cannot be kept is made again.
                made.keys.save(cache, solved.model.gears());
            }
            solved.map_err(Failure::Static)
        };
        let wider = |window, failure: &Failure| {
            let Failure::Static(e) = failure else { return None };
            wider_window(scene, &pair, &meshes, &with(window), e)
        };
        solve_widening(asked.window, attempt, wider).map_err(|failure| failure.into_error(scene))
    }

    /// The same gears with other numbers of slices and positions.
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
        let model = StaticModel::new(pair, model.into_gears(), options).map_err(fail)?;
        Self { scene: scene.clone(), history: StaticHistory::default(), model }.run().map_err(fail)
    }

    fn run(mut self) -> Result<Self, ltca::StaticError> {
        let [positions, cycles] = [self.scene.analysis.positions_per_cycle, self.scene.analysis.cycles];
        self.history = self.model.run(positions as usize, cycles as usize, |_, _, _| ())?;
        Ok(self)
    }

    /// Values of every `stride`-th position.
    ///
    /// # Errors
    /// [`AnalysisError::Statistics`].
    pub fn sample(&self, stride: usize) -> Result<Sample, AnalysisError> {
        Ok(Sample::of(&self.scene, &self.history, stride)?)
    }
}
