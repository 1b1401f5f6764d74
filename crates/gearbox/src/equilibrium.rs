//! Newton's method on the seats with the tangents of the meshes. Theory (84).

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::GearboxError;

/// Steps before giving up; two to four are usual, more where teeth come into contact on the way.
const STEPS: usize = 60;
/// Halvings of a step that does not lead nearer.
const HALVINGS: usize = 24;
/// Step over the displacements that ends the search. It is taken, and the forces follow it by the tangent, which is good
/// to some thousandths: what is left is some 1e-12.
const FINE: f64 = 1e-9;
/// The same where round-off of the contact does not let the residual fall any more.
const ROUND_OFF: f64 = 1e-7;

/// What meshes and loads leave over at some displacements: residual r = K z - f - f_mesh, and dr/dz.
pub(crate) struct Left {
    pub residual: DVector<f64>,
    pub tangent: DMatrix<f64>,
}

/// Equilibrium, and how well it was found.
pub(crate) struct Found {
    pub displacements: DVector<f64>,
    /// How far they are from where the meshes were evaluated last: forces follow by their tangents.
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
    /// Of a symmetric positive definite stiffness.
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

    /// K_0^-1 f.
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

    /// Newton's step; that of K_0 where the tangent is singular, as it is where nothing touches.
    fn step(&self, left: &Left) -> DVector<f64> {
        let right = -left.residual.component_mul(&self.scale);
        let solved = scaled(&left.tangent, &self.scale).lu().solve(&right);
        let step = solved.map(|s| s.component_mul(&self.scale)).filter(|s| s.iter().all(|x| x.is_finite()));
        step.unwrap_or_else(|| -self.displacements(&left.residual))
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
/// Elastic contact has a convex energy, so that a step always leads nearer when it is short enough.
pub(crate) fn equilibrium(
    norms: &Norms,
    load: &DVector<f64>,
    start: DVector<f64>,
    mut left_at: impl FnMut(&DVector<f64>) -> Result<Left, GearboxError>,
) -> Result<Found, GearboxError> {
    let whole = norms.of_forces(load).max(f64::MIN_POSITIVE);
    let mut z = start;
    let mut left = left_at(&z)?;
    let mut merit = norms.of_forces(&left.residual);
    let mut share = f64::INFINITY;
    for iterations in 0..STEPS {
        let found = |z: DVector<f64>, step: DVector<f64>| {
            let residual = merit / whole;
            Found { displacements: z + &step, last_step: step, residual, iterations }
        };
        if merit == 0.0 {
            let nothing = DVector::zeros(z.len());
            return Ok(found(z, nothing));
        }
        let step = norms.step(&left);
        share = norms.of_displacements(&step) / norms.of_displacements(&z).max(f64::MIN_POSITIVE);
        if share <= FINE {
            return Ok(found(z, step));
        }
        let mut part = 1.0;
        let mut better = None;
        for _ in 0..HALVINGS {
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
            None if share <= ROUND_OFF => {
                // The elements stand where the last try was.
                left_at(&z)?;
                return Ok(found(z, step));
            }
            None => return Err(GearboxError::NoEquilibrium { iterations, step: share }),
        }
    }
    Err(GearboxError::NoEquilibrium { iterations: STEPS, step: share })
}
