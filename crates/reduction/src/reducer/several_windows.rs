//! Several windows of one gear in one reduction: a force on the flanks of one moves those of all others.

use faer::Mat;

use super::{GearReducer, Method};
use crate::{ReductionError, Window, cyclic::turned, load::Load};

impl GearReducer {
    /// C of several windows of the gear together, mm/N: their coordinates one after the other, each in the frame of its own
    /// matrices; symmetric.
    ///
    /// ```text
    /// C_ij = R_i B_d R_j',   d = (t_i + s_i) - (t_j + s_j) mod z      t: tooth in the frame of the matrices, s: shift
    /// ```
    /// A cyclic gear has the blocks B_d of all distances: a window is a set of teeth among them, wherever it stands, and a
    /// change of teeth other distances. Of any other gear they are solves with its factor. Windows may have teeth in
    /// common. The blocks on the diagonal are [`crate::ReducedGear::compliance`] of each window. Theory (12a).
    ///
    /// # Errors
    /// [`ReductionError`] of a gear that is condensed by its layers, and where a window has no flank.
    pub fn compliance_of(&self, windows: &[&Window]) -> Result<Mat<f64>, ReductionError> {
        let sizes: Vec<usize> = windows.iter().map(|window| window.reduced.coordinates()).collect();
        let starts: Vec<usize> = sizes.iter().scan(0, |at, n| Some(std::mem::replace(at, *at + n))).collect();
        let n = sizes.iter().sum();
        let mut all = Mat::<f64>::zeros(n, n);
        let pairs = || (0..windows.len()).flat_map(|b| (b + 1..windows.len()).map(move |a| (a, b)));
        let between = self.between(windows, &pairs().collect::<Vec<_>>())?;
        for ((a, b), block) in pairs().zip(between) {
            all.as_mut().submatrix_mut(starts[a], starts[b], sizes[a], sizes[b]).copy_from(&block);
            all.as_mut().submatrix_mut(starts[b], starts[a], sizes[b], sizes[a]).copy_from(block.transpose());
        }
        for (window, (&at, &size)) in windows.iter().zip(starts.iter().zip(&sizes)) {
            let own = window.reduced.compliance();
            if own.ncols() < own.nrows() {
                self.method()?;
            }
            all.as_mut().submatrix_mut(at, at, size, size).copy_from(own);
        }
        Ok(all)
    }

    /// Displacements of the first window of each pair under unit forces on the second one.
    fn between(&self, windows: &[&Window], pairs: &[(usize, usize)]) -> Result<Vec<Mat<f64>>, ReductionError> {
        match self.method()? {
            Method::Cyclic(cyclic) => {
                let shifts: Vec<u32> = windows.iter().map(|window| window.shift).collect();
                let blocks = cyclic.blocks_between(pairs.iter().map(|&(a, b)| [shifts[a], shifts[b]]));
                Ok(pairs.iter().map(|&(a, b)| cyclic.between([shifts[a], shifts[b]], &blocks)).collect())
            }
            Method::General(general, _) => {
                let loads: Vec<Vec<Load>> =
                    windows.iter().map(|window| self.material_loads(window)).collect::<Result<_, _>>()?;
                let block = |&(a, b): &(usize, usize)| {
                    let found = general.compliance_between(&loads[a], &loads[b], &|| true)?;
                    // From the gear's own frame into those of the matrices.
                    Ok(turned(&found, [a, b].map(|i| -self.frame_angle(windows[i]))))
                };
                pairs.iter().map(block).collect()
            }
        }
    }

    /// Unit loads of a window's coordinates where they stand on the mesh of a whole gear, along its own axes.
    fn material_loads(&self, window: &Window) -> Result<Vec<Load>, ReductionError> {
        let on = |(node, weight): &(u32, f64)| (self.material_node(window, *node), *weight);
        Ok(self.loads(window)?.iter().map(|load| load.iter().map(on).collect()).collect())
    }
}
