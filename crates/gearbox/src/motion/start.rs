//! Start of a motion: in equilibrium, moving with the change of the equilibrium.

use dynamics::ModalForce;
use fem::natural_modes;
use integrate::{Forces, Mechanism, State};
use nalgebra::{DMatrix, DVector};

use super::{Drive, GearboxMechanism, gear_modes::with_modes};
use crate::{
    GearMesh, GearboxError, Vector12,
    equilibrium::{Left, Norms, equilibrium},
    even_mesh::{guessed_lever, guessed_stiffness},
};

/// Share of a cycle of the fastest mesh either way over which velocities are taken.
const SPAN: f64 = 1e-3;
/// Size of a coordinate that the equilibrium does not move, over the largest of its kind.
const LEAST: f64 = 1e-3;

/// Round-off of places, in units of the last bit.
const LAST_BITS: f64 = 256.0;
/// A load that is not so many times what round-off makes has no digit.
const ONE_DIGIT: f64 = 10.0;

impl GearboxMechanism {
    /// State at t = 0 in equilibrium. Its rates are those at which the equilibrium changes as the train slowly rotates
    /// and its loads change, with constant acceleration. Sets the modal damping about this equilibrium.
    ///
    /// ```text
    /// C += M Phi diag(2 zeta omega) Phi' M,   (K - df_mesh/dz) Phi = M Phi omega^2
    /// ```
    /// # Errors
    /// [`GearboxError`] if there is no equilibrium.
    pub fn start(&mut self, modal_damping: f64) -> Result<State, GearboxError> {
        self.start_at(0.0, modal_damping)
    }

    /// The same at another time, s.
    ///
    /// # Errors
    /// The errors of [`Self::start`].
    pub fn start_at(&mut self, time: f64, modal_damping: f64) -> Result<State, GearboxError> {
        let [angle, speed] = self.nominal_turn(time);
        let acceleration = self.acceleration(time);
        let z = self.standing((angle, time, acceleration), None)?;
        // Teeth near places that were looked at before are known less well: the search ends from its own end on.
        self.forget();
        let z = self.standing((angle, time, acceleration), Some(&z))?;
        if modal_damping > 0.0 {
            let (rigid, [k, mass]) = self.with_static_gears(&z)?;
            let modes = natural_modes(&k, &mass)?;
            // A tangent has round-off: what turns the whole train is no elastic mode.
            let turning = usize::from(self.free.turn.is_some());
            for (i, omega) in modes.frequencies.iter().enumerate().skip(turning) {
                let own = &mass * modes.shapes.column(i);
                let mut heavy = DVector::zeros(self.count());
                rigid.iter().zip(own.iter()).for_each(|(at, x)| heavy[*at] = *x);
                self.damping.ger(2.0 * modal_damping * omega, &heavy, &heavy, 1.0);
            }
            if let Some(i) = self.free.turn {
                self.damping.row_mut(i).fill(0.0);
                self.damping.column_mut(i).fill(0.0);
            }
        }
        let fastest = self.fastest();
        let mut v = DVector::zeros(z.len());
        if speed != 0.0 {
            let way = SPAN / fastest;
            // A change of speed that begins here has moved nothing yet: its acceleration is that of this time.
            let after = self.standing((angle + way, time + way / speed, acceleration), Some(&z))?;
            let before = self.standing((angle - way, time - way / speed, acceleration), Some(&z))?;
            v = (after - before) * (speed / (2.0 * way));
        }
        if let Some(i) = self.free.turn.filter(|_| !self.beside_nominal) {
            v[i] = speed;
        }
        self.forget();
        Ok(State::new(time, z, v))
    }

    /// The error that the load of a pair, of one mesh and one torque over time, is below what round-off of places makes of the stiffness
    /// of its teeth; `None` where it is not.
    fn too_light(&self, time: f64) -> Option<GearboxError> {
        let ([mesh], [output]) = (&self.meshes[..], &self.operation.torques[..]) else { return None };
        let driven = mesh.discs.iter().position(|disc| *disc == output.disc)?;
        let base = [&mesh.pair.pinion, &mesh.pair.wheel][driven].base_radius();
        let load_n = ((output.torque + self.varying.output(0, time)) / base).abs();
        // Places are known to some last bits of the distance of the axes, and teeth make a force of that.
        let place = LAST_BITS * f64::EPSILON * mesh.pair.centre_distance().abs();
        let lost_n = place * guessed_stiffness(&mesh.pair);
        (load_n <= ONE_DIGIT * lost_n).then_some(GearboxError::LostLoad { load_n, lost_n })
    }

