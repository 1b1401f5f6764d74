//! Bodies and meshes of a gearbox as one mechanism. Theory (91), (92), (93).

use dynamics::{ElasticDisplacement, Extremes, Speed, Torque};
use nalgebra::{DMatrix, DVector};

use super::{
    Drive, MotionOptions, MovingMesh, ReducedBodies,
    free_coordinates::{FreeCoordinates, Guide},
    gear_modes::MovingGears,
    live_mesh::LiveMesh,
    moving_frame::MovingFrame,
    rolling_supports::RollingSupports,
    varying_torques::{VaryingTorque, VaryingTorques},
};
use crate::{
    Assembly, GearMesh, GearboxError, Meshing, Operation, Structure, Train, Vector12,
    even_mesh::turn,
    static_gearbox::{check, guessed_force},
    train::at_mesh,
};

/// Moving shafts, bearings and meshes: any number of each, every mesh at its own phase.
///
/// ```text
/// M z'' = -dV/dz - (C + psi' G) z' - m psi'' + loads + dampers of the meshes,   V = z' K z/2 + sum of V_mesh(c_i(psi), D_i z)
/// and with a frame that turns  psi'^2 (b - S z) - psi' Q z
/// ```
pub struct GearboxMechanism {
    pub(super) assembly: Assembly,
    pub(super) meshes: Vec<GearMesh>,
    pub(super) train: Train,
    pub(super) operation: Operation,
    pub(super) bodies: ReducedBodies,
    pub(super) free: FreeCoordinates,
    /// Gears whose modes move.
    pub(super) gears: MovingGears,
    pub(super) live: Vec<LiveMesh>,
    pub(super) drive: Drive,
    /// Whether a free turn of the input is a coordinate beside the nominal one, not the whole of it.
    pub(super) beside_nominal: bool,
    pub(super) mass: DMatrix<f64>,
    pub(super) stiffness: DMatrix<f64>,
    /// Damping of bearings and modes.
    pub(super) damping: DMatrix<f64>,
    /// Gyroscopic matrix at the unit speed of the input.
    pub(super) gyroscopic: DMatrix<f64>,
    /// What the frame of a carrier that turns adds.
    pub(super) frame: Option<MovingFrame>,
    /// Constant torques of the outputs on the bodies.
    pub(super) outputs: DVector<f64>,
    /// Torques of the outputs that change with time.
    pub(super) varying: VaryingTorques,
    /// m = B' M r: what an acceleration of the nominal turn loads the deviations by.
    pub(super) momentum: DVector<f64>,
    /// Forces of preloaded bearings on the bodies.
    pub(super) preload: DVector<f64>,
    /// Rolling bearings that follow their laws, beside the springs in their place.
    pub(super) rolling: Option<RollingSupports>,
    /// Constant loads of the outputs with the preloads of bearings, and load of the input where a torque drives or
    /// balances.
    pub(super) loads: [DVector<f64>; 2],
    /// Torque on the input that is given, or balances the loads by the ratios of the train, N mm about +z; 0 where the
    /// input keeps its speed.
    pub(super) given: f64,
    /// What a unit torque on the input does to the coordinates.
    pub(super) push: DVector<f64>,
    /// Most that each mesh has been used of what it holds, at the ends of steps.
    pub(super) reach: Vec<f64>,
    /// Extremes of the flanks of each mesh, at the ends of steps.
    pub(super) extremes: Vec<Extremes>,
    /// Work that the torques of the outputs took in the nominal motion, over the cycles so far, N mm.
    pub(super) throughput: f64,
    /// Mesh cycles with the input at its start.
    pub(super) start_cycles: Vec<f64>,
}

impl GearboxMechanism {
    /// Mechanism with one element per mesh, in order; `elements` makes them from the running of the mesh. Modal damping
    /// is set at the start of the motion ([`GearboxMechanism::start`]).
    ///
    /// # Errors
    /// [`GearboxError`] if parts do not fit together, a torque drives, or a bearing prevents the rotation of its shaft.
    pub fn new(
        structure: Structure,
        meshes: Vec<GearMesh>,
        operation: Operation,
        options: &MotionOptions,
        elements: impl FnMut(usize, &GearMesh, &Meshing) -> Result<Box<dyn MovingMesh>, GearboxError>,
    ) -> Result<Self, GearboxError> {
        let guide = Guide { moves: &|_, _| true, by_length: None };
        Self::guided((structure, meshes, operation), options, &guide, elements)
    }

