//! Natural vibration about a state, also where the stiffness is not symmetric.

use std::f64::consts::TAU;

use integrate::{Forces, Mechanism};
use nalgebra::{Cholesky, Complex, DMatrix, DVector, Dyn, LU};

/// Eigenvalues whose imaginary part is below this share of the largest eigenvalue are real: round-off of the matrix.
const REAL: f64 = 1e-9;

/// One natural vibration x(t) = Re[shape exp(s t)], s = growth + i omega.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// omega / (2 pi), Hz, >= 0; 0 for rigid motion and for divergence.
    pub frequency_hz: f64,
    /// Real part of s, 1/s: negative dies out, positive grows. Of the pair of roots +s and -s that an undamped system
    /// has, the growing one.
    pub growth: f64,
    /// Shape in the mechanism's coordinates, the kinetic energy of a unit amplitude's velocity one half (shape* M shape
    /// = 1).
    pub shape: DVector<Complex<f64>>,
}

impl Mode {
    /// Growing oscillation: two modes have merged and feed on a force that is not conservative.
    pub fn flutters(&self) -> bool {
        self.growth > 0.0 && self.frequency_hz > 0.0
    }

    /// Damping ratio -growth / |s|; 0 for rigid motion.
    pub fn damping_ratio(&self) -> f64 {
        let size = self.growth.hypot(TAU * self.frequency_hz);
        if size > 0.0 { -self.growth / size } else { 0.0 }
    }
}

/// Stiffness -df/dq and damping -df/dv of a mechanism at a state.
///
/// # Errors
/// The system's own.
pub fn linearised<M: Mechanism>(
    system: &mut M,
    t: f64,
    q: &DVector<f64>,
) -> Result<(DMatrix<f64>, DMatrix<f64>), M::Error> {
    let mut forces = Forces::zeros(q.len());
    system.forces(t, q, &DVector::zeros(q.len()), &mut forces)?;
    Ok((forces.stiffness, forces.damping))
}

/// Undamped modes of M x'' + K x = 0, ascending in frequency; `None` unless M is symmetric positive definite and K of
/// the same size holds numbers.
///
/// ```text
/// (K - omega^2 M) shape = 0,   s = i omega
/// ```
/// K may be non-symmetric. While all omega^2 are real and positive every motion is bounded. Friction follows the normal
/// force and not its own displacement, so it makes K non-symmetric: pairs of omega^2 can merge and turn complex, and
/// then one of the two roots grows (flutter); a negative omega^2 is divergence.
pub fn undamped_modes(mass: &DMatrix<f64>, stiffness: &DMatrix<f64>) -> Option<Vec<Mode>> {
    let inverse = inverse_root(mass, &[stiffness])?;
    let scaled = &inverse * stiffness * inverse.transpose();
    let values = eigenvalues(&scaled)?;
    let largest = values.iter().map(|l| l.norm()).fold(0.0, f64::max);
    let mut modes: Vec<Mode> = values
        .iter()
        // Complex eigenvalues come in pairs that stand for the same four roots.
        .filter(|l| l.im >= -REAL * largest)
        .map(|&value| {
            let value = if value.im.abs() <= REAL * largest { Complex::new(value.re, 0.0) } else { value };
            let value = if value.norm() <= REAL * largest { Complex::new(0.0, 0.0) } else { value };
            // s^2 = -omega^2; of +-s the growing root.
            let root = (-value).sqrt();
            let s = if root.re < 0.0 { -root } else { root };
            let s = if value.im == 0.0 && value.re > 0.0 { Complex::new(0.0, value.re.sqrt()) } else { s };
            let shape = shape(&inverse, &scaled, value, largest);
            // The motion is told by the root with positive imaginary part.
            let shape = if s.im < 0.0 { shape.conjugate() } else { shape };
            Mode { frequency_hz: s.im.abs() / TAU, growth: s.re, shape }
        })
        .collect();
    sort(&mut modes);
    Some(modes)
}

/// Damped modes of M x'' + C x' + K x = 0, ascending in frequency: roots with non-negative imaginary part, n for n
/// coordinates where all oscillate.
///
/// Overdamped motion has two real roots, both listed with frequency 0. `None` as for [`undamped_modes`].
pub fn damped_modes(mass: &DMatrix<f64>, damping: &DMatrix<f64>, stiffness: &DMatrix<f64>) -> Option<Vec<Mode>> {
    let n = mass.nrows();
    let inverse = inverse_root(mass, &[damping, stiffness])?;
    let [c, k] = [damping, stiffness].map(|a| &inverse * a * inverse.transpose());
    // Time in the scale of the highest frequency: both blocks of the companion matrix of one size.
    let unit = k.amax().sqrt().max(c.amax()).max(f64::MIN_POSITIVE);
    let mut companion = DMatrix::zeros(2 * n, 2 * n);
    companion.view_mut((0, n), (n, n)).copy_from(&DMatrix::identity(n, n));
    companion.view_mut((n, 0), (n, n)).copy_from(&(-&k / (unit * unit)));
    companion.view_mut((n, n), (n, n)).copy_from(&(-&c / unit));
    let mut modes: Vec<Mode> = eigenvalues(&companion)?
        .iter()
        .filter(|s| s.im >= 0.0)
        .map(|&s| {
            let s = s * unit;
            let dynamic = k.map(|x| Complex::new(x, 0.0)) + c.map(|x| s * x);
            let raw = null_vector(dynamic + DMatrix::identity(n, n) * (s * s), unit * unit);
            Mode {
                frequency_hz: s.im / TAU,
                growth: s.re,
                shape: inverse.transpose().map(|x| Complex::new(x, 0.0)) * raw,
            }
        })
        .collect();
    sort(&mut modes);
    Some(modes)
}

