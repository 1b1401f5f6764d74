//! A pair whose contact is solved, as the run of a cheaper model asks for it.

use dynamics::{COORDINATES, MechanismState, PairMechanism, quasi_static_start};
use integrate::{Forces, Mechanism, Resumable, State};
use ltca::StaticError;
use nalgebra::{DMatrix, DVector};

use super::{
    LumpedRow,
    elastic_frame::ElasticFrame,
    mechanism::{LumpedMechanism, LumpedMemory, ModelFailure, ParameterChange, StaticPoint, mechanism_of_field},
};
use crate::{
    certificate::Check,
    motion::{force_jump_check, pulling_check},
};

/// Reduced gears, with normal modes where the scene has them.
pub(super) struct ReducedModel {
    system: PairMechanism,
    /// Windows where the run begins.
    home: MechanismState,
    frame: ElasticFrame,
}

impl ReducedModel {
    /// Model of a pair at its beginning.
    pub fn new(system: PairMechanism, frame: ElasticFrame) -> Self {
        Self { home: system.memory(), system, frame }
    }
}

mechanism_of_field!([] ReducedModel, system);

impl LumpedMechanism for ReducedModel {
    fn start(&mut self) -> Result<State, ModelFailure> {
        self.system.restore(&self.home).map_err(ModelFailure::at(0.0))?;
        Ok(quasi_static_start(&mut self.system, 0.0, self.frame.lag, &self.frame.scale)?)
    }

    fn scale(&self) -> DVector<f64> {
        self.frame.scale.clone()
    }

    fn row(&mut self, state: &State) -> Result<LumpedRow, StaticError> {
        let now = self.system.instant(state.time, &state.q, &state.v)?;
        let rate = self.system.coordinates().displacement(&state.v);
        let free = |of: &dynamics::Displacement| self.frame.free.iter().map(|&i| of[i]).collect();
        Ok(LumpedRow {
            time: state.time,
            pinion_angle: Some((now.cycles - 0.5) * self.system.pair().pinion.pitch_angle()),
            mesh_phase: now.cycles.rem_euclid(1.0),
            speeds: Some(now.speeds),
            transmission_error_um: 1e3 * now.transmission_error,
            contact_line_length: Some(now.contact_line_length),
            normal_force: now.normal_forces[0],
            coast_normal_force: Some(now.normal_forces[1]),
            wrench: [0, 1].map(|g| std::array::from_fn(|i| now.mesh[COORDINATES * g + i])),
            displacement: free(&now.displacement),
            velocity: free(&rate),
            ..LumpedRow::default()
        })
    }

    fn transmission_error_um(&mut self, state: &State) -> Result<f64, StaticError> {
        Ok(1e3 * state.q[self.system.coordinates().lag()])
    }

    fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
        let known = &self.frame.at_rest;
        let all = || known.iter().map(|&error| StaticPoint { error, line_length: None }).collect();
        (known.len() == phases).then(all)
    }

    fn natural_frequencies_hz(&self, _: f64) -> Vec<f64> {
        Vec::new()
    }

    fn checks(&self) -> Vec<Check> {
        let extremes = self.system.extremes();
        let force = extremes.largest_force;
        vec![
            pulling_check(extremes.least_force.unwrap_or(0.0), force),
            force_jump_check(self.system.changes().jump, force),
        ]
    }

    /// The teeth in the window belong to a state as well.
    fn shoots(&self) -> bool {
        false
    }

    fn memory(&self) -> LumpedMemory {
        LumpedMemory::Pair(self.system.memory())
    }

    fn take_up(&mut self, memory: &LumpedMemory) -> Result<(), StaticError> {
        match memory {
            LumpedMemory::Pair(memory) => self.system.restore(memory),
            LumpedMemory::Formulas | LumpedMemory::Map(_) => Ok(()),
        }
    }

    fn rewind(&mut self) -> Result<(), StaticError> {
        self.system.restore(&self.home)
    }

    fn follow(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<(), StaticError> {
        self.system.accepted(t, q, v)
    }

    fn set(&mut self, change: ParameterChange) -> bool {
        change.of_pair(&mut self.system);
        true
    }
}