    /// The same with shafts that are guided.
    pub(super) fn guided(
        (structure, meshes, operation): (Structure, Vec<GearMesh>, Operation),
        options: &MotionOptions,
        guide: &Guide<'_>,
        mut elements: impl FnMut(usize, &GearMesh, &Meshing) -> Result<Box<dyn MovingMesh>, GearboxError>,
    ) -> Result<Self, GearboxError> {
        let train = Train::new(&structure, &meshes, &operation.keys, operation.input, operation.sense)?;
        check(&structure, &train, &operation)?;
        check_motion(&structure, options)?;
        structure.check_linear()?;
        structure.check_rigid()?;
        let mut held = vec![false; structure.shafts.len()];
        operation.held.iter().for_each(|&shaft| held[shaft] = true);
        let assembly = Assembly::new(structure)?;
        let mut all = Vec::new();
        for (i, (mesh, meshing)) in meshes.iter().zip(train.meshing()).enumerate() {
            all.push(elements(i, mesh, meshing).map_err(|source| at_mesh(mesh, source))?);
        }
        let gears = MovingGears::new(&assembly, (&meshes, &train), &all)?;
        if let (Some(_), Some((disc, _))) = (assembly.structure().fixed, gears.modes().next()) {
            let gear = assembly.structure().discs[disc].name.clone();
            return Err(GearboxError::ModesInFrame { gear });
        }
        let bodies = ReducedBodies::new(&assembly, &held, options.limit)?.with_gears(&assembly, gears.modes());
        let free = FreeCoordinates::new((&assembly, &bodies), (&train, &operation), &options.drive, guide);
        let gears = gears.placed(&assembly, &bodies, &free);
        let mut outputs = DVector::zeros(bodies.size());
        let mut balancing = 0.0;
        for torque in &operation.torques {
            outputs[bodies.of_node(assembly.disc(torque.disc).unwrap_or(0)) + 5] += torque.torque;
            balancing -= torque.torque * train.ratios_in_space()[assembly.structure().discs[torque.disc].shaft];
        }
        let given = match options.drive {
            Drive::Speed(_) => 0.0,
            Drive::Balanced(_) => balancing,
            Drive::Torque { torque, .. } => torque.map_or(balancing, |amount| operation.sense.sign() as f64 * amount),
        };
        let momentum = free.basis.tr_mul(&(&bodies.mass * &free.rigid));
        let preload = bodies.preload(&assembly);
        let push = free.basis.tr_mul(&free.input);
        let loads = [free.basis.tr_mul(&(&outputs + &preload)), &push * given];
        let deviations = free.of_deviations();
        let (start_cycles, further) = (train.cycles(0.0), train.cycles(1.0));
        let mut live = Vec::new();
        for (i, (mut element, (mesh, meshing))) in all.into_iter().zip(meshes.iter().zip(train.meshing())).enumerate() {
            element.begin_at(start_cycles[i]).map_err(|source| at_mesh(mesh, source))?;
            let gears = mesh.discs.map(|d| bodies.of_node(assembly.disc(d).unwrap_or(0)));
            let rate = further[i] - start_cycles[i];
            let gears = (gears, &free.rigid);
            let balance = matches!(options.drive, Drive::Balanced(_)).then_some(&push);
            live.push(LiveMesh::new(element, &deviations, gears, turn(meshing.direction), (rate, balance)));
        }
        let mut spin = assembly.gyroscopic(train.ratios_in_space())?;
        let frame = MovingFrame::of((&assembly, &bodies, &free), train.frame_ratio(), &mut spin)?;
        let gyroscopic = free.of(&bodies.skew(&spin), false);
        let (mass, stiffness) = (free.of(&bodies.mass, true), free.of(&bodies.stiffness, false));
        let damping = free.of(&bodies.damping, false);
        let (drive, reach, extremes) = (options.drive, vec![0.0; live.len()], vec![Extremes::default(); live.len()]);
        Ok(Self {
            assembly,
            meshes,
            train,
            operation,
            bodies,
            free,
            gears,
            live,
            drive,
            beside_nominal: false,
            mass,
            stiffness,
            damping,
            gyroscopic,
            frame,
            outputs,
            varying: VaryingTorques::default(),
            momentum,
            preload,
            rolling: None,
            loads,
            given,
            push,
            reach,
            extremes,
            throughput: 0.0,
            start_cycles,
        })
    }

