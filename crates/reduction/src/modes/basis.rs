//! Vectors that are orthonormal with respect to the mass matrix.

use faer::{Mat, MatRef};
use fem::dense;

use super::pencil::Pencil;
use crate::ReductionError;

/// V with V' M V = 1, block by block.
#[derive(Default)]
pub(super) struct Basis {
    blocks: Vec<Mat<f64>>,
    /// M V.
    inertia: Vec<Mat<f64>>,
    size: usize,
}

/// Length, relative to what it was, below which a vector that was made orthogonal is round-off.
const DEPENDENT: f64 = 1e-11;

impl Basis {
    /// Number of vectors.
    pub fn size(&self) -> usize {
        self.size
    }

    /// M times the vectors that were appended last.
    pub fn inertia_of_last(&self) -> MatRef<'_, f64> {
        self.inertia.last().map_or(MatRef::from_column_major_slice(&[], 0, 0), |m| m.as_ref())
    }

    /// V' M x.
    pub fn products(&self, x: MatRef<'_, f64>) -> Mat<f64> {
        let mut all = Mat::zeros(self.size, x.ncols());
        let mut start = 0;
        for block in &self.inertia {
            let own = dense::product(block.transpose(), x);
            all.as_mut().subrows_mut(start, block.ncols()).copy_from(own);
            start += block.ncols();
        }
        all
    }

    /// V s for the first vectors, as many as `s` has rows.
    pub fn combined(&self, s: MatRef<'_, f64>) -> Mat<f64> {
        let rows = self.blocks.first().map_or(0, |b| b.nrows());
        let mut sum = Mat::zeros(rows, s.ncols());
        let mut start = 0;
        for block in self.blocks.iter().take_while(|b| b.ncols() > 0) {
            if start >= s.nrows() {
                break;
            }
            sum += dense::product(block.as_ref(), s.subrows(start, block.ncols()));
            start += block.ncols();
        }
        sum
    }

    /// Appends the components of the columns of `x` that are not yet spanned; returns the number of vectors appended.
    pub fn append(&mut self, pencil: &dyn Pencil, mut x: Mat<f64>) -> Result<usize, ReductionError> {
        let mut inertia = pencil.inertia(x.as_ref())?;
        let norm = |x: &Mat<f64>, m: &Mat<f64>, j: usize| (x.col(j).transpose() * m.col(j)).max(0.0).sqrt();
        let scale: Vec<f64> = (0..x.ncols()).map(|j| norm(&x, &inertia, j)).collect();
        for (j, &length) in scale.iter().enumerate() {
            let by = if length > 0.0 { 1.0 / length } else { 0.0 };
            x.as_mut().col_mut(j).iter_mut().for_each(|v| *v *= by);
            inertia.as_mut().col_mut(j).iter_mut().for_each(|v| *v *= by);
        }
        // Once is not enough where a block lies almost within the span; after the second time nothing but round-off can
        // be left.
        for least in [DEPENDENT * DEPENDENT, 0.25] {
            for (block, of_block) in self.blocks.iter().zip(&self.inertia) {
                let share = dense::product(of_block.transpose(), x.as_ref());
                x -= dense::product(block.as_ref(), share.as_ref());
                inertia -= dense::product(of_block.as_ref(), share.as_ref());
            }
            let (values, vectors) = dense::symmetric_eigen(dense::product(x.transpose(), inertia.as_ref()).as_ref())?;
            let kept: Vec<usize> = (0..values.len()).rev().filter(|&j| values[j] > least).collect();
            let turn = Mat::from_fn(x.ncols(), kept.len(), |i, j| vectors[(i, kept[j])] / values[kept[j]].sqrt());
            x = dense::product(x.as_ref(), turn.as_ref());
            // Anew: differences of large numbers would spoil it.
            inertia = pencil.inertia(x.as_ref())?;
        }
        let added = x.ncols();
        if added > 0 {
            self.size += added;
            self.blocks.push(x);
            self.inertia.push(inertia);
        }
        Ok(added)
    }
}
