//! Pressures on the bore of a gear: what they move there, and on its flanks.

use faer::Mat;
use mesh::BoreGrid;

use super::{GearReducer, Method};
use crate::{ReductionError, Window};

impl GearReducer {
    /// Grid of pressures over the bore of the whole gear, with at least so many stations around, equally many in each
    /// pitch, and so many heights.
    ///
    /// # Errors
    /// [`ReductionError::NoBorePressures`] for a bore that is not held by its means; those of a gear that cannot be
    /// condensed again.
    pub fn bore_grid(&self, stations: usize, heights: usize) -> Result<BoreGrid, ReductionError> {
        self.general_way()?;
        let z = self.gear.tooth_count() as usize;
        Ok(BoreGrid::new(&self.gear, z * stations.div_ceil(z), heights))
    }

    /// Openings of the bore along pressures of a grid by others of them, the gear held by the means of its bore.
    ///
    /// ```text
    /// U = L' P K~^-1 P' L      L: nodal forces of unit pressures, N/MPa
    /// ```
    /// U: mm N/MPa per MPa; symmetric to round-off. Theory (13e).
    ///
    /// # Errors
    /// As of [`GearReducer::bore_grid`].
    pub fn bore_compliance(&self, grid: &BoreGrid) -> Result<Mat<f64>, ReductionError> {
        let general = self.general_way()?;
        let loads = general.forces_on(&grid.loads);
        let found = general.between(&loads, &loads)?;
        Ok(Mat::from_fn(found.nrows(), found.ncols(), |i, j| 0.5 * (found[(i, j)] + found[(j, i)])))
    }

    /// Displacements of a window's coordinates (mm, in the frame of its matrices) under unit pressures (MPa) of a grid, 3n x
    /// k.
    ///
    /// # Errors
    /// As of [`GearReducer::bore_grid`].
    pub fn flanks_under_bore(&self, window: &Window, grid: &BoreGrid) -> Result<Mat<f64>, ReductionError> {
        let general = self.general_way()?;
        let axis = |k: usize| std::array::from_fn(|i| f64::from(u8::from(i == k)));
        let along = |load: &crate::load::Load, k: usize| {
            let unit: [f64; 3] = axis(k);
            load.iter().map(|&(node, share)| (node, unit.map(|x| share * x))).collect::<Vec<_>>()
        };
        let own: Vec<Vec<(u32, [f64; 3])>> =
            self.material_loads(window)?.iter().flat_map(|load| (0..3).map(move |k| along(load, k))).collect();
        let mut found = general.between(&general.forces_on(&own), &general.forces_on(&grid.loads))?;
        // From the gear's own frame into that of the matrices.
        let (sin, cos) = (-self.frame_angle(window)).sin_cos();
        for mut column in found.col_iter_mut() {
            for i in (0..column.nrows()).step_by(3) {
                let (x, y) = (column[i], column[i + 1]);
                column[i] = cos * x - sin * y;
                column[i + 1] = sin * x + cos * y;
            }
        }
        Ok(found)
    }

    /// The factor of a gear that is held by the means of its bore.
    fn general_way(&self) -> Result<&crate::general::GeneralGear, ReductionError> {
        match self.method()? {
            Method::General(general, _) if self.gear.bore_coupling() == mesh::BoreCoupling::Distributing => Ok(general),
            Method::General(..) | Method::Cyclic(_) => {
                Err(ReductionError::NoBorePressures { coupling: self.gear.bore_coupling().name() })
            }
        }
    }
}
