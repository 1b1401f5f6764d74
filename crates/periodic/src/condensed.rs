//! Periodic motions of a linear machine with forces at few places, all other coordinates eliminated.

use std::f64::consts::TAU;

use integrate::Forces;
use nalgebra::{Complex, DMatrix, DVector};

use crate::{
    Floquet, FourierSeries, LinearMachine, PeriodicError,
    balance::{force_slopes, over_vibration, scale_rows},
    equations::{Balance, PeriodicEquations},
    linear_machine::{ModalMachine, Receptance},
    modal_flow::ModalFlow,
    product::SeriesTransform,
    series::Basis,
};

/// A linear machine with forces at few places, over the angular frequency of its period.
pub trait CondensedFamily {
    /// Error of an evaluation of forces.
    type Error;

    /// w / p: angular frequency of the period (rad/s) over the parameter.
    fn frequency_slope(&self) -> f64;

    /// What counts as a large value of each s, > 0.
    fn scale(&self) -> DVector<f64>;

    /// f at a `share` of the period (0 .. 1), with the period's angular frequency, s and s'; -df/ds and -df/ds' where `out`
    /// asks for them.
    ///
    /// # Errors
    /// The system's own.
    fn forces(
        &mut self,
        share: f64,
        frequency: f64,
        s: &DVector<f64>,
        rate: &DVector<f64>,
        out: &mut Forces,
    ) -> Result<(), Self::Error>;
}

/// Step of the frequency for the derivative of forces, relative.
const DIFFERENCE: f64 = 1e-6;

/// The equations of the few harmonics of s. Theory (71a).
///
/// ```text
/// s_k = H(k w) (f_k + k_0 s_k) + s_p,   H(k w) = B' Z(k w)^-1 B,   Z = K + B k_0 B' - (k w)^2 M + i k w (C + w G)
/// ```
/// s_p: s under the load p alone (k = 0). Exact for any number of coordinates; unknowns are (2 H + 1) m.
pub struct Condensed<S> {
    family: S,
    machine: ModalMachine,
    /// k_0.
    reference: DMatrix<f64>,
    frequency: f64,
    /// At the harmonics 0, 1, 2 .. of the frequency, as far as they were asked for.
    receptances: Vec<Receptance>,
}

impl<S: CondensedFamily> Condensed<S> {
    /// Equations of a family of forces on a machine. `None` where the machine's masses, or its stiffness with k_0, are not
    /// positive definite.
    pub fn new(family: S, machine: &LinearMachine) -> Option<Self> {
        let reference = machine.reference.clone();
        let modal = ModalMachine::new(machine)?;
        Some(Self { family, machine: modal, reference, frequency: 1.0, receptances: Vec::new() })
    }

    /// The forces.
    pub fn family(&mut self) -> &mut S {
        &mut self.family
    }

    /// Series of s at rest under the load, forces being those of k_0.
    pub fn rest(&self) -> FourierSeries {
        FourierSeries::at_rest(&self.machine.rest, 1)
    }

    /// All coordinates z of a motion at a value of the parameter.
    ///
    /// # Errors
    /// Those of the forces.
    pub fn whole(&mut self, motion: &PeriodicMotionOf<'_>) -> Result<FourierSeries, PeriodicError<S::Error>> {
        let PeriodicMotionOf { parameter, series, samples } = *motion;
        let at = |source| PeriodicError::Mechanism { parameter, phase: 0.0, source };
        self.set_parameter(parameter).map_err(at)?;
        let basis = Basis::new(series.harmonics(), samples);
        let balance = self.balance(parameter, series, &basis, false)?;
        let driven = self.driven(series, &balance);
        let mut modes = DMatrix::zeros(self.machine.squares.len(), driven.ncols());
        for k in 0..=series.harmonics() {
            let of_harmonic = times(&self.receptances[k].modes, &driven, k);
            of_harmonic.iter().enumerate().for_each(|(column, own)| modes.set_column(first(k) + column, own));
        }
        let mut mean = modes.column_mut(0);
        mean += self.machine.load.component_div(&self.machine.squares);
        Ok(FourierSeries::from_coefficients(&self.machine.shapes * modes))
    }

    /// Multipliers of a motion with all modes of the machine, those beyond [`LinearMachine::highest`] among them.
    ///
    /// # Errors
    /// Those of the forces; [`PeriodicError::Singular`] where disturbances have no equation.
    pub fn with_all_modes(&mut self, motion: &PeriodicMotionOf<'_>) -> Result<Floquet, PeriodicError<S::Error>> {
        let PeriodicMotionOf { parameter, series, samples } = *motion;
        let at = |source| PeriodicError::Mechanism { parameter, phase: 0.0, source };
        self.set_parameter(parameter).map_err(at)?;
        let balance = self.balance(parameter, series, &Basis::new(series.harmonics(), samples), true)?;
        self.multipliers(self.machine.squares.len(), &balance).ok_or(PeriodicError::Singular { parameter })
    }

