//! A spring under a point of a face.

use nalgebra::{Matrix3, Vector3};

use crate::Face;

/// A part of the springs, which acts on one point of a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringPoint {
    /// The face.
    pub face: Face,
    /// Shape functions of its nodes at the point.
    pub shape: [f64; 9],
    /// Stiffness, N/mm, in the axes of the gear.
    pub stiffness: Matrix3<f64>,
}

/// Radial, tangential and axial numbers as a matrix in the axes of a place. On the axis itself no direction is radial: there
/// it is the mean of those around.
pub(crate) fn along_cylinder([radial, tangential, axial]: [f64; 3], x: Vector3<f64>) -> Matrix3<f64> {
    let along = Vector3::z() * Vector3::z().transpose();
    let across = Matrix3::identity() - along;
    let own = match Vector3::new(x.x, x.y, 0.0).try_normalize(0.0) {
        Some(e) => tangential * across + (radial - tangential) * e * e.transpose(),
        None => 0.5 * (radial + tangential) * across,
    };
    own + axial * along
}
