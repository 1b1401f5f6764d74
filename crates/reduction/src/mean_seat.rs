//! A gear held by the means of its bore: a free body in equilibrium with six reactions. Theory (13a), (13b).

use faer::{Mat, MatMut};
use fem::{DofMap, SymmetricMatrix};
use mesh::MeshedGear;
use nalgebra::{Matrix6, Vector3, Vector6};

use crate::ReductionError;

/// What holds a gear whose bore has a mean displacement and a mean turn of nothing.
///
/// ```text
/// B' u = 0,   B = W R / A,   R = [e_k, e_k x (x - c)/rho]        rigid motions on the free freedoms, mm
/// K u = f - B l,   l = (R'B)^-1 R' f                             reactions, as the body is free otherwise
/// u = P K~^-1 P' f,   P = 1 - R (R'B)^-1 B',   K~ = K + six springs
/// ```
/// W: integrals of the shape functions over the held faces ([`MeshedGear::bore_weights`]), A their sum, c and rho
/// centroid and radius of gyration of the faces. The springs hold the body without any redundancy: forces in balance leave
/// them without force, so that their stiffness is in no result.
#[derive(Debug)]
pub(crate) struct MeanSeat {
    rigid: Mat<f64>,
    forces: Mat<f64>,
    /// (R'B)^-1.
    inverse: Matrix6<f64>,
    /// Freedoms that the springs hold.
    springs: [usize; 6],
}

/// Least share of the largest eigenvalue of R'B, or of a row that is still independent, that is no round-off.
pub(crate) const LEAST: f64 = 1e-8;

/// Six rigid motions: three displacements, and three turns about a centre, by the radius of gyration of weights about it.
pub(crate) struct RigidMotions {
    centre: Vector3<f64>,
    /// Radius of gyration, mm.
    pub gyration: f64,
}

impl RigidMotions {
    /// About the centre of some weighted nodes.
    pub fn about(centre: Vector3<f64>, nodes: &[[f64; 3]], weights: &[(u32, f64)]) -> Self {
        let area: f64 = weights.iter().map(|own| own.1).sum();
        let away = |node: u32| (Vector3::from(nodes[node as usize]) - centre).norm_squared();
        let square: f64 = weights.iter().map(|&(node, weight)| weight * away(node)).sum();
        Self { centre, gyration: (square / area).max(0.0).sqrt() }
    }

    /// What a place moves along an axis in each of them.
    pub fn at(&self, place: [f64; 3], axis: usize) -> Vector6<f64> {
        let arm = (Vector3::from(place) - self.centre) / self.gyration;
        let turn = |k: usize| Vector3::from_fn(|i, _| f64::from(u8::from(i == k))).cross(&arm)[axis];
        Vector6::from_fn(|k, _| if k < 3 { f64::from(u8::from(k == axis)) } else { turn(k - 3) })
    }

    /// R: they of all free coordinates, n x 6.
    pub fn of(&self, nodes: &[[f64; 3]], dofs: &DofMap) -> Mat<f64> {
        let mut rigid = Mat::zeros(dofs.free_count(), 6);
        for row in 0..dofs.free_count() {
            let Some((node, axis)) = dofs.node_and_axis(row) else { continue };
            let motion = self.at(nodes[node as usize], axis);
            (0..6).for_each(|k| rigid[(row, k)] = motion[k]);
        }
        rigid
    }
}

impl MeanSeat {
    /// Seat of the held faces of a bore; all nodes of the mesh are free.
    pub(crate) fn new(gear: &MeshedGear, dofs: &DofMap) -> Result<Self, ReductionError> {
        let (weights, nodes) = (gear.bore_weights(), &gear.mesh().nodes);
        let at = |node: u32| Vector3::from(nodes[node as usize]);
        let area: f64 = weights.iter().map(|(_, w)| w).sum();
        let centre = weights.iter().map(|&(n, w)| w * at(n)).sum::<Vector3<f64>>() / area;
        let motions = RigidMotions::about(centre, nodes, &weights);
        let motion = |node: u32, axis: usize| motions.at(nodes[node as usize], axis);
        let rigid = motions.of(nodes, dofs);
        let mut forces = Mat::zeros(dofs.free_count(), 6);
        let mut sum = Matrix6::zeros();
        let mut rows = Vec::new();
        for &(node, weight) in &weights {
            for axis in 0..3 {
                let Some(row) = dofs.dof(node, axis) else { continue };
                let motion = motion(node, axis);
                (0..6).for_each(|k| forces[(row, k)] = weight / area * motion[k]);
                sum += weight / area * motion * motion.transpose();
                rows.push((row, motion));
            }
        }
        let eigenvalues = sum.symmetric_eigenvalues();
        let inverse = sum.try_inverse().filter(|_| eigenvalues.min() > LEAST * eigenvalues.max());
        let (Some(inverse), Some(springs)) = (inverse, independent(rows)) else {
            return Err(ReductionError::NoMeanTurn { faces: gear.bore().faces.len() });
        };
        Ok(Self { rigid, forces, inverse, springs })
    }

