//! What any spectrum and any mean must obey.

use std::f64::consts::PI;

use study::{StudyError, cycle_statistics, mesh_harmonics};

fn wave(per_cycle: usize, cycles: usize, f: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..per_cycle * cycles).map(|k| f(k as f64 / per_cycle as f64)).collect()
}

/// A sine of amplitude A at mesh order h reads A at h and nothing anywhere else, for any number of cycles.
#[test]
fn a_sine_reads_its_amplitude_without_leakage() {
    for (cycles, order, amplitude) in [(1, 1, 1.0), (3, 2, 0.25), (7, 5, 12.5)] {
        let x = wave(32, cycles, |phase| 10.0 + amplitude * (2.0 * PI * order as f64 * phase).sin());
        for h in mesh_harmonics(&x, cycles, 16).unwrap() {
            let want = if h.order == order { amplitude } else { 0.0 };
            assert!((h.amplitude - want).abs() < 1e-13 * (10.0 + amplitude), "order {}: {}", h.order, h.amplitude);
        }
    }
}

/// Parseval: half the sum of squared amplitudes is the variance (no content at the Nyquist order here).
#[test]
fn harmonics_carry_the_whole_variance() {
    let x = wave(33, 2, |p| (2.0 * PI * p).cos() + 0.3 * (6.0 * PI * p).sin() + (4.0 * (2.0 * PI * p).sin()).tanh());
    let mean = cycle_statistics(&x, 2).unwrap().mean;
    let variance = x.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / x.len() as f64;
    let carried: f64 = mesh_harmonics(&x, 2, 16).unwrap().iter().map(|h| 0.5 * h.amplitude.powi(2)).sum();
    assert!((carried - variance).abs() < 1e-12 * variance, "{carried} of {variance}");
}

/// The cosine with the returned amplitudes and phases is the history again.
#[test]
fn amplitudes_and_phases_rebuild_the_history() {
    let x = wave(15, 1, |p| (3.0 * (2.0 * PI * p).sin()).exp());
    let mean = cycle_statistics(&x, 1).unwrap().mean;
    let harmonics = mesh_harmonics(&x, 1, 7).unwrap();
    for (k, &value) in x.iter().enumerate() {
        let p = k as f64 / 15.0;
        let sum: f64 =
            harmonics.iter().map(|h| h.amplitude * (2.0 * PI * h.order as f64 * p + h.phase_rad).cos()).sum();
        assert!((mean + sum - value).abs() < 1e-12, "sample {k}: {} for {value}", mean + sum);
    }
}

/// A shift of phase changes no amplitude, a shift of level only the mean.
#[test]
fn mean_and_extent_follow_level_and_not_phase() {
    let x = wave(24, 4, |p| 2.0 + (2.0 * PI * p).sin());
    let s = cycle_statistics(&x, 4).unwrap();
    assert!((s.mean - 2.0).abs() < 1e-14 && (s.peak_to_peak - 2.0).abs() < 1e-14);
    assert_eq!((s.samples_per_cycle, s.cycles), (24, 4));
    let lifted: Vec<f64> = x.iter().map(|v| v + 5.0).collect();
    let t = cycle_statistics(&lifted, 4).unwrap();
    assert!((t.mean - s.mean - 5.0).abs() < 1e-13 && (t.peak_to_peak - s.peak_to_peak).abs() < 1e-13);
}

/// The order at half the sampling exists once: an alternating history of amplitude 1 reads 1.
#[test]
fn the_nyquist_order_is_not_doubled() {
    let h = mesh_harmonics(&[1.0, -1.0, 1.0, -1.0], 1, 9).unwrap();
    assert_eq!(h.len(), 2);
    assert!(h[0].amplitude.abs() < 1e-15 && (h[1].amplitude - 1.0).abs() < 1e-15);
}

#[test]
fn a_history_that_is_no_whole_cycle_is_refused() {
    assert_eq!(cycle_statistics(&[], 1), Err(StudyError::NotWholeCycles { samples: 0, cycles: 1 }));
    assert_eq!(cycle_statistics(&[1.0; 5], 2), Err(StudyError::NotWholeCycles { samples: 5, cycles: 2 }));
    assert_eq!(cycle_statistics(&[1.0; 5], 0), Err(StudyError::NotWholeCycles { samples: 5, cycles: 0 }));
    let bad = mesh_harmonics(&[1.0, f64::NAN], 1, 1);
    assert!(matches!(bad, Err(StudyError::NotFinite { index: 1, .. })));
}
