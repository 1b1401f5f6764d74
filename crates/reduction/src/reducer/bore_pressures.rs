//! Pressures on the bore of a gear: what they move there, and on its flanks.

use faer::Mat;
use mesh::{BoreCoupling, BoreGrid};

use super::{GearReducer, Method};
use crate::{ReductionError, Window, load::Load, turned_rows::turn_rows};

/// Forces (N) on nodes.
pub(super) type NodalForces = Vec<(u32, [f64; 3])>;

impl GearReducer {
    /// Grid of pressures over the bore of the whole gear, with at least so many stations around, equally many in each
    /// pitch, and so many heights. Its `loads` are on nodes of [`GearReducer::gear`]: those of a gear that is one sector are
    /// whole in the sectors of that mesh alone.
    ///
    /// # Errors
    /// [`ReductionError::NoBorePressures`] for a bore that is not held by its means; those of a gear that cannot be
    /// condensed again.
    pub fn bore_grid(&self, stations: usize, heights: usize) -> Result<BoreGrid, ReductionError> {
        let method = self.free_method()?;
        let z = self.gear.tooth_count() as usize;
        let stations = z * stations.div_ceil(z);
        let own = BoreGrid::new(self.gear.mesh(), &self.gear.bore().faces, stations, heights);
        Ok(match method {
            Method::Cyclic(cyclic) => cyclic.whole_grid(own),
            Method::General(..) => own,
        })
    }

    /// Openings of the bore along pressures of a grid by others of them, the gear held by the means of its bore.
    ///
    /// ```text
    /// U = L' P K~^-1 P' L      L: nodal forces of unit pressures, N/MPa
    /// ```
    /// U: mm N/MPa per MPa; symmetric to the bit. Theory (13e).
    ///
    /// # Errors
    /// As of [`GearReducer::bore_grid`].
    pub fn bore_compliance(&self, grid: &BoreGrid) -> Result<Mat<f64>, ReductionError> {
        let found = match self.free_method()? {
            Method::Cyclic(cyclic) => cyclic.under_pressures(grid)?,
            Method::General(general, _) => {
                let loads = general.forces_on(&grid.loads);
                general.between(&loads, &loads)?
            }
        };
        Ok(Mat::from_fn(found.nrows(), found.ncols(), |i, j| 0.5 * (found[(i, j)] + found[(j, i)])))
    }

    /// Displacements of a window's coordinates (mm, in the frame of its matrices) under unit pressures (MPa) of a grid, 3n x
    /// k.
    ///
    /// # Errors
    /// As of [`GearReducer::bore_grid`].
    pub fn flanks_under_bore(&self, window: &Window, grid: &BoreGrid) -> Result<Mat<f64>, ReductionError> {
        let general = match self.free_method()? {
            Method::Cyclic(cyclic) => return cyclic.flanks_under_pressures(grid, window.shift),
            Method::General(general, _) => general,
        };
        let own = self.coordinate_forces(window)?;
        let mut found = general.between(&general.forces_on(&own), &general.forces_on(&grid.loads))?;
        // From the gear's own frame into that of the matrices.
        turn_rows(&mut found, -self.frame_angle(window));
        Ok(found)
    }

    /// Unit forces on the coordinates of a window along the gear's own axes, on nodes of the mesh.
    pub(super) fn coordinate_forces(&self, window: &Window) -> Result<Vec<NodalForces>, ReductionError> {
        let along = |load: &Load, k: usize| {
            let on = |&(node, share): &(u32, f64)| {
                let mut force = [0.0; 3];
                force[k] = share;
                (node, force)
            };
            load.iter().map(on).collect::<Vec<_>>()
        };
        Ok(self.material_loads(window)?.iter().flat_map(|load| (0..3).map(move |k| along(load, k))).collect())
    }

    /// The method of a gear that is held by the means of its bore.
    fn free_method(&self) -> Result<&Method, ReductionError> {
        match self.gear.bore_coupling() {
            BoreCoupling::Distributing => self.method(),
            coupling => Err(ReductionError::NoBorePressures { coupling: coupling.name() }),
        }
    }
}
