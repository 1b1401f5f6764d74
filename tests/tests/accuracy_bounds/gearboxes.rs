//! Bounds of gearboxes by the committed factors.

use analysis::gearbox::GearboxCalibration;
use scene::Quantity;
use verification::{
    held_out::held_out,
    measured_gearbox::{MeasuredBound, QUANTITIES, bounds_of},
    pair_law_fit::conformal,
};

/// Seeds of all lines, and their bounds.
fn measured(lines: &str) -> (Vec<u64>, Vec<MeasuredBound>) {
    let lines: Vec<serde_json::Value> = lines.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    let seeds = lines.iter().filter_map(|line| line["seed"].as_u64()).collect();
    (seeds, lines.iter().flat_map(bounds_of).collect())
}

/// At least 95 in 100 numbers of gearboxes that took no part lie inside of what the factors leave of their bounds; without the factors the peak to peak
/// had bounds of some sixty times its error, in the median.
#[test]
fn bounds_hold_for_gearboxes_that_took_no_part() {
    let (seeds, all) = measured(include_str!("../../data/held_out_gearboxes.jsonl"));
    assert!(seeds.len() >= 20 && seeds.iter().all(|seed| held_out(*seed)), "{} gearboxes", seeds.len());
    let factor = |q: Quantity| GearboxCalibration::committed().factor(q);
    let holds = |bound: &MeasuredBound| {
        let q = QUANTITIES.into_iter().find(|q| q.key() == bound.key).unwrap();
        bound.filled() <= factor(q)
    };
    let share = all.iter().filter(|bound| holds(bound)).count() as f64 / all.len() as f64;
    assert!(share >= 0.95, "{share} of {} numbers lie inside", all.len());
    let mut ratios: Vec<f64> = all
        .iter()
        .filter(|bound| bound.key == Quantity::PeakToPeakSte.key())
        .map(|bound| bound.sharpness(factor(Quantity::PeakToPeakSte)))
        .collect();
    ratios.sort_unstable_by(f64::total_cmp);
    assert!(ratios[ratios.len() / 2] <= 10.0, "bound over error {}", ratios[ratios.len() / 2]);
}

/// The committed table is what its gearboxes give, and none of them is for checks.
#[test]
fn the_factors_are_of_their_gearboxes() {
    let (seeds, all) = measured(include_str!("../../data/calibration_gearboxes.jsonl"));
    let table = GearboxCalibration::committed();
    assert!(seeds.iter().all(|seed| !held_out(*seed)) && table.gearboxes == seeds.len(), "{}", table.gearboxes);
    for q in QUANTITIES {
        let ratios = all.iter().filter(|bound| bound.key == q.key()).map(MeasuredBound::filled);
        let factor = conformal(ratios.collect(), table.coverage);
        assert!((factor / table.factor(q) - 1.0).abs() < 1e-9, "{}: {factor}", q.key());
    }
}
