//! Series of a motion from its rows in columns.

use analysis::motion::MotionSeries;
use study::{Columns, StudyError};

use crate::columns::{
    At,
    motion_history::{COAST_FORCE, DTE, FORCE_Z, MOMENT_Y, NORMAL_FORCE, PINION_SPEED, TIME},
};

/// Columns of tooth pairs begin so.
const PAIR_FORCES: &str = "normal_force_pair_";

/// What spectra and passages are read off. A model without speeds, coast flanks or pairs has no such series.
///
/// # Errors
/// [`StudyError::NoColumn`].
pub fn motion_series(rows: &Columns) -> Result<MotionSeries, StudyError> {
    let series = |name: &str| rows.series(name).map(<[f64]>::to_vec);
    let of_model = |name: &str| rows.find(name).unwrap_or_default().to_vec();
    let pairs = rows.names_from(PAIR_FORCES).into_iter().filter_map(|name| rows.find(name));
    let larger = |a: Vec<f64>, b: Vec<f64>| a.into_iter().zip(b).map(|(a, b)| a.max(b)).collect();
    let at = |gear: usize| At { gear, pair: 0 };
    Ok(MotionSeries {
        time_s: series(TIME.name)?,
        pinion_speed_rpm: of_model(PINION_SPEED.name),
        dte_um: series(DTE.name)?,
        normal_force_n: series(NORMAL_FORCE.name)?,
        coast_normal_force_n: of_model(COAST_FORCE.name),
        pair_normal_force_n: pairs.map(<[f64]>::to_vec).reduce(larger),
        wheel_force_z_n: series(&FORCE_Z.name_at(at(1)))?,
        moment_y_nmm: [series(&MOMENT_Y.name_at(at(0)))?, series(&MOMENT_Y.name_at(at(1)))?],
    })
}
