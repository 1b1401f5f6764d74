//! State of a pair beside coordinates and velocities: teeth in its windows, extremes, and what has gone through it.

use std::f64::consts::TAU;

use integrate::Resumable;
use ltca::StaticError;

use super::{MechanismState, PairMechanism};

impl PairMechanism {
    /// Load torque times the driven gear's nominal turn between two times, N mm (Simpson's rule).
    pub(super) fn throughput_between(&self, begin: f64, end: f64) -> f64 {
        let statics = &self.bodies.options.statics;
        let driven = [&self.bodies.pair.pinion, &self.bodies.pair.wheel][statics.driven()];
        let rate = |t: f64| {
            let cycles = self.bodies.nominal.cycles_per_second(&self.bodies.pair, statics, t);
            (self.bodies.options.load.at(t) * cycles * TAU / f64::from(driven.teeth())).abs()
        };
        (end - begin) / 6.0 * (rate(begin) + 4.0 * rate(0.5 * (begin + end)) + rate(end))
    }
}

impl Resumable for PairMechanism {
    type Memory = MechanismState;

    fn memory(&self) -> MechanismState {
        MechanismState { flanks: self.flanks.state(), extremes: self.extremes, throughput: self.throughput }
    }

    fn restore(&mut self, memory: &MechanismState) -> Result<(), StaticError> {
        self.flanks.restore(&self.bodies.pair, &memory.flanks)?;
        (self.extremes, self.throughput) = (memory.extremes, memory.throughput);
        Ok(())
    }
}
