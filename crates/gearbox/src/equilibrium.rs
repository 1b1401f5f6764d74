//! Newton's method for the displacements of the seats with the tangents of the meshes. Theory (84).

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::GearboxError;

/// Steps before giving up; two to four are usual, more where teeth or rolling elements come into contact on the way.
const STEPS: usize = 120;
/// Halvings of a step that does not lead nearer.
const HALVINGS: usize = 24;
/// Step over the displacements that ends the search. It is taken, and the forces follow it by the tangent, which is good
/// to some thousandths: what is left is some 1e-12.
const FINE: f64 = 1e-9;
/// Residual over the load beyond which a fine step is not the last one.
const LEFT: f64 = 1e-6;
/// Residual over the load beyond which a fine step is not the last one, where round-off of the contact does not let the
/// residual fall any more.
const ROUND_OFF: f64 = 1e-7;

/// Newton's step over that of K_0 beyond which the tangent holds nothing.
const FAR: f64 = 1e6;
/// Share of K_0 that is added to a tangent which holds nothing somewhere.
const SHIFT: f64 = 1e-3;
/// Doublings of a step on which nothing touches, and halvings of the one on which something does.
const DOUBLINGS: usize = 64;

/// What meshes and loads leave over at some displacements: residual r = K z - f - f_mesh, and dr/dz.
pub(crate) struct Left {
    pub residual: DVector<f64>,
    pub tangent: DMatrix<f64>,
}

/// Equilibrium, and how well it was found.
pub(crate) struct Converged {
    pub displacements: DVector<f64>,
    /// Difference from the displacements at which the meshes were evaluated last: forces follow by their tangents.
    pub last_step: DVector<f64>,
    /// Residual where the meshes were evaluated last, over the load, in the norm of the compliance.
    pub residual: f64,
    pub iterations: usize,
}

/// Norms in which displacements (mm, rad) and forces (N, N mm) can be added up: those of a stiffness K_0 that is near
/// the tangent.
pub(crate) struct Norms {
    stiffness: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
    scale: DVector<f64>,
}

impl Norms {
    /// Norms defined by a symmetric positive definite stiffness.
    pub fn new(stiffness: DMatrix<f64>) -> Result<Self, GearboxError> {
        let free = |dof| fem::FemError::NotPositiveDefinite { dof, pivot_ratio: 0.0 };
        if let Some(dof) = (0..stiffness.nrows()).find(|i| stiffness[(*i, *i)].is_nan() || stiffness[(*i, *i)] <= 0.0) {
            return Err(free(dof).into());
        }
        let scale = stiffness.diagonal().map(|d| d.sqrt().recip());
        let scaled = scaled(&stiffness, &scale);
        let factor = Cholesky::new(scaled).ok_or_else(|| free(0))?;
        let pivots = factor.l_dirty().diagonal().map(|x| x * x);
        let (dof, least) = pivots.argmin();
        // Round-off of a matrix whose scaled entries are up to 1.
        if least < 1e-13 {
            return Err(fem::FemError::NotPositiveDefinite { dof, pivot_ratio: least }.into());
        }
        Ok(Self { stiffness, factor, scale })
    }

    /// Displacements K_0^-1 f.
    pub fn displacements(&self, forces: &DVector<f64>) -> DVector<f64> {
        self.factor.solve(&forces.component_mul(&self.scale)).component_mul(&self.scale)
    }

    /// sqrt(f' K_0^-1 f).
    fn of_forces(&self, forces: &DVector<f64>) -> f64 {
        forces.dot(&self.displacements(forces)).max(0.0).sqrt()
    }

    /// sqrt(z' K_0 z).
    fn of_displacements(&self, z: &DVector<f64>) -> f64 {
        z.dot(&(&self.stiffness * z)).max(0.0).sqrt()
    }

    /// Newton's step; none where the tangent is singular, as it is where nothing touches.
    fn step(&self, left: &Left) -> Option<DVector<f64>> {
        let most = FAR * self.of_forces(&left.residual);
        self.solved(&left.tangent, &left.residual).filter(|s| self.of_displacements(s) <= most)
    }

    /// The step of the tangent with a share of K_0: energy falls along it, and what the tangent holds is held.
    fn shifted_step(&self, left: &Left) -> DVector<f64> {
        let shifted = &left.tangent + SHIFT * &self.stiffness;
        self.solved(&shifted, &left.residual).unwrap_or_else(|| -self.displacements(&left.residual))
    }

