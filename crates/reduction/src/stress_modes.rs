//! Stress modes: stress at chosen nodes directly from a window's boundary coordinates. Theory (22a), (22b), (22c).

use std::sync::Arc;

use faer::{Mat, MatRef};
use fem::dense;
use mesh::Face;

use crate::{GearReducer, ReducedGear, ReductionError, Window, cyclic::SectorStress, stress_recovery::StressRecovery};

/// Stress at several nodes of a gear as a linear map of a window's boundary coordinates.
///
/// ```text
/// sigma = S u_B,   S = D B T,   T = [I; Phi_IC]
/// ```
/// | name      | shape       | unit   | meaning                                                             |
/// |-----------|-------------|--------|---------------------------------------------------------------------|
/// | `D B`     | 6 m x n     | MPa/mm | nodal stress of the whole mesh: extrapolated from Gauss points, then |
/// |           |             |        | the mean over the elements of the node ([`fem::StressOperator`])     |
/// | S         | 6 m x n_B   | MPa/mm | row 6 i + k: component k (xx, yy, zz, xy, yz, zx) at node i          |
///
/// Exact for loads on the boundary, as T is. Components are in the frame of the window's matrices; principal and
/// equivalent stresses do not depend on the frame. Source of T: Craig and Bampton, AIAA J. 6(7), 1968.
#[derive(Debug, Clone)]
pub struct StressModes {
    nodes: Vec<u32>,
    known: KnownStress,
    reduced: Arc<ReducedGear>,
}

/// What the stress at some nodes (6 rows each) is known by.
#[derive(Debug, Clone)]
pub(crate) enum KnownStress {
    /// S, MPa/mm, as read off a factor whose last rows are the window's.
    Displacements(Mat<f64>),
    /// S C, MPa/N, by unit forces on the coordinates: S itself takes the inverse of C, which nobody may ask for.
    Forces(Mat<f64>),
    /// S C of a cyclic gear, by its sectors.
    Sectors(SectorStress),
}

impl StressModes {
    /// The nodes in the order requested, as numbers of the mesh in the frame of the window's matrices.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// Stress modes S, MPa/mm.
    ///
    /// # Errors
    /// [`ReductionError::NotPositiveDefinite`] as for [`GearReducer::expand`].
    pub fn matrix(&self) -> Result<Mat<f64>, ReductionError> {
        match &self.known {
            KnownStress::Displacements(modes) => Ok(modes.clone()),
            // From stress of unit forces to that of unit displacements: the forces that these take are K^.
            KnownStress::Forces(modes) => self.by_displacements(modes),
            KnownStress::Sectors(sectors) => self.by_displacements(&sectors.matrix()?),
        }
    }

    fn by_displacements(&self, by_forces: &Mat<f64>) -> Result<Mat<f64>, ReductionError> {
        let stiffness = self.reduced.stiffness().ok_or_else(|| self.singular())?;
        Ok(dense::product(by_forces.as_ref(), stiffness.as_ref()))
    }

    /// Stress (MPa) at each node from boundary coordinates `u` (mm).
    ///
    /// # Errors
    /// [`ReductionError::WrongLength`]; [`ReductionError::NotPositiveDefinite`] as for [`GearReducer::expand`].
    pub fn stress(&self, u: &[f64]) -> Result<Vec<[f64; 6]>, ReductionError> {
        self.check_length(u)?;
        match &self.known {
            KnownStress::Displacements(modes) => Ok(applied(modes, u)),
            KnownStress::Forces(modes) => Ok(applied(modes, &self.reduced.forces(u).ok_or_else(|| self.singular())?)),
            KnownStress::Sectors(sectors) => {
                by_sectors(sectors, &self.reduced.forces(u).ok_or_else(|| self.singular())?)
            }
        }
    }

    /// Stress (MPa) at each node under `forces` on the boundary coordinates (N), which cause the displacements C f.
    ///
    /// # Errors
    /// [`ReductionError::WrongLength`].
    pub fn stress_under(&self, forces: &[f64]) -> Result<Vec<[f64; 6]>, ReductionError> {
        self.check_length(forces)?;
        match &self.known {
            KnownStress::Forces(modes) => Ok(applied(modes, forces)),
            KnownStress::Sectors(sectors) => by_sectors(sectors, forces),
            KnownStress::Displacements(modes) => {
                let forces = MatRef::from_column_major_slice(forces, forces.len(), 1);
                let moved = dense::product(self.reduced.compliance().as_ref(), forces);
                Ok(applied(modes, moved.col_as_slice(0)))
            }
        }
    }

