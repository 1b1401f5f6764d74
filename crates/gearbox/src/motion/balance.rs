//! Equilibrium of forces on the coordinates of a moving gearbox. Theory (92), (93).

use dynamics::ModalForce;
use integrate::{Forces, Mechanism};
use nalgebra::{DMatrix, DVector};

use super::{
    Drive, GearboxMechanism,
    gear_modes::with_modes,
    loops::{self, is_zero},
};
use crate::GearboxError;

impl GearboxMechanism {
    /// Forces of the shafts, bearings, loads and drive at a time; `acceleration` is that of a given turn.
    fn bodies_and_loads(
        &self,
        q: &DVector<f64>,
        v: &DVector<f64>,
        [t, speed, acceleration]: [f64; 3],
        out: &mut Forces,
    ) -> Result<(), GearboxError> {
        if !is_zero(&self.stiffness) {
            out.conservative.gemv(-1.0, &self.stiffness, q, 1.0);
            if out.tangents {
                out.stiffness += &self.stiffness;
            }
        }
        if let Some(own) = self.beside_springs(q, out.tangents)? {
            out.conservative += own.force;
            if let Some(stiffness) = own.stiffness {
                out.stiffness += stiffness;
            }
        }
        if !is_zero(&self.damping) {
            let damped = &self.damping * v;
            out.dissipated += damped.dot(v);
            out.other -= damped;
            if out.tangents {
                out.damping += &self.damping;
            }
        }
        if !is_zero(&self.gyroscopic) {
            let turned = &self.gyroscopic * v;
            out.other.axpy(-speed, &turned, 1.0);
            if out.tangents {
                out.damping.zip_apply(&self.gyroscopic, |c, g| *c += speed * g);
                if let Some(i) = self.free.turn {
                    let mut column = out.damping.column_mut(i);
                    column += turned;
                }
            }
        }
        if let Some(frame) = &self.frame {
            frame.add([q, v], speed, self.free.turn, out);
        }
        let mut load = |size: f64, along: &DVector<f64>| {
            loops::add(size, along, &mut out.other);
            out.supplied += size * loops::along(along, v);
        };
        self.loads.iter().for_each(|own| load(1.0, own));
        self.varying.forces(t).for_each(|(torque, along)| load(torque, along));
        for (size, along) in self.of_acceleration(acceleration).into_iter().flatten() {
            load(size, along);
        }
        Ok(())
    }

    /// Loads by a given acceleration of the input: sizes, and what they do to the coordinates. Inertia of what follows the
    /// input, and the torque of an input that balances and accelerates the whole train.
    pub(super) fn of_acceleration(&self, acceleration: f64) -> Option<[(f64, &DVector<f64>); 2]> {
        if acceleration == 0.0 {
            return None;
        }
        let balances = matches!(self.drive, Drive::Balanced(_));
        let torque = if balances { acceleration * self.train_inertia() } else { 0.0 };
        Some([(-acceleration, &self.momentum), (torque, &self.push)])
    }

    /// Elastic energy of shafts, bearings and housing, but what preloads of bearings do as loads, N mm.
    fn body_energy(&self, q: &DVector<f64>) -> Result<f64, GearboxError> {
        let beside = self.beside_springs(q, false)?.map_or(0.0, |own| own.energy);
        if is_zero(&self.stiffness) {
            return Ok(beside);
        }
        Ok(0.5 * q.dot(&(&self.stiffness * q)) + beside)
    }

    /// Forces of a mesh that answers along its levers; whether it is one.
    fn mesh_by_levers(
        &mut self,
        mesh: usize,
        [angle, given]: [f64; 2],
        [q, v]: [&DVector<f64>; 2],
        out: &mut Forces,
    ) -> bool {
        let (turn, cycles) = (self.free.turn, self.cycles(mesh, angle));
        let live = &mut self.live[mesh];
        let per_turn = live.cycles_per_turn;
        let Some((levers, found)) = live.answer(cycles, [q, v], out.rates || turn.is_some()) else { return false };
        for (k, lever) in levers.iter().enumerate() {
            loops::add(found.elastic[k], &lever.row, &mut out.conservative);
            loops::add(found.damping[k], &lever.row, &mut out.other);
            if let Some(answer) = &lever.answer {
                loops::add(found.damping[k], answer, &mut out.other);
                out.supplied += found.damping[k] * loops::along(answer, v);
            }
        }
        out.dissipated += found.dissipated;
        if let Some(i) = turn {
            out.conservative[i] -= per_turn * found.energy_rate;
        }
        if out.rates {
            out.parametric += found.energy_rate * per_turn * given;
        }
        if out.tangents {
            for (i, own) in levers.iter().enumerate() {
                for (j, other) in levers.iter().enumerate() {
                    loops::add_product(found.stiffness[i][j], &own.row, &other.row, &mut out.stiffness);
                    loops::add_product(found.rate_slope[i][j], &own.row, &other.row, &mut out.damping);
                    if let Some(answer) = &own.answer {
                        loops::add_product(found.rate_slope[i][j], answer, &other.row, &mut out.damping);
                    }
                }
                loops::add_product(found.slope[i], &own.row, &own.row, &mut out.stiffness);
                if let Some(answer) = &own.answer {
                    loops::add_product(found.slope[i], answer, &own.row, &mut out.stiffness);
                }
            }
        }
        true
    }