    fn solved(&self, tangent: &DMatrix<f64>, residual: &DVector<f64>) -> Option<DVector<f64>> {
        let right = -residual.component_mul(&self.scale);
        let solved = scaled(tangent, &self.scale).lu().solve(&right)?.component_mul(&self.scale);
        Some(solved).filter(|s| s.iter().all(|x| x.is_finite()))
    }
}

fn scaled(matrix: &DMatrix<f64>, scale: &DVector<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] * scale[i] * scale[j])
}

/// Displacements at which nothing is left over, from `start` on; `load` is what residuals are measured by.
///
/// ```text
/// (K - df_mesh/dz) dz = -r,   z := z + s dz,   s = 1, 1/2, ... until sqrt(r' K_0^-1 r) falls
/// ```
/// Elastic contact has a convex energy, so that a step always leads nearer when it is short enough. Where teeth or
/// rolling elements that ought to carry do not touch, the tangent is singular; the step of the tangent with a share of
/// K_0 is then followed to the least energy along it, and so is one whose residual does not fall.
pub(crate) fn equilibrium(
    norms: &Norms,
    load: &DVector<f64>,
    start: DVector<f64>,
    mut left_at: impl FnMut(&DVector<f64>) -> Result<Left, GearboxError>,
) -> Result<Converged, GearboxError> {
    let whole = norms.of_forces(load).max(f64::MIN_POSITIVE);
    let mut z = start;
    let mut left = left_at(&z)?;
    let mut merit = norms.of_forces(&left.residual);
    let mut share = f64::INFINITY;
    for iterations in 0..STEPS {
        let found = |z: DVector<f64>, step: DVector<f64>| {
            let residual = merit / whole;
            Converged { displacements: z + &step, last_step: step, residual, iterations }
        };
        if merit == 0.0 {
            let nothing = DVector::zeros(z.len());
            return Ok(found(z, nothing));
        }
        let newton = norms.step(&left);
        let is_held = newton.is_some();
        let step = newton.unwrap_or_else(|| norms.shifted_step(&left));
        share = norms.of_displacements(&step) / norms.of_displacements(&z).max(f64::MIN_POSITIVE);
        // A light load is a small part of what closes its gaps: there the residual says when it is found.
        if share <= FINE && (merit <= LEFT * whole || share <= 4.0 * f64::EPSILON) {
            return Ok(found(z, step));
        }
        let mut part = 1.0;
        let mut better = None;
        for _ in 0..if is_held { HALVINGS } else { 0 } {
            let next = &z + part * &step;
            // Poses beyond reason may have no contact that can be solved: nearer ones do.
            if let Ok(there) = left_at(&next) {
                let size = norms.of_forces(&there.residual);
                if size < merit {
                    better = Some((next, there, size));
                    break;
                }
            }
            if share <= ROUND_OFF {
                break;
            }
            part *= 0.5;
        }
        match better {
            Some((next, there, size)) => (z, left, merit) = (next, there, size),
            None if is_held && share <= ROUND_OFF => {
                // The elements stand where the last try was.
                left_at(&z)?;
                return Ok(found(z, step));
            }
            None => {
                (z, left) = approached(&z, step, &mut left_at)?;
                merit = norms.of_forces(&left.residual);
            }
        }
    }
    Err(GearboxError::NoEquilibrium { iterations: STEPS, step: share })
}

/// From `z` along `step`, on which energy falls, to where it is least: r . step = 0 between twice and once as far.
fn approached(
    z: &DVector<f64>,
    step: DVector<f64>,
    left_at: &mut impl FnMut(&DVector<f64>) -> Result<Left, GearboxError>,
) -> Result<(DVector<f64>, Left), GearboxError> {
    let (mut near, mut far) = (0.0, 1.0);
    let mut try_at = |part: f64| {
        let next = z + part * &step;
        left_at(&next).map(|left| (left.residual.dot(&step) >= 0.0, next, left))
    };
    // Poses beyond reason have no contact that can be solved: they lie too far as well. The nearest place where teeth press
    // is what Newton's steps can go on from.
    let mut found = None;
    for _ in 0..DOUBLINGS {
        match try_at(far) {
            Ok((false, next, left)) => {
                found = Some((next, left));
                (near, far) = (far, 2.0 * far);
            }
            Ok((true, next, left)) => {
                found = Some((next, left));
                break;
            }
            Err(_) => break,
        }
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (near + far);
        match try_at(middle) {
            Ok((true, next, left)) => {
                found = Some((next, left));
                far = middle;
            }
            Ok((false, ..)) => near = middle,
            Err(_) => far = middle,
        }
    }
    found.ok_or(GearboxError::NoEquilibrium { iterations: 0, step: f64::INFINITY })
}
