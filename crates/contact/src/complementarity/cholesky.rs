//! Cholesky's factor of a small dense matrix, and solutions with it.
//!
//! Contact has some fifty active rows. A factor of that order costs 50,000 multiplications, and several times that in a
//! library made for thousands: it prepares blocks and kernels that never come to work.

/// L with A = L L', in place of the lower triangle of A, column by column; what stands above is left alone. Whether A is
/// positive definite.
pub(super) struct Cholesky<'a> {
    pub matrix: &'a mut [f64],
    pub order: usize,
}

/// Columns that are taken away from a later one in one pass over it.
const AT_ONCE: usize = 4;

impl pulp::NullaryFnOnce for Cholesky<'_> {
    type Output = bool;

    // Compiled for each set of instructions that there may be; the processor's own is chosen as the program runs.
    #[inline(always)]
    fn call(self) -> bool {
        let Self { matrix, order: m } = self;
        for j in 0..m {
            let (before, rest) = matrix.split_at_mut(j * m);
            let column = &mut rest[j..m];
            let mut fours = before.chunks_exact(AT_ONCE * m);
            for four in &mut fours {
                let (a, b) = (&four[j..m], &four[m + j..2 * m]);
                let (c, d) = (&four[2 * m + j..3 * m], &four[3 * m + j..]);
                let [wa, wb, wc, wd] = [a[0], b[0], c[0], d[0]];
                for ((((x, a), b), c), d) in column.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                    *x -= (wa * a + wb * b) + (wc * c + wd * d);
                }
            }
            for one in fours.remainder().chunks_exact(m) {
                let own = &one[j..];
                let w = own[0];
                column.iter_mut().zip(own).for_each(|(x, a)| *x -= w * a);
            }
            if column[0].is_nan() || column[0] <= 0.0 {
                return false;
            }
            let root = column[0].sqrt();
            column[0] = root;
            let share = root.recip();
            column[1..].iter_mut().for_each(|x| *x *= share);
        }
        true
    }
}

/// Solves L L' x = b for one right-hand side in place, L lower triangular, column by column.
pub(super) struct Substitution<'a> {
    pub factor: &'a [f64],
    pub x: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Substitution<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { factor, x } = self;
        let m = x.len();
        let below = |j: usize| &factor[j * m + j..(j + 1) * m];
        for j in 0..m {
            let column = below(j);
            let share = x[j] / column[0];
            x[j] = share;
            x[j + 1..].iter_mut().zip(&column[1..]).for_each(|(x, l)| *x -= share * l);
        }
        for j in (0..m).rev() {
            let column = below(j);
            x[j] = (x[j] - dot(&column[1..], &x[j + 1..])) / column[0];
        }
    }
}

/// Eight sums side by side, so that they go on together.
#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    const LANES: usize = 8;
    let (a, b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    let mut sums = [0.0; LANES];
    for (a, b) in a.zip(b) {
        (0..LANES).for_each(|k| sums[k] += a[k] * b[k]);
    }
    rest + sums.iter().sum::<f64>()
}
