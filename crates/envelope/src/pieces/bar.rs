//! A bar that hits a rigid wall: the force is known in closed form.
//!
//! ```text
//! F = E A v / c for 2 L / c, then none; c = sqrt(E / rho)
//! ```
//! Units: L = A = E = rho = 1 and v = 1, so F = 1 for a time of 2.

use std::convert::Infallible;

use integrate::{Forces, Integrator, Mechanism, Scheme, State, StepControl};
use nalgebra::{DMatrix, DVector};

use crate::{EnvelopeError, bench::largest};

/// Whether the end that hits the wall has mass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Boundary {
    /// A consistent mass matrix, and a wall as stiff as a hundred elements: the end's own mass bounces.
    Consistent,
    /// The end has no mass: it follows the first node that has some, by the element between.
    Massless,
}

/// Elements of the bar.
const ELEMENTS: usize = 40;
/// Steps in the time that a wave takes through an element.
const STEPS: f64 = 4.0;

struct Bar {
    mass: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    wall: f64,
}

impl Bar {
    fn new(boundary: Boundary) -> Self {
        let (h, spring) = (1.0 / ELEMENTS as f64, ELEMENTS as f64);
        let nodes = ELEMENTS + usize::from(boundary == Boundary::Consistent);
        let (mut mass, mut stiffness) = (DMatrix::zeros(nodes, nodes), DMatrix::zeros(nodes, nodes));
        for e in 0..nodes - 1 {
            for (i, j) in [(e, e), (e + 1, e + 1), (e, e + 1), (e + 1, e)] {
                let same = i == j;
                stiffness[(i, j)] += if same { spring } else { -spring };
                mass[(i, j)] += if same { h / 3.0 } else { h / 6.0 };
            }
        }
        if boundary == Boundary::Massless {
            // The massless element's inertia goes to the first node that has some.
            mass[(0, 0)] += h;
        }
        // Of a massless end the spring to the wall is the end's own element.
        let wall = match boundary {
            Boundary::Consistent => 100.0 * spring,
            Boundary::Massless => spring,
        };
        Self { mass, stiffness, wall }
    }

    fn force(&self, overlap: f64) -> f64 {
        self.wall * overlap.max(0.0)
    }
}

impl Mechanism for Bar {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, _: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        out.conservative.copy_from(&-(&self.stiffness * q));
        out.conservative[0] += self.force(-q[0]);
        out.stiffness.copy_from(&self.stiffness);
        out.stiffness[(0, 0)] += if q[0] < 0.0 { self.wall } else { 0.0 };
        Ok(())
    }

    fn potential(&mut self, _: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        Ok(0.5 * q.dot(&(&self.stiffness * q)) + 0.5 * self.wall * (-q[0]).max(0.0).powi(2))
    }
}

/// What became of an impact.
pub(crate) struct Impact {
    /// Root mean square of the force less 1 while the wave runs to the far end and back, its ends left out.
    pub ringing: f64,
    /// Largest force.
    pub largest: f64,
    /// Energy not accounted for, over that of the flight.
    pub energy: f64,
}

/// Lets the bar hit the wall.
///
/// # Errors
/// [`EnvelopeError::Piece`] where a step has no solution.
pub(crate) fn impact(boundary: Boundary, scheme: Scheme) -> Result<Impact, EnvelopeError> {
    let mut bar = Bar::new(boundary);
    let n = bar.mass.nrows();
    let scale = DVector::from_element(n, 1.0);
    let h = 1.0 / (ELEMENTS as f64 * STEPS);
    let mut state = State::new(0.0, DVector::zeros(n), DVector::from_element(n, -1.0));
    let mut integrator = Integrator::new(scheme, StepControl::Fixed(h), scale);
    let mut course = Vec::new();
    integrator
        .advance(&mut bar, &mut state, 2.5, |bar, seen| course.push((seen.state.time, bar.force(-seen.state.q[0]))))
        .map_err(EnvelopeError::of("bar"))?;
    let plateau: Vec<f64> = course.iter().filter(|(t, _)| (0.2..1.8).contains(t)).map(|(_, f)| f - 1.0).collect();
    let ringing = (plateau.iter().map(|d| d * d).sum::<f64>() / plateau.len() as f64).sqrt();
    let largest = largest(course.iter().map(|c| c.1));
    let energy = integrator.ledger().map_or(f64::NAN, |l| l.residual().abs() / 0.5);
    Ok(Impact { ringing, largest, energy })
}
