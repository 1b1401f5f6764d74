//! The balance of forces on the free coordinates, from maps.

use std::convert::Infallible;

use contact_map::Wanted;
use integrate::{Forces, Mechanism, Resumable};
use nalgebra::{DMatrix, DVector};

use super::{MapExcess, MappedPair, MappedSide, SplineCache};

impl Mechanism for MappedPair {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let nominal = self.system.nominal_state(t);
        let external = self.system.external(t, &nominal);
        out.other.gemv(1.0, &self.loading, &external, 1.0);
        out.supplied += self.system.coordinates().power(&external, v);
        // A driver that balances the load answers loads, dampers and gyroscopic moments: its work is theirs beyond what
        // they do without the answer.
        let balancing = self.system.balancing_torque(&external);
        if balancing != 0.0 {
            out.supplied += balancing * self.system.driver_rate(v);
        }
        if let Some(bearing) = &self.bearing {
            out.conservative.gemv(-1.0, bearing, q, 1.0);
            if out.tangents {
                out.stiffness += bearing;
            }
        }
        if let Some(damping) = &self.damping {
            out.other.gemv(-1.0, damping, v, 1.0);
            let taken = power(&self.taken, v);
            out.dissipated += taken;
            out.supplied += taken - power(damping, v);
            if out.tangents {
                out.damping += damping;
            }
        }
        if let Some(gyroscopic) = &self.gyroscopic {
            out.other.gemv(-nominal.velocity[0], gyroscopic, v, 1.0);
            out.supplied -= nominal.velocity[0] * power(gyroscopic, v);
            if out.tangents {
                out.damping.zip_apply(gyroscopic, |c, g| *c += nominal.velocity[0] * g);
            }
        }
        let phase = self.phase(t, q);
        let wanted = Wanted { energy: false, phase_rate: out.rates || self.phase_of_driver.is_some() };
        for (side, kept) in self.sides.iter().zip(&mut self.kept) {
            let contact = side.contact(kept, phase, q, wanted);
            let rates = side.motion(v);
            let damping = side.map.map().damping(kept.last(), &contact, rates, self.system.damping_per_length());
            let along = [&side.approach, &side.tilt];
            let used = if side.map.map().tilts().is_some() { 2 } else { 1 };
            out.conservative.axpy(-contact.force, &side.approach, 1.0);
            out.conservative.axpy(contact.moment, &side.tilt, 1.0);
            if let Some((i, per_turn)) = self.phase_of_driver {
                out.conservative[i] -= per_turn * contact.phase_rate;
            }
            let answers = side.damped.iter().zip(&side.answered);
            for ((damped, answered), (force, rate)) in answers.zip(damping.force.iter().zip(&rates)).take(used) {
                out.other.axpy(-force, damped, 1.0);
                out.dissipated += force * rate;
                out.supplied -= force * answered.dot(v);
            }
            if out.rates {
                let speed = self.system.cycles_per_second(t);
                out.parametric += speed * contact.phase_rate;
            }
            if out.tangents {
                for i in 0..used {
                    for j in 0..used {
                        out.stiffness.ger(contact.stiffness[i][j], along[i], along[j], 1.0);
                        out.damping.ger(damping.rate_slope[i][j], &side.damped[i], along[j], 1.0);
                    }
                }
                out.stiffness.ger(damping.approach_slope, &side.damped[0], &side.approach, 1.0);
            }
        }
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        let phase = self.phase(t, q);
        let energy = |(side, kept): (&MappedSide, &mut SplineCache)| {
            let motion = side.motion(q);
            side.map.energy(kept.at(&side.map, phase, motion), motion[0])
        };
        let of_sides: f64 = self.sides.iter().zip(&mut self.kept).map(energy).sum();
        Ok(of_sides + self.bearing.as_ref().map_or(0.0, |bearing| 0.5 * power(bearing, q)))
    }

    fn accepted(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>) -> Result<(), Infallible> {
        let phase = self.phase(t, q);
        for (side, kept) in self.sides.iter().zip(&mut self.kept) {
            let motion @ [approach, tilt] = side.motion(q);
            let force = side.map.force(kept.at(&side.map, phase, motion), approach);
            let excess = &mut self.excess;
            excess.force = excess.force.max(force / side.map.map().largest_force());
            // Without contact a tilt does nothing.
            if let Some([low, high]) = side.map.map().tilts().filter(|_| force > 0.0) {
                let from_middle = (tilt - 0.5 * (low + high)).abs();
                excess.tilt = excess.tilt.max(from_middle / (0.5 * (high - low)));
            }
        }
        Ok(())
    }

    fn events(&self) -> usize {
        self.sides.len()
    }

    /// Overlap of the undeformed flanks of each side, mm: positive in contact.
    fn event_values(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut [f64]) -> Result<(), Infallible> {
        let phase = self.phase(t, q);
        for ((side, kept), value) in self.sides.iter().zip(&mut self.kept).zip(out) {
            let motion = side.motion(q);
            *value = side.map.overlap(kept.at(&side.map, phase, motion), motion[0]);
        }
        Ok(())
    }
}

impl Resumable for MappedPair {
    type Memory = MapExcess;

    fn memory(&self) -> MapExcess {
        self.excess
    }

    fn restore(&mut self, memory: &MapExcess) -> Result<(), Infallible> {
        self.excess = *memory;
        Ok(())
    }
}

/// x' A x.
fn power(a: &DMatrix<f64>, x: &DVector<f64>) -> f64 {
    (0..x.len()).map(|j| x[j] * a.column(j).dot(x)).sum()
}
