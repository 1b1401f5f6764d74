//! A pair with solved or mapped flanks, in the form that runs of cheaper models need.

use dynamics::{COORDINATES, MeshDamping, Torque};
use gearbox::{
    GearboxError,
    motion::{GearboxMechanism, GearboxMemory, PairModel},
};
use integrate::{Forces, Mechanism, Resumable, State};
use nalgebra::{DMatrix, DVector};

use super::{
    LumpedRow,
    elastic_frame::ElasticFrame,
    mechanism::{LumpedMechanism, LumpedMemory, ParameterChange, StaticPoint, mechanism_of_field},
};
use crate::{
    AnalysisError,
    certificate::Check,
    in_motion::{force_jump_check, map_checks, pulling_check},
};

/// Error of a map over the mean approach of the flanks, root mean square, that is the most: without friction, and with it,
/// which turns round within a few hundredths of a mesh cycle and bends the teeth as it does.
const WORST_MAP: [f64; 2] = [3e-4, 1e-3];

/// The most of a pair with this friction.
pub(super) fn worst_map(friction: f64) -> f64 {
    WORST_MAP[usize::from(friction != 0.0)]
}

/// A pair as a machine of one mesh.
pub(super) struct FlankPair {
    pair: PairModel,
    machine: GearboxMechanism,
    /// Windows where the run begins.
    home: GearboxMemory,
    frame: ElasticFrame,
    /// Transmission error by the coordinates of the machine.
    error: DVector<f64>,
}

impl FlankPair {
    /// The pair in its initial state.
    pub fn new(pair: PairModel, frame: ElasticFrame) -> Result<Self, GearboxError> {
        let machine = pair.machine()?;
        let (home, error) = (machine.memory(), machine.error_slopes(0));
        Ok(Self { pair, machine, home, frame, error })
    }
}

mechanism_of_field!([] FlankPair, machine);

impl LumpedMechanism for FlankPair {
    fn start(&mut self) -> Result<State, AnalysisError> {
        self.machine.restore(&self.home)?;
        Ok(self.machine.start(0.0).map_err(GearboxError::at(0.0))?)
    }

    fn scale(&self) -> DVector<f64> {
        self.pair.scale(self.frame.length)
    }

    fn row(&mut self, state: &State) -> Result<LumpedRow, GearboxError> {
        let now = self.machine.pair_instant(state)?;
        let [normal_force, coast] = now.normal_forces();
        let [driving, _] = &now.flanks;
        Ok(LumpedRow {
            time: state.time,
            pinion_angle: Some((now.mesh.cycles - 0.5) * self.pair.pair().pinion.pitch_angle()),
            mesh_phase: now.mesh.cycles.rem_euclid(1.0),
            speeds: Some(now.speeds),
            transmission_error_um: 1e3 * now.mesh.transmission_error,
            contact_line_length: Some(driving.line_length),
            normal_force,
            coast_normal_force: Some(coast),
            wrench: [0, 1].map(|g| std::array::from_fn(|i| now.mesh.wrench[COORDINATES * g + i])),
            displacement: self.frame.free.iter().map(|&i| now.displacements[i]).collect(),
            velocity: self.frame.free.iter().map(|&i| now.rates[i]).collect(),
            ..LumpedRow::default()
        })
    }

    fn transmission_error_um(&mut self, state: &State) -> Result<f64, GearboxError> {
        Ok(1e3 * self.error.dot(&state.q))
    }

    fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
        if self.pair.map().is_none() {
            let known = &self.frame.at_rest;
            let all = || known.iter().map(|&error| StaticPoint { error, line_length: None }).collect();
            return (known.len() == phases).then(all);
        }
        let mut own = self.pair.clone();
        own.options_mut().load = Torque::Constant(own.options().mean_load());
        let mut machine = own.machine().ok()?;
        let mut from: Option<DVector<f64>> = None;
        let mut at = |k: usize| {
            let cycles = k as f64 / phases as f64;
            let time = machine.time_of_cycles(cycles)?;
            let z = machine.standing_at(0, (cycles, time), from.as_ref()).ok()?;
            let found = machine.pair_instant(&State::new(time, z.clone(), DVector::zeros(z.len()))).ok()?;
            from = Some(z);
            let [driving, _] = &found.flanks;
            Some(StaticPoint { error: found.mesh.transmission_error, line_length: Some(driving.line_length) })
        };
        (0..phases).map(&mut at).collect()
    }

    fn natural_frequencies_hz(&self, _: f64) -> Vec<f64> {
        Vec::new()
    }

    fn checks(&self) -> Vec<Check> {
        let Some(map) = self.pair.map() else {
            let extremes = self.machine.extremes(0);
            let force = extremes.largest_force;
            return vec![
                pulling_check(extremes.least_force.unwrap_or(0.0), force),
                force_jump_check(self.machine.changes(0).jump, force),
            ];
        };
        let worst = worst_map(self.pair.options().statics.contact.friction);
        let reach = self.machine.reach().iter().copied().fold(0.0, crate::worse);
        let instead = [
            "use `model = \"reduced\"`, which solves the contact itself",
            "forces or tilts leave what the map holds: use `model = \"reduced\"`, or more damping",
        ];
        map_checks([map.error(), worst], reach, instead).into()
    }

    fn common_period(&self) -> Option<u64> {
        self.machine.common_period()
    }

    /// The teeth in the window belong to a state as well, where there is one.
    fn shoots(&self) -> bool {
        self.pair.map().is_some()
    }

    fn memory(&self) -> LumpedMemory {
        LumpedMemory::Machine(self.machine.memory())
    }

    fn take_up(&mut self, memory: &LumpedMemory) -> Result<(), GearboxError> {
        match memory {
            LumpedMemory::Machine(memory) => self.machine.restore(memory),
            LumpedMemory::Formulas => Ok(()),
        }
    }

    fn rewind(&mut self) -> Result<(), GearboxError> {
        if self.pair.map().is_some() {
            return Ok(());
        }
        self.machine.restore(&self.home)
    }

    fn follow(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<(), GearboxError> {
        if self.pair.map().is_some() {
            return Ok(());
        }
        self.machine.accepted(t, q, v)
    }

    fn set(&mut self, change: ParameterChange) -> bool {
        match change {
            ParameterChange::Speed(speed) => {
                self.pair = self.pair.at_speed(speed);
                self.machine.set_speed(speed);
                true
            }
            ParameterChange::Load(torque) => {
                let load = Torque::Constant(torque);
                self.machine.set_pair_load(&load);
                self.pair.options_mut().load = load;
                true
            }
            ParameterChange::Damping(ratio) => {
                self.pair.options_mut().damping = MeshDamping::Ratio(ratio);
                // What the motion has used of a map so far counts on, and teeth stay in their windows.
                let memory = self.machine.memory();
                let made = self.pair.machine().and_then(|mut made| made.restore(&memory).map(|()| made));
                made.map(|made| self.machine = made).is_ok()
            }
        }
    }
}