    /// Multipliers with the lowest so many modes.
    fn multipliers(&self, modes: usize, at: &Balance) -> Option<Floquet> {
        let flow = ModalFlow::new(&self.machine, modes, self.frequency, at.stiffness.len())?;
        flow.floquet(at, &self.reference)
    }

    /// Motion that harmonics beyond those of the equations would add, over the vibration: what they leave of the forces on
    /// the machine.
    ///
    /// ```text
    /// s_k = H(k w) f_k,   k = H + 1 .. N/2
    /// ```
    fn tail(&self, samples: DMatrix<f64>, motion: &FourierSeries, scale: &DVector<f64>) -> f64 {
        let count = samples.nrows();
        let mut transform = SeriesTransform::new(count);
        let sums: Option<Vec<_>> = samples.column_iter().map(|own| transform.sums(own.iter().copied())).collect();
        let Some(sums) = sums else { return f64::INFINITY };
        let of = |k: usize| {
            let forces = DVector::from_iterator(sums.len(), sums.iter().map(|own| own[k]));
            let added = self.machine.uncoupled((k, self.frequency), &forces);
            added.iter().zip(scale.iter()).map(|(s, size)| s.norm_sqr() / (size * size)).sum::<f64>()
        };
        // Root mean square in time: a sum of N samples is N/2 times its amplitude.
        let added: f64 = (motion.harmonics() + 1..=count / 2).map(of).sum();
        over_vibration((2.0 * added).sqrt() / count as f64, motion, scale)
    }

    /// f_k + k_0 s_k.
    fn driven(&self, motion: &FourierSeries, at: &Balance) -> DMatrix<f64> {
        &at.forces + &self.reference * motion.coefficients()
    }

    /// Finds the receptances up to a harmonic.
    fn prepare(&mut self, harmonics: usize, parameter: f64) -> Result<(), PeriodicError<S::Error>> {
        for k in self.receptances.len()..=harmonics {
            let found = self.machine.receptance(k, self.frequency).ok_or(PeriodicError::Singular { parameter })?;
            self.receptances.push(found);
        }
        Ok(())
    }

    /// P f and its samples, forces at a frequency and the motion in units of the period.
    fn forces(
        &mut self,
        (parameter, frequency): (f64, f64),
        motion: &FourierSeries,
        basis: &Basis,
        mut seen: impl FnMut(&Forces),
        tangents: bool,
    ) -> Result<[DMatrix<f64>; 2], PeriodicError<S::Error>> {
        let (m, count) = (motion.coordinates(), basis.samples());
        let coefficients = motion.coefficients().transpose();
        let (places, rates) = (basis.values() * &coefficients, basis.rates() * (coefficients * frequency));
        let mut samples = DMatrix::zeros(count, m);
        let mut out = Forces::zeros(m);
        for i in 0..count {
            let phase = i as f64 / count as f64;
            out.clear();
            out.tangents = tangents;
            let (s, rate) = (places.row(i).transpose(), rates.row(i).transpose());
            let found = self.family.forces(phase, frequency, &s, &rate, &mut out);
            found.map_err(|source| PeriodicError::Mechanism { parameter, phase, source })?;
            (0..m).for_each(|k| samples[(i, k)] = out.total(k));
            seen(&out);
        }
        Ok([basis.projection().tr_mul(&samples).transpose(), samples])
    }
}

/// A motion of a [`Condensed`] system whose other coordinates are asked for.
#[derive(Debug, Clone, Copy)]
pub struct PeriodicMotionOf<'a> {
    /// Value of the parameter.
    pub parameter: f64,
    /// s over the period.
    pub series: &'a FourierSeries,
    /// Phases at which forces are evaluated.
    pub samples: usize,
}

impl<S: CondensedFamily> PeriodicEquations for Condensed<S> {
    type Error = S::Error;

    fn set_parameter(&mut self, value: f64) -> Result<(), S::Error> {
        let frequency = value * self.family.frequency_slope();
        if frequency != self.frequency {
            self.frequency = frequency;
            self.receptances.clear();
        }
        Ok(())
    }

    fn period(&self) -> f64 {
        TAU / self.frequency
    }

    fn scale(&self) -> DVector<f64> {
        self.family.scale()
    }

