//! Two bodies that nothing holds: their motion against each other is that of one body on the same spring.

use std::convert::Infallible;

use integrate::{Forces, Mechanism};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use periodic::{BalanceOptions, FourierSeries, PeriodicFamily, TangentFlow, Tracer};

use crate::oscillator::Oscillator;

/// The oscillator between two masses whose reduced mass is one: what is between them acts on both.
struct TwoBodies {
    mass: DMatrix<f64>,
    between: Oscillator,
}

/// Masses with 1 / m1 + 1 / m2 = 1.
const MASSES: [f64; 2] = [3.0, 1.5];

impl Mechanism for TwoBodies {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let mut own = Forces::zeros(1);
        self.between.forces(t, &dvector![q[0] - q[1]], &dvector![v[0] - v[1]], &mut own)?;
        for (i, sign) in [1.0, -1.0].into_iter().enumerate() {
            out.conservative[i] += sign * own.conservative[0];
            out.other[i] += sign * own.other[0];
            for (j, other) in [1.0, -1.0].into_iter().enumerate() {
                out.stiffness[(i, j)] += sign * other * own.stiffness[(0, 0)];
                out.damping[(i, j)] += sign * other * own.damping[(0, 0)];
            }
        }
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        self.between.potential(t, &dvector![q[0] - q[1]])
    }
}

impl PeriodicFamily for TwoBodies {
    fn set_parameter(&mut self, value: f64) -> Result<(), Infallible> {
        self.between.set_parameter(value)
    }

    fn period(&self) -> f64 {
        self.between.period()
    }

    fn scale(&self) -> DVector<f64> {
        dvector![1.0, 1.0]
    }

    fn free_direction(&self) -> Option<DVector<f64>> {
        Some(dvector![1.0, 1.0])
    }
}

/// Amplitudes and multipliers are those of the one body; the common turn is in neither.
#[test]
fn two_free_bodies_move_as_one_held() {
    let mut one = Oscillator::new(0.05, 1.0, 0.1, 0.05);
    let (m1, m2) = (MASSES[0], MASSES[1]);
    let mut two = TwoBodies { mass: dmatrix![m1, 0.0; 0.0, m2], between: one.clone() };
    let rest = one.at_rest().at(0.0)[0];
    for frequency in [0.55, 0.78, 1.2] {
        let start = FourierSeries::at_rest(&dvector![rest], 4);
        let held = Tracer::new(&mut one, BalanceOptions::default(), 1.0).unwrap().motion_at(frequency, &start).unwrap();
        let start = FourierSeries::at_rest(&dvector![rest, 0.0], 4);
        let free = Tracer::new(&mut two, BalanceOptions::default(), 1.0).unwrap().motion_at(frequency, &start).unwrap();
        let [a, b] = [held.series.peak_to_peak(&dvector![1.0]), free.series.peak_to_peak(&dvector![1.0, -1.0])];
        assert!((b / a - 1.0).abs() < 1e-9, "at {frequency}: {b}, held {a}");
        let [a, b] = [&held, &free].map(|motion| &motion.floquet.multipliers);
        assert_eq!((a.len(), b.len()), (2, 2), "the common turn has no multiplier");
        for (x, y) in a.iter().zip(b) {
            assert!((x - y).norm() < 1e-8, "at {frequency}: {y}, held {x}");
        }
    }
}

/// A disturbance of a linear mass on a damped spring fades as it must: exp(-zeta t) for any direction, to the square of
/// the step.
#[test]
fn the_tangent_flow_fades_as_damping_says() {
    let (zeta, h, steps) = (0.1f64, 0.01, 1000);
    let [mass, stiffness, damping] = [1.0, 1.0, 2.0 * zeta].map(|x| DMatrix::from_element(1, 1, x));
    let mut flow = TangentFlow { places: dmatrix![1.0], rates: dmatrix![-zeta] };
    for _ in 0..steps {
        flow.step(&mass, [&stiffness, &damping], [&stiffness, &damping], h).unwrap();
    }
    let t = h * f64::from(steps);
    let own = (1.0 - zeta * zeta).sqrt();
    let exact = (-zeta * t).exp() * (own * t).cos();
    assert!((flow.places[0] - exact).abs() < 1e-4, "{}, not {exact}", flow.places[0]);
}
