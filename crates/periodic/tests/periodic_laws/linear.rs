//! What is known exactly: linear vibration, its decay, and the parametric resonance of Mathieu's equation.

use std::{f64::consts::TAU, ops::ControlFlow};

use periodic::{BalanceOptions, BranchOptions, Floquet, FourierSeries, Loss, PeriodicError, PeriodicMotion, Tracer};

use crate::oscillator::{Oscillator, Varied};

fn motion(system: &mut Oscillator, parameter: f64) -> PeriodicMotion {
    let start = system.at_rest();
    Tracer::new(system, BalanceOptions::default(), 1.0).unwrap().motion_at(parameter, &start).unwrap()
}

/// Amplitude F_ah W^2 / |1 - W^2 + 2 i zeta W|, decay exp(-zeta T) a period.
#[test]
fn a_linear_spring_answers_as_it_must() {
    for frequency in [0.3, 0.9, 1.0, 1.7] {
        let zeta = 0.03;
        let found = motion(&mut Oscillator::new(zeta, 0.0, 0.1, 0.05), frequency);
        let wanted = 0.05 * frequency.powi(2) / (1.0 - frequency.powi(2)).hypot(2.0 * zeta * frequency);
        let amplitude = found.series.amplitude(0, 1);
        assert!((amplitude / wanted - 1.0).abs() < 1e-10, "W {frequency}: {amplitude}, not {wanted}");
        assert!((found.series.amplitude(0, 0) - 0.1).abs() < 1e-12, "mean {}", found.series.amplitude(0, 0));
        let decay = (-zeta * TAU / frequency).exp();
        let largest = found.floquet.largest();
        assert!((largest - decay).abs() < 1e-4, "W {frequency}: multiplier {largest}, not {decay}");
    }
}

/// (x - mean) about rest: x'' + 2 zeta x' + (1 + e cos 2 t) x = 0 doubles its period from e = 4 zeta on, up to terms of
/// order zeta^3.
#[test]
fn mathieus_equation_doubles_its_period() {
    let zeta = 0.02;
    let mut system = Oscillator { frequency: 2.0, varied: Varied::Parametric, ..Oscillator::new(zeta, 0.0, 0.0, 0.0) };
    let start = system.at_rest();
    let mut tracer = Tracer::new(&mut system, BalanceOptions::default(), 0.1).unwrap();
    let options = BranchOptions { range: [0.0, 0.2], first_step: 0.01, longest_step: 0.2, most: 50 };
    let branch = tracer.branch(0.0, &start, &options, |_| ControlFlow::Continue(())).unwrap();
    let [only] = &branch.bifurcations[..] else { panic!("{:?}", branch.bifurcations) };
    assert_eq!(only.loss, Loss::PeriodDoubling);
    let at = only.motion.parameter;
    assert!((at / (4.0 * zeta) - 1.0).abs() < 2e-3, "at {at}, not {}", 4.0 * zeta);
}

/// A series goes to samples and back; its parts are those that were put in.
#[test]
fn series_and_samples_are_one() {
    let n = 32;
    let value = |tau: f64| [0.3 + 1.5 * (2.0 * tau).cos(), -0.2 * (3.0 * tau).sin()];
    let samples = nalgebra::DMatrix::from_fn(2, n, |i, k| value(TAU * k as f64 / n as f64)[i]);
    let series = FourierSeries::of_samples(&samples, 5).unwrap();
    for tau in [0.0, 0.4, 2.2, 6.0] {
        let off = series.at(tau) - nalgebra::DVector::from_row_slice(&value(tau));
        assert!(off.amax() < 1e-13, "at {tau}: off by {}", off.amax());
        let difference = (series.at(tau + 1e-6) - series.at(tau - 1e-6)) / 2e-6;
        assert!((series.rate(tau) - difference).amax() < 1e-8, "rate at {tau}");
    }
    assert!((series.amplitude(0, 2) - 1.5).abs() < 1e-13 && (series.amplitude(1, 3) - 0.2).abs() < 1e-13);
    assert!((series.peak_to_peak(&nalgebra::dvector![1.0, 0.0]) - 3.0).abs() < 1e-6);
    assert_eq!(series.with_harmonics(9).with_harmonics(5), series);
    assert!(FourierSeries::of_samples(&samples, 16).is_none(), "32 samples do not tell 16 harmonics");
}

/// What has no answer is an error.
#[test]
fn what_cannot_be_balanced_is_an_error() {
    let start = Oscillator::new(0.0, 0.0, 0.0, 0.0).at_rest();
    // Resonance without damping.
    let mut system = Oscillator::new(0.0, 0.0, 0.0, 1.0);
    let mut tracer = Tracer::new(&mut system, BalanceOptions::default(), 1.0).unwrap();
    let error = tracer.motion_at(1.0, &start).unwrap_err();
    assert!(matches!(error, PeriodicError::Singular { .. } | PeriodicError::NotConverged { .. }), "{error}");
    // A free flight has more harmonics than one.
    let mut system = Oscillator::new(0.05, 1.0, 0.1, 0.05);
    let few = BalanceOptions { harmonics: 1, most_harmonics: 2, ..BalanceOptions::default() };
    let start = system.at_rest();
    let mut tracer = Tracer::new(&mut system, few, 1.0).unwrap();
    let options = BranchOptions { range: [0.5, 1.1], first_step: 0.01, longest_step: 0.03, most: 400 };
    let error = tracer.branch(0.5, &start, &options, |_| ControlFlow::Continue(())).unwrap().broken.unwrap();
    assert!(matches!(error, PeriodicError::Harmonics { harmonics: 2, .. }), "{error}");
    for wrong in [
        BalanceOptions { harmonics: 0, ..few },
        BalanceOptions { most_harmonics: 0, ..few },
        BalanceOptions { samples_per_harmonic: 2, ..few },
    ] {
        assert!(Tracer::new(&mut system, wrong, 1.0).is_err(), "{wrong:?}");
    }
    assert!(Tracer::new(&mut system, few, f64::NAN).is_err());
    assert_eq!(Floquet { multipliers: Vec::new() }.largest(), 0.0);
}
