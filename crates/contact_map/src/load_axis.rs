//! The load axis of a map: force over its parameter, and what is read off a curve of approach over load. Theory (72).

use crate::spline::{Axis, Splines};

/// Most intervals of the load axis.
pub const MOST_LOADS: usize = 24;

/// Coefficients of a curve over load, at one phase and tilt.
pub type Curve = [f64; MOST_LOADS + 3];

/// Places over load are those of evenly spaced square roots of the force,
///
/// ```text
/// F = F_max (nu / n)^2,   nu = 0 .. n
/// ```
/// Lines of contact that grow shorter with load, and tips that press a point, then have approaches that are smooth in
/// nu down to no load at all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadAxis {
    intervals: usize,
    force: f64,
}

/// Integrals of the four splines of an interval over it, and of their products with the place in it.
const SPLINE_AREA: [f64; 4] = [1.0 / 24.0, 11.0 / 24.0, 11.0 / 24.0, 1.0 / 24.0];
const SPLINE_MOMENT: [f64; 4] = [1.0 / 120.0, 22.0 / 120.0, 33.0 / 120.0, 4.0 / 120.0];

/// Places and weights of Gauss' rule with three points on 0 .. 1: exact for a cubic times a slope.
const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

impl LoadAxis {
    /// Up to `force` (N) in so many intervals.
    pub fn new(intervals: usize, force: f64) -> Self {
        Self { intervals, force }
    }

    /// Its axis.
    pub fn axis(self) -> Axis {
        Axis::Open(self.intervals)
    }

    /// Force at a place, N.
    pub fn force(self, place: f64) -> f64 {
        let part = place / self.intervals as f64;
        self.force * part * part
    }

    /// Place of a force (N).
    pub fn place(self, force: f64) -> f64 {
        (force / self.force).sqrt() * self.intervals as f64
    }

    /// dF/d nu, N.
    pub fn force_slope(self, place: f64) -> f64 {
        let n = self.intervals as f64;
        2.0 * self.force * place / (n * n)
    }

    /// Value and slope over nu of a curve. Beyond the largest force it goes on in a straight line over force.
    pub fn value(self, curve: &Curve, place: f64) -> [f64; 2] {
        let n = self.intervals as f64;
        if place > n {
            let [end, slope] = self.value(curve, n);
            let per_force = slope / self.force_slope(n);
            return [end + per_force * (self.force(place) - self.force), per_force * self.force_slope(place)];
        }
        let Splines { first, values, slopes, .. } = self.axis().splines_at(place);
        let of = |weights: [f64; 4]| (0..4).map(|k| weights[k] * curve[first + k]).sum::<f64>();
        [of(values), of(slopes)]
    }

    /// Values of a curve at its places, and its integrals over force from none up to them.
    pub fn knots(self, curve: &Curve) -> Knots {
        let n = self.intervals;
        let scale = self.force_slope(1.0);
        let mut knots = Knots { values: [0.0; MOST_LOADS + 1], integrals: [0.0; MOST_LOADS + 1] };
        for i in 0..=n {
            knots.values[i] = (curve[i] + 4.0 * curve[i + 1] + curve[i + 2]) / 6.0;
        }
        for cell in 0..n {
            let of = |weights: [f64; 4]| (0..4).map(|k| weights[k] * curve[cell + k]).sum::<f64>();
            let part = cell as f64 * of(SPLINE_AREA) + of(SPLINE_MOMENT);
            knots.integrals[cell + 1] = knots.integrals[cell] + scale * part;
        }
        knots
    }

    /// Integral of a curve over force from none to that of a place.
    pub fn integral(self, curve: &Curve, knots: &Knots, place: f64) -> f64 {
        let n = self.intervals as f64;
        if place > n {
            let ([end, slope], beyond) = (self.value(curve, n), self.force(place) - self.force);
            return knots.integrals[self.intervals]
                + beyond * (end + 0.5 * beyond * slope / self.force_slope(n));
        }
        let cell = (place as usize).min(self.intervals - 1);
        let (begin, mut sum) = (cell as f64, 0.0);
        for (at, weight) in GAUSS {
            let s = begin + (place - begin) * at;
            sum += weight * self.force_slope(s) * self.value(curve, s)[0];
        }
        knots.integrals[cell] + (place - begin) * sum
    }

    /// Place at which a curve that grows has a value; below its beginning: none.
    pub fn solve(self, curve: &Curve, knots: &Knots, value: f64) -> Option<f64> {
        let n = self.intervals;
        let all = &knots.values[..=n];
        let end = all.partition_point(|knot| *knot < value);
        if end == 0 {
            return None;
        }
        if end > n {
            let [last, slope] = self.value(curve, n as f64);
            let force = self.force + (value - last) * self.force_slope(n as f64) / slope;
            return Some(self.place(force));
        }
        let [mut low, mut high] = [(end - 1) as f64, end as f64];
        let mut place = low + (value - all[end - 1]) / (all[end] - all[end - 1]);
        for _ in 0..MOST_STEPS {
            let [at, slope] = self.value(curve, place);
            let off = at - value;
            if off < 0.0 { low = place } else { high = place }
            let next = place - off / slope;
            let next = if next >= low && next <= high { next } else { 0.5 * (low + high) };
            if (next - place).abs() <= LAST_BITS * next {
                return Some(next);
            }
            place = next;
        }
        Some(place)
    }
}

/// What a curve is at its places.
#[derive(Debug, Clone, PartialEq)]
pub struct Knots {
    /// Values.
    pub values: [f64; MOST_LOADS + 1],
    /// Integrals over force from none up to there.
    pub integrals: [f64; MOST_LOADS + 1],
}

/// Newton steps and halvings after which a place has all its digits.
const MOST_STEPS: usize = 60;
/// Change of a place, relative, that is round-off.
const LAST_BITS: f64 = 4.0 * f64::EPSILON;
