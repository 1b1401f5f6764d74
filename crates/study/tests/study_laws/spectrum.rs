//! What a spectrum must say of sines, wherever they lie between the bins.

use std::f64::consts::TAU;

use study::{StudyError, Window, scalloping_loss, spectrum};

const WINDOWS: [Window; 4] = [Window::Rectangular, Window::Hann, Window::BlackmanHarris, Window::FlatTop];
const RATE: f64 = 1000.0;

fn record(n: usize, f: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..n).map(|k| f(k as f64 / RATE)).collect()
}

/// A sine of amplitude A on a bin reads A there with every window, for even and odd lengths; the mean reads the mean.
#[test]
fn a_sine_on_a_bin_reads_its_amplitude() {
    for window in WINDOWS {
        for n in [500, 501] {
            let f = 40.0 * RATE / n as f64;
            let s = spectrum(&record(n, |t| 7.0 + 0.25 * (TAU * f * t + 0.3).sin()), RATE, window).unwrap();
            let (at, mean) = (s.amplitudes[40], s.mean);
            assert!((at - 0.25).abs() < 1e-12 && (mean - 7.0).abs() < 1e-12, "{window:?}, n {n}: {at}, mean {mean}");
            assert_eq!(s.amplitudes.len(), n / 2 + 1);
        }
    }
}

/// Off the bins: interpolated amplitude within 1e-3 and frequency within a thousandth of a bin, for every window that
/// tapers; without a taper leakage of the negative frequency is left, some 1 % at 40 bins.
#[test]
fn a_sine_off_the_bins_reads_its_amplitude_too() {
    for window in WINDOWS {
        let allowed = if window == Window::Rectangular { 1.5e-2 } else { 1e-3 };
        for shift in [0.1, 0.25, 0.5, 0.77] {
            let f = (40.0 + shift) * RATE / 500.0;
            let s = spectrum(&record(500, |t| (TAU * f * t + 1.1).sin()), RATE, window).unwrap();
            let peak = s.largest_peak().unwrap();
            let bins = (peak.frequency - f) / s.resolution;
            assert!((peak.amplitude - 1.0).abs() < allowed, "{window:?}, {shift} bins off: {}", peak.amplitude);
            assert!(
                bins.abs() < if window == Window::FlatTop { 0.5 } else { 2.0 * allowed },
                "{window:?}, {shift} bins off: {bins} bins away"
            );
            assert!((s.amplitude_at(f) - 1.0).abs() < allowed);
        }
    }
}

/// What a bin alone reads of a line half a bin off is what the closed form of the window says; the flat top needs no
/// interpolation.
#[test]
fn scalloping_is_that_of_the_window() {
    for window in WINDOWS {
        let f = 100.5 * RATE / 2000.0;
        let s = spectrum(&record(2000, |t| (TAU * f * t).cos()), RATE, window).unwrap();
        let read = s.amplitudes[100].max(s.amplitudes[101]);
        let wanted = 1.0 - scalloping_loss(window);
        assert!((read / wanted - 1.0).abs() < 6e-3, "{window:?}: {read}, not {wanted}");
    }
    assert!(scalloping_loss(Window::FlatTop).abs() < 2e-3 && (scalloping_loss(Window::Hann) - 0.1512).abs() < 1e-3);
}