/// L^-1 with M = L L'; `None` where there is none, or where the other matrices are of another size.
fn inverse_root(mass: &DMatrix<f64>, others: &[&DMatrix<f64>]) -> Option<DMatrix<f64>> {
    let n = mass.nrows();
    if n == 0 || mass.ncols() != n || others.iter().any(|a| a.shape() != (n, n)) {
        return None;
    }
    Cholesky::<f64, Dyn>::new(mass.clone())?.l().solve_lower_triangular(&DMatrix::identity(n, n))
}

/// Eigenvalues of a real matrix; those of a symmetric one by the method that keeps them real.
fn eigenvalues(a: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    if !a.iter().all(|x| x.is_finite()) {
        return None;
    }
    let asymmetry = (a - a.transpose()).amax();
    if asymmetry <= 1e-14 * a.amax() {
        let symmetric = 0.5 * (a + a.transpose());
        return Some(symmetric.symmetric_eigenvalues().iter().map(|&x| Complex::new(x, 0.0)).collect());
    }
    Some(integrate::eigenvalues(a.clone())?.iter().copied().collect())
}

fn shape(inverse: &DMatrix<f64>, scaled: &DMatrix<f64>, value: Complex<f64>, largest: f64) -> DVector<Complex<f64>> {
    let n = scaled.nrows();
    let matrix = scaled.map(|x| Complex::new(x, 0.0)) - DMatrix::identity(n, n) * value;
    inverse.transpose().map(|x| Complex::new(x, 0.0)) * null_vector(matrix, largest)
}

/// Unit vector that a nearly singular matrix takes to (nearly) nothing: inverse iteration a little beside the
/// eigenvalue.
fn null_vector(matrix: DMatrix<Complex<f64>>, size: f64) -> DVector<Complex<f64>> {
    let n = matrix.nrows();
    // Unequal entries, so that the start is orthogonal to no vector of a symmetric structure.
    let mut x = DVector::from_fn(n, |i, _| Complex::new(1.0 + 0.37 * i as f64, 0.0));
    let beside = matrix + DMatrix::identity(n, n) * Complex::new(1e-11 * size.max(f64::MIN_POSITIVE), 0.0);
    let lu = LU::<Complex<f64>, Dyn, Dyn>::new(beside);
    for _ in 0..3 {
        match lu.solve(&x) {
            Some(y) if y.iter().all(|v| v.re.is_finite() && v.im.is_finite()) => x = y.scale(1.0 / y.norm()),
            _ => break,
        }
    }
    x.scale(1.0 / x.norm())
}

fn sort(modes: &mut [Mode]) {
    modes.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz).then(a.growth.total_cmp(&b.growth)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;

    /// Two masses, three springs: 1 and sqrt(3) rad/s, in phase and against each other.
    #[test]
    fn chain_of_two() {
        let m = DMatrix::identity(2, 2);
        let modes = undamped_modes(&m, &dmatrix![2.0, -1.0; -1.0, 2.0]).unwrap();
        for (mode, (omega, ratio)) in modes.iter().zip([(1.0, 1.0), (3f64.sqrt(), -1.0)]) {
            assert!((TAU * mode.frequency_hz - omega).abs() < 1e-12 && mode.growth == 0.0);
            assert!(((mode.shape[1] / mode.shape[0]).re - ratio).abs() < 1e-9, "{}", mode.shape);
        }
    }

    /// k(1 -+ d) with coupling +-c: omega^2 = k +- sqrt(d^2 - c^2), complex when c > d; growth from the closed form.
    #[test]
    fn circulatory_coupling_flutters_beyond_the_split() {
        let m = DMatrix::identity(2, 2);
        let of = |c: f64| undamped_modes(&m, &dmatrix![101.0, c; -c, 99.0]).unwrap();
        assert!(of(0.9).iter().all(|mode| !mode.flutters()));
        let fluttering = of(2.0);
        let s = (-Complex::new(100.0, 3f64.sqrt())).sqrt();
        assert_eq!(fluttering.iter().filter(|mode| mode.flutters()).count(), 1);
        assert!((fluttering[0].growth - s.re.abs()).abs() < 1e-12, "{:?}", fluttering[0]);
    }

    /// Damping ratio of a single mass, and both roots of an overdamped one.
    #[test]
    fn damping_of_one_mass() {
        let one = |c: f64| damped_modes(&dmatrix![2.0], &dmatrix![c], &dmatrix![8.0]).unwrap();
        let modes = one(0.8);
        assert!(modes.len() == 1 && (modes[0].damping_ratio() - 0.1).abs() < 1e-12, "{modes:?}");
        assert!((TAU * modes[0].frequency_hz - 2.0 * 0.99f64.sqrt()).abs() < 1e-12);
        assert_eq!(one(20.0).len(), 2);
        assert!(undamped_modes(&dmatrix![1.0], &DMatrix::zeros(2, 2)).is_none());
        assert!(undamped_modes(&dmatrix![-1.0], &dmatrix![1.0]).is_none());
        assert!(undamped_modes(&dmatrix![1.0], &dmatrix![f64::NAN]).is_none());
    }
}