    /// Forces of one mesh; `given`: the part of the input's speed that is no coordinate.
    fn mesh(
        &mut self,
        mesh: usize,
        [angle, speed, given]: [f64; 3],
        q: &DVector<f64>,
        v: &DVector<f64>,
        out: &mut Forces,
    ) -> Result<(), GearboxError> {
        if self.mesh_by_levers(mesh, [angle, given], [q, v], out) {
            return Ok(());
        }
        let turn = self.free.turn;
        let rates = self.displacements(mesh, v);
        let cycles = self.cycles(mesh, angle);
        let at = self.displaced(mesh, angle, q);
        let live = &mut self.live[mesh];
        let reply = live.reply(&self.meshes[mesh], cycles, &at, out.tangents)?;
        let (force, tangent) = (reply.force, out.tangents.then_some(reply.tangent));
        let per_turn = live.cycles_per_turn;
        let passing = per_turn * speed;
        let losses = live.element().losses(&rates, passing);
        let energy_rate = live.element().energy_rate();
        let on_modes = live.element().on_modes().cloned();
        let answer = self.balance_of(mesh, &(losses.friction + losses.force));
        if answer != 0.0 {
            out.other.axpy(answer, &self.push, 1.0);
            out.supplied += answer * self.push.dot(v);
        }
        let to_gears = &self.live[mesh].to_gears;
        out.conservative += to_gears.tr_mul(&(force - losses.friction));
        out.other += to_gears.tr_mul(&(losses.friction + losses.force));
        out.dissipated += losses.dissipated;
        if let Some(i) = turn {
            out.conservative[i] -= per_turn * energy_rate;
            out.other[i] += per_turn * losses.along_cycles;
        }
        // What the input pushes uneven teeth through with, and against friction.
        out.supplied -= losses.along_cycles * (per_turn * given);
        let mut along_modes = 0.0;
        let modal = on_modes.zip(self.gears.map_of(mesh, angle)).zip(self.gears.map_rate_of(mesh, angle));
        if let Some(((found, map), map_rate)) = &modal {
            out.conservative += map.tr_mul(&found.normal);
            out.other += map.tr_mul(&found.friction);
            out.dissipated -= found.friction.dot(&(map * v));
            along_modes = found.normal.dot(&(map_rate * q));
            if let Some(i) = turn {
                out.conservative[i] += along_modes;
            }
        }
        if let Some(tangent) = tangent {
            match &modal {
                Some(((ModalForce { stiffness: Some(stiffness), .. }, map), _)) => {
                    out.stiffness += with_modes(to_gears, map, stiffness);
                    out.stiffness += to_gears.tr_mul(&(losses.slope * to_gears));
                }
                _ => out.stiffness += to_gears.tr_mul(&((losses.slope - tangent) * to_gears)),
            }
            out.damping += to_gears.tr_mul(&(losses.rate_slope * to_gears));
        }
        if out.rates && given != 0.0 {
            out.parametric -= along_modes * given;
            out.parametric += self.live[mesh].energy_change(&self.meshes[mesh])? * (per_turn * given);
        }
        Ok(())
    }
}

impl Mechanism for GearboxMechanism {
    type Error = GearboxError;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), GearboxError> {
        let input = self.input(t, q, v);
        self.bodies_and_loads(q, v, [t, input[1], self.acceleration(t)], out)?;
        let given = self.given_speed(input[1]);
        self.gears.add([input[0], given], [q, v], self.free.turn, out);
        (0..self.live.len()).try_for_each(|i| self.mesh(i, [input[0], input[1], given], q, v, out))
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, GearboxError> {
        let [angle, _] = self.input(t, q, q);
        let mut sum = self.body_energy(q)? + self.gears.energy(angle, q);
        for i in 0..self.live.len() {
            sum += self.go(i, angle, q)?.element().energy();
        }
        Ok(sum)
    }

    fn potential_off_path(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, GearboxError> {
        let [angle, _] = self.input(t, q, q);
        let mut sum = self.body_energy(q)? + self.gears.energy(angle, q);
        for i in 0..self.live.len() {
            let cycles = self.cycles(i, angle);
            sum += if self.live[i].stand(cycles, q) {
                self.live[i].element().energy()
            } else {
                let at = self.displaced(i, angle, q);
                self.live[i].energy_at(&self.meshes[i], cycles, &at)?
            };
        }
        Ok(sum)
    }

    fn events(&self) -> usize {
        2 * self.live.len()
    }

    /// Overlap of the undeformed flanks of each mesh, side by side: positive in contact.
    fn event_values(
        &mut self,
        t: f64,
        q: &DVector<f64>,
        _: &DVector<f64>,
        out: &mut [f64],
    ) -> Result<(), GearboxError> {
        let [angle, _] = self.input(t, q, q);
        for (i, values) in out.chunks_mut(2).enumerate() {
            values.copy_from_slice(&self.go(i, angle, q)?.element().overlaps()?);
        }
        Ok(())
    }

    fn accepted(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<(), GearboxError> {
        let [angle, _] = self.input(t, q, q);
        for i in 0..self.live.len() {
            let cycles = self.cycles(i, angle);
            self.live[i].check_pace(&self.meshes[i], cycles)?;
            let reach = self.go(i, angle, q)?.element().reach();
            self.reach[i] = self.reach[i].max(reach);
            self.live[i].accept(&self.meshes[i], v, &mut self.extremes[i])?;
        }
        self.varying.accept(t, self.nominal_turn(t)[0], q);
        Ok(())
    }

    /// Has every mesh forget what it remembers of earlier places: what comes then depends on the state alone.
    fn forget(&mut self) {
        self.live.iter_mut().for_each(super::live_mesh::LiveMesh::forget);
    }

    fn end_cycle(&mut self, begin: f64, end: f64) {
        self.add_throughput(begin, end);
    }
}
