//! Largest stable step of an explicit method. Theory (48a).
//!
//! ```text
//! M q'' + C q' + K q = 0,   q ~ exp(lambda t):   stable with steps h while |R(h lambda)| <= 1 for every lambda
//! ```
//! R is the method's stability polynomial. Runge-Kutta 4 is stable on the imaginary axis (no damping) up to |h lambda|
//! = 2.828 and on the negative real axis (only damping) up to 2.785; Dormand-Prince 5(4) up to 0.998 and 3.307.

use nalgebra::{Cholesky, Complex, DMatrix, Dyn};

use crate::{Forces, Scheme, eigenvalues::eigenvalues};

/// Growth in a step that counts as none.
const GROWTH_TOLERANCE: f64 = 1e-9;
/// Step of the search along a ray, and where it ends: no method of few stages is stable farther out.
const RAY: [f64; 2] = [0.01, 40.0];
/// Change of the tangents over which the limit of before is kept.
const TANGENT_CHANGE: f64 = 0.02;
/// Damped eigenvalues below this share of the largest move nothing.
const RIGID_SHARE: f64 = 1e-9;

/// The largest stable step of an explicit method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepLimit {
    /// Length of the step, s.
    pub step: f64,
    /// |lambda| of the motion that sets it, rad/s.
    pub rate: f64,
}

impl Scheme {
    /// Largest step with which no vibration of M q'' + C q' + K q = 0 grows numerically that does not grow physically;
    /// all matrices n x n, M symmetric positive definite.
    ///
    /// Motions that grow physically (flutter) are limited like undamped motion. `None` for implicit methods, if there
    /// is no free motion, and for matrices with entries that are not finite.
    pub fn step_limit(
        &self,
        mass: &DMatrix<f64>,
        stiffness: &DMatrix<f64>,
        damping: &DMatrix<f64>,
    ) -> Option<StepLimit> {
        let polynomial = self.stability_polynomial()?;
        let [stiffness, damping] = per_mass(&Cholesky::new(mass.clone())?, [stiffness, damping])?;
        limit(&polynomial, &stiffness, &damping)
    }
}

/// L^-1 A L^-T with M = L L': both per mass, and symmetric where they were; `None` where they hold no numbers.
fn per_mass(mass: &Cholesky<f64, Dyn>, both: [&DMatrix<f64>; 2]) -> Option<[DMatrix<f64>; 2]> {
    let lower = mass.l_dirty();
    let [Some(k), Some(c)] = both.map(|a| {
        let half = lower.solve_lower_triangular(a)?;
        let whole = lower.solve_lower_triangular(&half.transpose())?.transpose();
        whole.iter().all(|x| x.is_finite()).then_some(whole)
    }) else {
        return None;
    };
    Some([k, c])
}

/// The limit for matrices per mass.
fn limit(polynomial: &[f64], stiffness: &DMatrix<f64>, damping: &DMatrix<f64>) -> Option<StepLimit> {
    let n = stiffness.nrows();
    let scale = stiffness.norm().sqrt().max(damping.norm());
    if scale == 0.0 {
        return None;
    }
    // Velocities over the largest rate: both halves of the matrix are of one size.
    let mut first_order = DMatrix::zeros(2 * n, 2 * n);
    first_order.view_mut((0, n), (n, n)).fill_with_identity();
    first_order.view_mut((n, 0), (n, n)).copy_from(&(stiffness / (-scale * scale)));
    first_order.view_mut((n, n), (n, n)).copy_from(&(damping / -scale));
    let Some(all) = eigenvalues(first_order) else {
        // No eigenvalue lies beyond the norms, in whatever direction.
        let rate = bound([stiffness.norm(), damping.norm()]);
        return rate.is_finite().then(|| StepLimit { step: shortest_reach(polynomial) / rate, rate });
    };
    let largest = all.iter().map(|x| x.norm()).fold(0.0, f64::max);
    let moving = all.iter().filter(|x| x.norm() > RIGID_SHARE * largest);
    let limits = moving.map(|x| StepLimit { step: reach(polynomial, *x) / (scale * x.norm()), rate: scale * x.norm() });
    limits.min_by(|a, b| a.step.total_cmp(&b.step))
}

/// The value of |z| at which |R| first passes 1 on the ray from 0 in the direction of `towards`. Directions of growth
/// count as undamped ones.
fn reach(polynomial: &[f64], towards: Complex<f64>) -> f64 {
    let direction = Complex::new(towards.re.min(0.0), towards.im);
    let direction = if direction.norm() > 0.0 { direction / direction.norm() } else { Complex::i() };
    let grows = |r: f64| {
        let z = direction * r;
        polynomial.iter().rev().fold(Complex::new(0.0, 0.0), |sum, c| sum * z + c).norm() > 1.0 + GROWTH_TOLERANCE
    };
    let [step, end] = RAY;
    let (mut inside, mut outside) = (0.0, step);
    while !grows(outside) && outside < end {
        (inside, outside) = (outside, outside + step);
    }
    for _ in 0..40 {
        let middle = 0.5 * (inside + outside);
        if grows(middle) { outside = middle } else { inside = middle }
    }
    inside
}

/// Shortest reach of a method over all damped directions.
fn shortest_reach(polynomial: &[f64]) -> f64 {
    let directions = (0..=180).map(|i| Complex::from_polar(1.0, (90.0 + 0.5 * f64::from(i)).to_radians()));
    directions.map(|d| reach(polynomial, d)).fold(f64::INFINITY, f64::min)
}

