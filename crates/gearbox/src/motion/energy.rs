//! Where the energy of a gearbox goes, counted in common axes. Theory (96).

use integrate::{Ledger, State};

use super::GearboxMechanism;
use crate::GearboxError;

/// Energy of a motion since its start, mJ (N mm).
///
/// ```text
/// d(kinetic + shafts + supports + meshes) = input_work + output_work - dissipated + residual
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxEnergy {
    /// Work of the input's torque.
    pub input_work: f64,
    /// Work of the torques of the outputs; below 0 where they load.
    pub output_work: f64,
    /// Kinetic energy of all bodies, the nominal turn included.
    pub kinetic: f64,
    /// Strain energy of the shafts.
    pub shafts: f64,
    /// Strain energy of bearings and housing.
    pub supports: f64,
    /// Elastic energy of the meshes, modes of gears among it.
    pub meshes: f64,
    /// Energy stored since the start, of all four kinds.
    pub gained: f64,
    /// Energy dissipated in bearings, modes and meshes.
    pub dissipated: f64,
    /// What does not close, over the sum of all work and of the kinetic energy at the start.
    pub relative_residual: f64,
    /// What steps add or take by themselves, over the kinetic and elastic energy that comes and goes in them, of the
    /// deviations from the turn: the energy of the turn itself is no measure of a vibration.
    pub open_over_vibration: f64,
}

impl GearboxMechanism {
    /// The energy at `state` of a motion that began at `start`.
    ///
    /// ```text
    /// input at given speed: E = E_z + Omega m . v + Omega^2 r' M r/2,   W_in = W_z + [Omega m . v + Omega^2 r' M r/2]_0 - sum T_j theta_j
    /// ```
    /// E_z, W_z: energy of the deviations, and what the integrator's ledger has for them, the work -Omega' m . v of an
    /// acceleration in it; m = B' M r. Work of constant torques is that of the turns. That of torques over time is summed
    /// up step by step where the speed is given and beside a torque over time on the input; under a torque it is what the
    /// ledger has beside constant ones, and so is that of a torque over time on the input beside those sums.
    ///
    /// # Errors
    /// [`GearboxError`] of a mesh.
    pub fn energy(&mut self, start: &State, state: &State, ledger: &Ledger) -> Result<GearboxEnergy, GearboxError> {
        let moved = &state.q - &start.q;
        // Preloads of bearings are no torques: what they give is taken off what is stored.
        let of_loads = self.loads[0].dot(&moved);
        let of_preload = self.preload.dot(&self.free.deviations(&moved));
        let of_outputs = of_loads - of_preload;
        let mut energy = GearboxEnergy {
            input_work: self.loads[1].dot(&moved),
            output_work: of_outputs,
            kinetic: ledger.kinetic,
            shafts: 0.0,
            supports: self.support_energy(&state.q)?,
            meshes: 0.0,
            gained: ledger.kinetic + ledger.potential - ledger.initial - of_preload,
            dissipated: ledger.dissipated,
            relative_residual: 0.0,
            open_over_vibration: ledger.open_over_vibration(),
        };
        let mut began = ledger.initial;
        if !self.varying.is_empty() {
            let left = ledger.supplied - of_loads - energy.input_work;
            match (self.free.turn.is_some() && !self.beside_nominal, self.varying.input(state.time).is_some()) {
                (true, false) => energy.output_work += left,
                (true, true) => {
                    energy.output_work += self.varying.work();
                    energy.input_work += left - self.varying.work();
                }
                (false, _) => energy.output_work += self.varying.work(),
            }
        }
        if self.free.turn.is_none() || self.beside_nominal {
            let inertia = self.train_inertia();
            let of = |s: &State| self.nominal_turn(s.time);
            let along = |s: &State| {
                let [_, omega] = of(s);
                omega * self.momentum.dot(&s.v) + 0.5 * omega * omega * inertia
            };
            let nominal = self.outputs.dot(&self.free.rigid) * (of(state)[0] - of(start)[0]);
            let shift = along(state) - along(start);
            energy.output_work += nominal;
            energy.input_work = ledger.parametric + ledger.supplied - of_loads + shift - nominal - self.varying.work();
            energy.kinetic += along(state);
            energy.gained += shift;
            began += along(start);
        }
        energy.shafts = 0.5 * (state.q.dot(&(&self.stiffness * &state.q)) - self.springs_energy(&state.q));
        let [angle, _] = self.input(state.time, &state.q, &state.v);
        energy.meshes = self.gears.energy(angle, &state.q);
        for i in 0..self.live.len() {
            energy.meshes += self.ask(i, angle, &state.q)?.1.element().energy();
        }
        let left = energy.gained - energy.input_work - energy.output_work + energy.dissipated;
        let turnover = energy.input_work.abs() + energy.output_work.abs() + energy.dissipated + began.abs();
        energy.relative_residual = if left == 0.0 { 0.0 } else { left / turnover };
        Ok(energy)
    }
}