    /// Magnitudes of the coordinates: the deflections and rotations at `state`.
    pub fn scale(&self, state: &State) -> DVector<f64> {
        let modes: Vec<usize> = self.gears.sizes(0.0).map(|(i, _)| i).collect();
        let of = |turns: bool| {
            let own = state
                .q
                .iter()
                .zip(&self.free.turns)
                .enumerate()
                .filter(|(i, (_, t))| **t == turns && !modes.contains(i));
            own.map(|(_, (x, _))| x.abs()).fold(0.0, f64::max)
        };
        let sizes = [of(false).max(1e-6), of(true).max(1e-9)];
        let one = |(x, turns): (&f64, &bool)| x.abs().max(LEAST * sizes[usize::from(*turns)]);
        let mut scale = DVector::from_iterator(state.q.len(), state.q.iter().zip(&self.free.turns).map(one));
        if let Some(i) = self.free.turn {
            scale[i] = sizes[1];
        }
        self.gears.sizes(self.moved(&state.q)).for_each(|(i, size)| scale[i] = size);
        scale
    }

    /// Largest displacement of a gear, mm: of its place, or of its base circle.
    fn moved(&self, q: &DVector<f64>) -> f64 {
        let of = |(i, mesh): (usize, &GearMesh)| {
            let (d, radii) = (self.displacements(i, q), [&mesh.pair.pinion, &mesh.pair.wheel].map(|g| g.base_radius()));
            let one = |g: usize| d.fixed_rows::<3>(6 * g).amax().max((radii[g] * d[6 * g + 5]).abs());
            one(0).max(one(1))
        };
        self.meshes.iter().enumerate().map(of).fold(1e-6, f64::max)
    }

    /// Equilibrium with a mesh advanced by a number of cycles, under the loads at a time (s).
    ///
    /// # Errors
    /// The errors of [`Self::start`].
    pub fn standing_at(
        &mut self,
        mesh: usize,
        (cycles, time): (f64, f64),
        from: Option<&DVector<f64>>,
    ) -> Result<DVector<f64>, GearboxError> {
        let angle = cycles / self.live[mesh].cycles_per_turn;
        self.standing((angle, time, self.acceleration(time)), from)
    }

    /// Equilibrium where the nominal motion is at a time (s).
    ///
    /// # Errors
    /// As of [`Self::start`].
    pub(super) fn standing_in_motion(
        &mut self,
        time: f64,
        from: Option<&DVector<f64>>,
    ) -> Result<DVector<f64>, GearboxError> {
        let [angle, _] = self.nominal_turn(time);
        self.standing((angle, time, self.acceleration(time)), from)
    }

