//! Openings of rows by forces.

use faer::MatRef;
use pulp::{Simd, WithSimd};

use crate::lanes::{Four, LANES};

/// S F of the forces on the active rows, mm: openings of all rows, into `out`.
pub(super) struct Opening<'a> {
    pub compliance: MatRef<'a, f64>,
    pub active: &'a [usize],
    pub forces: &'a [f64],
    pub out: &'a mut [f64],
}

impl WithSimd for Opening<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { compliance, active, forces, out } = self;
        out.fill(0.0);
        for &i in active {
            let (force, column) = (forces[i], compliance.col(i));
            let Some(column) = column.try_as_col_major().map(|c| c.as_slice()) else {
                out.iter_mut().zip(column.iter()).for_each(|(o, c)| *o += c * force);
                continue;
            };
            let of_row = Four::splat(simd, force);
            let (fours, rest) = out.as_chunks_mut::<LANES>();
            let (columns, last) = column.as_chunks::<LANES>();
            for (o, c) in fours.iter_mut().zip(columns) {
                *o = of_row.mul_add(Four::new(simd, c), Four::new(simd, o)).array();
            }
            rest.iter_mut().zip(last).for_each(|(o, c)| *o = c.mul_add(force, *o));
        }
    }
}
