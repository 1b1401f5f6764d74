//! The table of gearboxes.

use std::collections::BTreeMap;

use analysis::gearbox::{GearboxCalibration, GearboxLaw};
use serde_json::Value;
use verification::{
    held_out::held_out,
    measured_gearbox::{MeasuredBound, QUANTITIES, bounds_of},
    pair_law_fit::conformal,
};

use super::Failure;

/// Share of the numbers that a bound holds for.
const COVERAGE: f64 = 0.96;
/// Gearboxes that a table is made of, at least.
const LEAST: usize = 20;

/// The table of measured gearboxes, one a line.
pub(super) fn table(lines: &[Value]) -> Result<GearboxCalibration, Failure> {
    let mut made_of = BTreeMap::<u64, Vec<u64>>::new();
    let mut all: Vec<MeasuredBound> = Vec::new();
    for line in lines {
        let (Some(seed), Some(index)) = (line["seed"].as_u64(), line["index"].as_u64()) else { continue };
        if held_out(seed) {
            return Err(format!("gearboxes of seed {seed} are for checks alone").into());
        }
        let own = bounds_of(line);
        if !own.is_empty() {
            made_of.entry(seed).or_default().push(index);
            all.extend(own);
        }
    }
    let gearboxes: usize = made_of.values().map(Vec::len).sum();
    if gearboxes < LEAST {
        return Err(format!("{gearboxes} gearboxes are measured, {LEAST} are wanted").into());
    }
    println!("{gearboxes} gearboxes, {} without a result", lines.len() - gearboxes);
    let law = |key: &'static str| {
        let own: Vec<&MeasuredBound> = all.iter().filter(|bound| bound.key == key).collect();
        let factor = conformal(own.iter().map(|bound| bound.filled()).collect(), COVERAGE);
        let mut sharpness: Vec<f64> = own.iter().map(|bound| bound.sharpness(factor)).collect();
        sharpness.sort_unstable_by(f64::total_cmp);
        let median = sharpness.get(sharpness.len() / 2).copied().unwrap_or(f64::NAN);
        println!("{key:24} {:3} bounds, factor {factor:.3}, median bound over error {median:.1}", own.len());
        GearboxLaw { quantity: key.to_owned(), factor }
    };
    let quantities = QUANTITIES.map(|q| law(q.key())).to_vec();
    Ok(GearboxCalibration { gearboxes, made_of, coverage: COVERAGE, quantities })
}
