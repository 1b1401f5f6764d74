//! What a pair is beside coordinates and velocities: teeth in its windows, extremes, and what has gone through it.

use std::f64::consts::TAU;

use integrate::Resumable;
use ltca::StaticError;

use super::{MechanismState, PairMechanism};
use crate::mesh_side::MeshSide;

impl PairMechanism {
    /// Forgets the last contact solution.
    pub(super) fn forget_contact(&mut self) {
        self.drive_side.forget();
        if let Some(side) = &mut self.coast_side {
            side.forget();
        }
        self.last = None;
    }

    /// Load torque times the driven gear's nominal turn between two times, N mm (Simpson's rule).
    pub(super) fn throughput_between(&self, begin: f64, end: f64) -> f64 {
        let statics = &self.options.statics;
        let driven = [&self.pair.pinion, &self.pair.wheel][statics.driven()];
        let rate = |t: f64| {
            let cycles = self.nominal.cycles_per_second(&self.pair, statics, t);
            (self.options.load.at(t) * cycles * TAU / f64::from(driven.teeth())).abs()
        };
        (end - begin) / 6.0 * (rate(begin) + 4.0 * rate(0.5 * (begin + end)) + rate(end))
    }
}

impl Resumable for PairMechanism {
    type Memory = MechanismState;

    fn memory(&self) -> MechanismState {
        let coast = self.coast_side.as_ref().map(MeshSide::state);
        let (extremes, throughput) = (self.extremes, self.throughput);
        MechanismState { driving: self.drive_side.state(), coast, extremes, throughput }
    }

    fn restore(&mut self, memory: &MechanismState) -> Result<(), StaticError> {
        self.drive_side.restore(&self.pair, memory.driving)?;
        if let (Some(side), Some(coast)) = (&mut self.coast_side, memory.coast) {
            side.restore(&self.pair, coast)?;
        }
        (self.last, self.extremes, self.throughput) = (None, memory.extremes, memory.throughput);
        Ok(())
    }
}
