//! Laws of what `in_motion::resolved` keeps to itself.

use std::f64::consts::TAU;

use integrate::Scheme;

use super::*;

fn steps(per_cycle: f64, resonance: f64) -> SteadySteps {
    SteadySteps { per_period: per_cycle, scheme: Scheme::Energy, resonance, damping: 0.05 }
}

fn resolved(samples: &[f64], cycles: f64, steps: Option<SteadySteps>, comes_back: bool) -> Resolved {
    MeshRecord { samples, cycles, steps, comes_back, keys: StepKeys::PAIR }.resolved()
}

fn unresolved(samples: &[f64], cycles: f64, steps: Option<SteadySteps>, comes_back: bool) -> Vec<Remark> {
    resolved(samples, cycles, steps, comes_back).remarks
}

/// Two mesh cycles with a wave of this order.
fn wave(rows: usize, order: f64) -> Vec<f64> {
    (0..2 * rows).map(|i| 10.0 + (TAU * order * i as f64 / rows as f64).cos()).collect()
}

/// One order with many steps is silent; the same with few, and one that the rows hardly show, are told.
#[test]
fn few_steps_and_few_rows_are_told() {
    assert!(unresolved(&wave(64, 2.0), 2.0, Some(steps(400.0, 2.0)), true).is_empty());
    assert!(unresolved(&[3.0; 64], 2.0, Some(steps(8.0, 2.0)), true).is_empty(), "nothing moves");
    let few = unresolved(&wave(64, 2.0), 2.0, Some(steps(64.0, 2.0)), true);
    assert!(few.len() == 1 && few[0].text().contains("mesh order 2, whose period has 32.0"), "{few:?}");
    let coarse = unresolved(&wave(16, 7.0), 2.0, Some(steps(1000.0, 1.0)), true);
    assert!(coarse.len() == 1 && coarse[0].text().contains("16 rows a mesh cycle"), "{coarse:?}");
    let by_error = resolved(&wave(64, 2.0), 2.0, None, true);
    assert_eq!(by_error, Resolved::default(), "steps that follow an error");
}

/// The same steps matter most on the sides of a resonance, and less the more there are: by the square.
#[test]
fn steps_matter_beside_a_resonance() {
    let error = |per_cycle: f64, resonance: f64| {
        0.01 * resolved(&wave(64, 2.0), 2.0, Some(steps(per_cycle, resonance)), true).step_error_percent.unwrap()
    };
    assert!(error(64.0, 2.0) > 3.0 * error(64.0, 8.0), "{} and {}", error(64.0, 2.0), error(64.0, 8.0));
    let order = (error(128.0, 2.0) / error(256.0, 2.0)).log2();
    assert!((order - 2.0).abs() < 0.1, "order {order}");
    assert!(error(4.0, 2.0) > 0.99, "two steps in a period show nothing");
}

/// A mesh whose cycles are no whole number of rows, on a drift that does not come back: the same orders are told, by the
/// same error, and the jump from the end to the beginning is none of them.
#[test]
fn a_record_that_does_not_come_back_is_judged_by_its_orders() {
    let rows = 40.0 * 53.0 / 19.0;
    let record = |order: f64| -> Vec<f64> {
        (0..640).map(|i| 10.0 + 0.001 * f64::from(i) + (TAU * order * f64::from(i) / rows).cos()).collect()
    };
    let of = |order: f64, per_cycle: f64| resolved(&record(order), 640.0 / rows, Some(steps(per_cycle, order)), false);
    let few = of(2.0, 64.0);
    let whole = resolved(&wave(64, 2.0), 2.0, Some(steps(64.0, 2.0)), true);
    let [own, same] = [&few, &whole].map(|r| r.step_error_percent.unwrap());
    assert!((own / same - 1.0).abs() < 0.1, "{own} and {same} %");
    assert!(few.remarks.len() == 1 && few.remarks[0].text().contains("mesh order 2, whose period"), "{few:?}");
    assert!(of(2.0, 400.0).remarks.is_empty(), "{:?}", of(2.0, 400.0));
    let coarse = of(40.0, 10_000.0).remarks;
    assert!(coarse.len() == 1 && coarse[0].code() == "few_rows", "{coarse:?}");
    let (samples, keys) = (record(2.0), StepKeys::GEARBOX);
    let own = Some(steps(8.0, 2.0));
    let short = MeshRecord { samples: &samples[..300], cycles: 300.0 / rows, steps: own, comes_back: false, keys };
    assert_eq!(short.resolved().step_error_percent, None, "less than three cycles do not tell their orders apart");
}

/// Eleven steps in the period of a resonance are told, with what helps; twelve are not.
#[test]
fn steps_that_cannot_show_a_resonance_are_told() {
    let of = |steps: f64| coarse_steps(steps, ("mesh resonance", 2000.0), (StepKeys::GEARBOX, ", or wait"));
    assert_eq!(of(12.0), None);
    assert_eq!(of(11.0).unwrap().hint().unwrap(), "take more `steps_per_cycle`, or wait");
}
