//! Options of an optimisation on a command line.

use super::DesignParameter;
use crate::plan::{AxisValues, AxisWord};

/// Options of an optimisation on a command line.
#[derive(Debug, Clone, Default)]
pub struct OptimisationWords<'a> {
    /// Keys that may change, `KEY=FROM:TO`; by default a selection of tip reliefs and crowning.
    pub parameters: &'a [String],
    /// Torques, N m; by default the scene's own.
    pub torques_nm: &'a [f64],
    /// Quantity to be minimised.
    pub measure: Option<&'a str>,
    /// Limit of the contact pressure, MPa.
    pub max_pressure_mpa: Option<f64>,
    /// Limit of the contact pressure at end faces and tip edges, MPa.
    pub max_edge_pressure_mpa: Option<f64>,
    /// Headline values to be minimised instead of the transmission error.
    pub goals: &'a [String],
    /// Limits of headline values, `KEY=MOST`; only with `goals`.
    pub limits: &'a [String],
    /// Largest number of evaluations.
    pub evaluations: u32,
    /// Number of points of the trade-off.
    pub front: u32,
}

/// What `KEY=FROM:TO` lets change, from the scene's own value on; the error says what is wrong with it.
pub(super) fn parameter(word: &str, known: impl Fn(&str) -> Option<f64>) -> Result<DesignParameter, String> {
    let AxisWord { keys, values } = AxisWord::parse(word)?;
    let AxisValues::Between(bounds) = values else {
        return Err("say KEY=FROM:TO; the search begins at the scene's own value".into());
    };
    if !(bounds[1] > bounds[0] && bounds.iter().all(|b| b.is_finite())) {
        return Err("its second bound is not above the first".into());
    }
    let middle = if bounds[0] <= 0.0 && bounds[1] >= 0.0 { 0.0 } else { 0.5 * (bounds[0] + bounds[1]) };
    let own = known(&keys[0]).filter(|own| own.is_finite());
    let start = own.unwrap_or(middle).clamp(bounds[0], bounds[1]);
    let (grain, outside) = (grain(&keys[0]), own.filter(|own| *own != start));
    Ok(DesignParameter { keys, bounds, start, outside, grain })
}

/// What a machine is set to.
fn grain(key: &str) -> f64 {
    let of = [("_um", 1.0), ("_deg", 0.1), ("_mm", 0.01)];
    of.into_iter().find(|(ending, _)| key.ends_with(ending)).map_or(0.0, |(_, grain)| grain)
}
