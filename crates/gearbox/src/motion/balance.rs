//! The balance of forces on the coordinates of a gearbox in motion. Theory (92), (93).

use dynamics::ModalForce;
use integrate::{Forces, Mechanism};
use nalgebra::{DMatrix, DVector};

use super::{GearboxMechanism, gear_modes::with_modes};
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
        out.conservative.gemv(-1.0, &self.stiffness, q, 1.0);
        if let Some(own) = self.beside_springs(q, out.tangents)? {
            out.conservative += own.force;
            if let Some(stiffness) = own.stiffness {
                out.stiffness += stiffness;
            }
        }
        let damped = &self.damping * v;
        out.dissipated += damped.dot(v);
        out.other -= damped;
        let turned = &self.gyroscopic * v;
        out.other.axpy(-speed, &turned, 1.0);
        for load in &self.loads {
            out.other += load;
            out.supplied += load.dot(v);
        }
        for (torque, along) in self.varying.forces(t) {
            out.other.axpy(torque, along, 1.0);
            out.supplied += torque * along.dot(v);
        }
        if acceleration != 0.0 {
            out.other.axpy(-acceleration, &self.momentum, 1.0);
            out.supplied -= acceleration * self.momentum.dot(v);
        }
        if out.tangents {
            out.stiffness += &self.stiffness;
            out.damping += &self.damping;
            out.damping.zip_apply(&self.gyroscopic, |c, g| *c += speed * g);
            if let Some(i) = self.free.turn {
                let mut column = out.damping.column_mut(i);
                column += turned;
            }
        }
        Ok(())
    }

    /// Elastic energy of shafts, bearings and housing, but what preloads of bearings do as loads, N mm.
    fn body_energy(&self, q: &DVector<f64>) -> Result<f64, GearboxError> {
        let beside = self.beside_springs(q, false)?.map_or(0.0, |own| own.energy);
        Ok(0.5 * q.dot(&(&self.stiffness * q)) + beside)
    }

    /// Forces of one mesh.
    fn mesh(
        &mut self,
        mesh: usize,
        [angle, speed]: [f64; 2],
        q: &DVector<f64>,
        v: &DVector<f64>,
        out: &mut Forces,
    ) -> Result<(), GearboxError> {
        let turn = self.free.turn;
        let rates = self.displacements(mesh, v);
        let cycles = self.cycles(mesh, angle);
        let at = self.displaced(mesh, angle, q);
        let live = &mut self.live[mesh];
        let reply = live.reply(&self.meshes[mesh], cycles, &at, out.tangents)?.clone();
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
        out.conservative += to_gears.tr_mul(&(reply.force - losses.friction));
        out.other += to_gears.tr_mul(&(losses.friction + losses.force));
        out.dissipated += losses.dissipated;
        match turn {
            Some(i) => {
                out.conservative[i] -= per_turn * energy_rate;
                out.other[i] += per_turn * losses.along_cycles;
            }
            None => {
                // What the input pushes uneven teeth through with, and against friction.
                out.supplied -= losses.along_cycles * passing;
            }
        }
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
        if out.tangents {
            match &modal {
                Some(((ModalForce { stiffness: Some(stiffness), .. }, map), _)) => {
                    out.stiffness += with_modes(to_gears, map, stiffness);
                    out.stiffness += to_gears.tr_mul(&(losses.slope * to_gears));
                }
                _ => out.stiffness += to_gears.tr_mul(&((losses.slope - reply.tangent) * to_gears)),
            }
            out.damping += to_gears.tr_mul(&(losses.rate_slope * to_gears));
        }
        if out.rates && turn.is_none() {
            out.parametric -= along_modes * speed;
            out.parametric += self.live[mesh].energy_change(&self.meshes[mesh])? * passing;
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
        self.gears.add(input, [q, v], self.free.turn, out);
        (0..self.live.len()).try_for_each(|i| self.mesh(i, input, q, v, out))
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, GearboxError> {
        let [angle, _] = self.input(t, q, q);
        let mut sum = self.body_energy(q)? + self.gears.energy(angle, q);
        for i in 0..self.live.len() {
            sum += self.ask(i, angle, q)?.1.element().energy();
        }
        Ok(sum)
    }

    fn potential_off_path(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, GearboxError> {
        let [angle, _] = self.input(t, q, q);
        let mut sum = self.body_energy(q)? + self.gears.energy(angle, q);
        for i in 0..self.live.len() {
            let (cycles, at) = (self.cycles(i, angle), self.displaced(i, angle, q));
            sum += self.live[i].energy_at(&self.meshes[i], cycles, &at)?;
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
            let (_, live) = self.ask(i, angle, q)?;
            values.copy_from_slice(&live.element().overlaps()?);
        }
        Ok(())
    }

    fn accepted(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>) -> Result<(), GearboxError> {
        let [angle, _] = self.input(t, q, q);
        for i in 0..self.live.len() {
            let (_, live) = self.ask(i, angle, q)?;
            let reach = live.element().reach();
            self.reach[i] = self.reach[i].max(reach);
            self.live[i].accept(&self.meshes[i])?;
        }
        self.varying.accept(t, angle, q);
        Ok(())
    }

    /// Has every mesh forget what it remembers of earlier places: what comes then depends on the state alone.
    fn forget(&mut self) {
        self.live.iter_mut().for_each(super::live_mesh::LiveMesh::forget);
    }
}
