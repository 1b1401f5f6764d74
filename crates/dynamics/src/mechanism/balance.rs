//! The balance of forces on the free coordinates, as integrators ask for it.

use nalgebra::{DMatrix, DVector, SMatrix};

use super::{PairMechanism, external::about_own_axis};
use crate::{
    COORDINATES, Displacement, NominalState,
    elastic_displacement::ElasticDisplacement,
    mesh_side::{MeshSide, SideContacts},
    modal::{ModalBalance, expansion},
};
use integrate::{Forces, Mechanism};
use ltca::StaticError;

impl Mechanism for PairMechanism {
    type Error = StaticError;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), StaticError> {
        let (at, moving) = (self.elastic_displacement(t, q), self.elastic_displacement(t, v));
        let (d, rate) = (at.d, moving.d);
        let nominal = self.nominal_state(t);
        let SideContacts { driving, coast, .. } = self.contact(t, &at, out.tangents)?;
        let cycles = self.cycles(t);
        let mut normal = Displacement::zeros();
        let mut other = self.external(t, &nominal);
        out.supplied += other.dot(&rate);
        let mut stiffness = self.bearing[0];
        let mut damping = self.bearing[1];
        out.dissipated += rate.dot(&(self.bearing[1] * rate));
        let mut modal = self.modal.as_ref().map(|modal| ModalBalance::new(modal, &at.q, &moving.q));
        for (side, force) in [(Some(&self.drive_side), Some(&driving)), (self.coast_side.as_ref(), coast.as_ref())] {
            let (Some(side), Some(force)) = (side, force) else { continue };
            normal += force.normal;
            other += force.friction;
            let poses = side.poses(&self.pair, cycles, &d);
            let matrix = out.tangents.then_some(&mut damping);
            let (damped, power) = side.damping(&poses, &rate, self.damping, matrix);
            other += damped;
            out.dissipated += power;
            // Friction goes against the sliding of the turn, and takes its power there. What it does to the deviations,
            // of either sign, comes from the turn as well.
            let taken = -force.friction.dot(&self.turning(&nominal, v));
            out.dissipated += taken;
            out.supplied += taken + force.friction.dot(&rate);
            match &mut modal {
                None => stiffness += force.stiffness,
                Some(modal) => out.supplied += modal.add(force, &moving.q),
            }
        }
        if out.tangents && modal.is_none() {
            let Self { pair, drive_side, coast_side, damping: per_length, .. } = self;
            for side in std::iter::once(drive_side).chain(coast_side) {
                let poses = side.poses(pair, cycles, &d);
                stiffness += side.held_damping(&poses, &rate, *per_length).unwrap_or_else(SMatrix::zeros);
            }
        }
        let gyroscopic = self.gyroscopic(&nominal);
        other -= self.bearing[1] * rate;
        other -= gyroscopic * rate;
        damping += gyroscopic;
        let driver = COORDINATES * (2 - self.options.statics.driven()) - 1;
        let balancing = self.balancing_torque(&other);
        other[driver] += balancing;
        out.supplied += balancing * rate[driver];
        let mut conservative = about_own_axis(normal - self.bearing[0] * d, &d);
        let mut other = about_own_axis(other, &d);
        match modal {
            None if out.tangents => {
                self.coordinates.add_matrix(&stiffness, 1.0, &mut out.stiffness);
                self.coordinates.add_matrix(&damping, 1.0, &mut out.damping);
            }
            None => {}
            Some(mut modal) => {
                let coupling = self.coupling(t);
                out.supplied += modal.accelerate(&coupling, &nominal).dot(&moving.q);
                out.dissipated += modal.dissipated;
                conservative -= coupling.tr_mul(&modal.conservative);
                other -= coupling.tr_mul(&modal.other);
                for (f, all) in [(&modal.conservative, &mut out.conservative), (&modal.other, &mut out.other)] {
                    let mut rows = all.rows_mut(self.coordinates.count(), f.len());
                    rows += f;
                }
                if out.tangents {
                    let y = expansion(self.coordinates.map(), &coupling);
                    modal.add_rigid(&stiffness, &damping);
                    out.stiffness += y.tr_mul(&modal.stiffness) * &y;
                    out.damping += y.tr_mul(&modal.damping) * &y;
                }
            }
        }
        self.coordinates.add_force(&conservative, &mut out.conservative);
        self.coordinates.add_force(&other, &mut out.other);
        if out.rates {
            // A ten-thousandth of a mesh cycle either way; at rest nothing changes.
            let way = 1e-4 * self.pair.pinion.pitch_angle();
            let [speed, growth] = [nominal.velocity[0].abs(), nominal.acceleration[0].abs()];
            let step = (way / speed).min((2.0 * way / growth).sqrt());
            out.parametric = if !step.is_finite() {
                0.0
            } else {
                (self.potential(t + step, q)? - self.potential(t - step, q)?) / (2.0 * step)
            };
        }
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, StaticError> {
        let at = self.elastic_displacement(t, q);
        self.contact(t, &at, false)?;
        let of = |side: &MeshSide| side.contact().strain_energy();
        let contact = of(&self.drive_side) + self.coast_side.as_ref().map_or(0.0, of);
        Ok(contact + self.bearing_and_modal_energy(&at))
    }

    fn potential_off_path(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, StaticError> {
        let at = self.elastic_displacement(t, q);
        Ok(self.contact_energy(t, &at)? + self.bearing_and_modal_energy(&at))
    }

    fn events(&self) -> usize {
        1 + usize::from(self.coast_side.is_some())
    }

    /// Least gap of the driving flanks and of the coast flanks, mm, with the sign turned: positive in contact.
    fn event_values(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut [f64]) -> Result<(), StaticError> {
        let at = self.elastic_displacement(t, q);
        self.contact(t, &at, false)?;
        let cycles = self.cycles(t);
        let pair = &self.pair;
        for (side, value) in std::iter::once(&mut self.drive_side).chain(self.coast_side.as_mut()).zip(out) {
            *value = side.overlap(pair, cycles, &at);
        }
        if self.modal.is_some() {
            self.last = None;
        }
        Ok(())
    }

    fn accepted(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<(), StaticError> {
        let (at, rate) = (self.elastic_displacement(t, q), self.coordinates.displacement(v));
        self.check_passage(t, &at.d)?;
        let turned = self.turned_cycles(t, &at.d);
        for side in std::iter::once(&self.drive_side).chain(&self.coast_side) {
            side.check_pace(turned)?;
        }
        // Several teeth may be due after a long step.
        loop {
            let before = self.contact(t, &at, false)?;
            let Self { pair, drive_side, coast_side, .. } = self;
            let loads = |side: &MeshSide| side.contact().force().pair_forces.iter().sum::<f64>();
            let sums = [Some(loads(drive_side)), coast_side.as_ref().map(loads)];
            let moved = [
                drive_side.follow(pair, turned)?,
                coast_side.as_mut().map_or(Ok(false), |side| side.follow(pair, turned))?,
            ];
            if moved == [false; 2] {
                self.update_extremes(t, &before.at.1, &rate, turned)?;
                return Ok(());
            }
            self.last = None;
            self.contact(t, &at, false)?;
            for ((side, moved), sum) in
                [Some(&mut self.drive_side), self.coast_side.as_mut()].into_iter().zip(moved).zip(sums)
            {
                if let (Some(side), true, Some(sum)) = (side, moved, sum) {
                    side.record_jump(sum);
                }
            }
        }
    }

    /// Forgets the last contact solution: later results depend on state and windows alone, bit by bit.
    fn forget(&mut self) {
        self.forget_contact();
    }

    fn end_cycle(&mut self, begin: f64, end: f64) {
        self.throughput += self.throughput_between(begin, end);
    }
}

impl PairMechanism {
    /// Velocities of both gears that turn in the ratio of their teeth, at the driver's own speed.
    fn turning(&self, nominal: &NominalState, v: &DVector<f64>) -> Displacement {
        let mut all = Displacement::zeros();
        for (g, velocity) in nominal.velocity.iter().enumerate() {
            all[COORDINATES * (g + 1) - 1] = *velocity;
        }
        if let Some(i) = self.coordinates.driver_turn() {
            all.axpy(v[i], &self.coordinates.map().column(i), 1.0);
        }
        all
    }

    /// Energy of bearings and modes, N mm.
    fn bearing_and_modal_energy(&self, at: &ElasticDisplacement) -> f64 {
        let modes = self.modal.as_ref().map_or(0.0, |modal| at.q.dot(&modal.squares.component_mul(&at.q)));
        0.5 * (at.d.dot(&(self.bearing[0] * at.d)) + modes)
    }
}
