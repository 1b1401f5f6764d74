//! LU factor of a small matrix, in its own memory.

use nalgebra::{DMatrix, DVector};

/// L U = P A by columns with partial pivoting, in place of the matrix. A system of few coordinates has one made in every
/// step, which would spend more on memory than on numbers.
#[derive(Debug, Clone)]
pub(crate) struct LuFactor {
    matrix: DMatrix<f64>,
    /// Row that each row was exchanged with when its column was reached.
    exchanged: Vec<usize>,
}

impl LuFactor {
    /// Allocates memory for `n` rows.
    pub fn new(n: usize) -> Self {
        Self { matrix: DMatrix::zeros(n, n), exchanged: (0..n).collect() }
    }

    /// Factors the n x n matrix that `fill` writes. Before the call of `fill` the matrix contains the last factor.
    pub fn make(&mut self, fill: impl FnOnce(&mut DMatrix<f64>)) {
        fill(&mut self.matrix);
        let n = self.matrix.nrows();
        let all = self.matrix.as_mut_slice();
        for k in 0..n {
            let mut pivot = k;
            for i in k + 1..n {
                if all[k * n + i].abs() > all[k * n + pivot].abs() {
                    pivot = i;
                }
            }
            self.exchanged[k] = pivot;
            if all[k * n + pivot] == 0.0 {
                continue;
            }
            if pivot != k {
                (0..n).for_each(|j| all.swap(j * n + k, j * n + pivot));
            }
            let (left, right) = all.split_at_mut((k + 1) * n);
            let column = &mut left[k * n + k..];
            let inverse = 1.0 / column[0];
            let below = &mut column[1..];
            below.iter_mut().for_each(|x| *x *= inverse);
            for other in right.chunks_exact_mut(n) {
                let factor = -other[k];
                other[k + 1..].iter_mut().zip(&*below).for_each(|(x, l)| *x += factor * l);
            }
        }
    }

    /// Solves A x = b, where `x` contains b on entry; returns false if the matrix is singular.
    pub fn solve(&self, x: &mut DVector<f64>) -> bool {
        let (n, all, x) = (self.matrix.nrows(), self.matrix.as_slice(), x.as_mut_slice());
        self.exchanged.iter().enumerate().for_each(|(k, &pivot)| x.swap(k, pivot));
        for k in 0..n {
            let (known, below) = x[k..].split_at_mut(1);
            let column = &all[k * n + k + 1..(k + 1) * n];
            below.iter_mut().zip(column).for_each(|(x, l)| *x -= known[0] * l);
        }
        for k in (0..n).rev() {
            let column = &all[k * n..k * n + k + 1];
            if column[k] == 0.0 {
                return false;
            }
            x[k] /= column[k];
            let (above, known) = x.split_at_mut(k);
            above.iter_mut().zip(column).for_each(|(x, u)| *x -= known[0] * u);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector, LU};

    use super::LuFactor;

    /// As the library's, to the bit, also where rows are exchanged and the memory holds an earlier factor; and a matrix of
    /// dependent rows is none that can be solved.
    #[test]
    fn it_solves_as_the_library_does() {
        for n in [1, 2, 3, 7, 12] {
            let mut own = LuFactor::new(n);
            for turn in 0..5 {
                let entry = |i: usize, j: usize| (1.0 + 0.7 * ((i * n + j) as f64).powi(2) + f64::from(turn)).sin();
                let matrix = DMatrix::from_fn(n, n, entry);
                let rest = DVector::from_fn(n, |i, _| entry(i, i + 1));
                own.make(|m| m.copy_from(&matrix));
                let mut x = rest.clone();
                assert!(own.solve(&mut x));
                assert_eq!(Some(&x), LU::new(matrix.clone()).solve(&rest).as_ref(), "{n} rows");
                assert!((matrix * x - rest).amax() < 1e-10);
            }
            own.make(|m| m.fill(if n == 1 { 0.0 } else { 1.0 }));
            assert!(!own.solve(&mut DVector::from_element(n, 1.0)));
        }
    }
}
