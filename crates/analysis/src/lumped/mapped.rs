//! A pair on a map of its contact, as the run of a cheaper model asks for it.

use ::lumped::{LumpedError, equilibrium};
use dynamics::{COORDINATES, Drive, MeshDamping, MotionOptions, PairMechanism, Speed, Torque, damping_per_length};
use gearbox::{
    GearboxError,
    motion::{FlankInstant, GearboxMechanism, MappedMesh, PairInstant},
};
use geometry::GearPair;
use integrate::{Forces, Mechanism, Resumable, State};
use ltca::StaticError;
use nalgebra::{DMatrix, DVector};

use super::{
    LumpedRow,
    elastic_frame::ElasticFrame,
    mechanism::{
        LumpedMechanism, LumpedMemory, ModelFailure, OfContact, ParameterChange, StaticPoint, mechanism_of_field,
    },
};
use crate::certificate::Check;

/// Part of a mesh cycle either way over which the velocities of a start are taken.
const SPAN: f64 = 1e-3;

/// Error of a map over the mean approach of the flanks, root mean square, that is the most.
pub(super) const WORST_MAP: f64 = 3e-4;

/// A pair with maps of its flanks: a machine of one mesh, for every drive and load.
#[derive(Debug, Clone)]
pub(super) struct MappedPair {
    pair: GearPair,
    options: MotionOptions,
    /// Stiffness and length of contact lines that damping refers to.
    means: [f64; 2],
    mesh: MappedMesh,
}

impl MappedPair {
    /// The pair of a mechanism with `mesh` in the place of its contact.
    pub fn new(system: &PairMechanism, mesh: MappedMesh) -> Self {
        let mesh = if system.has_coast_flanks() { mesh } else { mesh.with_driving_flanks_alone() };
        Self { pair: system.pair().clone(), options: system.options().clone(), means: system.means(), mesh }
    }

    /// The same with another drive.
    pub fn with_drive(&self, drive: Drive) -> Self {
        Self { options: MotionOptions { drive, ..self.options.clone() }, ..self.clone() }
    }

    fn machine(&self) -> Result<GearboxMechanism, GearboxError> {
        let per_length = damping_per_length(&self.pair, &self.options, self.means);
        GearboxMechanism::of_pair(&self.pair, &self.options, |_, _, _| {
            Ok(Box::new(self.mesh.clone().with_damping(per_length)))
        })
    }
}

/// A pair on its map, as the run of a cheaper model asks for it.
pub(super) struct MappedModel {
    pair: MappedPair,
    machine: GearboxMechanism,
    frame: ElasticFrame,
    /// What counts as a large motion of each coordinate of the machine.
    scale: DVector<f64>,
    /// Transmission error by the coordinates of the machine: of one alone, the turn of the driven gear.
    error: DVector<f64>,
    lag: usize,
}

impl MappedModel {
    /// The model at its beginning; `frame` is of the pair's own coordinates.
    pub fn new(pair: MappedPair, frame: ElasticFrame) -> Result<Self, GearboxError> {
        let machine = pair.machine()?;
        let error = machine.error_slopes(0);
        let lag = error.iamax();
        // The coordinates of the pair in their order, but for the driver's turn, which comes last, and the lag, which is a turn.
        let driven = pair.options.statics.driven();
        let mut sizes: Vec<f64> = frame.scale.iter().copied().collect();
        if matches!(pair.options.drive, Drive::Torque { .. }) {
            let before = |g: usize| pair.options.free[g][..COORDINATES - 1].iter().filter(|free| **free).count();
            let turn = before(0) + if driven == 0 { 1 + before(1) } else { 0 };
            let own = sizes.remove(turn);
            sizes.push(own);
        }
        sizes[lag] /= error[lag].abs();
        Ok(Self { pair, machine, frame, scale: DVector::from_vec(sizes), error, lag })
    }

    /// Where forces on a machine balance at a time, the driver's own turn held.
    fn standing(
        &self,
        machine: &mut GearboxMechanism,
        t: f64,
        from: Option<&DVector<f64>>,
    ) -> Result<DVector<f64>, LumpedError> {
        let mut guess = DVector::zeros(self.scale.len());
        guess[self.lag] = self.frame.lag / self.error[self.lag];
        let held: Vec<usize> = match self.pair.options.drive {
            Drive::Torque { .. } => vec![self.scale.len() - 1],
            _ => Vec::new(),
        };
        let found = equilibrium(machine, t, from.unwrap_or(&guess), &held, &self.scale);
        found.ok().flatten().ok_or(LumpedError::NoEquilibrium)
    }

    fn machine(&self, pair: &MappedPair) -> Result<GearboxMechanism, LumpedError> {
        pair.machine().map_err(|_| LumpedError::NoEquilibrium)
    }

    fn mesh_hz(&self) -> f64 {
        self.machine.mesh_frequencies()[0]
    }

    fn instant(&mut self, state: &State) -> Result<PairInstant, StaticError> {
        self.machine.pair_instant(0, state).map_err(OfContact::of_contact)
    }
}

