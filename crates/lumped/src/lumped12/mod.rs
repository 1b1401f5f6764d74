//! Twelve coordinates: all six of each gear, with friction at the mesh (seed 003).
//!
//! ```text
//! M X'' + C X' + K X = F_w + F_e,   X = (x_i, y_i, z_i, theta_xi, theta_yi, theta_zi, x_j, ..., theta_zj)
//! K = K_s + k_m (a_m - mu a_f) a_m' + k_t (a_t - mu a_ft) a_t',   F_e = k_m (a_m - mu a_f) e
//! ```
//! in the global axes of the pair (driver i, driven gear j, turned by the orientation angle). The mesh is a compression
//! spring k_m along the flanks' normal at the centre of the contact lines and a tilt spring k_t: together they are
//! *exactly* a stiffness spread evenly along all contact lines between two rigid gears, because two rigid gears can
//! only approach along a line by a constant and a slope. Hence k_t = k_m times the mean square distance from the centre
//! along the lines, and the geometry gives every lever:
//!
//! * a_m: displacement of the flanks towards each other, n . [(u_i + theta_i x r_i) - (u_j + theta_j x r_j)], printed
//!   term by term as l_ij;
//! * a_t: relative tilt about the direction across the plane of action, n_ij;
//! * a_f: what a unit normal force does by friction; with lambda_1, lambda_2 the shares of the contact lines after and
//!   before the pitch line, (lambda_1 - lambda_2) across the line of action, and the moments by the levers of either
//!   share.
//!
//! What is printed otherwise: N = k_m l + k_t n adds a force and a moment (here the tilt loads the lines unevenly,
//! which has a friction vector a_ft of its own); T_x, T_y and a_f disagree on cos psi and sin psi (here they are r x
//! F); K = k_m a_m a_m' + a_f' + ... is k_m (a_m - mu a_f) a_m', the sign being that of a_f; the total force is said to
//! grow with the total *length* of the lines once more, which k_m already holds.

mod mechanism;
mod mesh_vectors;
mod parameters;

pub use mechanism::Motion12;
use mesh_vectors::MeshVectors;
pub use parameters::{Lumped12, Support12};
