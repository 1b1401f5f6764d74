//! The load axis of a map: force as a function of its parameter, and evaluation of a curve of approach over load.
//! Theory (72).

use crate::spline::Axis;

/// The grid points on the load axis are evenly spaced in the square root of the force,
///
/// ```text
/// F = F_max (nu / n)^2,   nu = 0 .. n
/// ```
/// Then the approach is a smooth function of nu down to zero load, also for contact lines that become shorter with
/// decreasing load and for tips with point contact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LoadAxis {
    intervals: usize,
    force: f64,
}

impl LoadAxis {
    /// Axis up to `force` (N) with a number of intervals.
    pub fn new(intervals: usize, force: f64) -> Self {
        Self { intervals, force }
    }

    /// Spline axis of the grid points.
    pub fn axis(self) -> Axis {
        Axis::Open(self.intervals)
    }

    /// Force at a position on the axis, N.
    #[inline]
    pub fn force(self, place: f64) -> f64 {
        let part = place / self.intervals as f64;
        self.force * part * part
    }

    /// Position of a force (N) on the axis.
    pub fn place(self, force: f64) -> f64 {
        (force / self.force).sqrt() * self.intervals as f64
    }

    /// dF/d nu, N.
    #[inline]
    pub fn force_slope(self, place: f64) -> f64 {
        let n = self.intervals as f64;
        2.0 * self.force * place / (n * n)
    }
}

/// A curve over load: cubic splines. The polynomial of an interval is computed from its four coefficients on request,
/// because a motion usually needs only one interval. Integrals from zero load consist of those of whole intervals,
/// which are summed once, and of a part of one interval.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LoadCurve {
    axis: LoadAxis,
    /// Coefficients of the splines: one at each end of an interval, and one beyond either end of the axis.
    coefficients: Vec<f64>,
    /// Sums of the intervals before each and before the end of the axis, of what [`Self::close`] says.
    before: Vec<f64>,
}

impl LoadCurve {
    /// Clears the curve and keeps its memory.
    pub fn clear(&mut self, axis: LoadAxis) {
        self.axis = axis;
        self.coefficients.clear();
        self.coefficients.resize(axis.intervals + 3, 0.0);
    }

    /// Adds rows of coefficients, multiplied by weights.
    #[inline]
    pub fn add(&mut self, weights: &[f64; 4], rows: [&[f64]; 4]) {
        let [w0, w1, w2, w3] = weights;
        let n = self.coefficients.len();
        let [r0, r1, r2, r3] = rows.map(|row| &row[..n]);
        for (i, sum) in self.coefficients.iter_mut().enumerate() {
            *sum += (w0 * r0[i] + w1 * r1[i]) + (w2 * r2[i] + w3 * r3[i]);
        }
    }

    /// Adds a constant.
    pub fn raise(&mut self, constant: f64) {
        self.coefficients.iter_mut().for_each(|k| *k += constant);
    }

    /// Sums the integrals of whole intervals, from their moments over the axis; the curve is then complete.
    pub fn close(&mut self) {
        let Self { axis, coefficients, before } = self;
        let n = axis.intervals;
        before.clear();
        before.resize(n + 1, 0.0);
        // Each by itself first: so the processor does several at once.
        let own = &mut before[1..][..n];
        let [k0, k1, k2, k3] = [0, 1, 2, 3].map(|k| &coefficients[k..][..n]);
        for i in 0..n {
            let area = (k0[i] + 11.0 * (k1[i] + k2[i]) + k3[i]) / 24.0;
            let moment = (k0[i] + 22.0 * k1[i] + 33.0 * k2[i] + 4.0 * k3[i]) / 120.0;
            own[i] = f64::from(i as i32) * area + moment;
        }
        let mut sum = 0.0;
        for own in own {
            sum += *own;
            *own = sum;
        }
    }

    /// Spline coefficients of an interval.
    #[inline]
    pub fn in_cell(&self, cell: usize) -> [f64; 4] {
        let k = &self.coefficients[cell..cell + 4];
        [k[0], k[1], k[2], k[3]]
    }

    /// Coefficients of an interval's cubic in the place from its beginning, lowest power first.
    #[inline]
    fn cubic(&self, cell: usize) -> [f64; 4] {
        cubic(&self.in_cell(cell))
    }

    /// Value of the curve at the beginning of interval `i`.
    #[inline]
    fn knot(&self, i: usize) -> f64 {
        let k = &self.coefficients[i..i + 3];
        knot([k[0], k[1], k[2]])
    }

