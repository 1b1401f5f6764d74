//! Flanks of one gear that stand apart, or on other sides of its teeth. Theory (12a).

use std::collections::BTreeMap;

use faer::Mat;
use fem::dense;

use super::{CyclicGear, turned};
use crate::ReductionError;

impl CyclicGear {
    /// Displacements (mm) of the coordinates of a window that is turned by so many pitches under unit forces (N) on those
    /// of a window of another reduction of the same gear, each window in its own frame, mm/N, 3n x 3m.
    ///
    /// # Errors
    /// [`ReductionError::OtherReduction`] where its sector is another one.
    pub(crate) fn between(&self, other: &Self, [own, theirs]: [u32; 2]) -> Result<Mat<f64>, ReductionError> {
        if !self.has_sector_of(other) || self.material != other.material || self.elements != other.elements {
            return Err(ReductionError::OtherReduction);
        }
        let pairs = || self.loaded().flat_map(|p| other.loaded().map(move |q| (p, q)));
        let distance = |(p, q): (u32, u32)| self.apart(q + theirs, p + own);
        let blocks = self.blocks_under(other, pairs().map(distance))?;
        let mut all = Mat::<f64>::zeros(3 * self.coordinates.len(), 3 * other.coordinates.len());
        for (p, q) in pairs() {
            let Some(block) = blocks.get(&distance((p, q))) else { continue };
            let block = turned(block, [self.angle(p), self.angle(q)]);
            for ((i, at), (j, load)) in self.on_copy(p).flat_map(|x| other.on_copy(q).map(move |y| (x, y))) {
                let part = block.as_ref().submatrix(3 * at, 3 * load, 3, 3);
                all.as_mut().submatrix_mut(3 * i, 3 * j, 3, 3).copy_from(part);
            }
        }
        Ok(all)
    }

    /// B_d at some distances d (below z, in sectors): displacements under this one's loads of the d-th sector on, in its
    /// frame, by unit loads of the other one on one in its own, mm/N, 3m x 3n each.
    ///
    /// ```text
    /// B_d = H' u_c(d) + delta_d0 A
    /// ```
    fn blocks_under(
        &self,
        other: &Self,
        distances: impl Iterator<Item = u32>,
    ) -> Result<BTreeMap<u32, Mat<f64>>, ReductionError> {
        let unit = Mat::<f64>::identity(other.sector.loads(), other.sector.loads());
        let block = |(d, ends): (u32, Mat<f64>)| {
            let through = dense::product(self.sector.transfer.transpose(), ends.as_ref());
            Ok((d, if d == 0 { through + self.sector.under(&other.sector)? } else { through }))
        };
        other.ends_about(unit.as_ref(), distances).into_iter().map(block).collect()
    }

    /// Coordinates on a copy: number and load.
    pub(super) fn on_copy(&self, copy: u32) -> impl Iterator<Item = (usize, usize)> + Clone + '_ {
        let own = self.coordinates.iter().enumerate().filter(move |(_, place)| place.0 == copy);
        own.map(|(i, place)| (i, place.1))
    }
}
