//! The balance of forces on the free coordinates, as integrators ask for it.

use nalgebra::{DMatrix, DVector, SMatrix};

use super::PairMechanism;
use crate::{
    COORDINATES, Displacement, NominalState,
    elastic_displacement::ElasticDisplacement,
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
        let contacts = self.contact(t, &at, out.tangents)?;
        let cycles = self.cycles(t);
        let mut normal = Displacement::zeros();
        let mut other = self.external(t, &nominal);
        out.supplied += other.dot(&rate);
        let mut stiffness = self.bearing[0];
        let mut damping = self.bearing[1];
        out.dissipated += rate.dot(&(self.bearing[1] * rate));
        let mut modal = self.modal.as_ref().map(|modal| ModalBalance::new(modal, &at.q, &moving.q));
        for (side, force) in self.flanks.with_forces(&contacts) {
            normal += force.normal;
            other += force.friction;
            let placed = side.placed(&self.pair, cycles, &d);
            let matrix = out.tangents.then_some(&mut damping);
            let (damped, power) = side.damping(&placed, &rate, self.damping, matrix);
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
            let Self { pair, flanks, damping: per_length, .. } = self;
            for side in std::iter::once(&mut flanks.driving).chain(flanks.coast.as_mut()) {
                let placed = side.placed(pair, cycles, &d);
                stiffness += side.held_damping(&placed, &rate, *per_length).unwrap_or_else(SMatrix::zeros);
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
        let mut conservative = normal - self.bearing[0] * d;
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
        Ok(self.flanks.strain_energy() + self.bearing_and_modal_energy(&at))
    }

    fn potential_off_path(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, StaticError> {
        let at = self.elastic_displacement(t, q);
        let cycles = self.cycles(t);
        Ok(self.flanks.energy(&self.pair, cycles, &at)? + self.bearing_and_modal_energy(&at))
    }

    fn events(&self) -> usize {
        1 + usize::from(self.flanks.has_coast_flanks())
    }

    /// Least gap of the driving flanks and of the coast flanks, mm, with the sign turned: positive in contact.
    fn event_values(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut [f64]) -> Result<(), StaticError> {
        let at = self.elastic_displacement(t, q);
        self.contact(t, &at, false)?;
        let cycles = self.cycles(t);
        let overlaps = self.flanks.overlaps(&self.pair, cycles, &at);
        out.iter_mut().zip(overlaps).for_each(|(value, overlap)| *value = overlap);
        Ok(())
    }

    fn accepted(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<(), StaticError> {
        let (at, rate) = (self.elastic_displacement(t, q), self.coordinates.displacement(v));
        let (cycles, turned) = (self.cycles(t), self.turned_cycles(t, &at.d));
        self.flanks.check_passage(&self.pair, cycles, &at.d)?;
        self.flanks.follow(&self.pair, cycles, &at, turned)?;
        self.update_extremes(t, &at, &rate, turned)
    }

    /// Forgets the last contact solution: later results depend on state and windows alone, bit by bit.
    fn forget(&mut self) {
        self.flanks.forget();
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
