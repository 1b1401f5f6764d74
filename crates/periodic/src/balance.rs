//! The equations of a periodic motion: balance of its harmonics.

use std::f64::consts::TAU;

use integrate::Forces;
use nalgebra::{DMatrix, DVector};

use crate::{
    FourierSeries, PeriodicError, PeriodicFamily,
    product::{SeriesTransform, Wave},
    series::Basis,
};

/// Forces and tangents over a period, and what is left of the equations of motion. Theory (69).
///
/// ```text
/// R(c) = w^2 M c'' - P f(t, q, w q'),   w = 2 pi / T
/// ```
/// f is evaluated at N equal phases and projected (P) onto the harmonics (alternating frequency and time; Cameron and
/// Griffin, J. Appl. Mech. 56, 1989). Rows are multiplied by the scale of their coordinate, and unknowns divided by it,
/// so that all are energies.
#[derive(Debug, Clone)]
pub(crate) struct Balance {
    /// n x (2 H + 1), scaled.
    pub residual: DMatrix<f64>,
    /// Size of the terms that balance.
    pub size: f64,
    /// Bound of the motion that the harmonics leave out, over the vibration.
    pub tail: f64,
    /// -df/dq and -df/dv at each phase; empty where they were not asked for.
    pub stiffness: Vec<DMatrix<f64>>,
    pub damping: Vec<DMatrix<f64>>,
}

/// Evaluates the equations at a motion.
pub(crate) fn balance<S: PeriodicFamily>(
    system: &mut S,
    parameter: f64,
    motion: &FourierSeries,
    basis: &Basis,
    tangents: bool,
) -> Result<Balance, PeriodicError<S::Error>> {
    let (n, count) = (motion.coordinates(), basis.samples());
    let frequency = TAU / system.period();
    // Samples stand one under the other: so the products run down columns.
    let coefficients = motion.coefficients().transpose();
    let places = basis.values() * &coefficients;
    let rates = basis.rates() * (coefficients * frequency);
    let mut forces = DMatrix::zeros(count, n);
    let mut out = Forces::zeros(n);
    let (mut stiffness, mut damping) = (Vec::new(), Vec::new());
    for i in 0..count {
        let phase = i as f64 / count as f64;
        out.clear();
        out.tangents = tangents;
        let (q, v): (DVector<f64>, DVector<f64>) = (places.row(i).transpose(), rates.row(i).transpose());
        system.forces(phase * system.period(), &q, &v, &mut out).map_err(|source| PeriodicError::Mechanism {
            parameter,
            phase,
            source,
        })?;
        (0..n).for_each(|k| forces[(i, k)] = out.total(k));
        if tangents {
            stiffness.push(out.stiffness.clone());
            damping.push(out.damping.clone());
        }
    }
    let inertia = system.mass() * accelerations(motion.coefficients(), frequency);
    let mut residual = &inertia - basis.projection().tr_mul(&forces).transpose();
    let scale = system.scale();
    let per_sample = (count as f64).sqrt();
    // In time, what is left holds all harmonics that the samples show; those of the equations are taken away.
    let beyond = basis.values() * (&inertia - &residual).transpose() - &forces;
    let tail = neglected(system, motion, beyond.transpose(), frequency) / per_sample;
    scale_rows(&mut residual, &scale);
    let norm = |mut terms: DMatrix<f64>| {
        scale_rows(&mut terms, &scale);
        terms.norm()
    };
    let size = norm(inertia) + norm(forces.transpose()) / per_sample;
    Ok(Balance { residual, size, tail, stiffness, damping })
}

/// dR/dw at fixed harmonics, scaled, where forces know the frequency by the velocities alone:
///
/// ```text
/// dR/dw = 2 w M c'' + P D q'
/// ```
/// Gyroscopic forces, which grow with the speed as well, are left out: they are small beside these, and the derivative
/// only leads the steps.
pub(crate) fn frequency_derivative<S: PeriodicFamily>(
    system: &S,
    motion: &FourierSeries,
    basis: &Basis,
    at: &Balance,
) -> DMatrix<f64> {
    let frequency = TAU / system.period();
    let coefficients = motion.coefficients();
    let rates = basis.rates() * coefficients.transpose();
    let mut damped = DMatrix::zeros(rates.nrows(), rates.ncols());
    for (i, damping) in at.damping.iter().enumerate() {
        damped.set_row(i, &(damping * rates.row(i).transpose()).transpose());
    }
    let inertia = system.mass() * accelerations(coefficients, frequency) * (2.0 / frequency);
    let mut all = inertia + basis.projection().tr_mul(&damped).transpose();
    scale_rows(&mut all, &system.scale());
    all
}

/// Bound of the motion that harmonics above H would add, over the vibration: forces beyond them over the inertia at the
/// first that is left out. Summed over the samples.
fn neglected<S: PeriodicFamily>(system: &S, motion: &FourierSeries, beyond: DMatrix<f64>, frequency: f64) -> f64 {
    let scale = system.scale().map(|s| 1.0 / s);
    let Some(mass) = system.mass().clone().cholesky() else { return f64::INFINITY };
    let mut added = mass.solve(&beyond) / (frequency * (motion.harmonics() + 1) as f64).powi(2);
    scale_rows(&mut added, &scale);
    let mut vibration = motion.coefficients().clone();
    vibration.column_mut(0).fill(0.0);
    scale_rows(&mut vibration, &scale);
    let size = vibration.norm() / 2f64.sqrt();
    if size > 0.0 { added.norm() / size } else { 0.0 }
}

/// dR/dc, scaled: (harmonic, coordinate) by (harmonic, coordinate), harmonics outermost.
pub(crate) fn jacobian<S: PeriodicFamily>(system: &S, basis: &Basis, at: &Balance) -> DMatrix<f64> {
    let (n, scale) = (system.mass().nrows(), system.scale());
    let frequency = TAU / system.period();
    let columns = 2 * basis.harmonics() + 1;
    let mut all = DMatrix::zeros(n * columns, n * columns);
    let mut transform = SeriesTransform::new(basis.samples());
    for i in 0..n {
        for j in 0..n {
            let scaled = scale[i] * scale[j];
            if let Some(stiffness) = transform.of(&at.stiffness, (i, j), scaled) {
                for l in 0..columns {
                    for k in 0..columns {
                        all[(k * n + i, l * n + j)] += stiffness.projected(k, Wave::of(l));
                    }
                }
            }
            if let Some(damping) = transform.of(&at.damping, (i, j), frequency * scaled) {
                for l in 1..columns {
                    let (rate, wave) = Wave::of(l).rate();
                    for k in 0..columns {
                        all[(k * n + i, l * n + j)] += rate * damping.projected(k, wave);
                    }
                }
            }
            for k in 0..columns {
                all[(k * n + i, k * n + j)] -= scaled * (frequency * order(k)).powi(2) * system.mass()[(i, j)];
            }
        }
    }
    all
}

/// Harmonic of a column.
fn order(column: usize) -> f64 {
    column.div_ceil(2) as f64
}

fn accelerations(coefficients: &DMatrix<f64>, frequency: f64) -> DMatrix<f64> {
    let mut all = coefficients.clone();
    for k in 0..all.ncols() {
        all.column_mut(k).scale_mut(-(frequency * order(k)).powi(2));
    }
    all
}

fn scale_rows(matrix: &mut DMatrix<f64>, scale: &DVector<f64>) {
    matrix.row_iter_mut().zip(scale.iter()).for_each(|(mut row, s)| row *= *s);
}