    /// K~: the springs are as stiff as what is about them.
    pub(crate) fn held(&self, mut stiffness: SymmetricMatrix) -> Result<SymmetricMatrix, ReductionError> {
        let diagonal = stiffness.diagonal();
        for dof in self.springs {
            stiffness.add(dof, dof, diagonal[dof])?;
        }
        Ok(stiffness)
    }

    /// P' f: forces (n x k) with the reactions that balance them.
    pub(crate) fn balance(&self, forces: MatMut<'_, f64>) {
        subtract(forces, &self.rigid, &self.inverse, &self.forces);
    }

    /// P u: displacements (n x k) less the mean motion of the bore.
    pub(crate) fn settle(&self, displacements: MatMut<'_, f64>) {
        subtract(displacements, &self.forces, &self.inverse, &self.rigid);
    }

    /// Compliance of some freedoms, P applied from both sides to that of K~ (`springs`, m x m); `reactions`: K~^-1 B.
    pub(crate) fn compliance(&self, springs: &Mat<f64>, rows: &[usize], reactions: &Mat<f64>) -> Mat<f64> {
        let m = rows.len();
        let share: Vec<Vector6<f64>> =
            rows.iter().map(|&r| self.inverse * Vector6::from_fn(|k, _| self.rigid[(r, k)])).collect();
        let moved: Vec<Vector6<f64>> = rows.iter().map(|&r| Vector6::from_fn(|k, _| reactions[(r, k)])).collect();
        let own = fem::dense::product(self.forces.transpose(), reactions.as_ref());
        let own = Matrix6::from_fn(|i, j| 0.5 * (own[(i, j)] + own[(j, i)]));
        let folded: Vec<Vector6<f64>> = share.iter().map(|s| own * s).collect();
        Mat::from_fn(m, m, |i, j| {
            springs[(i, j)] - moved[i].dot(&share[j]) - share[i].dot(&moved[j])
                + 0.5 * (share[i].dot(&folded[j]) + share[j].dot(&folded[i]))
        })
    }

    /// B.
    pub(crate) fn reactions(&self) -> &Mat<f64> {
        &self.forces
    }
}

/// x -= to (R'B)^-1 from' x, column by column.
fn subtract(mut x: MatMut<'_, f64>, from: &Mat<f64>, inverse: &Matrix6<f64>, to: &Mat<f64>) {
    for j in 0..x.ncols() {
        let sums = Vector6::from_fn(|k, _| (0..x.nrows()).map(|i| from[(i, k)] * x[(i, j)]).sum());
        let shares = inverse * sums;
        for i in 0..x.nrows() {
            x[(i, j)] -= (0..6).map(|k| to[(i, k)] * shares[k]).sum::<f64>();
        }
    }
}

/// Six rows that no rigid motion leaves at rest: one after the other the one that is farthest from those before.
pub(crate) fn independent(mut rows: Vec<(usize, Vector6<f64>)>) -> Option<[usize; 6]> {
    let mut found = [0; 6];
    for place in &mut found {
        let (mut best, mut size) = (None, LEAST);
        for (i, (_, row)) in rows.iter().enumerate().filter(|(_, r)| r.1.norm_squared() > 0.0) {
            if row.norm_squared() > size {
                (best, size) = (Some(i), row.norm_squared());
            }
        }
        let (dof, direction) = rows[best?];
        *place = dof;
        let unit = direction.normalize();
        rows.iter_mut().for_each(|(_, row)| *row -= unit * unit.dot(row));
    }
    Some(found)
}