/// Bound of all |lambda|: |lambda|^2 <= |C| |lambda| + |K|, by the norms of stiffness and damping per mass.
fn bound([stiffness, damping]: [f64; 2]) -> f64 {
    0.5 * (damping + (damping * damping + 4.0 * stiffness).sqrt())
}

/// The largest stable step over several states of a system, such as those of a mesh cycle: that of the stiffest state.
#[derive(Debug, Clone)]
pub struct Stiffest {
    polynomial: Vec<f64>,
    mass: Cholesky<f64, Dyn>,
    /// Bound of the rates there, stiffness and damping per mass.
    found: Option<(f64, [DMatrix<f64>; 2])>,
}

impl Stiffest {
    /// Before the first state. `None` for implicit methods, which have no limit, and for an invalid mass matrix.
    pub fn new(scheme: Scheme, mass: &DMatrix<f64>) -> Option<Self> {
        Some(Self { polynomial: scheme.stability_polynomial()?, mass: Cholesky::new(mass.clone())?, found: None })
    }

    /// Includes one more state, given its forces with tangents.
    pub fn include(&mut self, forces: &Forces) {
        let Some(both) = per_mass(&self.mass, [&forces.stiffness, &forces.damping]) else { return };
        let rate = bound([both[0].norm(), both[1].norm()]);
        if self.found.as_ref().is_none_or(|(before, _)| rate > *before) {
            self.found = Some((rate, both));
        }
    }

    /// The limit at the stiffest state so far; `None` if there is no free motion.
    pub fn limit(&self) -> Option<StepLimit> {
        let (_, [stiffness, damping]) = self.found.as_ref()?;
        limit(&self.polynomial, stiffness, damping)
    }
}

/// Watches the tangents of a motion under way: into how many parts a step has to be taken.
#[derive(Debug, Clone)]
pub(crate) struct StabilityGuard {
    polynomial: Vec<f64>,
    /// No eigenvalue below this over the step is unstable, in whatever direction it lies.
    safe: f64,
    /// Norms of stiffness and damping per mass at which the limit was found, and the limit.
    found: Option<([f64; 2], f64)>,
}

impl StabilityGuard {
    /// Stability guard of an explicit method; `None` for others, which need none.
    pub fn new(scheme: Scheme) -> Option<Self> {
        let polynomial = scheme.stability_polynomial()?;
        Some(Self { safe: shortest_reach(&polynomial), polynomial, found: None })
    }

    /// Largest stable step with the tangents of `forces`, as far as it matters for a step of length `h`: infinite if
    /// `h` is clearly stable.
    pub fn longest(&mut self, mass: &Cholesky<f64, Dyn>, forces: &Forces, h: f64) -> f64 {
        let Some([stiffness, damping]) = per_mass(mass, [&forces.stiffness, &forces.damping]) else {
            // What is no number says nothing of steps; it shows in the motion.
            return f64::INFINITY;
        };
        let norms = [stiffness.norm(), damping.norm()];
        if h * bound(norms) <= self.safe {
            return f64::INFINITY;
        }
        let alike =
            |(before, _): &([f64; 2], f64)| (0..2).all(|i| (norms[i] - before[i]).abs() <= TANGENT_CHANGE * before[i]);
        if let Some((_, limit)) = self.found.filter(alike) {
            return limit;
        }
        let step = limit(&self.polynomial, &stiffness, &damping).map_or(f64::INFINITY, |l| l.step);
        self.found = Some((norms, step));
        step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn single(x: f64) -> DMatrix<f64> {
        DMatrix::from_element(1, 1, x)
    }

    /// Runge-Kutta 4: 2 sqrt 2 without damping, 2.7853 with damping alone (Hairer, Wanner, Solving Ordinary
    /// Differential Equations II, IV.2); Dormand-Prince 5(4): a real limit of 3.3066.
    #[test]
    fn limits_on_the_axes_are_those_of_the_books() {
        let undamped = |s: Scheme| s.step_limit(&single(2.0), &single(2.0 * 1e8), &single(0.0)).unwrap().step * 1e4;
        // Without stiffness lambda = -C/M.
        let damped = |s: Scheme| s.step_limit(&single(2.0), &single(0.0), &single(2.0 * 1e4)).unwrap().step * 1e4;
        assert!((undamped(Scheme::RungeKutta4) - 8f64.sqrt()).abs() < 1e-5, "{}", undamped(Scheme::RungeKutta4));
        assert!((damped(Scheme::RungeKutta4) - 2.78529).abs() < 1e-4, "{}", damped(Scheme::RungeKutta4));
        assert!((damped(Scheme::DormandPrince) - 3.3066).abs() < 1e-3, "{}", damped(Scheme::DormandPrince));
        assert!((undamped(Scheme::DormandPrince) - 0.9985).abs() < 2e-3, "{}", undamped(Scheme::DormandPrince));
        for scheme in [Scheme::Energy, Scheme::Newmark, Scheme::GeneralisedAlpha { rho: 0.8 }] {
            assert_eq!(scheme.step_limit(&single(1.0), &single(1.0), &single(0.0)), None);
        }
    }

    /// A method of order p has 1/k! up to k = p.
    #[test]
    fn polynomials_begin_as_the_exponential_function() {
        for (scheme, order) in [(Scheme::RungeKutta4, 4), (Scheme::DormandPrince, 5)] {
            let mut wanted = 1.0;
            for (k, c) in scheme.stability_polynomial().unwrap().iter().enumerate().take(order + 1) {
                wanted /= (k as f64).max(1.0);
                assert!((c - wanted).abs() < 1e-14, "{scheme:?}: c_{k} = {c}, not {wanted}");
            }
        }
    }
}
