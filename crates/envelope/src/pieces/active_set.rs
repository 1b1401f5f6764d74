//! The active set as it is first thought of: points that overlap come in, points that pull go out, all at once.

use nalgebra::{DMatrix, DVector};

/// Whether the naive method ends, within ten changes a row, for openings C F and gaps g: g + C F >= 0, F >= 0, F (g + C
/// F) = 0. It goes round in circles where what one point takes away brings its neighbours in.
pub(crate) fn naive_ends(compliance: &DMatrix<f64>, gaps: &DVector<f64>, start: &[bool]) -> bool {
    let n = gaps.len();
    let mut active: Vec<bool> = start.to_vec();
    for _ in 0..10 * n {
        let rows: Vec<usize> = (0..n).filter(|&i| active[i]).collect();
        let inner = DMatrix::from_fn(rows.len(), rows.len(), |i, j| compliance[(rows[i], rows[j])]);
        let wanted = DVector::from_fn(rows.len(), |i, _| -gaps[rows[i]]);
        let Some(forces) = inner.lu().solve(&wanted) else { return false };
        let mut all = DVector::zeros(n);
        rows.iter().zip(forces.iter()).for_each(|(&i, f)| all[i] = *f);
        let open = gaps + compliance * &all;
        let next: Vec<bool> = (0..n).map(|i| if active[i] { all[i] > 0.0 } else { open[i] < -1e-12 }).collect();
        if next == active {
            return true;
        }
        active = next;
    }
    false
}
