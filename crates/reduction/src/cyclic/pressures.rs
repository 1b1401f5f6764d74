//! Pressures on the bore of a cyclic gear, sector by sector. Theory (13e).

use faer::Mat;
use fem::dense;
use mesh::BoreGrid;
use nalgebra::{Rotation3, Vector3, Vector6};

use super::{CyclicGear, SectorLoads, sector::UnderForces};
use crate::{ReductionError, turned_rows::turn_rows};

/// Parts of a grid's pressures on one sector.
struct OnSector {
    /// Station and height of each, and of none others.
    places: Vec<[usize; 2]>,
    under: UnderForces,
}

impl CyclicGear {
    /// A grid over some sectors, as that over all of them: with the resultants of all its pressures.
    pub(crate) fn whole_grid(&self, seen: BoreGrid) -> BoreGrid {
        let faces = self.part.seat.as_deref().unwrap_or_default();
        let own = BoreGrid::new(&self.part.mesh, faces, seen.stations, seen.heights);
        let mut resultants = vec![Vector6::zeros(); seen.count()];
        for copy in 0..self.part.teeth {
            let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), self.angle(copy));
            for (at, resultant) in own.resultants.iter().enumerate().filter(|own| own.1.amax() > 0.0) {
                let [force, moment] =
                    [0, 3].map(|k| turn * Vector3::new(resultant[k], resultant[k + 1], resultant[k + 2]));
                let place = [at / own.heights, at % own.heights];
                resultants[self.on_gear(&seen, place, copy)] +=
                    Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
            }
        }
        BoreGrid { resultants, radius: own.radius, ends: own.ends, ..seen }
    }

    /// U of all pressures of a grid, k x k.
    pub(crate) fn under_pressures(&self, grid: &BoreGrid) -> Result<Mat<f64>, ReductionError> {
        let own = self.on_sector(grid)?;
        let z = self.part.teeth;
        let loads = own.loads();
        let mut all = Mat::<f64>::zeros(grid.count(), grid.count());
        for (d, ends) in self.ends_under(&loads, 0..z) {
            let mut block = dense::product(own.under.ends.transpose(), ends.as_ref());
            if d == 0 {
                block += &own.under.own;
            }
            for from in 0..z {
                let to = (from + d) % z;
                let [rows, columns] = [to, from].map(|copy| own.numbers(self, grid, copy));
                for (j, &column) in columns.iter().enumerate() {
                    for (i, &row) in rows.iter().enumerate() {
                        all[(row, column)] += block[(i, j)];
                    }
                }
            }
        }
        Ok(all)
    }

    /// Displacements of the coordinates (mm, in the frame of copy 0) of the window that stands `shift` pitches on, in its own frame,
    /// under unit pressures, 3n x k.
    pub(crate) fn flanks_under_pressures(&self, grid: &BoreGrid, shift: u32) -> Result<Mat<f64>, ReductionError> {
        let own = self.on_sector(grid)?;
        let z = self.part.teeth;
        let loads = own.loads();
        let mut all = Mat::<f64>::zeros(3 * self.coordinates.len(), grid.count());
        for (d, ends) in self.ends_under(&loads, 0..z) {
            let mut block = dense::product(self.sector.transfer.transpose(), ends.as_ref());
            if d == 0 {
                block += &own.under.on_loads;
            }
            for to in self.loaded() {
                // In the frame of the window the bore stands back.
                let from = (to + shift + z - d) % z;
                let numbers = own.numbers(self, grid, from);
                let mut turned = block.clone();
                turn_rows(&mut turned, self.angle(to));
                for (i, at) in self.on_copy(to) {
                    for (j, &column) in numbers.iter().enumerate() {
                        (0..3).for_each(|k| all[(3 * i + k, column)] += turned[(3 * at + k, j)]);
                    }
                }
            }
        }
        Ok(all)
    }

    fn on_sector(&self, grid: &BoreGrid) -> Result<OnSector, ReductionError> {
        let faces = self.part.seat.as_deref().unwrap_or_default();
        let own = BoreGrid::new(&self.part.mesh, faces, grid.stations, grid.heights);
        let loaded: Vec<usize> = (0..own.count()).filter(|&at| !own.loads[at].is_empty()).collect();
        let mut forces = Mat::<f64>::zeros(self.sector.dofs.free_count(), loaded.len());
        for (column, &at) in loaded.iter().enumerate() {
            for (node, force) in &own.loads[at] {
                for (axis, part) in force.iter().enumerate() {
                    if let Some(row) = self.sector.dofs.dof(*node, axis) {
                        forces[(row, column)] += part;
                    }
                }
            }
        }
        let places = loaded.into_iter().map(|at| [at / own.heights, at % own.heights]).collect();
        Ok(OnSector { places, under: self.sector.under_forces(forces.as_ref())? })
    }

    /// Number among the grid's of a pressure on a copy of the sector.
    fn on_gear(&self, grid: &BoreGrid, [station, height]: [usize; 2], copy: u32) -> usize {
        let (all, pitch) = (grid.stations as i64, (grid.stations / self.part.teeth as usize) as i64);
        let station = (station as i64 + self.part.way as i64 * pitch * i64::from(copy)).rem_euclid(all);
        station as usize * grid.heights + height
    }
}

impl OnSector {
    fn loads(&self) -> SectorLoads {
        SectorLoads { ends: self.under.ends.clone(), resultants: self.under.resultants.clone() }
    }

    /// Numbers of its pressures on a copy of the sector.
    fn numbers(&self, gear: &CyclicGear, grid: &BoreGrid, copy: u32) -> Vec<usize> {
        self.places.iter().map(|&place| gear.on_gear(grid, place, copy)).collect()
    }
}
