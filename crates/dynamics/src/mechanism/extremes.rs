//! What is worth knowing of a whole motion, gathered at the end of every step.

use super::PairMechanism;
use crate::{Displacement, elastic_displacement::ElasticDisplacement, mesh_side::MeshSide};
use ltca::StaticError;

impl PairMechanism {
    /// Extremes of the step that has just been taken; and whether a pair beside a window ought to carry load.
    pub(super) fn update_extremes(
        &mut self,
        t: f64,
        at: &ElasticDisplacement,
        rate: &Displacement,
        turned: f64,
    ) -> Result<(), StaticError> {
        let (cycles, d) = (self.cycles(t), &at.d);
        let placed = self.flanks.driving.placed(&self.bodies.pair, cycles, d);
        self.flanks.driving.check_neighbours(&self.bodies.pair, turned, &placed.poses)?;
        let touches = |side: &MeshSide| side.contact().solver().forces().iter().any(|f| *f > 0.0);
        let mut least = f64::INFINITY;
        if touches(&self.flanks.driving) {
            let [sum, smallest] = self.flanks.driving.normal_forces(&placed, rate, self.damping);
            self.extremes.largest_force = self.extremes.largest_force.max(sum);
            least = smallest;
        } else {
            self.extremes.steps_apart += 1;
            let gap = -self.flanks.driving.overlap(&self.bodies.pair, cycles, at);
            if self.modal.is_some() {
                self.flanks.forget_last();
            }
            self.extremes.largest_gap = self.extremes.largest_gap.max(gap);
        }
        if let Some(side) = &mut self.flanks.coast
            && touches(side)
        {
            let placed = side.placed(&self.bodies.pair, cycles, d);
            side.check_neighbours(&self.bodies.pair, turned, &placed.poses)?;
            least = least.min(side.normal_forces(&placed, rate, self.damping)[1]);
            self.extremes.steps_on_coast += 1;
        }
        if least.is_finite() {
            self.extremes.least_force = Some(self.extremes.least_force.map_or(least, |f| f.min(least)));
        }
        Ok(())
    }
}
