//! Cholesky factor of a small dense matrix, and solutions with it, in blocks of four.
//!
//! A contact problem has about fifty active rows. A factor of that order costs 25,000 multiplications. A library made
//! for orders of thousands needs several times that, because it prepares blocks and kernels that are not used at this
//! size.

use pulp::{Simd, WithSimd};

use crate::lanes::{Four, LANES};

/// Columns of four entries a block, from the diagonal down.
type Block<S> = [Four<S>; LANES];

/// L with A = L L', in place of the lower triangle of A, column by column; what stands above does not matter. Whether A
/// is positive definite. The order is a multiple of four ([`padded`]).
pub(super) struct Cholesky<'a> {
    pub matrix: &'a mut [f64],
    pub order: usize,
}

/// The least multiple of four from an order on: a matrix is filled up to it with ones on the diagonal.
pub(super) fn padded(order: usize) -> usize {
    order.next_multiple_of(LANES)
}

impl WithSimd for Cholesky<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let Self { matrix, order } = self;
        let (fours, per) = (matrix.as_chunks_mut::<LANES>().0, order / LANES);
        for first in 0..per {
            let (before, rest) = fours.split_at_mut(first * LANES * per);
            let panel = &mut rest[..LANES * per];
            let [own] = take::<S, 1>(simd, panel, before, per, [first; 2]);
            let Some((own, shares)) = factor(arrays(own)) else { return false };
            put(panel, per, first, own);
            let known = (&own, &shares);
            let mut row = first + 1;
            while row + 1 < per {
                let [a, b] = take::<S, 2>(simd, panel, before, per, [first, row]);
                put(panel, per, row, solve(simd, a, known));
                put(panel, per, row + 1, solve(simd, b, known));
                row += 2;
            }
            if row < per {
                let [a] = take::<S, 1>(simd, panel, before, per, [first, row]);
                put(panel, per, row, solve(simd, a, known));
            }
        }
        true
    }
}

/// Entries of four rows and four columns.
type Entries = [[f64; LANES]; LANES];

/// Four columns of a panel at `R` times four rows, less what the columns before take away: `first` their first row, `row`
/// that of the blocks, in fours. `per`: fours of a column.
#[inline(always)]
fn take<S: Simd, const R: usize>(
    simd: S,
    panel: &[[f64; LANES]],
    before: &[[f64; LANES]],
    per: usize,
    [first, row]: [usize; 2],
) -> [Block<S>; R] {
    let mut blocks = [[Four::splat(simd, 0.0); LANES]; R];
    for (k, column) in panel.chunks_exact(per).enumerate() {
        for (block, rows) in blocks.iter_mut().zip(&column[row..]) {
            block[k] = Four::new(simd, rows);
        }
    }
    for column in before.chunks_exact(per) {
        let (weights, Some(rows)) = (&column[first], column[row..].first_chunk::<R>()) else { continue };
        for (k, weight) in weights.iter().enumerate() {
            let weight = Four::splat(simd, *weight);
            for (block, rows) in blocks.iter_mut().zip(rows) {
                block[k] = block[k].less_product(Four::new(simd, rows), weight);
            }
        }
    }
    blocks
}

/// Rows of the factor below its block on the diagonal, `own` with one over what stands on that one's diagonal.
#[inline(always)]
fn solve<S: Simd>(simd: S, [a, b, c, d]: Block<S>, (own, shares): (&Entries, &[f64; LANES])) -> Entries {
    let of = |column: usize, row: usize| Four::splat(simd, own[column][row]);
    let share = |column: usize| Four::splat(simd, shares[column]);
    let a = a * share(0);
    let b = b.less_product(a, of(0, 1)) * share(1);
    let c = c.less_product(a, of(0, 2)).less_product(b, of(1, 2)) * share(2);
    let d = d.less_product(a, of(0, 3)).less_product(b, of(1, 3)).less_product(c, of(2, 3)) * share(3);
    arrays([a, b, c, d])
}

#[inline(always)]
fn arrays<S: Simd>([a, b, c, d]: Block<S>) -> Entries {
    [a.array(), b.array(), c.array(), d.array()]
}

#[inline(always)]
fn put(panel: &mut [[f64; LANES]], per: usize, row: usize, block: Entries) {
    for (column, four) in panel.chunks_exact_mut(per).zip(block) {
        column[row] = four;
    }
}

/// Factor of four columns, and one over what stands on its diagonal.
#[inline(always)]
fn factor(mut block: Entries) -> Option<(Entries, [f64; LANES])> {
    let mut shares = [0.0; LANES];
    for j in 0..LANES {
        if block[j][j].is_nan() || block[j][j] <= 0.0 {
            return None;
        }
        let root = block[j][j].sqrt();
        shares[j] = root.recip();
        block[j][j] = root;
        block[j][j + 1..].iter_mut().for_each(|x| *x *= shares[j]);
        for k in j + 1..LANES {
            for i in k..LANES {
                block[k][i] -= block[j][i] * block[j][k];
            }
        }
    }
    Some((block, shares))
}

/// Solves L L' x = b for one right-hand side in place, L lower triangular, column by column, of the order of x.
pub(super) struct Substitution<'a> {
    pub factor: &'a [f64],
    pub x: &'a mut [f64],
}