    /// The mechanism with rolling bearings that follow their laws. It must have been made with springs instead of them
    /// ([`Structure::about`] of `structure`). The differences between laws and springs then act at every instant, with
    /// their tangent. Damping of bearings in a housing still uses the share of a velocity that the seats take according
    /// to the springs.
    ///
    /// # Errors
    /// [`GearboxError::Count`] if `structure` has another number of bearings.
    pub fn with_rolling_bearings(mut self, structure: &Structure) -> Result<Self, GearboxError> {
        let (found, wanted) = (structure.bearings.len(), self.assembly.structure().bearings.len());
        if found != wanted {
            return Err(GearboxError::Count { what: "bearings", found, wanted });
        }
        if structure.bearings.iter().any(|b| b.law.is_some()) {
            let mut held = vec![false; structure.shafts.len()];
            self.operation.held.iter().for_each(|&shaft| held[shaft] = true);
            let deviations = self.free.of_deviations();
            let columns: Vec<_> = deviations.column_iter().map(|own| self.at_bearings(&own)).collect();
            let to_bearings = DMatrix::from_fn(6 * found, columns.len(), |i, j| columns[j][i]);
            let force = guessed_force(&self.meshes, &self.operation);
            self.rolling = Some(RollingSupports::new(structure, &held, force, to_bearings)?);
        }
        Ok(self)
    }

    /// The mechanism with torques over time instead of constant ones: each entry is an index among the torques of the
    /// operation, and a torque in N mm about +z. The motion starts in equilibrium under their initial values. A
    /// balanced drive follows them at every instant; a constant torque on the input balances the torques of the
    /// operation.
    ///
    /// # Errors
    /// [`GearboxError::Count`] for an index that the operation does not have, [`GearboxError::OutOfRange`] if a torque
    /// is not a finite number.
    pub fn with_torques(mut self, laws: Vec<(usize, Torque)>) -> Result<Self, GearboxError> {
        let wanted = self.operation.torques.len();
        let mut all = Vec::new();
        for (i, law) in laws {
            let found = i + 1;
            let own = *self.operation.torques.get(i).ok_or(GearboxError::Count { what: "torques", found, wanted })?;
            if let Some(value) = law.numbers().find(|x| !x.is_finite()) {
                return Err(GearboxError::OutOfRange { part: "a torque over time".into(), quantity: "number", value });
            }
            let shaft = self.assembly.structure().discs[own.disc].shaft;
            let at = self.bodies.of_node(self.assembly.disc(own.disc).unwrap_or(0)) + 5;
            let (disc, ratio) = (self.free.basis.row(at).transpose(), self.train.ratios_in_space()[shaft]);
            self.outputs[at] -= own.torque;
            self.loads[0].axpy(-own.torque, &disc, 1.0);
            let mut along = disc.clone();
            if matches!(self.drive, Drive::Balanced(_)) {
                self.given += own.torque * ratio;
                along.axpy(-ratio, &self.push, 1.0);
            }
            // A free turn of the train is a coordinate.
            let ratio = if self.free.turn.is_some() && !self.beside_nominal { 0.0 } else { ratio };
            all.push(VaryingTorque { law, along, disc, at, ratio });
        }
        if matches!(self.drive, Drive::Balanced(_)) {
            self.loads[1] = &self.push * self.given;
        }
        self.varying = std::mem::take(&mut self.varying).with_outputs(all);
        Ok(self)
    }

    /// The mechanism with a torque over time (N mm about +z) instead of the constant one, on an input driven by a
    /// torque.
    ///
    /// # Errors
    /// [`GearboxError::GivenSpeed`] if the speed of the input is given, [`GearboxError::OutOfRange`] for a torque that
    /// is not a finite number.
    pub fn with_input_torque(mut self, law: Torque) -> Result<Self, GearboxError> {
        if self.free.turn.is_none() {
            return Err(GearboxError::GivenSpeed);
        }
        if let Some(value) = law.numbers().find(|x| !x.is_finite()) {
            return Err(GearboxError::OutOfRange { part: "a torque over time".into(), quantity: "number", value });
        }
        self.given = 0.0;
        self.loads[1].fill(0.0);
        let along = self.push.clone();
        self.varying = std::mem::take(&mut self.varying).with_input(law, along);
        Ok(self)
    }

    /// Puts another law in the place of a torque over time of the outputs ([`GearboxMechanism::with_torques`]), by its number
    /// among these.
    pub(super) fn set_torque(&mut self, i: usize, law: Torque) {
        self.varying.set_output(i, law);
    }

