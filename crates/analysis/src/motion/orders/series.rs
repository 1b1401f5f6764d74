//! Series of a motion: what spectra and a run-up over speed are read off.

use study::StudyError;

use crate::motion::MotionRow;

/// Quantities of a motion over time, equally many values in each mesh cycle.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MotionSeries {
    /// Time, s.
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
    /// Of the rows of a motion of reduced gears.
    pub fn of(rows: &[MotionRow]) -> Self {
        let series = |value: fn(&MotionRow) -> f64| -> Vec<f64> { rows.iter().map(value).collect() };
        Self {
            time_s: series(|r| r.time_s),
            pinion_speed_rpm: series(|r| r.speed_rpm[0]),
            dte_um: series(|r| r.dte_um),
            normal_force_n: series(|r| r.normal_force_n),
            coast_normal_force_n: series(|r| r.coast_normal_force_n),
            pair_normal_force_n: Some(series(|r| r.pair_normal_force_n.iter().fold(0.0, |m: f64, f| m.max(*f)))),
            wheel_force_z_n: series(|r| r.force_n[1][2]),
            moment_y_nmm: [series(|r| r.moment_nmm[0][1]), series(|r| r.moment_nmm[1][1])],
        }
    }

    /// Values of each series.
    pub fn len(&self) -> usize {
        self.dte_um.len()
    }

    /// Whether there is no value.
    pub fn is_empty(&self) -> bool {
        self.dte_um.is_empty()
    }

    /// That `series` are as long as the transmission error, and that a mesh cycle has values.
    pub(super) fn check(&self, series: &[&[f64]], per_cycle: usize) -> Result<(), StudyError> {
        if per_cycle == 0 {
            return Err(StudyError::NotPositive { quantity: "values in a mesh cycle", value: 0.0 });
        }
        let wanted = self.len();
        let other = series.iter().map(|s| s.len()).find(|found| *found != wanted);
        other.map_or(Ok(()), |found| Err(StudyError::Lengths { found, wanted }))
    }
}