/// Noise: power over the noise bandwidth is the variance.
#[test]
fn noise_keeps_its_power() {
    let mut seed = 12345u64;
    let mut noise = move |_: usize| {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let x: Vec<f64> = (0..20_000).map(&mut noise).collect();
    for window in WINDOWS {
        let s = spectrum(&x, RATE, window).unwrap();
        let power: f64 = s.amplitudes.iter().map(|a| 0.5 * a * a).sum::<f64>() / window.noise_bandwidth();
        assert!((power * 12.0 - 1.0).abs() < 0.05, "{window:?}: {} of the variance", power * 12.0);
    }
}

/// Amplitude modulation: a carrier with sidebands at the shaft frequency, m/2 of it each, none where there are none.
#[test]
fn sidebands_are_found_at_the_shaft_frequency() {
    let (carrier, shaft, depth) = (203.7, 11.13, 0.08);
    let wave = |t: f64| (1.0 + depth * (TAU * shaft * t).cos()) * (TAU * carrier * t).sin();
    for window in [Window::Hann, Window::BlackmanHarris] {
        let s = spectrum(&record(4000, wave), RATE, window).unwrap();
        let found = s.sidebands(carrier, shaft, 3).unwrap();
        assert!((found.carrier.amplitude - 1.0).abs() < 1e-3 && (found.carrier.frequency - carrier).abs() < 1e-2);
        for side in found.pairs[0] {
            assert!((side.amplitude / (0.5 * depth) - 1.0).abs() < 0.02, "{window:?}: {side:?}");
        }
        for side in found.pairs[1].iter().chain(&found.pairs[2]) {
            assert!(side.amplitude < 2e-4, "{window:?}: {side:?}");
        }
        assert!(found.floor < 1e-4, "{window:?}: floor {}", found.floor);
        assert!(matches!(s.sidebands(carrier, 0.5, 1), Err(StudyError::Unresolved { .. })));
    }
}

/// Sidebands five bins apart, each a thousand times what stands between them: the floor is of the bins that hold no
/// line, and of these the middle one.
#[test]
fn the_floor_is_what_lines_stand_out_of() {
    let n = 4000;
    let (carrier, spacing) = (800.0 * RATE / f64::from(n), 5.0 * RATE / f64::from(n));
    let mut seed = 777u64;
    let mut noise = move || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let deviation = 1e-2;
    let wave = |t: f64| -> f64 {
        (-40..=40).map(|k| 0.1 * (TAU * (carrier + f64::from(k) * spacing) * t + 0.7 * f64::from(k * k)).sin()).sum()
    };
    let samples: Vec<f64> = record(n as usize, wave).into_iter().map(|x| x + deviation * noise()).collect();
    let window = Window::Hann;
    let found = spectrum(&samples, RATE, window).unwrap().sidebands(carrier, spacing, 40).unwrap();
    assert!(found.pairs.iter().flatten().all(|side| (side.amplitude / 0.1 - 1.0).abs() < 0.02), "{found:?}");
    // Rayleigh: the square of the median is ln 2 of the mean square, 4 sigma^2 (1/12 for the noise) times the window's
    // bandwidth over n. Eighty bins: a tenth.
    let mean_square = 4.0 / 12.0 * deviation * deviation * window.noise_bandwidth() / f64::from(n);
    let wanted = (2f64.ln() * mean_square).sqrt();
    assert!((found.floor / wanted - 1.0).abs() < 0.3, "floor {:e}, of the noise {wanted:e}", found.floor);
}

/// At half of the sampling a cosine is in one bin alone, whole; so is what the mean leaves at 0.
#[test]
fn the_last_bin_reads_the_whole_amplitude() {
    let samples: Vec<f64> = (0..64).map(|k| 3.0 + if k % 2 == 0 { 0.5 } else { -0.5 }).collect();
    let found = spectrum(&samples, RATE, Window::Rectangular).unwrap();
    assert!((found.amplitudes[32] - 0.5).abs() < 1e-12, "{}", found.amplitudes[32]);
    assert!(found.amplitudes[..32].iter().all(|a| *a < 1e-12), "{:?}", found.amplitudes);
}

/// The bandwidth is that of the weights: n sum w^2 / (sum w)^2, and of Hann's three halves of a bin.
#[test]
fn noise_bandwidth_is_that_of_the_weights() {
    assert_eq!(Window::Rectangular.noise_bandwidth(), 1.0);
    assert!((Window::Hann.noise_bandwidth() - 1.5).abs() < 1e-12);
    // Harris's table 1: 2.00 bins.
    assert!((Window::BlackmanHarris.noise_bandwidth() - 2.0044).abs() < 1e-4);
    // ISO 18431-2: 3.77 bins.
    assert!((Window::FlatTop.noise_bandwidth() - 3.7702).abs() < 1e-3, "{}", Window::FlatTop.noise_bandwidth());
}

/// Several lines at once, each at its place with its amplitude; ascending.
#[test]
fn lines_are_listed_where_they_are() {
    let lines = [(50.3, 1.0), (120.0, 0.1), (333.3, 0.01)];
    let wave = |t: f64| lines.iter().map(|(f, a)| a * (TAU * f * t + f).sin()).sum();
    let peaks = spectrum(&record(3000, wave), RATE, Window::BlackmanHarris).unwrap().peaks(0.005);
    assert_eq!(peaks.len(), 3, "{peaks:?}");
    for (peak, (f, a)) in peaks.iter().zip(lines) {
        assert!((peak.frequency - f).abs() < 1e-2 && (peak.amplitude / a - 1.0).abs() < 1e-3, "{peak:?}");
    }
}

#[test]
fn what_is_no_record_is_refused() {
    assert_eq!(spectrum(&[1.0; 7], 1.0, Window::Hann), Err(StudyError::TooFewSamples { samples: 7, least: 8 }));
    let mut x = [0.0; 16];
    x[3] = f64::NAN;
    assert!(matches!(spectrum(&x, 1.0, Window::Hann), Err(StudyError::NotFinite { index: 3, .. })));
    assert!(spectrum(&[0.0; 16], 0.0, Window::Hann).is_err());
    assert!(spectrum(&[0.0; 16], 1.0, Window::Hann).unwrap().peaks(1e-9).is_empty());
}
