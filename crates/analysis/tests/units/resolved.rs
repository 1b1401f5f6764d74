//! Laws of what `in_motion::resolved` keeps to itself.

use std::f64::consts::TAU;

use super::*;

fn unresolved(samples: &[f64], cycles: f64, steps: f64, comes_back: bool) -> Vec<Remark> {
    MeshRecord { samples, cycles, steps, comes_back, keys: StepKeys::PAIR }.unresolved()
}

/// One order with many steps is silent; the same with few, and one that the rows hardly show, are told.
#[test]
fn few_steps_and_few_rows_are_told() {
    let wave = |rows: usize, order: f64| -> Vec<f64> {
        (0..2 * rows).map(|i| 10.0 + (TAU * order * i as f64 / rows as f64).cos()).collect()
    };
    assert!(unresolved(&wave(64, 2.0), 2.0, 64.0, true).is_empty());
    assert!(unresolved(&[3.0; 64], 2.0, 8.0, true).is_empty(), "nothing moves");
    let few = unresolved(&wave(64, 2.0), 2.0, 24.0, true);
    assert!(few.len() == 1 && few[0].text().contains("1/12.0 of the period of mesh order 2"), "{few:?}");
    let coarse = unresolved(&wave(16, 7.0), 2.0, 1000.0, true);
    assert!(coarse.len() == 1 && coarse[0].text().contains("16 rows a mesh cycle"), "{coarse:?}");
}

/// A mesh whose cycles are no whole number of rows, on a drift that does not come back: the same orders are told, and the
/// jump from the end to the beginning is none of them.
#[test]
fn a_record_that_does_not_come_back_is_judged_by_its_orders() {
    let rows = 40.0 * 53.0 / 19.0;
    let record = |order: f64| -> Vec<f64> {
        (0..640).map(|i| 10.0 + 0.01 * f64::from(i) + (TAU * order * f64::from(i) / rows).cos()).collect()
    };
    let of = |order: f64, steps: f64| unresolved(&record(order), 640.0 / rows, steps, false);
    assert!(of(2.0, 80.0).is_empty(), "{:?}", of(2.0, 80.0));
    let few = of(2.0, 24.0);
    assert!(few.len() == 1 && few[0].text().contains("1/12.0 of the period of mesh order 2"), "{few:?}");
    let coarse = of(40.0, 10_000.0);
    assert!(coarse.len() == 1 && coarse[0].code() == "few_rows", "{coarse:?}");
    let (samples, keys) = (record(2.0), StepKeys::GEARBOX);
    let short = MeshRecord { samples: &samples[..300], cycles: 300.0 / rows, steps: 8.0, comes_back: false, keys };
    assert!(short.few_steps().is_none(), "less than three cycles do not tell their orders apart");
}

/// Eleven steps in the period of a resonance are told, with what helps; twelve are not.
#[test]
fn steps_that_cannot_show_a_resonance_are_told() {
    let of = |steps: f64| coarse_steps(steps, ("mesh resonance", 2000.0), (StepKeys::GEARBOX, ", or wait"));
    assert_eq!(of(12.0), None);
    assert_eq!(of(11.0).unwrap().hint().unwrap(), "take more `steps_per_cycle`, or wait");
}
