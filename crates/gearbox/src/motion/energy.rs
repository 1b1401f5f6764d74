//! Energy balance of a gearbox, in common axes. Theory (96).

use integrate::{Ledger, State};

use super::GearboxMechanism;
use crate::GearboxError;

/// Energies of a motion since its start, mJ (N mm).
///
/// ```text
/// d(kinetic + shafts + supports + meshes) = input_work + output_work - dissipated + residual
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxEnergy {
    /// Work of the input's torque.
    pub input_work: f64,
    /// Work of the torques of the outputs; negative if they are loads.
    pub output_work: f64,
    /// Kinetic energy of all bodies, including that of the nominal rotation.
    pub kinetic: f64,
    /// Strain energy of the shafts.
    pub shafts: f64,
    /// Strain energy of bearings and housing.
    pub supports: f64,
    /// Elastic energy of the meshes, including that of the gears' modes.
    pub meshes: f64,
    /// Increase of the stored energy of all four kinds since the start.
    pub gained: f64,
    /// Energy dissipated in bearings, modes and meshes.
    pub dissipated: f64,
    /// Error of the energy balance, divided by the sum of all work and the kinetic energy at the start.
    pub relative_residual: f64,
    /// Energy that the time steps add or remove numerically, divided by the kinetic and elastic energy exchanged in
    /// them. Only deviations from the nominal rotation count, because the energy of the rotation is no measure of a
    /// vibration.
    pub open_over_vibration: f64,
}

impl GearboxMechanism {
    /// Energies at `state` of a motion that began at `start`.
    ///
    /// ```text
    /// input at given speed: E = E_z + Omega m . v + Omega^2 r' M r/2,   W_in = W_z + [Omega m . v + Omega^2 r' M r/2]_0 - sum T_j theta_j
    /// ```
    /// E_z and W_z are the energy of the deviations and its value in the integrator's ledger; -Omega' m . v with m = B'
    /// M r is the work of an acceleration in that ledger. The work of constant torques is that of the rotations. The
    /// work of torques over time is summed step by step if the input speed is given, and if there is a torque over time
    /// on the input. If a constant torque drives, it is the ledger's work minus that of constant torques; the work of a
    /// torque over time on the input is obtained in the same way from the remaining sums.
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
                let by_frame = self.frame.as_ref().map_or(0.0, |own| own.kinetic([&s.q, &s.v], omega));
                omega * self.momentum.dot(&s.v) + 0.5 * omega * omega * inertia + by_frame
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
