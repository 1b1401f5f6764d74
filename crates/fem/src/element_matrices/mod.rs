//! Stiffness and mass of one element.
//!
//! ```text
//! K_ij = sum_q w det J (lambda g_i g_j' + mu g_j g_i' + mu (g_i . g_j) I),   g_i = J^-T dN_i/dxi     [N/mm]
//! M_ij = sum_q w det J rho N_i N_j                                                                   [t]
//! ```

mod blocks;
mod geometry;
mod incompatible;
mod kernels;
mod options;

pub(crate) use blocks::block_index;
pub(crate) use geometry::{Table, checked_jacobian, gradients};
pub(crate) use incompatible::{BUBBLES, Condensed, bubble_gradients};
pub(crate) use kernels::{MassKernel, StiffnessKernel};
pub use kernels::{element_mass, element_stiffness};
pub use options::{ElementOptions, IncompatibleModes, Integration, locks_from};
