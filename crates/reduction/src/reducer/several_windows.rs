//! Several windows of one gear together: a force on the flanks of one moves those of all others.

use faer::Mat;

use super::{GearReducer, Method};
use crate::{ReductionError, Window, cyclic::turned, load::Load};

impl GearReducer {
    /// Displacements (mm) of a window's coordinates under unit forces (N) on those of a window of `other`, which is this
    /// gear or another reduction of it; each window in the frame of its own matrices, mm/N, 3n x 3m.
    ///
    /// ```text
    /// C_ij = R_i B_d R_j',   d = (t_i + s_i) - (t_j + s_j) mod z      t: tooth in the frame of the matrices, s: shift
    /// ```
    /// A cyclic gear has the blocks B_d of all distances: a window is a set of teeth among them, wherever it stands, and a
    /// change of teeth other distances. Of any other gear they are solves with its factor. Windows may have teeth in
    /// common. Theory (12a).
    ///
    /// # Errors
    /// [`ReductionError::OtherReduction`] of gears that differ in mesh, material, bore or way; [`ReductionError`] of a gear
    /// that is condensed by its layers, and where a window has no flank.
    pub fn compliance_between(
        &self,
        window: &Window,
        (other, theirs): (&Self, &Window),
    ) -> Result<Mat<f64>, ReductionError> {
        if let (Some(own), Some(another)) = (self.bolted()?, other.bolted()?) {
            return own.between(&self.loads(window)?, (another, &other.loads(theirs)?));
        }
        match (self.method()?, other.method()?) {
            (Method::Cyclic(own), Method::Cyclic(another)) => own.between(another, [window.shift, theirs.shift]),
            (Method::General(general, _), Method::General(..)) if self.is_meshed_as(other) => {
                let loads = [self.material_loads(window)?, other.material_loads(theirs)?];
                let found = general.compliance_between(&loads[0], &loads[1], &|| true)?;
                // From the gear's own frame into those of the matrices.
                Ok(turned(&found, [-self.frame_angle(window), -other.frame_angle(theirs)]))
            }
            _ => Err(ReductionError::OtherReduction),
        }
    }

    /// C of several windows of one gear, each of some reduction of it, mm/N: their coordinates one after the other, each in
    /// the frame of its own matrices; symmetric. The blocks on the diagonal are [`crate::ReducedGear::compliance`] of each
    /// window, the others [`GearReducer::compliance_between`].
    ///
    /// # Errors
    /// As [`GearReducer::compliance_between`].
    pub fn compliance_of(windows: &[(&Self, &Window)]) -> Result<Mat<f64>, ReductionError> {
        let sizes: Vec<usize> = windows.iter().map(|(_, window)| window.reduced.coordinates()).collect();
        let starts: Vec<usize> = sizes.iter().scan(0, |at, n| Some(std::mem::replace(at, *at + n))).collect();
        let n = sizes.iter().sum();
        let mut all = Mat::<f64>::zeros(n, n);
        for (b, &(other, theirs)) in windows.iter().enumerate() {
            let own = theirs.reduced.compliance();
            if own.ncols() < own.nrows() {
                other.method()?;
            }
            all.as_mut().submatrix_mut(starts[b], starts[b], sizes[b], sizes[b]).copy_from(own);
            for (a, &(reducer, window)) in windows.iter().enumerate().skip(b + 1) {
                let block = reducer.compliance_between(window, (other, theirs))?;
                all.as_mut().submatrix_mut(starts[a], starts[b], sizes[a], sizes[b]).copy_from(&block);
                all.as_mut().submatrix_mut(starts[b], starts[a], sizes[b], sizes[a]).copy_from(block.transpose());
            }
        }
        Ok(all)
    }

    /// Whether another reduction is of the same mesh, held in the same way, of the same material.
    fn is_meshed_as(&self, other: &Self) -> bool {
        let [a, b] = [&self.gear, &other.gear];
        (self.material, self.options.elements) == (other.material, other.options.elements)
            && a.bore_coupling() == b.bore_coupling()
            && a.bore() == b.bore()
            && a.held_nodes() == b.held_nodes()
            && a.mesh() == b.mesh()
    }

    /// Unit loads of a window's coordinates where they stand on the mesh of a whole gear, along its own axes.
    pub(super) fn material_loads(&self, window: &Window) -> Result<Vec<Load>, ReductionError> {
        let on = |(node, weight): &(u32, f64)| (self.material_node(window, *node), *weight);
        Ok(self.loads(window)?.iter().map(|load| load.iter().map(on).collect()).collect())
    }
}
