//! Series of a motion, from which spectra and run-ups are computed.

use answer::{RowStore, TableError};
use study::StudyError;

use crate::motion::MotionRow;

/// Quantities of a motion over time, the same number of values in each mesh cycle.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MotionSeries {
    /// Time, s. This and all other series that only a ramp needs may be empty.
    pub time_s: Vec<f64>,
    /// Speed of the pinion, 1/min; may be empty if nothing is plotted over it.
    pub pinion_speed_rpm: Vec<f64>,
    /// Dynamic transmission error, um.
    pub dte_um: Vec<f64>,
    /// Sum of the normal forces of the driving flanks, N.
    pub normal_force_n: Vec<f64>,
    /// Sum of the normal forces of the coast flanks, N; empty for a model without coast flanks.
    pub coast_normal_force_n: Vec<f64>,
    /// Largest normal force of any tooth pair, N; `None` for a model that does not distinguish pairs.
    pub pair_normal_force_n: Option<Vec<f64>>,
    /// Axial force of the mesh on the wheel, N.
    pub wheel_force_z_n: Vec<f64>,
    /// Tilting moments of the mesh about y on pinion and wheel, N mm.
    pub moment_y_nmm: [Vec<f64>; 2],
}

impl MotionSeries {
    /// Series from the rows of a motion of reduced gears, for spectra and, with `over_speed`, for the evaluation of a
    /// ramp.
    ///
    /// # Errors
    /// [`TableError`] if rows cannot be read back.
    pub fn of(rows: &RowStore<MotionRow>, over_speed: bool) -> Result<Self, TableError> {
        let mut all = Self::default();
        let mut pairs = Vec::new();
        rows.for_each(0..rows.len(), |row| {
            all.dte_um.push(row.dte_um);
            all.normal_force_n.push(row.normal_force_n);
            all.wheel_force_z_n.push(row.force_n[1][2]);
            all.moment_y_nmm.iter_mut().zip(row.moment_nmm).for_each(|(list, moment)| list.push(moment[1]));
            if over_speed {
                all.time_s.push(row.time_s);
                all.pinion_speed_rpm.push(row.speed_rpm[0]);
                all.coast_normal_force_n.push(row.coast_normal_force_n);
                pairs.push(row.pair_normal_force_n.iter().fold(0.0, |m: f64, f| m.max(*f)));
            }
        })?;
        all.pair_normal_force_n = over_speed.then_some(pairs);
        Ok(all)
    }

    /// Number of values of each series.
    pub fn len(&self) -> usize {
        self.dte_um.len()
    }

    /// Whether there are no values.
    pub fn is_empty(&self) -> bool {
        self.dte_um.is_empty()
    }

    /// Checks that `series` are as long as the transmission error, and that a mesh cycle has values.
    pub(super) fn check(&self, series: &[&[f64]], per_cycle: usize) -> Result<(), StudyError> {
        if per_cycle == 0 {
            return Err(StudyError::NotPositive { quantity: "values in a mesh cycle", value: 0.0 });
        }
        let wanted = self.len();
        let other = series.iter().map(|s| s.len()).find(|found| *found != wanted);
        other.map_or(Ok(()), |found| Err(StudyError::Lengths { found, wanted }))
    }
}