    /// The mechanism, with the turn of an input that a torque drives counted from the nominal one: what is no deviation is then
    /// no coordinate, and motions that come back do so in all of them.
    pub(super) fn beside_nominal(mut self) -> Self {
        self.beside_nominal = true;
        self
    }

    /// Matrices and parts of the structure.
    pub fn assembly(&self) -> &Assembly {
        &self.assembly
    }

    /// Nominal motion of the train.
    pub fn train(&self) -> &Train {
        &self.train
    }

    /// Shafts in reduced coordinates.
    pub fn bodies(&self) -> &ReducedBodies {
        &self.bodies
    }

    /// Inertia of all parts that rotate with the input, except its own shaft, t mm^2 referred to the input: the inertia
    /// that the meshes accelerate.
    ///
    /// ```text
    /// J = sum over shafts i but the input's of J_i ratio_i^2
    /// ```
    pub fn driven_inertia(&self) -> f64 {
        let input = self.assembly.structure().discs[self.operation.input].shaft;
        let own = |i: usize, turn: f64| if self.bodies.shaft(i) == input { 0.0 } else { turn };
        let driven = DVector::from_fn(self.bodies.size(), |i, _| own(i, self.free.rigid[i]));
        driven.dot(&(&self.bodies.mass * &driven))
    }

    /// Inertia of the whole train, t mm^2 at the input.
    pub(super) fn train_inertia(&self) -> f64 {
        self.free.rigid.dot(&(&self.bodies.mass * &self.free.rigid))
    }

    /// Number of coordinates.
    pub fn count(&self) -> usize {
        self.free.count()
    }

    /// Nominal speed of the input at the start, rad/s about +z.
    pub(crate) fn input_speed(&self) -> f64 {
        self.operation.sense.sign() as f64 * self.drive.nominal().at(0.0)
    }

    /// Frequency of each mesh at the initial speed, Hz.
    pub fn mesh_frequencies(&self) -> Vec<f64> {
        self.live.iter().map(|m| (m.cycles_per_turn * self.input_speed()).abs()).collect()
    }

    /// Extremes of the flanks of a mesh since the start; for a mesh that does not record them, those given at the
    /// start.
    pub fn extremes(&self, mesh: usize) -> &Extremes {
        &self.extremes[mesh]
    }

    /// Work of the output torques in the nominal motion, over all cycles, N mm: the energy transmitted by the gearbox.
    pub fn throughput(&self) -> f64 {
        self.throughput
    }

    /// Torques of the outputs times the turns of their discs in the nominal motion, N mm/s.
    fn power_through(&self, t: f64) -> f64 {
        let of_outputs = self.outputs.dot(&self.free.rigid) - self.varying.balance(t);
        (of_outputs * self.nominal_turn(t)[1]).abs()
    }

    /// Adds the work that has gone through in a cycle between two times (Simpson's rule).
    pub(super) fn add_throughput(&mut self, begin: f64, end: f64) {
        let of = |t: f64| self.power_through(t);
        self.throughput += (end - begin) / 6.0 * (of(begin) + 4.0 * of(0.5 * (begin + end)) + of(end));
    }

    /// Cycles of the fastest mesh in a radian of the input.
    pub(super) fn fastest(&self) -> f64 {
        self.live.iter().map(|m| m.cycles_per_turn.abs()).fold(0.0, f64::max)
    }

    /// Time (s, >= 0) at which the fastest mesh has advanced by `cycles` cycles in the nominal motion; `None` if the
    /// motion stops before.
    pub fn time_of_cycles(&self, cycles: f64) -> Option<f64> {
        self.drive.nominal().time_at(cycles / self.fastest())
    }