    fn balance(
        &mut self,
        parameter: f64,
        motion: &FourierSeries,
        basis: &Basis,
        tangents: bool,
    ) -> Result<Balance, PeriodicError<S::Error>> {
        self.prepare(motion.harmonics(), parameter)?;
        let (mut stiffness, mut damping) = (Vec::new(), Vec::new());
        let seen = |out: &Forces| {
            if tangents {
                stiffness.push(out.stiffness.clone());
                damping.push(out.damping.clone());
            }
        };
        let [forces, samples] = self.forces((parameter, self.frequency), motion, basis, seen, tangents)?;
        let scale = self.family.scale();
        let tail = self.tail(samples, motion, &scale);
        let mut at = Balance { residual: DMatrix::zeros(0, 0), size: 0.0, tail, forces, stiffness, damping };
        let driven = self.driven(motion, &at);
        let mut answer = DMatrix::zeros(driven.nrows(), driven.ncols());
        for k in 0..=motion.harmonics() {
            let of_harmonic = times(&self.receptances[k].value, &driven, k);
            of_harmonic.iter().enumerate().for_each(|(column, own)| answer.set_column(first(k) + column, own));
        }
        let mut mean = answer.column_mut(0);
        mean += &self.machine.rest;
        let inverse = scale.map(|s| 1.0 / s);
        let scaled = |mut terms: DMatrix<f64>| {
            scale_rows(&mut terms, &inverse);
            terms
        };
        at.residual = scaled(motion.coefficients() - &answer);
        at.size = scaled(motion.coefficients().clone()).norm() + scaled(answer).norm();
        Ok(at)
    }

    fn jacobian(&self, basis: &Basis, at: &Balance) -> DMatrix<f64> {
        let scale = self.family.scale();
        let (m, one) = (scale.len(), DVector::from_element(scale.len(), 1.0));
        // P (-df/ds) - k_0, columns in units of the scale.
        let mut slopes = force_slopes(basis, at, self.frequency, [&one, &scale]);
        for column in 0..2 * basis.harmonics() + 1 {
            for i in 0..m {
                for j in 0..m {
                    slopes[(column * m + i, column * m + j)] -= self.reference[(i, j)] * scale[j];
                }
            }
        }
        let mut all = DMatrix::identity(slopes.nrows(), slopes.ncols());
        for k in 0..=basis.harmonics() {
            let (re, im) = (self.receptances[k].value.map(|x| x.re), self.receptances[k].value.map(|x| x.im));
            let own = |column: usize| slopes.rows(column * m, m);
            let parts = match k {
                0 => vec![&re * own(0)],
                _ => {
                    let [cos, sin] = [own(2 * k - 1), own(2 * k)];
                    vec![&re * cos + &im * sin, &re * sin - &im * cos]
                }
            };
            for (column, mut part) in parts.into_iter().enumerate() {
                scale_rows(&mut part, &scale.map(|s| 1.0 / s));
                let mut rows = all.rows_mut((first(k) + column) * m, m);
                rows += part;
            }
        }
        all
    }

    fn frequency_slope(&self) -> Option<f64> {
        Some(self.family.frequency_slope())
    }

    /// dR/dw = -dH/dw (f + k_0 s) - H df/dw, the latter by a difference: forces are cheap.
    fn frequency_derivative(
        &mut self,
        parameter: f64,
        motion: &FourierSeries,
        basis: &Basis,
        at: &Balance,
    ) -> Result<DMatrix<f64>, PeriodicError<S::Error>> {
        let beside = self.frequency * (1.0 + DIFFERENCE);
        let [after, _] = self.forces((parameter, beside), motion, basis, |_| (), false)?;
        let by_frequency = (after - &at.forces) / (beside - self.frequency);
        let driven = self.driven(motion, at);
        let mut all = DMatrix::zeros(driven.nrows(), driven.ncols());
        for (k, of) in self.receptances.iter().enumerate().take(motion.harmonics() + 1) {
            let own = times(&of.slope, &driven, k).into_iter().zip(times(&of.value, &by_frequency, k));
            own.enumerate().for_each(|(column, (a, b))| all.set_column(first(k) + column, &-(a + b)));
        }
        scale_rows(&mut all, &self.family.scale().map(|s| 1.0 / s));
        Ok(all)
    }

    /// Multipliers of the modes up to [`LinearMachine::highest`].
    fn floquet(&self, _: &Basis, at: &Balance) -> Option<Floquet> {
        self.multipliers(self.machine.known, at)
    }
}

/// First column of a harmonic.
fn first(k: usize) -> usize {
    (2 * k).saturating_sub(1)
}

/// A complex matrix times harmonic k of a series a cos + b sin, that is a - i b: the mean, or cosine and sine.
fn times(matrix: &DMatrix<Complex<f64>>, series: &DMatrix<f64>, k: usize) -> Vec<DVector<f64>> {
    let re = matrix.map(|x| x.re);
    if k == 0 {
        return vec![re * series.column(0)];
    }
    let (im, cos, sin) = (matrix.map(|x| x.im), series.column(2 * k - 1), series.column(2 * k));
    vec![&re * cos + &im * sin, &re * sin - &im * cos]
}