mechanism_of_field!([] MappedModel, machine);

impl LumpedMechanism for MappedModel {
    fn start(&mut self) -> Result<State, ModelFailure> {
        let mut machine = self.machine(&self.pair)?;
        let mut now = |t: f64, from: Option<&DVector<f64>>| self.standing(&mut machine, t, from);
        let q = now(0.0, None)?;
        let mut v = DVector::zeros(q.len());
        let hz = self.mesh_hz();
        if hz > 0.0 {
            let dt = SPAN / hz;
            v = (now(dt, Some(&q))? - now(-dt, Some(&q))?) / (2.0 * dt);
        }
        Ok(State::new(0.0, q, v))
    }

    fn scale(&self) -> DVector<f64> {
        self.scale.clone()
    }

    fn row(&mut self, state: &State) -> Result<LumpedRow, StaticError> {
        let PairInstant { mesh, displacements, rates, speeds, flanks } = self.instant(state)?;
        let [driving, coast] = flanks.unwrap_or_default();
        let force = |side: &FlankInstant| side.force + side.damping;
        Ok(LumpedRow {
            time: state.time,
            pinion_angle: Some((mesh.cycles - 0.5) * self.pair.pair.pinion.pitch_angle()),
            mesh_phase: mesh.cycles.rem_euclid(1.0),
            speeds: Some(speeds),
            transmission_error_um: 1e3 * mesh.transmission_error,
            contact_line_length: Some(driving.line_length),
            normal_force: force(&driving),
            coast_normal_force: Some(force(&coast)),
            wrench: [0, 1].map(|g| std::array::from_fn(|i| mesh.wrench[COORDINATES * g + i])),
            displacement: self.frame.free.iter().map(|&i| displacements[i]).collect(),
            velocity: self.frame.free.iter().map(|&i| rates[i]).collect(),
            ..LumpedRow::default()
        })
    }

    fn transmission_error_um(&mut self, state: &State) -> Result<f64, StaticError> {
        Ok(1e3 * self.error.dot(&state.q))
    }

    fn static_cycle(&self, phases: usize) -> Option<Vec<StaticPoint>> {
        let load = Torque::Constant(self.pair.options.mean_load());
        let options = MotionOptions { load, ..self.pair.options.clone() };
        let mut machine = self.machine(&MappedPair { options, ..self.pair.clone() }).ok()?;
        let mut from: Option<DVector<f64>> = None;
        let mut at = |k: usize| {
            let time = k as f64 / (phases as f64 * self.mesh_hz());
            let q = self.standing(&mut machine, time, from.as_ref()).ok()?;
            let state = State::new(time, q.clone(), DVector::zeros(q.len()));
            let found = machine.pair_instant(0, &state).ok()?;
            from = Some(q);
            let line_length = found.flanks.map(|[driving, _]| driving.line_length);
            Some(StaticPoint { error: found.mesh.transmission_error, line_length })
        };
        (0..phases).map(&mut at).collect()
    }

    fn natural_frequencies_hz(&self, _: f64) -> Vec<f64> {
        Vec::new()
    }

    fn checks(&self) -> Vec<Check> {
        let worst = self.pair.mesh.maps().map(|m| m.certificate()).map(|c| c.rms_error_mm / c.deflection_mm);
        vec![
            Check {
                name: "map_error".into(),
                value: worst.fold(0.0, crate::worse),
                bound: WORST_MAP,
                hint: "use `model = \"reduced\"`, which solves the contact itself",
            },
            Check {
                name: "map_excess".into(),
                value: self.machine.reach().iter().copied().fold(0.0, crate::worse),
                bound: 1.0,
                hint: "forces or tilts leave what the map holds: use `model = \"reduced\"`, or more damping",
            },
        ]
    }

    fn memory(&self) -> LumpedMemory {
        LumpedMemory::Map(self.machine.memory())
    }

    fn take_up(&mut self, memory: &LumpedMemory) -> Result<(), StaticError> {
        match memory {
            LumpedMemory::Map(memory) => self.machine.restore(memory).map_err(OfContact::of_contact),
            LumpedMemory::Formulas | LumpedMemory::Pair(_) => Ok(()),
        }
    }

    fn set(&mut self, change: ParameterChange) -> bool {
        let options = &mut self.pair.options;
        match change {
            ParameterChange::Speed(speed) => {
                match &mut options.drive {
                    Drive::Speed(own) | Drive::Balanced(own) => *own = Speed::Constant(speed),
                    Drive::Torque { start, .. } => *start = speed,
                }
                self.machine.set_speed(speed);
                true
            }
            ParameterChange::Load(torque) => {
                options.load = Torque::Constant(torque);
                self.machine.set_pair_load(&options.load);
                true
            }
            ParameterChange::Damping(ratio) => {
                options.damping = MeshDamping::Ratio(ratio);
                // What the motion has used of the map so far counts on.
                let memory = self.machine.memory();
                let made = self.pair.machine().and_then(|mut made| made.restore(&memory).map(|()| made));
                made.map(|made| self.machine = made).is_ok()
            }
        }
    }
}
