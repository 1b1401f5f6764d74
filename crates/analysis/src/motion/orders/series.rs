//! Series of a motion: what spectra and a run-up over speed are read off.

use answer::{RowStore, TableError};
use study::StudyError;

use crate::motion::MotionRow;

/// Quantities of a motion over time, equally many values in each mesh cycle.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MotionSeries {
    /// Time, s; it and all that only a ramp is judged by may be empty.
    pub time_s: Vec<f64>,
    /// Speed of the pinion, 1/min; may be empty where nothing is drawn over it.
    pub pinion_speed_rpm: Vec<f64>,
    /// Dynamic transmission error, um.
    pub dte_um: Vec<f64>,
    /// Sum of the normal forces of the driving flanks, N.
    pub normal_force_n: Vec<f64>,
    /// The same of the coast flanks; empty for a model without any.
    pub coast_normal_force_n: Vec<f64>,
    /// Normal force of the hardest pressed tooth pair, N; `None` for a model that does not tell pairs apart.
    pub pair_normal_force_n: Option<Vec<f64>>,
    /// Axial force of the mesh on the wheel, N.
    pub wheel_force_z_n: Vec<f64>,
    /// Tilting moments of the mesh about y on pinion and wheel, N mm.
    pub moment_y_nmm: [Vec<f64>; 2],
}

impl MotionSeries {
    /// Of the rows of a motion of reduced gears, for spectra; `over_speed`: and what a ramp is judged by.
    ///
    /// # Errors
    /// [`TableError`] where rows cannot be read back.
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

    /// Values of each series.
    pub fn len(&self) -> usize {
        self.dte_um.len()
    }

    /// Whether there is no value.
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
