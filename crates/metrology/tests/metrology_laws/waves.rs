//! Ripple analysis.

use std::f64::consts::TAU;

use geometry::Side;
use metrology::ripple;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::made::{gear, measured};

/// Five waves on the flanks of all teeth, two of them ghost orders, under slopes, crowning, pitch and noise: found again
/// within one per cent, with their phases.
#[test]
fn summed_waves_are_found_again() {
    let gear = gear();
    let waves = [(61u32, 0.3, 0.4), (90, 0.21, 2.0), (120, 0.15, 5.0), (143, 0.11, 3.0), (217, 0.08, 1.0)];
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let noise: Vec<f64> = (0..30 * 480).map(|_| rng.random_range(-0.02..0.02)).collect();
    let next = std::cell::Cell::new(0);
    let all = measured(|tooth, x| {
        let theta = x / gear.base_radius() - TAU * f64::from(tooth) / 30.0;
        let sum: f64 = waves.iter().map(|(o, a, phi)| a * (f64::from(*o) * theta + phi).cos()).sum();
        let i = next.replace(next.get() + 1);
        sum + f64::from(tooth % 5) - 0.3 * x + 0.02 * (x - 15.0).powi(2) + noise[i % noise.len()]
    });
    let found = ripple(&all, Side::Left, (31..=300, 1), 5, 0.01).unwrap();
    for ((order, amplitude, phase), own) in waves.into_iter().zip(&found) {
        println!("{own:?}");
        assert_eq!(own.order, order);
        assert!((own.amplitude_um / amplitude - 1.0).abs() < 0.01, "{own:?}, not {amplitude}");
        let off = (own.phase_rad - phase + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
        assert!(off.abs() < 0.02, "{own:?}, not {phase}");
    }
    assert!(ripple(&all, Side::Right, (31..=300, 1), 5, 0.01).is_err());
    // Orders far below and above the number of teeth are no others in disguise.
    for order in [7u32, 333] {
        let one = measured(|tooth, x| {
            let theta = x / gear.base_radius() - TAU * f64::from(tooth) / 30.0;
            2.0 * (f64::from(order) * theta + 0.4).cos()
        });
        let found = ripple(&one, Side::Left, (1..=600, 1), 5, 0.002).unwrap();
        assert!(found[0].order == order && (found[0].amplitude_um - 2.0).abs() < 0.02, "{found:?}");
        assert!(found.iter().skip(1).all(|own| own.amplitude_um < 0.02), "{found:?}");
    }
    // Teeth that are alike: their multiples alone have the same answer.
    let alike = measured(|_, x| 0.4 * (90.0 * x / gear.base_radius() + 0.3).cos());
    let [all_of, multiples] = [(1..=600, 1), (30..=600, 30)].map(|o| ripple(&alike, Side::Left, o, 5, 0.01).unwrap());
    assert_eq!((all_of[0].order, multiples[0].order), (90, 90));
    assert!((all_of[0].amplitude_um - multiples[0].amplitude_um).abs() < 1e-9 && multiples.len() == 1, "{multiples:?}");
    // On some of the teeth alone a wave is like any other that differs by the number of teeth.
    let mut some = all.clone();
    some.traces.truncate(29);
    assert!(ripple(&some, Side::Left, (31..=300, 1), 5, 0.01).is_err());
}
