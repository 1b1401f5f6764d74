//! Quantities at one instant of the motion.

use dynamics::FlankInstant;
use integrate::State;
use nalgebra::{DMatrix, DVector, DVectorView, Matrix6, Vector6};
use serde::{Deserialize, Serialize};

use super::{Drive, GearboxMechanism, rolling_supports::BesideSprings};
use crate::{BearingState, GearboxError, Vector12, train::at_mesh};

/// State of a mesh at an instant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeshInstant {
    /// Mesh cycles, see [`crate::Train::cycles`].
    pub cycles: f64,
    /// Dynamic transmission error: from the rotations of both gears, mm on the transverse line of action
    /// ([`crate::MeshState::transmission_error`]).
    pub transmission_error: f64,
    /// Rate of the transmission error, mm/s.
    pub transmission_error_rate: f64,
    /// Sum of the normal forces on the driving flanks, damping included, N.
    pub normal_force: f64,
    /// Sum of the normal forces on the coast flanks, damping included, N.
    pub coast_normal_force: f64,
    /// Largest contact pressure on driving and coast flanks, MPa, without damping; 0 for a mesh without slices.
    pub max_pressure: f64,
    /// Forces (N) and moments (N mm) on gear 1 and gear 2, friction and damping included, common axes.
    pub wrench: [f64; 12],
}

/// State of a gearbox at an instant of its motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GearboxInstant {
    /// Time, s.
    pub time: f64,
    /// Angle of the input from its start (rad) and its speed (rad/s), about +z.
    pub input: [f64; 2],
    /// Torque on the input, N mm about +z: the given torque, or the one that maintains the given speed.
    pub input_torque: f64,
    /// Speeds of the discs that have torques in space, rad/s about +z.
    pub output_speeds: Vec<f64>,
    /// Meshes in their order.
    pub meshes: Vec<MeshInstant>,
    /// Bearings in order, damping included; their forces are those on the shafts.
    pub bearings: Vec<BearingState>,
}

impl GearboxMechanism {
    /// Quantities at the instant of a state.
    ///
    /// # Errors
    /// [`GearboxError`] of a mesh.
    pub fn instant(&mut self, state: &State) -> Result<GearboxInstant, GearboxError> {
        Ok(self.instant_by_side(state)?.0)
    }

    /// The same with the driving and coast flanks of each mesh.
    pub(super) fn instant_by_side(
        &mut self,
        state: &State,
    ) -> Result<(GearboxInstant, Vec<[FlankInstant; 2]>), GearboxError> {
        let State { time, q, v, a, .. } = state;
        let input = self.input(*time, q, v);
        let (mut meshes, mut flanks, mut answered) = (Vec::new(), Vec::new(), 0.0);
        let mut on_bodies = DVector::zeros(self.bodies.size());
        let mut on_modes = Vec::new();
        for i in 0..self.live.len() {
            let (own, sides, answer) = self.mesh_instant(i, input, q, v)?;
            answered += answer;
            flanks.push(sides);
            let at = self.live[i].gears;
            (0..12).for_each(|k| on_bodies[at[k / 6] + k % 6] += own.wrench[k]);
            meshes.push(own);
            let found = self.live[i].element().on_modes();
            on_modes.push(found.map(|found| &found.normal + &found.friction));
        }
        for (disc, force) in self.gears.on_discs(input[0], [q, v], &on_modes) {
            let at = self.bodies.of_node(self.assembly.disc(disc).unwrap_or(0));
            (0..6).for_each(|k| on_bodies[at + k] += force[k]);
        }
        let (y, rates) = (self.free.deviations(q), self.free.deviations(v));
        let input_torque = match self.free.turn {
            Some(i) => self.varying.input(*time).unwrap_or(self.loads[1][i]),
            None if matches!(self.drive, Drive::Balanced(_)) => {
                let of_loads = self.given + self.varying.balance(*time);
                of_loads + answered + self.acceleration(*time) * self.train_inertia()
            }
            None => self.reaction(*time, [q, v, a], &on_bodies),
        };
        let speed_of = |torque: &crate::Torque| {
            let shaft = self.assembly.structure().discs[torque.disc].shaft;
            let own = self.assembly.disc(torque.disc).map_or(0.0, |n| rates[self.bodies.of_node(n) + 5]);
            self.train.ratios_in_space()[shaft] * input[1] + own
        };
        let output_speeds = self.operation.torques.iter().map(speed_of).collect();
        let bearings = self.bearing_states(q, &y, &rates)?;
        Ok((GearboxInstant { time: *time, input, input_torque, output_speeds, meshes, bearings }, flanks))
    }

    /// A mesh with its driving and coast flanks, and the torque by which an input that balances answers its losses.
    fn mesh_instant(
        &mut self,
        mesh: usize,
        [angle, speed]: [f64; 2],
        q: &DVector<f64>,
        v: &DVector<f64>,
    ) -> Result<(MeshInstant, [FlankInstant; 2], f64), GearboxError> {
        let cycles = self.cycles(mesh, angle);
        let rates = self.displacements(mesh, v);
        let (at, live) = self.ask(mesh, angle, q)?;
        let passing = live.cycles_per_turn * speed;
        let losses = live.element().losses(&rates, passing);
        let answer = self.balance_of(mesh, &(losses.friction + losses.force));
        let live = &mut self.live[mesh];
        let sides = live.element().by_side(&rates, passing).map_err(|e| at_mesh(&self.meshes[mesh], e))?;
        let turn = live.turn;
        let reply = live.reply(&self.meshes[mesh], cycles, &at, false)?;
        let wrench = (turn * (reply.force + losses.force)).into();
        let (pair, meshing) = (&self.meshes[mesh].pair, &self.train.meshing()[mesh]);
        let [r1, r2] = [&pair.pinion, &pair.wheel].map(|g| g.base_radius());
        let error = |moved: &Vector12| meshing.side().sign() * (r1 * moved[5] + r2 * moved[11]);
        let [transmission_error, transmission_error_rate] = [error(&at.d), error(&rates)];
        let [normal_force, coast_normal_force] = sides.each_ref().map(FlankInstant::normal_force);
        let max_pressure = sides.iter().map(FlankInstant::max_pressure).fold(0.0, f64::max);
        let instant = MeshInstant {
            cycles,
            transmission_error,
            transmission_error_rate,
            normal_force,
            coast_normal_force,
            max_pressure,
            wrench,
        };
        Ok((instant, sides, answer))
    }