    /// Value and derivative by nu. Beyond the largest force the curve is linear in the force.
    #[inline]
    pub fn value(&self, place: f64) -> [f64; 2] {
        let axis = self.axis;
        let n = axis.intervals as f64;
        if place > n {
            let [end, slope] = self.value(n);
            let per_force = slope / axis.force_slope(n);
            return [end + per_force * (axis.force(place) - axis.force), per_force * axis.force_slope(place)];
        }
        let cell = (place as usize).min(axis.intervals - 1);
        along(&self.cubic(cell), place - cell as f64)
    }

    /// Integral over force within an interval, from its beginning to the part `s` of it.
    #[inline]
    fn within(&self, cell: usize, s: f64) -> f64 {
        let ([a, b, c, d], begin) = (self.cubic(cell), cell as f64);
        let area = s * (a + s * (b / 2.0 + s * (c / 3.0 + s * d / 4.0)));
        let moment = s * s * (a / 2.0 + s * (b / 3.0 + s * (c / 4.0 + s * d / 5.0)));
        self.axis.force_slope(1.0) * (begin * area + moment)
    }

    /// Integral over force of the whole intervals before one.
    fn before(&self, cell: usize) -> f64 {
        self.axis.force_slope(1.0) * self.before[cell]
    }

    /// Integral over the force from zero to a position on the axis.
    pub fn integral(&self, place: f64) -> f64 {
        let axis = self.axis;
        let n = axis.intervals as f64;
        if place > n {
            let ([end, slope], beyond) = (self.value(n), axis.force(place) - axis.force);
            return self.before(axis.intervals) + beyond * (end + 0.5 * beyond * slope / axis.force_slope(n));
        }
        let cell = (place as usize).min(axis.intervals - 1);
        self.before(cell) + self.within(cell, place - cell as f64)
    }

    /// The last interval whose beginning lies below a value.
    fn interval_of(&self, value: f64) -> usize {
        let (mut low, mut high) = (0, self.axis.intervals);
        while high - low > 1 {
            let middle = (low + high) / 2;
            if self.knot(middle) < value { low = middle } else { high = middle }
        }
        low
    }

    /// Position at which an increasing curve exceeds its first value by a given amount.
    pub fn solve(&self, value: f64) -> f64 {
        let n = self.axis.intervals;
        let end = self.knot(n);
        if value > end {
            let [last, slope] = self.value(n as f64);
            let force = self.axis.force + (value - last) * self.axis.force_slope(n as f64) / slope;
            return self.axis.place(force);
        }
        // The interval in which it is: its beginning is below.
        let cell = self.interval_of(value);
        let ([a, b, c, d], begin) = (self.cubic(cell), cell as f64);
        let [mut low, mut high] = [0.0, 1.0];
        let mut s = (value - a) / (self.knot(cell + 1) - a);
        for _ in 0..MOST_STEPS {
            let off = a - value + s * (b + s * (c + s * d));
            if off < 0.0 {
                low = s
            } else {
                high = s
            }
            // Halley's step: what is left is the third power of it.
            let (slope, bend) = (b + s * (2.0 * c + 3.0 * s * d), c + 3.0 * s * d);
            let next = s - off * slope / (slope * slope - off * bend);
            let within = next >= low && next <= high;
            let next = if within { next } else { 0.5 * (low + high) };
            if within && (next - s).abs() <= LAST_STEP * (begin + next).min(1.0) {
                return begin + next;
            }
            s = next;
        }
        begin + s
    }
}

/// Value at the beginning of an interval, from its first three coefficients.
#[inline]
pub(crate) fn knot(k: [f64; 3]) -> f64 {
    (k[0] + 4.0 * k[1] + k[2]) / 6.0
}

/// Coefficients of an interval's cubic in the place from its beginning, lowest power first.
#[inline]
pub(crate) fn cubic(k: &[f64; 4]) -> [f64; 4] {
    [
        knot([k[0], k[1], k[2]]),
        0.5 * (k[2] - k[0]),
        0.5 * (k[0] - 2.0 * k[1] + k[2]),
        (k[3] - k[0] + 3.0 * (k[1] - k[2])) / 6.0,
    ]
}

/// Value and slope of an interval's cubic at the part `s` of it.
#[inline]
pub(crate) fn along([a, b, c, d]: &[f64; 4], s: f64) -> [f64; 2] {
    [a + s * (b + s * (c + s * d)), b + s * (2.0 * c + 3.0 * s * d)]
}

/// Steps and halvings after which a place has all its digits.
const MOST_STEPS: usize = 60;
/// Step within an interval, over the place where that is small, whose third power is round-off.
const LAST_STEP: f64 = 2e-6;
