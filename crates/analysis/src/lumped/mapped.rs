//! A pair on a map of its contact, as the run of a cheaper model asks for it.

use ::lumped::LumpedError;
use dynamics::{COORDINATES, MappedPair};
use integrate::{Forces, Mechanism, Resumable, State, equilibrium, quasi_static};
use ltca::StaticError;
use nalgebra::{DMatrix, DVector};

use super::{
    LumpedRow,
    elastic_frame::ElasticFrame,
    mechanism::{LumpedMechanism, LumpedMemory, ModelFailure, ParameterChange, StaticPoint, mechanism_of_field},
};
use crate::certificate::Check;

/// Part of a mesh cycle either way over which the velocities of a start are taken.
const SPAN: f64 = 1e-3;

/// Error of a map over the mean approach of the flanks, root mean square, that is the most.
pub(super) const WORST_MAP: f64 = 3e-4;

/// A pair on its map, as the run of a cheaper model asks for it.
pub(super) struct MappedModel {
    pub pair: MappedPair,
    pub frame: ElasticFrame,
}

impl MappedModel {
    /// Where forces on a copy of the pair balance at a time, the driver's own turn held.
    fn standing(&self, pair: &mut MappedPair, t: f64, from: &DVector<f64>) -> Result<DVector<f64>, LumpedError> {
        let held: Vec<usize> = pair.system().coordinates().driver_turn().into_iter().collect();
        let Ok(found) = equilibrium(pair, t, from, &held, &self.frame.scale);
        found.ok_or(LumpedError::NoEquilibrium)
    }

    /// Where the search for that begins.
    fn guess(&self) -> DVector<f64> {
        let mut guess = DVector::zeros(self.frame.scale.len());
        guess[self.pair.system().coordinates().lag()] = self.frame.lag;
        guess
    }
}

mechanism_of_field!([] MappedModel, pair);

impl LumpedMechanism for MappedModel {
    fn start(&mut self) -> Result<State, ModelFailure> {
        let hz = self.pair.mesh_hz(0.0);
        let span = if hz > 0.0 { SPAN / hz } else { 0.0 };
        Ok(quasi_static(&mut self.pair.again()?, 0.0, span, self.guess(), |pair, t, q| self.standing(pair, t, &q))?)
    }

    fn scale(&self) -> DVector<f64> {
        self.frame.scale.clone()
    }

    fn row(&mut self, state: &State) -> Result<LumpedRow, StaticError> {
        let State { time, q, v, .. } = state;
        let system = self.pair.system();
        let [driving, coast] = self.pair.instant(*time, q, v);
        let (d, rate) = (system.coordinates().displacement(q), system.coordinates().displacement(v));
        let (cycles, speeds) = self.pair.turning(*time, q, v);
        let wrench = driving.wrench + coast.wrench;
        let lag = system.coordinates().lag();
        Ok(LumpedRow {
            time: *time,
            pinion_angle: Some((cycles - 0.5) * system.pair().pinion.pitch_angle()),
            mesh_phase: cycles.rem_euclid(1.0),
            speeds: Some(speeds),
            transmission_error_um: 1e3 * q[lag],
            contact_line_length: Some(driving.line_length),
            normal_force: driving.force + driving.damping,
            coast_normal_force: Some(coast.force + coast.damping),
            wrench: [0, 1].map(|g| std::array::from_fn(|i| wrench[COORDINATES * g + i])),
            displacement: self.frame.free.iter().map(|&i| d[i]).collect(),
            velocity: self.frame.free.iter().map(|&i| rate[i]).collect(),
            ..LumpedRow::default()
        })
    }

    fn transmission_error_um(&mut self, state: &State) -> Result<f64, StaticError> {
        Ok(1e3 * state.q[self.pair.system().coordinates().lag()])
    }

    fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
        let hz = self.pair.mesh_hz(0.0);
        let lag = self.pair.system().coordinates().lag();
        let (mut loaded, mut q) = (self.pair.under_mean_load().ok()?, self.guess());
        let mut at = |k: usize| {
            let t = k as f64 / (phases as f64 * hz);
            q = self.standing(&mut loaded, t, &q).ok()?;
            let line_length = self.pair.instant(t, &q, &DVector::zeros(q.len()))[0].line_length;
            Some(StaticPoint { error: q[lag], line_length: Some(line_length) })
        };
        (0..phases).map(&mut at).collect()
    }

    fn natural_frequencies_hz(&self, _: f64) -> Vec<f64> {
        Vec::new()
    }

    fn checks(&self) -> Vec<Check> {
        let excess = self.pair.excess();
        let worst = self.pair.maps().map(|m| m.certificate()).map(|c| c.rms_error_mm / c.deflection_mm);
        vec![
            Check {
                name: "map_error".into(),
                value: worst.fold(0.0, crate::worse),
                bound: WORST_MAP,
                hint: "use `model = \"reduced\"`, which solves the contact itself",
            },
            Check {
                name: "map_excess".into(),
                value: crate::worse(excess.force, excess.tilt),
                bound: 1.0,
                hint: "forces or tilts leave what the map holds: use `model = \"reduced\"`, or more damping",
            },
        ]
    }

    fn memory(&self) -> LumpedMemory {
        LumpedMemory::Map(self.pair.memory())
    }

    fn take_up(&mut self, memory: &LumpedMemory) -> Result<(), StaticError> {
        if let LumpedMemory::Map(memory) = memory {
            let Ok(()) = self.pair.restore(memory);
        }
        Ok(())
    }

    fn set(&mut self, change: ParameterChange) -> bool {
        change.of_pair(self.pair.system_mut());
        true
    }
}
