//! Shafts that their bearings leave free to move: named before a matrix would only say a number.

use nalgebra::{Matrix5, SMatrix, SymmetricEigen};

use crate::{GearboxError, Structure};

/// Share of a scaled stiffness that is round-off.
const NOTHING: f64 = 1e-13;
/// Share of a tilt in a motion from which on it is called one.
const TILTS: f64 = 0.1;
/// Rigid motions of a shaft beside its turn.
const MOTIONS: [&str; 5] = ["along x", "along y", "along z", "tilting about x", "tilting about y"];

/// Whether bearings hold every shaft against every rigid motion but its turn; those of `held` need none.
///
/// ```text
/// K = sum T_b' K_b T_b,   u_b = T_b (x, y, z, theta_x, theta_y),   u = x + theta x r      r from the middle of the shaft
/// ```
/// Rolling bearings count with all their elements pressed, whatever their clearance. Housings are in series with the
/// bearings: what these do not hold, nothing holds.
///
/// # Errors
/// [`GearboxError::Loose`].
pub(crate) fn check_held(structure: &Structure, held: &[bool]) -> Result<(), GearboxError> {
    for (i, shaft) in structure.shafts.iter().enumerate().filter(|(i, _)| !held[*i]) {
        let half = 0.5 * shaft.pieces.iter().map(|p| p.length).sum::<f64>();
        let mut stiffness = Matrix5::zeros();
        for bearing in structure.bearings.iter().filter(|b| b.shaft == i) {
            let moves = rigid(bearing.position - half);
            stiffness += moves.transpose() * bearing.rough_stiffness(1.0) * moves;
        }
        if let Some(motion) = free(&(0.5 * (stiffness + stiffness.transpose()))) {
            return Err(GearboxError::Loose { shaft: shaft.name.clone(), motion: MOTIONS[motion] });
        }
    }
    Ok(())
}

impl Structure {
    /// Whether bearings hold every shaft but those of `held`, which are rigid in rigid bearings, against every rigid
    /// motion but its turn. Springs about a load hold nothing where rolling elements carry nothing.
    ///
    /// # Errors
    /// [`GearboxError::Loose`].
    pub fn check_held(&self, held: &[usize]) -> Result<(), GearboxError> {
        let flags: Vec<bool> = (0..self.shafts.len()).map(|shaft| held.contains(&shaft)).collect();
        check_held(self, &flags)
    }
}

/// Displacements of a bearing at height z by the rigid motions of its shaft.
fn rigid(z: f64) -> SMatrix<f64, 6, 5> {
    let mut moves = SMatrix::zeros();
    (0..5).for_each(|i| moves[(i, i)] = 1.0);
    moves[(0, 4)] = z;
    moves[(1, 3)] = -z;
    moves
}

/// The motion that a stiffness does not hold; about a point off the middle a shaft tilts and shifts at once.
fn free(stiffness: &Matrix5<f64>) -> Option<usize> {
    let diagonal = stiffness.diagonal();
    if let Some(nothing) = (0..5).find(|&i| diagonal[i].is_nan() || diagonal[i] <= 0.0) {
        return Some(nothing);
    }
    let scaled = Matrix5::from_fn(|i, j| stiffness[(i, j)] / (diagonal[i] * diagonal[j]).sqrt());
    let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(scaled);
    let (least, value) = eigenvalues.argmin();
    let free = eigenvectors.column(least);
    let tilt = 3 + free.rows(3, 2).iamax();
    (value < NOTHING).then(|| if free[tilt].abs() > TILTS { tilt } else { free.iamax() })
}
