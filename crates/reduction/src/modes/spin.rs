//! Quantities of a cyclic gear's modes that its spin needs. Theory (58a).

use faer::Mat;
use fem::dense;
use nalgebra::{DMatrix, Vector3};

use super::krylov::Eigenpairs;
use crate::{ReductionError, cyclic::VibratingSector};

/// What the spin of a cyclic gear needs of its modes, in the gear's own frame.
#[derive(Debug, Clone)]
pub(super) struct Spin {
    /// -1 where teeth are counted clockwise, else +1.
    pub way: f64,
    /// B, m x m, skew-symmetric.
    pub products: DMatrix<f64>,
    /// E, mode by mode.
    pub swept: Vec<[f64; 6]>,
}

/// The field whose product with the inertia of a mode is E: what the spin makes of it for unit rates of the gear's
/// displacements and turns.
///
/// ```text
/// e_k . (e_z x u),    (e_k x r) . (e_z x u) + (e_k x u) . (e_z x r)
/// ```
pub(super) fn swept(j: usize, r: Vector3<f64>) -> Vector3<f64> {
    match j {
        0 => Vector3::new(0.0, -1.0, 0.0),
        1 => Vector3::new(1.0, 0.0, 0.0),
        2 => Vector3::zeros(),
        3 => Vector3::new(-r.z, 0.0, -r.x),
        4 => Vector3::new(0.0, -r.z, -r.y),
        _ => 2.0 * Vector3::new(r.x, r.y, 0.0),
    }
}

/// B of modes by harmonics; `places`: harmonic of each mode, and its number there.
pub(super) fn spin_products(
    sector: &VibratingSector,
    found: &[Eigenpairs],
    places: &[(u32, usize)],
) -> Result<DMatrix<f64>, ReductionError> {
    let rows = sector.dofs().free_count();
    let mut all = DMatrix::zeros(places.len(), places.len());
    for (n, pairs) in (0..).zip(found) {
        let own: Vec<usize> = (0..places.len()).filter(|&j| places[j].0 == n).collect();
        if own.is_empty() || rows == 0 {
            continue;
        }
        let shapes = Mat::from_fn(pairs.shapes.nrows(), own.len(), |row, j| pairs.shapes[(row, places[own[j]].1)]);
        // Freedoms of a node are x, y, z one after the other, in parts and sectors of frames that share e_z.
        let swept = Mat::from_fn(shapes.nrows(), own.len(), |row, j| match row % rows % 3 {
            0 => -shapes[(row + 1, j)],
            1 => shapes[(row - 1, j)],
            _ => 0.0,
        });
        let inertia = sector.inertia(swept.as_ref(), shapes.nrows() / rows)?;
        let products = dense::product(shapes.transpose(), inertia.as_ref());
        for (i, &row) in own.iter().enumerate() {
            for (j, &column) in own.iter().enumerate() {
                all[(row, column)] = 0.5 * (products[(i, j)] - products[(j, i)]);
            }
        }
    }
    Ok(all)
}