    /// Angle (rad about +z) and speed of the input.
    #[inline]
    pub(super) fn input(&self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> [f64; 2] {
        match self.free.turn {
            Some(i) if self.beside_nominal => {
                let [angle, speed] = self.nominal_turn(t);
                [angle + q[i], speed + v[i]]
            }
            Some(i) => [q[i], v[i]],
            None => self.nominal_turn(t),
        }
    }

    /// Angle and speed of the input's nominal turn.
    #[inline]
    pub(super) fn nominal_turn(&self, t: f64) -> [f64; 2] {
        let (sense, nominal) = (self.operation.sense.sign() as f64, self.drive.nominal());
        // No angle is -0.
        [0.0 + sense * nominal.angle(t), sense * nominal.at(t)]
    }

    /// The part of the input's `speed` that is no coordinate.
    pub(super) fn given_speed(&self, speed: f64) -> f64 {
        match self.free.turn {
            None => speed,
            Some(_) if self.beside_nominal => self.input_speed(),
            Some(_) => 0.0,
        }
    }

    /// Given acceleration of the input, rad/s^2 about +z; 0 where a torque drives.
    pub(super) fn acceleration(&self, t: f64) -> f64 {
        match self.drive {
            Drive::Speed(speed) | Drive::Balanced(speed) => self.operation.sense.sign() as f64 * speed.acceleration(t),
            Drive::Torque { .. } => 0.0,
        }
    }

    /// Torque of an input that balances losses (forces on both gears of a mesh, own axes), N mm about +z: no force is left
    /// along the turn of the whole train. 0 with another drive. Theory (92a).
    pub(super) fn balance_of(&self, mesh: usize, losses: &Vector12) -> f64 {
        match self.drive {
            // No torque is -0.
            Drive::Balanced(_) => 0.0 - self.live[mesh].by_train.dot(losses),
            _ => 0.0,
        }
    }

    /// Cycles of a mesh with the input at an angle.
    #[inline]
    pub(super) fn cycles(&self, mesh: usize, angle: f64) -> f64 {
        self.start_cycles[mesh] + self.live[mesh].cycles_per_turn * angle
    }

    /// Has a mesh answer at a state, with any tangent.
    pub(super) fn ask(
        &mut self,
        mesh: usize,
        angle: f64,
        q: &DVector<f64>,
    ) -> Result<(ElasticDisplacement, &mut LiveMesh), GearboxError> {
        let cycles = self.cycles(mesh, angle);
        let at = self.displaced(mesh, angle, q);
        let live = &mut self.live[mesh];
        live.reply(&self.meshes[mesh], cycles, &at, false)?;
        Ok((at, live))
    }

    /// Has a mesh stand at a state: along its levers where it answers these, else as [`Self::ask`] does.
    pub(super) fn go(&mut self, mesh: usize, angle: f64, q: &DVector<f64>) -> Result<&mut LiveMesh, GearboxError> {
        let cycles = self.cycles(mesh, angle);
        if self.live[mesh].stand(cycles, q) { Ok(&mut self.live[mesh]) } else { Ok(self.ask(mesh, angle, q)?.1) }
    }

    /// Displacements of both gears of a mesh with the amplitudes of their modes.
    pub(super) fn displaced(&self, mesh: usize, angle: f64, z: &DVector<f64>) -> ElasticDisplacement {
        let q = self.gears.map_of(mesh, angle).map_or_else(|| DVector::zeros(0), |map| map * z);
        ElasticDisplacement { d: self.displacements(mesh, z), q }
    }

    /// Displacements of both gears of a mesh, or their rates, in the mesh's own axes.
    pub fn displacements(&self, mesh: usize, q: &DVector<f64>) -> Vector12 {
        let d = &self.live[mesh].to_gears * q;
        Vector12::from_fn(|i, _| d[i])
    }
}

/// Checks that speed, damping and bearings have a meaning in motion.
fn check_motion(structure: &Structure, options: &MotionOptions) -> Result<(), GearboxError> {
    let (torque, [speed, last, duration]) = match options.drive {
        Drive::Speed(Speed::Constant(speed)) | Drive::Balanced(Speed::Constant(speed)) => (0.0, [speed; 3]),
        Drive::Speed(Speed::Ramp { from, to, duration, .. })
        | Drive::Balanced(Speed::Ramp { from, to, duration, .. }) => (0.0, [from, to, duration.recip()]),
        Drive::Torque { start, torque } => (torque.unwrap_or(0.0), [start; 3]),
    };
    let values = [
        ("speed, rad/s", speed),
        ("speed, rad/s", last),
        ("rate of the ramp, 1/s", duration),
        ("torque, N mm", torque),
        ("modal damping", options.modal_damping),
    ];
    if let Some((quantity, value)) = values.into_iter().find(|(_, x)| !(x.is_finite() && *x >= 0.0)) {
        return Err(GearboxError::OutOfRange { part: "the motion".into(), quantity, value });
    }
    for bearing in structure.bearings.iter().filter(|b| !structure.can_hold_turn(b.shaft)) {
        let turning = |m: &nalgebra::Matrix6<f64>| m.row(5).amax().max(m.column(5).amax());
        if turning(&bearing.stiffness) > 0.0 || turning(&bearing.damping) > 0.0 {
            return Err(GearboxError::HeldTurn { bearing: bearing.name.clone() });
        }
    }
    Ok(())
}
