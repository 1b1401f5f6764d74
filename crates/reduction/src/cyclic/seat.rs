//! The seat of a cyclic gear whose bore is held by its means, as its sectors see it. Theory (13a), (13f).

use faer::{Mat, MatRef};
use fem::DofMap;
use mesh::face_weights;
use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, Rotation3, Vector3, Vector6};

use super::SectorMesh;
use crate::{
    ReductionError,
    mean_seat::{LEAST, RigidMotions, independent},
};

/// Numbers of a rigid motion, and of what balances forces on a free body.
pub(super) const SIX: usize = 6;

/// Share of the seat in one sector, in the sector's frame.
///
/// ```text
/// B_s = W_s R_s/A,   M = sum over sectors of D_s R_s' B_s D_s',   l = M^-1 R' f      R, B, l: theory (13a)
/// ```
/// D_s: turn from the frame of sector s. The whole gear is free, and l is what balances its loads. Six springs on a cut make
/// matrices regular that rigid motions would make singular; loads in balance leave them without force.
#[derive(Debug)]
pub(super) struct SectorSeat {
    /// R_s on the free freedoms, n x 6, mm.
    pub rigid: Mat<f64>,
    /// B_s, n x 6.
    pub forces: Mat<f64>,
    /// M^-1, the same in the frames of all sectors.
    pub inverse: Matrix6<f64>,
    /// Freedoms of the left cut with springs, in the order of the cut, and their stiffness, N/mm.
    pub springs: [usize; SIX],
    pub stiffness: f64,
    /// Matrix rows of the left cut.
    left: Vec<usize>,
    /// Angle from one sector to the next, rad.
    pub pitch: f64,
}

impl SectorSeat {
    /// Of a sector with these faces and these matrix rows of its left cut; `young`: Young's modulus, MPa.
    pub fn new(
        part: &SectorMesh,
        dofs: &DofMap,
        (left, young): (&[usize], f64),
    ) -> Result<Option<Self>, ReductionError> {
        let Some(faces) = &part.seat else { return Ok(None) };
        let pitch = part.way * (std::f64::consts::TAU / f64::from(part.teeth));
        let weights = face_weights(&part.mesh, faces);
        let at = |node: u32| Vector3::from(part.mesh.nodes[node as usize]);
        let area: f64 = weights.iter().map(|own| own.1).sum();
        // Of all sectors together on the axis.
        let height = weights.iter().map(|&(n, w)| w * at(n).z).sum::<f64>() / area;
        let centre = Vector3::new(0.0, 0.0, height);
        let motions = RigidMotions::about(centre, &part.mesh.nodes, &weights);
        let motion = |node: u32, axis: usize| motions.at(part.mesh.nodes[node as usize], axis);
        let rigid = motions.of(&part.mesh.nodes, dofs);
        let mut forces = Mat::zeros(dofs.free_count(), SIX);
        let whole = area * f64::from(part.teeth);
        let mut own = Matrix6::zeros();
        for &(node, weight) in &weights {
            for axis in 0..3 {
                let Some(row) = dofs.dof(node, axis) else { continue };
                let motion = motion(node, axis);
                (0..SIX).for_each(|k| forces[(row, k)] += weight / whole * motion[k]);
                own += weight / whole * motion * motion.transpose();
            }
        }
        let mut sum = Matrix6::zeros();
        for sector in 0..part.teeth {
            let turn = turn(pitch * f64::from(sector));
            sum += turn * own * turn.transpose();
        }
        let sum = 0.5 * (sum + sum.transpose());
        let eigenvalues = sum.symmetric_eigenvalues();
        let on_cut = left.iter().enumerate().map(|(i, &row)| (i, Vector6::from_fn(|k, _| rigid[(row, k)])));
        let faces = faces.len() * part.teeth as usize;
        let refused = || ReductionError::NoMeanTurn { faces };
        let inverse =
            sum.try_inverse().filter(|_| eigenvalues.min() > LEAST * eigenvalues.max()).ok_or_else(refused)?;
        let springs = independent(on_cut.collect()).ok_or_else(refused)?;
        let left = left.to_vec();
        Ok(Some(Self { rigid, forces, inverse, springs, stiffness: young * motions.gyration, left, pitch }))
    }