    /// Equilibrium with the input turned by an angle (rad about +z), under the loads of a time (s) and an acceleration of the
    /// input (rad/s^2 about +z); the turn itself is left at 0.
    fn standing(
        &mut self,
        (angle, time, acceleration): (f64, f64, f64),
        from: Option<&DVector<f64>>,
    ) -> Result<DVector<f64>, GearboxError> {
        // The turn of the whole train comes last, if it is one.
        let count = self.count();
        let n = count - usize::from(self.free.turn.is_some());
        let all = |z: &DVector<f64>| z.clone().resize_vertically(count, 0.0);
        let of_modes = self.gears.stiffness(angle, count);
        let stiffness = (&self.stiffness + of_modes).view((0, 0), (n, n)).into_owned();
        // What a torque gives to the turn itself is left out.
        let mut load = (&self.loads[0] + &self.loads[1]).rows(0, n).into_owned();
        self.varying.forces(time).for_each(|(torque, along)| load.axpy(torque, &along.rows(0, n), 1.0));
        let accelerating = self.of_acceleration(acceleration);
        accelerating.into_iter().flatten().for_each(|(size, along)| load.axpy(size, &along.rows(0, n), 1.0));
        let by_frame = self.frame.as_ref().map(|frame| frame.at(self.nominal_turn(time)[1]));
        if let Some((centrifugal, _)) = &by_frame {
            load += centrifugal.rows(0, n);
        }
        let push = self.push.rows(0, n).into_owned();
        let balances = matches!(self.drive, Drive::Balanced(_));
        let mut guessed = stiffness.clone();
        for (i, (mesh, meshing)) in self.meshes.iter().zip(self.train.meshing()).enumerate() {
            let lever = self.live[i].to_gears.tr_mul(&guessed_lever(mesh, meshing)?);
            let lever = lever.rows(0, n).into_owned();
            guessed.ger(guessed_stiffness(&mesh.pair), &lever, &lever, 1.0);
        }
        let norms = Norms::new(guessed)?;
        // Beside springs it is small, and no measure of displacements.
        let stiffness = by_frame.map_or_else(|| stiffness.clone(), |(_, own)| &stiffness + own.view((0, 0), (n, n)));
        let start = from.map_or_else(|| norms.displacements(&load), |z| z.rows(0, n).into_owned());
        let found = equilibrium(&norms, &load, start, |z| {
            let mut left = Left { residual: &stiffness * z - &load, tangent: stiffness.clone() };
            let whole = all(z);
            if let Some(own) = self.beside_springs(&whole, true)? {
                left.residual -= own.force.rows(0, n);
                left.tangent +=
                    own.stiffness.map_or_else(|| DMatrix::zeros(n, n), |k| k.view((0, 0), (n, n)).into_owned());
            }
            for i in 0..self.live.len() {
                let cycles = self.cycles(i, angle);
                let (at, map) = (self.displaced(i, angle, &whole), self.gears.map_of(i, angle));
                let live = &mut self.live[i];
                let reply = live.reply(&self.meshes[i], cycles, &at, true)?.clone();
                let on_modes = live.element().on_modes().cloned();
                let own = live.to_gears.columns(0, n);
                left.residual -= own.tr_mul(&reply.force);
                match on_modes.zip(map) {
                    Some((ModalForce { normal, friction, stiffness: Some(stiffness) }, map)) => {
                        let map = map.columns(0, n);
                        left.residual -= map.tr_mul(&(normal + friction));
                        left.tangent += with_modes(&own.into_owned(), &map.into_owned(), &stiffness);
                    }
                    _ => left.tangent -= own.tr_mul(&(reply.tangent * own)),
                }
                if balances {
                    let losses = live.element().losses(&Vector12::zeros(), 0.0);
                    left.residual.axpy(-self.balance_of(i, &losses.friction), &push, 1.0);
                }
            }
            Ok(left)
        });
        match found {
            Ok(found) => Ok(all(&found.displacements)),
            Err(lost @ GearboxError::NoEquilibrium { .. }) => Err(self.too_light(time).unwrap_or(lost)),
            Err(other) => Err(other),
        }
    }

    /// Coordinates that are no modes of gears, and for these K - df_mesh/dz at a place, symmetric, and the mass, with the modes
    /// of gears in equilibrium and without inertia: theirs are damped by themselves.
    fn with_static_gears(&mut self, z: &DVector<f64>) -> Result<(Vec<usize>, [DMatrix<f64>; 2]), GearboxError> {
        let n = z.len();
        let mut forces = Forces::zeros(n);
        // Modes are those without spin.
        let frame = self.frame.take();
        let found = self.forces(0.0, z, &DVector::zeros(n), &mut forces);
        self.frame = frame;
        found?;
        let k = forces.stiffness;
        let k = 0.5 * (&k + k.transpose());
        let modes: Vec<usize> = self.gears.sizes(1.0).map(|(i, _)| i).collect();
        let rigid: Vec<usize> = (0..n).filter(|i| !modes.contains(i)).collect();
        if modes.is_empty() {
            return Ok((rigid, [k, self.mass.clone()]));
        }
        let condensation = fem::Condensation::new(&k, &rigid)?;
        // P that leaves the gears as they are.
        let follow = self.gears.undeformed(0.0, n);
        let still = DMatrix::from_fn(n, rigid.len(), |i, j| follow[(i, rigid[j])] + f64::from(u8::from(i == rigid[j])));
        let stiffness = condensation.of(&k);
        Ok((rigid, [0.5 * (&stiffness + stiffness.transpose()), still.tr_mul(&(&self.mass * &still))]))
    }
}
