//! Quantities of an instant from a state.

use nalgebra::DVector;

use super::PairMechanism;
use crate::{
    COORDINATES, Displacement, Instant, NominalState,
    elastic_displacement::ElasticDisplacement,
    mesh_side::{SideContacts, SideForce},
    modal::ModalBalance,
};
use ltca::StaticError;

impl PairMechanism {
    /// Everything the results hold of a state.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn instant(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<Instant, StaticError> {
        let (at, rate) = (self.elastic_displacement(t, q), self.bodies.coordinates.displacement(v));
        let d = at.d;
        let SideContacts { driving, coast, .. } = self.contact(t, &at, false)?;
        let cycles = self.cycles(t);
        let placed = self.flanks.driving.placed(&self.bodies.pair, cycles, &d);
        let mut losses = driving.friction + self.flanks.driving.damping(&placed, &rate, self.damping, None).0;
        let mut normal = driving.normal;
        let mut normal_forces = [self.flanks.driving.normal_forces(&placed, &rate, self.damping)[0], 0.0];
        if let (Some(side), Some(force)) = (&self.flanks.coast, &coast) {
            let placed = side.placed(&self.bodies.pair, cycles, &d);
            losses += force.friction + side.damping(&placed, &rate, self.damping, None).0;
            normal += force.normal;
            normal_forces[1] = side.normal_forces(&placed, &rate, self.damping)[0];
        }
        let mesh = normal + losses;
        let contact = self.flanks.driving.contact();
        let slices = self.flanks.driving.loaded_slices();
        let max_pressure = slices.iter().fold(0.0, |m: f64, s| m.max(s.slice.pressure));
        let (window, tooth_changes) = self.flanks.driving.window();
        let nominal = self.nominal_state(t);
        let shared = self.modal_reaction(t, &at, v, [Some(&driving), coast.as_ref()], &nominal);
        let of_turn = |g: usize| COORDINATES * (g + 1) - 1;
        let speeds = [0, 1].map(|g| nominal.velocity[g] + rate[of_turn(g)]);
        let (pair_forces, first_pair) = (contact.force().pair_forces.clone(), window.first());
        let contact_line_length = contact.line_length(&self.bodies.pair, &placed.poses);
        let root_stress = match &self.roots {
            Some(roots) => self.flanks.driving.root_stress(&self.bodies.pair, &placed.poses, roots)?,
            None => Default::default(),
        };
        Ok(Instant {
            time: t,
            cycles: self.turned_cycles(t, &d),
            speeds,
            transmission_error: q[self.bodies.coordinates.lag()],
            transmission_error_rate: v[self.bodies.coordinates.lag()],
            displacement: d,
            drive_torque: self.drive_torque(t, &nominal, &(mesh - shared), &losses),
            load_torque: self.bodies.options.load.at(t),
            bearing: -(self.bodies.bearing[0] * d + self.bodies.bearing[1] * rate),
            pair_forces,
            first_pair,
            normal_forces,
            contact_line_length,
            max_pressure,
            tooth_changes,
            mesh,
            slices,
            root_stress,
        })
    }

    /// What the inertia of the modes takes of the forces on the rigid bodies, D' L' p''; nothing without modes.
    fn modal_reaction(
        &self,
        t: f64,
        at: &ElasticDisplacement,
        v: &DVector<f64>,
        sides: [Option<&SideForce>; 2],
        nominal: &NominalState,
    ) -> Displacement {
        let Some(modal) = &self.modal else { return Displacement::zeros() };
        let (coupling, rate) = (self.coupling(t), self.elastic_displacement(t, v).q);
        let mut balance = ModalBalance::new(modal, &at.q, &rate);
        sides.into_iter().flatten().for_each(|side| {
            balance.add(side, &rate);
        });
        balance.accelerate(&coupling, nominal);
        let all = coupling.tr_mul(&(balance.conservative + balance.other));
        Displacement::from_fn(|i, _| all[i])
    }
}