impl WithSimd for Substitution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { factor, x } = self;
        let order = x.len();
        let panels = || factor.chunks_exact(LANES * order).zip((0..order).step_by(LANES));
        for (panel, first) in panels() {
            let [l0, l1, l2, l3] = columns(panel, order, first);
            let (own, below) = x[first..].split_at_mut(LANES);
            let a = own[0] / l0[0];
            let b = (own[1] - l0[1] * a) / l1[1];
            let c = (own[2] - (l0[2] * a + l1[2] * b)) / l2[2];
            let d = (own[3] - ((l0[3] * a + l1[3] * b) + l2[3] * c)) / l3[3];
            own.copy_from_slice(&[a, b, c, d]);
            let of = |x: f64| Four::splat(simd, x);
            let (a, b, c, d) = (of(a), of(b), of(c), of(d));
            let fours = fours(below_of(l0)).zip(fours(below_of(l1))).zip(fours(below_of(l2)).zip(fours(below_of(l3))));
            for (x, ((l0, l1), (l2, l3))) in below.as_chunks_mut::<LANES>().0.iter_mut().zip(fours) {
                let left = Four::new(simd, x).less_product(Four::new(simd, l0), a).less_product(Four::new(simd, l1), b);
                *x = left.less_product(Four::new(simd, l2), c).less_product(Four::new(simd, l3), d).array();
            }
        }
        for (panel, first) in panels().rev() {
            let [l0, l1, l2, l3] = columns(panel, order, first);
            let (own, below) = x[first..].split_at_mut(LANES);
            let zero = Four::splat(simd, 0.0);
            let (mut a, mut b, mut c, mut d) = (zero, zero, zero, zero);
            let fours_of =
                fours(below_of(l0)).zip(fours(below_of(l1))).zip(fours(below_of(l2)).zip(fours(below_of(l3))));
            for (x, ((l0, l1), (l2, l3))) in fours(below).zip(fours_of) {
                let x = Four::new(simd, x);
                (a, b) = (x.mul_add(Four::new(simd, l0), a), x.mul_add(Four::new(simd, l1), b));
                (c, d) = (x.mul_add(Four::new(simd, l2), c), x.mul_add(Four::new(simd, l3), d));
            }
            let d = (own[3] - d.sum()) / l3[3];
            let c = (own[2] - (c.sum() + l2[3] * d)) / l2[2];
            let b = (own[1] - (b.sum() + (l1[2] * c + l1[3] * d))) / l1[1];
            let a = (own[0] - (a.sum() + ((l0[1] * b + l0[2] * c) + l0[3] * d))) / l0[0];
            own.copy_from_slice(&[a, b, c, d]);
        }
    }
}

/// The four columns of a panel from its first row on.
#[inline(always)]
fn columns(panel: &[f64], order: usize, first: usize) -> [&[f64]; LANES] {
    let column = |k: usize| &panel[k * order + first..(k + 1) * order];
    [column(0), column(1), column(2), column(3)]
}

/// A column without the block on the diagonal.
#[inline(always)]
fn below_of(column: &[f64]) -> &[f64] {
    &column[LANES..]
}

#[inline(always)]
fn fours(list: &[f64]) -> std::slice::Iter<'_, [f64; LANES]> {
    list.as_chunks::<LANES>().0.iter()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::run;

    /// Factor and solution of a matrix whose solution is known, of orders that fill their blocks and of some that do not;
    /// plain instructions give the same bits as the processor's own.
    #[test]
    fn solutions_are_those_of_the_matrix() {
        for m in [1usize, 3, 4, 9, 52] {
            let order = padded(m);
            let entry = |i: usize, j: usize| 1.0 / (1.0 + (i as f64 - j as f64).abs()) + if i == j { 0.5 } else { 0.0 };
            let wanted: Vec<f64> = (0..order).map(|i| if i < m { (i as f64).cos() } else { 0.0 }).collect();
            let mut factor = vec![0.0; order * order];
            for j in 0..order {
                for i in j..order {
                    factor[j * order + i] = if i < m { entry(i, j) } else { f64::from(u8::from(i == j)) };
                }
            }
            let mut x: Vec<f64> =
                (0..order).map(|i| if i < m { (0..m).map(|j| entry(i, j) * wanted[j]).sum() } else { 0.0 }).collect();
            let (mut plain, mut plain_x) = (factor.clone(), x.clone());
            assert!(run(pulp::Arch::new(), Cholesky { matrix: &mut factor, order }));
            run(pulp::Arch::new(), Substitution { factor: &factor, x: &mut x });
            assert!(run(pulp::Arch::Scalar, Cholesky { matrix: &mut plain, order }));
            run(pulp::Arch::Scalar, Substitution { factor: &plain, x: &mut plain_x });
            assert_eq!((&factor, &x), (&plain, &plain_x), "order {m}: other bits on another machine");
            for (found, wanted) in x.iter().zip(&wanted) {
                assert!((found - wanted).abs() < 1e-13, "order {m}: {found}, not {wanted}");
            }
            factor.fill(-1.0);
            assert!(!run(pulp::Arch::new(), Cholesky { matrix: &mut factor, order }), "not positive definite");
        }
    }
}
