//! Results of a periodic motion.

use periodic::{PeriodicFamily, PeriodicMotion};

use super::super::LumpedRow;
use super::family::ModelFamily;
use crate::{
    AnalysisError,
    branch::{BranchPoint, ROWS, state},
};

/// Reads a point off a motion; the family stands at its value afterwards.
///
/// # Errors
/// Contact that cannot be solved.
pub(super) fn point(
    family: &mut ModelFamily<'_>,
    motion: &PeriodicMotion,
    cycles: u32,
) -> Result<BranchPoint, AnalysisError> {
    family.set_parameter(motion.parameter)?;
    let count = ROWS * cycles as usize;
    let rows = family.rows((0..count).map(|i| state(motion, i as f64 / count as f64)))?;
    let errors: Vec<f64> = rows.iter().map(|row| row.transmission_error_um).collect();
    let forces: Vec<f64> = rows.iter().map(|row: &LumpedRow| row.normal_force).collect();
    Ok(BranchPoint::new(motion, &errors, &forces, cycles as usize))
}
