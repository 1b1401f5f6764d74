//! Gearboxes of one pair on two elastic shafts.

use serde_json::json;
use verification::{measured_gearbox::measured, random_gearbox::random_gearbox};

use super::{Failure, Measure};

/// Shares of all numbers that are asked for: settings from the coarsest to fine ones.
const ASKED: [f64; 3] = [0.5, 0.1, 0.02];

/// The line of a gearbox of a seed.
pub(super) fn measure(seed: u64, word: Option<&str>) -> Result<Measure, Failure> {
    if let Some(word) = word {
        return Err(format!("`{word}`: gearboxes have no other words").into());
    }
    Ok(Box::new(move |index| {
        let file = random_gearbox(seed, index)?;
        Some(vec![measured(&file, &ASKED).unwrap_or_else(|e| json!({ "error": e.to_string() }))])
    }))
}
