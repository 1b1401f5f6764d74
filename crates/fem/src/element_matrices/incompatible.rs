//! Incompatible bending modes of hex8: three bubble functions 1 - xi_k^2, each with a vector of three amplitudes.
//!
//! ```text
//! u = sum N_i u_i + sum_k (1 - xi_k^2) alpha_k,     grad (1 - xi_k^2) := (det J0 / det J) J0^-T d(1 - xi_k^2)/dxi
//! K = K_uu - K_ua K_aa^-1 K_au,                     alpha = -K_aa^-1 K_au u
//! ```
//! J0 is the Jacobian at the centre. With the ratio the strains of the bubbles integrate to zero on any element. So a
//! state of constant stress does no work on them, and the patch test is passed.

use nalgebra::{Cholesky, Const, SMatrix, SVector};

use super::{IncompatibleModes, blocks::block_index};

/// Number of bubble functions.
pub(crate) const BUBBLES: usize = 3;
const NODES: usize = 8;

/// Gradients (1/mm) of the three bubbles at `xi`.
pub(crate) fn bubble_gradients(
    modes: IncompatibleModes,
    xi: [f64; 3],
    inverse_centre: &[[f64; 3]; 3],
    det_centre: f64,
    det: f64,
) -> [[f64; 3]; BUBBLES] {
    let ratio = match modes {
        IncompatibleModes::Taylor => det_centre / det,
        IncompatibleModes::WithoutJacobianRatio | IncompatibleModes::Off => 1.0,
    };
    [0, 1, 2].map(|k| inverse_centre[k].map(|slope| -2.0 * xi[k] * ratio * slope))
}

/// What the condensation leaves behind to find the bubbles' amplitudes again.
pub(crate) struct Condensed {
    k_aa: Cholesky<f64, Const<9>>,
    k_au: SMatrix<f64, 9, 24>,
}

impl Condensed {
    /// Amplitudes alpha_k of the three bubbles (mm) for the nodes' displacements (mm).
    pub(crate) fn amplitudes(&self, displacement: &[[f64; 3]]) -> [[f64; 3]; BUBBLES] {
        let u = SVector::<f64, 24>::from_iterator(displacement.iter().flatten().copied());
        let alpha = -self.k_aa.solve(&(self.k_au * u));
        [0, 1, 2].map(|k| [alpha[3 * k], alpha[3 * k + 1], alpha[3 * k + 2]])
    }
}

/// Reduces the stiffness of 8 nodes and 3 bubbles, in place, to the nodes.
///
/// `blocks` is a lower block triangle of order 11; the first 8 rows become the result.
/// `None` when K_aa is not positive definite, which no valid element has.
pub(super) fn condense(blocks: &mut [[f64; 9]]) -> Option<Condensed> {
    let mut k_aa = SMatrix::<f64, 9, 9>::zeros();
    let mut k_au = SMatrix::<f64, 9, 24>::zeros();
    for m in 0..BUBBLES {
        for j in 0..NODES + m + 1 {
            let block = &blocks[block_index(NODES + m, j)];
            for a in 0..3 {
                for b in 0..3 {
                    let value = block[3 * a + b];
                    if j < NODES {
                        k_au[(3 * m + a, 3 * j + b)] = value;
                    } else {
                        k_aa[(3 * m + a, 3 * (j - NODES) + b)] = value;
                        k_aa[(3 * (j - NODES) + b, 3 * m + a)] = value;
                    }
                }
            }
        }
    }
    let k_aa = k_aa.cholesky()?;
    // with L Y = K_au the correction is Y'Y: symmetric to the last bit
    let half = k_aa.l().solve_lower_triangular(&k_au)?;
    for i in 0..NODES {
        for j in 0..=i {
            let block = &mut blocks[block_index(i, j)];
            for a in 0..3 {
                for b in 0..3 {
                    block[3 * a + b] -= half.column(3 * i + a).dot(&half.column(3 * j + b));
                }
            }
        }
    }
    Some(Condensed { k_aa, k_au })
}
