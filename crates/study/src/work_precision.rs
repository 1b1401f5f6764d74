//! Accuracy against cost of a method that computes a mesh cycle.

use serde::Serialize;

use crate::{StudyError, error::check};

/// Result for one mesh cycle at evenly spaced positions, the first at phase 0, without the end point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Answer {
    /// Transmission error at each position, um.
    pub ste_um: Vec<f64>,
    /// Total contact-line length at each position, mm; empty if a program does not give it.
    pub line_length_mm: Vec<f64>,
}

/// Difference of a result from a reference.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AnswerError {
    /// Mean STE minus that of the reference at the same positions, relative.
    pub mean_ste: f64,
    /// Peak-to-peak STE minus that of the reference, relative; `None` unless the result has all positions of the
    /// reference.
    pub peak_to_peak_ste: Option<f64>,
    /// Mean contact-line length minus that of the reference at the same positions, relative.
    pub mean_line_length: Option<f64>,
}

/// Cost: wall-clock times in s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Work {
    /// Time before the first position: meshes, matrices, factors, condensation.
    pub offline_s: f64,
    /// Time for all positions of the first mesh cycle.
    pub cycle_s: f64,
    /// Time for all positions of a later cycle, if one was run.
    pub further_cycle_s: Option<f64>,
    /// Number of positions of the cycle that were run. If they are fewer than [`Work::positions_asked`], times of a
    /// cycle are extrapolated.
    pub positions_run: usize,
    /// Number of positions of the cycle.
    pub positions_asked: usize,
    /// Largest resident set, MB = 10^6 bytes; `None` if the operating system does not report it.
    pub peak_memory_mb: Option<f64>,
    /// Degrees of freedom of both gears as meshed.
    pub dof_before: usize,
    /// Degrees of freedom of both gears that are solved at every position.
    pub dof_after: usize,
}

impl Work {
    /// Time for offline work and the first cycle, s.
    pub fn first_cycle_s(&self) -> f64 {
        self.offline_s + self.cycle_s
    }

    /// Time for one more cycle, s: measured, otherwise that of the first cycle.
    pub fn another_cycle_s(&self) -> f64 {
        self.further_cycle_s.unwrap_or(self.cycle_s)
    }

    /// Time for one position of a cycle after the first, s.
    pub fn position_s(&self) -> f64 {
        self.another_cycle_s() / self.positions_asked.max(1) as f64
    }

    /// Degrees of freedom of the meshes divided by those solved at a position; `None` for a model without meshes.
    pub fn dof_reduction(&self) -> Option<f64> {
        (self.dof_after > 0).then(|| self.dof_before as f64 / self.dof_after as f64)
    }
}

impl Answer {
    /// Relative errors compared with a reference whose positions include those of this result.
    ///
    /// # Errors
    /// [`StudyError::OtherPositions`] if they do not, [`StudyError::NotFinite`] if a value is not a finite number.
    ///
    /// # Example
    /// ```
    /// use study::Answer;
    /// let reference = Answer { ste_um: vec![10.0, 11.0, 12.0, 11.0], line_length_mm: vec![40.0; 4] };
    /// let rough = Answer { ste_um: vec![10.1, 12.12], line_length_mm: vec![] };
    /// let error = rough.error_against(&reference)?;
    /// assert!((error.mean_ste - 0.01).abs() < 1e-12);
    /// assert_eq!((error.peak_to_peak_ste, error.mean_line_length), (None, None));
    /// # Ok::<(), study::StudyError>(())
    /// ```
    pub fn error_against(&self, reference: &Self) -> Result<AnswerError, StudyError> {
        let (own, all) = (self.ste_um.len(), reference.ste_um.len());
        if own == 0 || !all.is_multiple_of(own) {
            return Err(StudyError::OtherPositions { positions: own, reference: all });
        }
        let stride = all / own;
        let mean_ste = relative_mean(&self.ste_um, &reference.ste_um, stride)?;
        let whole = own == all && own > 1;
        let swing = |values: &[f64]| {
            let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| (l.min(v), h.max(v)));
            high - low
        };
        let peak_to_peak = swing(&self.ste_um) / swing(&reference.ste_um) - 1.0;
        let peak_to_peak_ste = (whole && peak_to_peak.is_finite()).then_some(peak_to_peak);
        let lengths = self.line_length_mm.len() == own && reference.line_length_mm.len() == all;
        let mean_line_length =
            lengths.then(|| relative_mean(&self.line_length_mm, &reference.line_length_mm, stride)).transpose()?;
        Ok(AnswerError { mean_ste, peak_to_peak_ste, mean_line_length })
    }
}

/// Mean of `own` over the mean of every `stride`-th value of `reference`, minus 1.
fn relative_mean(own: &[f64], reference: &[f64], stride: usize) -> Result<f64, StudyError> {
    check(own, 1)?;
    check(reference, 1)?;
    let sum: f64 = own.iter().sum();
    let wanted: f64 = reference.iter().step_by(stride).sum();
    Ok(sum / wanted - 1.0)
}
