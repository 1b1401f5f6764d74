//! Cubic splines over one axis of a table. Theory (73).

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

/// A table axis with evenly spaced grid points, and its cubic B-splines.
///
/// ```text
/// f(s) = sum over k = 0 .. 3 of c_(i + k) B_k(s - i),   s: place in units of the spacing, i = floor(s)
/// ```
/// f has two continuous derivatives and takes the given values at the grid points; between them the error is O(h^4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Axis {
    /// One value, without dependence on the position.
    Single,
    /// Grid points 0 .. n of a period, where point n equals the first; n >= 4.
    Periodic(usize),
    /// Grid points 0 ..= n between two ends, n >= 3. The third derivative is continuous next to the ends ("not a
    /// knot").
    Open(usize),
}

/// The splines that are not zero at a position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Splines {
    /// Index of the coefficient of the first spline.
    pub first: usize,
    /// Number of weights: 4, or 1 on an axis with a single value.
    pub count: usize,
    /// Values of the splines; all per unit of the spacing.
    pub values: [f64; 4],
    /// Slopes of the splines.
    pub slopes: [f64; 4],
    /// Second derivatives of the splines.
    pub curvatures: [f64; 4],
}

impl Default for Splines {
    fn default() -> Self {
        Self::NONE
    }
}

impl Axis {
    /// Number of grid points with a value of their own.
    pub fn places(self) -> usize {
        match self {
            Self::Single => 1,
            Self::Periodic(n) => n,
            Self::Open(n) => n + 1,
        }
    }

    /// Number of coefficients. Those of a period are repeated beyond its end, so that no position has to wrap.
    pub fn coefficients(self) -> usize {
        match self {
            Self::Single => 1,
            Self::Periodic(n) | Self::Open(n) => n + 3,
        }
    }

    /// Number of intervals.
    pub fn cells(self) -> usize {
        match self {
            Self::Single => 1,
            Self::Periodic(n) | Self::Open(n) => n,
        }
    }

    /// Map from values to coefficients, coefficients x grid points; `None` for an axis with too few points.
    pub fn interpolation(self) -> Option<DMatrix<f64>> {
        let n = self.cells();
        match self {
            Self::Single => Some(DMatrix::identity(1, 1)),
            Self::Periodic(_) if n >= 4 => {
                let mut collocation = DMatrix::zeros(n, n);
                for i in 0..n {
                    for (k, b) in splines(0.0).values.into_iter().enumerate() {
                        collocation[(i, (i + k) % n)] += b;
                    }
                }
                let inverse = collocation.try_inverse()?;
                Some(DMatrix::from_fn(n + 3, n, |c, i| inverse[(c % n, i)]))
            }
            Self::Open(_) if n >= 3 => {
                let mut collocation = DMatrix::zeros(n + 3, n + 3);
                for i in 0..=n {
                    // The last place is the end of the last interval.
                    let (cell, s) = if i < n { (i, 0.0) } else { (n - 1, 1.0) };
                    for (k, b) in splines(s).values.into_iter().enumerate() {
                        collocation[(i, cell + k)] = b;
                    }
                }
                // Third derivatives of neighbouring intervals: differences of the coefficients, -1 3 -3 1.
                for (row, cell) in [(n + 1, 0), (n + 2, n - 2)] {
                    for (k, d) in [1.0, -4.0, 6.0, -4.0, 1.0].into_iter().enumerate() {
                        collocation[(row, cell + k)] = d;
                    }
                }
                Some(collocation.try_inverse()?.columns(0, n + 1).into_owned())
            }
            Self::Periodic(_) | Self::Open(_) => None,
        }
    }

    /// The splines at a position in units of the spacing. A period has no ends; beyond the ends of an open axis the
    /// polynomials of its outermost intervals continue.
    pub fn splines_at(self, place: f64) -> Splines {
        match self {
            Self::Single => Splines { first: 0, count: 1, values: [1.0, 0.0, 0.0, 0.0], ..Splines::NONE },
            Self::Periodic(n) => {
                let period = n as f64;
                let place = if (0.0..period).contains(&place) { place } else { place.rem_euclid(period) };
                // Whole numbers of floats beyond their range are the ends of theirs.
                let cell = (place as usize).min(n - 1);
                Splines { first: cell, ..splines(place - cell as f64) }
            }
            Self::Open(n) => {
                let cell = (place as usize).min(n - 1);
                Splines { first: cell, ..splines(place - cell as f64) }
            }
        }
    }
}

/// Pole of the filter that turns values at places into coefficients of cubic splines, sqrt(3) - 2.
const POLE: f64 = -0.267_949_192_431_122_7;
/// Places after which the filter has forgotten: POLE to this power is below round-off.
const FORGOTTEN: usize = 32;

/// Coefficients of splines over the places of a period from rows of values, as those of [`Axis::interpolation`], for
/// periods so long that a matrix would cost too much.
///
/// ```text
/// c_i + 4 c_(i+1) + c_(i+2) = 6 f_i:   a_i = f_i + p a_(i-1),   b_i = p (b_(i+1) - a_i),   c_(i+1) = 6 b_i
/// ```
/// Source: Unser, IEEE Signal Processing Magazine 16(6), 1999, p. 22, box 2.
pub(crate) fn periodic_coefficients(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let n = rows.len();
    let Some(first) = rows.first() else { return Vec::new() };
    let (mut last, mut filtered) = (vec![0.0; first.len()], rows.to_vec());
    // Both ways begin before the period, and have forgotten how when they enter it.
    for i in 0..FORGOTTEN + n {
        let at = (i + (n - 1) * FORGOTTEN) % n;
        last.iter_mut().zip(&rows[at]).for_each(|(a, f)| *a = f + POLE * *a);
        if i >= FORGOTTEN {
            filtered[at].clone_from(&last);
        }
    }
    let mut all = filtered.clone();
    last.fill(0.0);
    for i in (0..n + FORGOTTEN).rev() {
        last.iter_mut().zip(&filtered[i % n]).for_each(|(b, a)| *b = POLE * (*b - a));
        if i < n {
            all[i].iter_mut().zip(&last).for_each(|(c, b)| *c = 6.0 * b);
        }
    }
    (0..n + 3).map(|c| all[(c + n - 1) % n].clone()).collect()
}

impl Splines {
    /// None at all.
    pub(crate) const NONE: Self = Self { first: 0, count: 0, values: [0.0; 4], slopes: [0.0; 4], curvatures: [0.0; 4] };

    /// Those of a function whose value goes on from here by so many slopes, and whose own first and second derivatives are
    /// as many as `rates`.
    pub(crate) fn go_on(&mut self, slopes: f64, rates: [f64; 2]) {
        let own = self.slopes;
        self.values.iter_mut().zip(own).for_each(|(value, slope)| *value += slopes * slope);
        [self.slopes, self.curvatures] = rates.map(|rate| own.map(|slope| rate * slope));
    }
}

/// The four cubic B-splines of an interval at `s`, 0 .. 1.
#[inline]
pub(crate) fn splines(s: f64) -> Splines {
    let r = 1.0 - s;
    let middle = |s: f64| (4.0 + s * s * (3.0 * s - 6.0)) / 6.0;
    let slope = |s: f64| s * (1.5 * s - 2.0);
    Splines {
        first: 0,
        count: 4,
        values: [r * r * r / 6.0, middle(s), middle(r), s * s * s / 6.0],
        slopes: [-0.5 * r * r, slope(s), -slope(r), 0.5 * s * s],
        curvatures: [r, 3.0 * s - 2.0, 3.0 * r - 2.0, s],
    }
}
