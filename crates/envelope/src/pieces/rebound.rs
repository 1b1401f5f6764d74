//! A mass thrown at a contact and thrown back.

use std::convert::Infallible;

use integrate::{Forces, Integrator, Mechanism, Scheme, State, StepControl};
use lumped::impact::ImpactLaw;
use nalgebra::{DMatrix, DVector, dvector};

use crate::{
    EnvelopeError,
    bench::{largest, least},
};

/// How the contact is damped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Damper {
    /// A damper beside the spring, from the first touch to the last.
    KelvinVoigt,
    /// The law of the model `impact`.
    Impact,
}

/// kg, mm, s; the sizes of a tooth pair.
const MASS_T: f64 = 1e-3;
const SPEED: f64 = 200.0;
const LAW: ImpactLaw = ImpactLaw { stiffness: 2e5, exponent: 1.5, damping: 5.0, depth: 0.02 };
const STEP: f64 = 2e-7;

/// What became of it.
pub(crate) struct Rebound {
    pub least_over_largest: f64,
    pub first_over_largest: f64,
    /// Energy of the mass before, less after, less what the damper took, over before.
    pub energy_off: f64,
}

struct Thrown {
    mass: DMatrix<f64>,
    damper: Damper,
}

impl Thrown {
    /// Force against the overlap -x, its damping part, and slopes by x and v.
    fn force(&self, x: f64, v: f64) -> [f64; 4] {
        if x >= 0.0 {
            return [0.0; 4];
        }
        match self.damper {
            Damper::Impact => {
                let f = LAW.at(-x, -v);
                [f.total(), f.damping, -f.by_overlap, -f.by_rate]
            }
            Damper::KelvinVoigt => {
                let elastic = LAW.stiffness * (-x).powf(LAW.exponent);
                let damping = -LAW.damping * v;
                [elastic + damping, damping, LAW.exponent * elastic / x, -LAW.damping]
            }
        }
    }
}

impl Mechanism for Thrown {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, _: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let [total, damping, by_x, by_v] = self.force(q[0], v[0]);
        out.conservative[0] = total - damping;
        out.other[0] = damping;
        out.stiffness[(0, 0)] = -by_x;
        out.damping[(0, 0)] = -by_v;
        out.dissipated = -damping * v[0];
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        let overlap = (-q[0]).max(0.0);
        Ok(LAW.stiffness * overlap.powf(LAW.exponent + 1.0) / (LAW.exponent + 1.0))
    }
}

/// Throws it.
///
/// # Errors
/// [`EnvelopeError::Piece`] where a step has no solution.
pub(crate) fn rebound(damper: Damper) -> Result<Rebound, EnvelopeError> {
    let mut thrown = Thrown { mass: DMatrix::from_element(1, 1, MASS_T), damper };
    let mut state = State::new(0.0, dvector![0.5 * SPEED * STEP], dvector![-SPEED]);
    let mut integrator = Integrator::new(Scheme::Energy, StepControl::Fixed(STEP), dvector![1e-2]);
    let mut course = Vec::new();
    let mut dissipated = 0.0;
    integrator
        .advance(&mut thrown, &mut state, 4e-3, |system, seen| {
            course.push(system.force(seen.state.q[0], seen.state.v[0])[0]);
            dissipated = seen.ledger.dissipated;
        })
        .map_err(EnvelopeError::of("thrown mass"))?;
    let most = largest(course.iter().copied());
    let fewest = least(course.iter().copied());
    let first = course.iter().copied().find(|f| *f != 0.0).unwrap_or(f64::NAN);
    let before = 0.5 * MASS_T * SPEED * SPEED;
    let after = 0.5 * MASS_T * state.v[0] * state.v[0];
    Ok(Rebound {
        least_over_largest: fewest / most,
        first_over_largest: first.abs() / most,
        energy_off: ((before - after - dissipated) / before).abs(),
    })
}
