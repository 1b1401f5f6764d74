//! Lowest frequencies of K phi = omega^2 M phi by a block Lanczos method on the inverse.
//!
//! ```text
//! A = K^-1 M,   A V = V T + V_+ R E',   V' M V = 1        theta = 1 / omega^2 of T, the largest first
//! |A phi - theta phi|_M = |R s_last|                       for phi = V s, T s = theta s
//! ```
//! A is self-adjoint in the inner product of M. All vectors are kept and orthogonalised twice, so no vector is found
//! twice. Blocks of several columns find repeated frequencies, which axisymmetric bodies have. Source: R. G. Grimes, J.
//! G. Lewis, H. D. Simon, SIAM J. Matrix Anal. Appl. 15 (1994) 228.

use faer::Mat;
use fem::dense;

use super::{basis::Basis, pencil::Pencil};
use crate::ReductionError;

/// Which of the modes are wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Until {
    /// The lowest so many, or as many as there are.
    Count(usize),
    /// All with omega^2 up to this, (rad/s)^2.
    Below(f64),
    /// The lowest alone, if there is one.
    First {
        /// Its residual relative to theta, at the most.
        residual: f64,
    },
}

impl Until {
    /// Residual of a converged pair relative to theta.
    fn residual(self) -> f64 {
        if let Self::First { residual } = self { residual } else { RESIDUAL }
    }
}

/// Some modes of a body, the lowest first.
#[derive(Debug, Clone)]
pub(crate) struct Eigenpairs {
    /// omega^2, (rad/s)^2.
    pub squares: Vec<f64>,
    /// One column a mode, Phi' M Phi = 1.
    pub shapes: Mat<f64>,
}

/// Residual of a converged pair relative to theta, of several; the frequency's own error is its square.
const RESIDUAL: f64 = 1e-9;
/// theta of no motion at all, relative to the largest: round-off in a basis that spans everything.
const NOTHING: f64 = 1e-11;
/// Vectors at most.
const MOST_VECTORS: usize = 3000;

/// The modes asked for; `block`: columns of a step, at least as many as any frequency is there.
pub(crate) fn lowest(pencil: &dyn Pencil, until: Until, block: usize) -> Result<Eigenpairs, ReductionError> {
    let n = pencil.order();
    let mut basis = Basis::default();
    let mut columns: Vec<Mat<f64>> = Vec::new();
    let mut added = basis.append(pencil, pencil.follow(scattered(n, block.min(n)).as_ref())?)?;
    while added > 0 {
        let image = pencil.follow(basis.inertia_of_last())?;
        let own = basis.products(image.as_ref());
        let before = basis.size();
        added = basis.append(pencil, image.clone())?;
        let residual = match added {
            0 => Mat::zeros(0, image.ncols()),
            _ => dense::product(basis.inertia_of_last().transpose(), image.as_ref()),
        };
        columns.push(own);
        let ritz = Ritz::new(&columns, before, &residual)?;
        if let Some(count) = ritz.settled(until, added == 0) {
            return Ok(ritz.pairs(&basis, count));
        }
        if basis.size() > MOST_VECTORS {
            let converged = ritz.converged(until.residual());
            return Err(ReductionError::ModesNotConverged { converged, vectors: basis.size() });
        }
    }
    Ok(Eigenpairs { squares: Vec::new(), shapes: Mat::zeros(n, 0) })
}

/// Numbers between -1 and 1 that are the same in every run and favour no direction.
fn scattered(rows: usize, columns: usize) -> Mat<f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    Mat::from_fn(rows, columns, |_, _| {
        // Knuth's linear congruential generator; its high bits.
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    })
}

/// Eigenpairs of T, the largest theta first, and how good they are.
struct Ritz {
    theta: Vec<f64>,
    vectors: Mat<f64>,
    residuals: Vec<f64>,
}

impl Ritz {
    /// Ritz pairs of the first `size` vectors of a basis; `columns`: T's block columns down to their own block.
    fn new(columns: &[Mat<f64>], size: usize, residual: &Mat<f64>) -> Result<Self, ReductionError> {
        let mut t = Mat::<f64>::zeros(size, size);
        let mut start = 0;
        for column in columns {
            for c in 0..column.ncols() {
                for r in 0..=start + c {
                    t[(start + c, r)] = column[(r, c)];
                }
            }
            start += column.ncols();
        }
        let (mut theta, vectors) = dense::symmetric_eigen(t.as_ref())?;
        theta.reverse();
        let vectors = Mat::from_fn(size, size, |i, j| vectors[(i, size - 1 - j)]);
        let last = vectors.as_ref().subrows(size - residual.ncols(), residual.ncols());
        let left = dense::product(residual.as_ref(), last);
        let residuals = (0..size).map(|j| left.col(j).norm_l2()).collect();
        Ok(Self { theta, vectors, residuals })
    }

    /// How many from the first on have residuals up to `most` of theta.
    fn converged(&self, most: f64) -> usize {
        let good = |(theta, residual): (&f64, &f64)| *theta > 0.0 && *residual <= most * theta;
        self.theta.iter().zip(&self.residuals).take_while(|&p| good(p)).count()
    }

    /// How many are the answer; `None` as long as there is none. `complete`: the basis spans all that the start can
    /// reach.
    fn settled(&self, until: Until, complete: bool) -> Option<usize> {
        let real = |t: &&f64| **t > NOTHING * self.theta[0];
        let good = if complete { self.theta.iter().take_while(real).count() } else { self.converged(until.residual()) };
        match until {
            Until::Count(count) => (complete || good >= count).then_some(good.min(count)),
            Until::First { .. } => (complete || good >= 1).then_some(good.min(1)),
            Until::Below(square) => {
                let below = self.theta.iter().take_while(|t| **t * square >= 1.0).count();
                // The first one above the bound must be as sure to be there as its residual says.
                let above = self.theta.get(below).zip(self.residuals.get(below));
                let sure = above.is_some_and(|(t, r)| (t + r) * square < 1.0);
                (complete || (good >= below && sure)).then_some(below.min(good))
            }
        }
    }

    fn pairs(&self, basis: &Basis, count: usize) -> Eigenpairs {
        let shapes = basis.combined(self.vectors.as_ref().subcols(0, count));
        Eigenpairs { squares: self.theta[..count].iter().map(|t| 1.0 / t).collect(), shapes }
    }
}