    /// Freedoms of the left cut that motions with real parts above imaginary ones (`parts` of them; of all free freedoms, one column
    /// each, i times itself beside each where both are) do not leave at rest, as few as hold them.
    pub fn springs_of(&self, motions: &Mat<f64>, parts: usize) -> Vec<usize> {
        let n = motions.nrows() / parts;
        let of = |&row: &usize, part: usize| DVector::from_fn(motions.ncols(), |k, _| motions[(part * n + row, k)]);
        let mut rows: Vec<Vec<DVector<f64>>> =
            self.left.iter().map(|row| (0..parts).map(|part| of(row, part)).collect()).collect();
        let mut found = Vec::new();
        while found.len() * parts < motions.ncols() {
            let size = |i: &usize| rows[*i][0].norm_squared();
            let Some(best) = (0..rows.len()).max_by(|a, b| size(a).total_cmp(&size(b))) else { break };
            found.push(best);
            for part in 0..parts {
                let unit = rows[best][part].normalize();
                rows.iter_mut().flatten().for_each(|row| *row -= &unit * unit.dot(row));
            }
        }
        found
    }

    /// Six numbers of a sector (6 x k) as those of one so many sectors on.
    pub fn seen_from(&self, numbers: MatRef<'_, f64>, sectors: u32) -> Mat<f64> {
        turned(numbers, -self.pitch * f64::from(sectors))
    }

    /// What balances forces of these six resultants R'f, 6 x k: -M^-1 R'f.
    pub fn balance(&self, resultants: MatRef<'_, f64>) -> Mat<f64> {
        product(&-self.inverse, resultants)
    }
}

/// Six numbers (6 x k) of a frame in one that is turned back by an angle, rad: D x.
pub(super) fn turned(numbers: MatRef<'_, f64>, angle: f64) -> Mat<f64> {
    product(&turn(angle), numbers)
}

/// D of an angle, rad.
fn turn(angle: f64) -> Matrix6<f64> {
    let own: Matrix3<f64> = *Rotation3::from_axis_angle(&Vector3::z_axis(), angle).matrix();
    let mut all = Matrix6::zeros();
    [0, 3].into_iter().for_each(|at| all.fixed_view_mut::<3, 3>(at, at).copy_from(&own));
    all
}

fn product(left: &Matrix6<f64>, right: MatRef<'_, f64>) -> Mat<f64> {
    Mat::from_fn(SIX, right.ncols(), |i, j| (0..SIX).map(|k| left[(i, k)] * right[(k, j)]).sum::<f64>())
}

/// Rigid motions and seat of some vectors, for any number of motions: forces in balance, displacements without the mean motion
/// of the bore.
///
/// ```text
/// P' f = f - B (R'B)^-1 R' f,   P u = u - R (R'B)^-1 B' u
/// ```
#[derive(Debug)]
pub(super) struct Settled {
    pub rigid: Mat<f64>,
    pub forces: Mat<f64>,
    inverse: DMatrix<f64>,
}

impl Settled {
    /// `None` where R'B is singular.
    pub fn new(rigid: Mat<f64>, forces: Mat<f64>) -> Option<Self> {
        let own = fem::dense::product(rigid.transpose(), forces.as_ref());
        let m = own.nrows();
        let inverse = DMatrix::from_fn(m, m, |i, j| own[(i, j)]).try_inverse()?;
        Some(Self { rigid, forces, inverse })
    }

    /// P' f.
    pub fn balanced(&self, forces: MatRef<'_, f64>) -> Mat<f64> {
        self.less(forces, &self.rigid, (&self.forces, &self.inverse))
    }

    /// P u.
    pub fn settled(&self, displacements: MatRef<'_, f64>) -> Mat<f64> {
        self.less(displacements, &self.forces, (&self.rigid, &self.inverse.transpose()))
    }

    fn less(&self, x: MatRef<'_, f64>, from: &Mat<f64>, (to, inverse): (&Mat<f64>, &DMatrix<f64>)) -> Mat<f64> {
        let sums = fem::dense::product(from.transpose(), x);
        let m = sums.nrows();
        let shares = Mat::from_fn(m, sums.ncols(), |i, j| (0..m).map(|k| inverse[(i, k)] * sums[(k, j)]).sum::<f64>());
        x - fem::dense::product(to.as_ref(), shares.as_ref())
    }
}
