//! Flanks of one gear that stand apart, or on other sides of its teeth. Theory (12a).

use std::collections::{BTreeMap, BTreeSet};

use faer::Mat;
use fem::dense;

use super::{CyclicGear, turned};
use crate::ReductionError;

/// A coordinate node of a window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spot {
    /// Copy of the sector.
    pub copy: u32,
    /// Load of the sector.
    pub load: usize,
    /// Angle of the frame of the copy in that of the window, rad.
    pub angle: f64,
}

impl CyclicGear {
    /// Displacements (mm) of the coordinates of a window that is turned by so many pitches under unit forces (N) on those
    /// of a window of another reduction of the same gear, each window in its own frame, mm/N, 3n x 3m.
    ///
    /// # Errors
    /// [`ReductionError::OtherReduction`] where its sector is another one.
    pub(crate) fn between(&self, other: &Self, [own, theirs]: [u32; 2]) -> Result<Mat<f64>, ReductionError> {
        self.between_spots(other, [&self.spots(own), &other.spots(theirs)])
    }

    /// The same between any coordinates of both.
    pub(super) fn between_spots(&self, other: &Self, [own, theirs]: [&[Spot]; 2]) -> Result<Mat<f64>, ReductionError> {
        if !self.has_sector_of(other) || self.material != other.material || self.elements != other.elements {
            return Err(ReductionError::OtherReduction);
        }
        let [rows, columns] = [own, theirs].map(by_copy);
        let pairs = || rows.iter().flat_map(|p| columns.iter().map(move |q| (p, q)));
        let blocks = self.blocks_under(other, pairs().map(|(p, q)| self.apart(q.copy, p.copy)))?;
        let mut all = Mat::<f64>::zeros(3 * own.len(), 3 * theirs.len());
        for (p, q) in pairs() {
            let Some(block) = blocks.get(&self.apart(q.copy, p.copy)) else { continue };
            let block = turned(block, [p.angle, q.angle]);
            for (&(i, at), &(j, load)) in p.nodes.iter().flat_map(|x| q.nodes.iter().map(move |y| (x, y))) {
                let part = block.as_ref().submatrix(3 * at, 3 * load, 3, 3);
                all.as_mut().submatrix_mut(3 * i, 3 * j, 3, 3).copy_from(part);
            }
        }
        Ok(all)
    }

    /// Coordinates of the window that stands so many pitches on, in its own frame.
    fn spots(&self, shift: u32) -> Vec<Spot> {
        let z = self.part.teeth;
        let spot = |&(copy, load): &(u32, usize)| Spot { copy: (copy + shift) % z, load, angle: self.angle(copy) };
        self.coordinates.iter().map(spot).collect()
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

/// Coordinate nodes on one copy.
pub(super) struct OnCopy {
    pub copy: u32,
    pub angle: f64,
    /// Number of each and its load.
    pub nodes: Vec<(usize, usize)>,
}

/// Coordinate nodes copy by copy.
pub(super) fn by_copy(spots: &[Spot]) -> Vec<OnCopy> {
    let copies: BTreeSet<u32> = spots.iter().map(|spot| spot.copy).collect();
    let of = |copy: u32| {
        let own = || spots.iter().enumerate().filter(move |(_, spot)| spot.copy == copy);
        let angle = own().next().map_or(0.0, |(_, spot)| spot.angle);
        OnCopy { copy, angle, nodes: own().map(|(i, spot)| (i, spot.load)).collect() }
    };
    copies.into_iter().map(of).collect()
}