    /// Torque that keeps the input at its speed: what its coordinate leaves over. Dampers of modes do not brake the turn
    /// of the whole train, so that what they do to the other turns is held here.
    fn reaction(&self, t: f64, z: [&DVector<f64>; 3], on_bodies: &DVector<f64>) -> f64 {
        let [y, rate, mut acceleration] = z.map(|x| self.free.deviations(x));
        acceleration.axpy(self.acceleration(t), &self.free.rigid, 1.0);
        let shaft = self.assembly.structure().discs[self.operation.input].shaft;
        let held = self.operation.held.contains(&shaft);
        let own = |i: &usize| {
            if held {
                self.bodies.axis(*i) == Some(5) && self.bodies.shaft(*i) == shaft
            } else {
                self.free.input[*i] != 0.0
            }
        };
        let speed = self.nominal_turn(t)[1];
        // No gyroscopic moment acts about the axis; seats of planets that turn with a carrier do.
        let row = |i: usize| {
            let by_frame = self.frame.as_ref().map_or(0.0, |frame| frame.on_turn(i, &y, speed));
            let of = |m: &DMatrix<f64>, x: &DVector<f64>| m.column(i).dot(x);
            of(&self.bodies.mass, &acceleration) + of(&self.bodies.damping, &rate) + of(&self.bodies.stiffness, &y)
                - on_bodies[i]
                - self.outputs[i]
                - self.varying.on_body(t, i)
                - by_frame
        };
        let modal = self.free.turning.dot(&(&self.damping * z[1]));
        (0..self.bodies.size()).filter(own).map(row).sum::<f64>() - modal
    }

    fn bearing_states(
        &self,
        q: &DVector<f64>,
        y: &DVector<f64>,
        rates: &DVector<f64>,
    ) -> Result<Vec<BearingState>, GearboxError> {
        let (u, du) = (self.at_bearings(&y.as_view()), self.at_bearings(&rates.as_view()));
        let supports = self.assembly.supports();
        let [relative, elastic] = match &self.rolling {
            Some(rolling) => rolling.standing(&rolling.at(supports, q)?),
            None => supports.standing(&u),
        };
        let forces = elastic - &supports.damping * du;
        let of = |i: usize| BearingState {
            force: std::array::from_fn(|k| forces[6 * i + k]),
            moment: std::array::from_fn(|k| forces[6 * i + 3 + k]),
            displacement: std::array::from_fn(|k| relative[6 * i + k]),
        };
        Ok((0..u.len() / 6).map(of).collect())
    }

    /// Twice the strain energy of the springs of bearings and housing at a state, N mm.
    pub(super) fn springs_energy(&self, q: &DVector<f64>) -> f64 {
        let y = self.free.deviations(q);
        let (bearings, housing) = self.assembly.supports().energies(&self.at_bearings(&y.as_view()));
        bearings.iter().sum::<f64>() + housing.unwrap_or(0.0)
    }

    /// Energy of bearings and housing at a state, that of preloads and of what laws store beside springs among it, N mm.
    pub(super) fn support_energy(&self, q: &DVector<f64>) -> Result<f64, GearboxError> {
        let beside = self.beside_springs(q, false)?.map_or(0.0, |own| own.energy);
        Ok(0.5 * self.springs_energy(q) - self.preload.dot(&self.free.deviations(q)) + self.stored() + beside)
    }

    /// What rolling bearings do by their laws beside the springs in their place.
    pub(super) fn beside_springs(
        &self,
        q: &DVector<f64>,
        tangent: bool,
    ) -> Result<Option<BesideSprings>, GearboxError> {
        let Some(rolling) = &self.rolling else { return Ok(None) };
        rolling.beside((self.assembly.supports(), self.stored()), q, tangent).map(Some)
    }

    /// Energy that springs store with nothing displaced, N mm.
    fn stored(&self) -> f64 {
        let of_bearings: f64 = self.assembly.structure().bearings.iter().map(crate::Bearing::energy_at_rest).sum();
        self.assembly.supports().pressed_energy() + of_bearings
    }

    /// Displacements of the bearings by reduced coordinates, six a bearing: of its shaft, against that of the shaft its seat is
    /// part of.
    pub(super) fn at_bearings(&self, y: &DVectorView<'_, f64>) -> DVector<f64> {
        let of_node = |(node, own): (usize, &Matrix6<f64>)| own * y.fixed_rows::<6>(self.bodies.of_node(node));
        let all = 0..self.assembly.structure().bearings.len();
        let each: Vec<Vector6<f64>> = all.map(|i| self.assembly.bearing_ends(i).map(of_node).sum()).collect();
        DVector::from_iterator(6 * each.len(), each.iter().flat_map(|own| own.iter().copied()))
    }
}
