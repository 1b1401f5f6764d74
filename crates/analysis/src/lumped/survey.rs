//! Evaluates the rows of a run as they are computed.

use std::f64::consts::TAU;

use answer::{RowStore, TableError};

use super::LumpedRow;
use crate::{AnalysisError, motion::MotionSeries, refused::Refusal, running::Running};

/// Numbers of the rows that are judged, beside their series.
#[derive(Debug, Default)]
pub(super) struct Judged {
    /// Mesh stiffness, N/um.
    pub stiffness: Running,
    /// Length of the contact lines, mm.
    pub contact_line_length: Running,
    /// Force on the wheel along x and y, N.
    pub wheel_force: [Running; 2],
    /// Normal force on the coast flanks, N.
    pub coast_normal_force: Running,
    /// Smallest normal force of a slice in contact, N.
    pub least_slice_force: Running,
    /// Speeds of pinion and wheel, 1/min.
    pub speeds_rpm: [Running; 2],
    /// Rows in which the flanks are apart.
    pub without_contact: usize,
}

impl Judged {
    fn take(&mut self, row: &LumpedRow) {
        // What a model does not tell of one row it tells of none.
        self.stiffness.push_known(row.mesh_stiffness.map(|stiffness| 1e-3 * stiffness));
        self.contact_line_length.push_known(row.contact_line_length);
        self.coast_normal_force.push_known(row.coast_normal_force);
        self.least_slice_force.push_known(row.least_slice_force);
        for gear in [0, 1] {
            self.wheel_force[gear].push(row.wrench[1][gear]);
            self.speeds_rpm[gear].push_known(row.speeds.map(|both| both[gear] * 60.0 / TAU));
        }
        self.without_contact += usize::from(row.contact_line_length == Some(0.0));
    }
}

/// What is read off the rows of a run.
#[derive(Debug, Default)]
pub(crate) struct RowSurvey {
    /// Number of the first row that is judged.
    first: usize,
    /// Rows so far.
    rows: usize,
    /// Time of the first row that holds what is no number, s.
    diverged: Option<f64>,
    /// Transmission error of all rows, um.
    pub errors_um: Running,
    /// Smallest normal force of a slice in contact in any row, N; of rigid gears.
    pub least_slice_force: Option<f64>,
    /// Largest normal force of any row, N.
    pub largest_force: f64,
    /// Series of the rows that are judged, for spectra.
    pub series: MotionSeries,
    /// Other numbers of the judged rows.
    pub judged: Judged,
}

impl RowSurvey {
    /// Survey of no rows yet; those from `first` on are judged.
    pub(super) fn judged_from(first: usize) -> Self {
        Self { first, largest_force: f64::NEG_INFINITY, ..Self::default() }
    }

    /// Takes the next row.
    pub(super) fn take(&mut self, row: &LumpedRow) {
        if !row.is_finite() {
            self.diverged = self.diverged.or(Some(row.time));
        }
        self.errors_um.push(row.transmission_error_um);
        self.least_slice_force = row.least_slice_force.into_iter().chain(self.least_slice_force).reduce(f64::min);
        let largest = f64::max(self.largest_force, row.normal_force);
        self.largest_force = row.coast_normal_force.into_iter().fold(largest, f64::max);
        if self.rows >= self.first {
            self.series.push(row, false);
            self.judged.take(row);
        }
        self.rows += 1;
    }

    /// Whether all rows hold numbers.
    ///
    /// # Errors
    /// [`AnalysisError`] where one does not.
    pub(super) fn finite(&self) -> Result<(), AnalysisError> {
        let Some(time) = self.diverged else { return Ok(()) };
        let what = format!("the motion diverged at t = {} s", answer::digits(time));
        let hint = "take smaller steps, or check supports and damping".to_owned();
        Err(AnalysisError::from(Refusal::no_result(what, Some(hint))).of_part("history.csv"))
    }
}

impl MotionSeries {
    /// Series of all rows of a ramp, with what it is judged by over its speed.
    ///
    /// # Errors
    /// [`TableError::Kept`] where rows cannot be read back.
    pub(super) fn over_speed(rows: &RowStore<LumpedRow>) -> Result<Self, TableError> {
        let mut all = Self::default();
        rows.for_each(0..rows.len(), |row| all.push(row, true))?;
        Ok(all)
    }

    fn push(&mut self, row: &LumpedRow, over_speed: bool) {
        self.dte_um.push(row.transmission_error_um);
        self.normal_force_n.push(row.normal_force);
        self.wheel_force_z_n.push(row.wrench[1][2]);
        self.moment_y_nmm.iter_mut().zip(&row.wrench).for_each(|(list, wrench)| list.push(wrench[4]));
        if over_speed {
            self.time_s.push(row.time);
            self.pinion_speed_rpm.extend(row.speeds.map(|both| both[0] * 60.0 / TAU));
            self.coast_normal_force_n.extend(row.coast_normal_force);
        }
    }
}