    fn check_length(&self, given: &[f64]) -> Result<(), ReductionError> {
        let (given, wanted) = (given.len(), self.reduced.coordinates());
        if given == wanted { Ok(()) } else { Err(ReductionError::WrongLength { given, wanted }) }
    }

    fn singular(&self) -> ReductionError {
        ReductionError::NotPositiveDefinite { first: self.reduced.teeth.first().copied().unwrap_or(0) }
    }
}

/// Stress at nodes of a cyclic gear under forces on the coordinates.
fn by_sectors(sectors: &SectorStress, forces: &[f64]) -> Result<Vec<[f64; 6]>, ReductionError> {
    let stress = sectors.under(MatRef::from_column_major_slice(forces, forces.len(), 1))?;
    Ok(stress.col_as_slice(0).as_chunks().0.to_vec())
}

/// Stress at nodes, six rows each, of columns that count so many times.
fn applied(modes: &Mat<f64>, counts: &[f64]) -> Vec<[f64; 6]> {
    let mut stress = vec![[0.0; 6]; modes.nrows() / 6];
    // Column by column, as the matrix lies in memory.
    for (column, &count) in modes.col_iter().zip(counts).filter(|(_, count)| **count != 0.0) {
        for (s, &mode) in stress.as_flattened_mut().iter_mut().zip(column.iter()) {
            *s += mode * count;
        }
    }
    stress
}

impl GearReducer {
    /// Stress modes of a window for `nodes` (numbers of the mesh in the frame of the window's matrices).
    ///
    /// A cyclic gear has the same modes in all its windows: `S = (D B) [X f + T u_c]`, sector by sector, with f = K^
    /// u_B. With one factor of the whole gear, the modes of the window whose boundary is last in the factor are read
    /// from it. Other windows need solves: S = D B K^-1 R' K^, where R selects the window's degrees of freedom. If the
    /// forces f are given, K^ is not computed until it is needed.
    ///
    /// # Errors
    /// [`ReductionError::Fem`] if a node does not exist.
    pub fn stress_modes(&self, window: &Window, nodes: &[u32]) -> Result<StressModes, ReductionError> {
        let [volume] = self.modes_by(window, nodes, [StressRecovery::Volume]);
        volume
    }

    /// Stress modes for nodes of free faces, computed only from the displacement of these `faces` (numbers of the mesh
    /// in the frame of the window's matrices): D B is [`fem::StressOperator::on_surface`]. Theory (22c).
    ///
    /// # Errors
    /// Those of [`GearReducer::stress_modes`].
    pub fn surface_stress_modes(
        &self,
        window: &Window,
        nodes: &[u32],
        faces: &[Vec<Face>],
    ) -> Result<StressModes, ReductionError> {
        let [surface] = self.modes_by(window, nodes, [StressRecovery::Surface(faces)]);
        surface
    }

    /// [`GearReducer::surface_stress_modes`] and [`GearReducer::stress_modes`] of the same nodes. For a cyclic gear
    /// both use the same matrix for the displacements around these nodes.
    ///
    /// # Errors
    /// Those of [`GearReducer::stress_modes`].
    pub fn both_stress_modes(
        &self,
        window: &Window,
        nodes: &[u32],
        faces: &[Vec<Face>],
    ) -> Result<[StressModes; 2], ReductionError> {
        let recoveries = [StressRecovery::Surface(faces), StressRecovery::Volume];
        let [surface, volume] = self.modes_by(window, nodes, recoveries);
        Ok([surface?, volume?])
    }

    fn modes_by<const N: usize>(
        &self,
        window: &Window,
        nodes: &[u32],
        recoveries: [StressRecovery<'_>; N],
    ) -> [Result<StressModes, ReductionError>; N] {
        let modes = |known| StressModes { nodes: nodes.to_vec(), known, reduced: window.reduced.clone() };
        self.stress_of(window, nodes, recoveries).map(|known| known.map(modes))
    }
}
