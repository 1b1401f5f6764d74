//! Errors of the statistics.

/// The statistics cannot be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// Fewer than one sample per cycle, or no cycle at all.
    #[error("{samples} samples cannot be divided into {cycles} whole cycles")]
    NotWholeCycles {
        /// Number of samples in the history.
        samples: usize,
        /// Number of cycles given.
        cycles: usize,
    },
    /// A requested column does not exist.
    #[error("the rows have no column `{name}`")]
    NoColumn {
        /// Name of the column.
        name: String,
    },
    /// A sample is NaN or infinite.
    #[error("sample {index} is {value}, not a finite number")]
    NotFinite {
        /// Index of the first such sample.
        index: usize,
        /// Value of the sample.
        value: f64,
    },
    /// No grid can be made over a flank.
    #[error("no grid of {steps} steps from roll angle {low} to {high} rad at {stations} stations")]
    NoGrid {
        /// Start of the range, rad.
        low: f64,
        /// End of the range, rad.
        high: f64,
        /// Number of steps along the profile.
        steps: usize,
        /// Number of axial stations.
        stations: usize,
    },
    /// No power law can be fitted to the measured costs.
    #[error("no power law through {points} points: it takes two different sizes, and all values above 0")]
    NoPowerLaw {
        /// Number of points given.
        points: usize,
    },
    /// There are too few samples.
    #[error("{samples} samples, at least {least} are needed")]
    TooFewSamples {
        /// Number of samples given.
        samples: usize,
        /// Least number of samples.
        least: usize,
    },
    /// A period, rate or order is not positive.
    #[error("{quantity} = {value} must be above 0")]
    NotPositive {
        /// Name of the input.
        quantity: &'static str,
        /// Value of the input.
        value: f64,
    },
    /// Lists that belong together have different lengths.
    #[error("{found} entries where {wanted} are wanted")]
    Lengths {
        /// Number of entries of the list.
        found: usize,
        /// Number of entries of the other lists.
        wanted: usize,
    },
    /// Times or speeds do not ascend.
    #[error("entry {index} is not above the one before it")]
    NotAscending {
        /// Index of the entry, from 0.
        index: usize,
    },
    /// Spectral lines are too close together for the window.
    #[error("lines {spacing} Hz apart are not separated: {least} Hz is needed")]
    Unresolved {
        /// Distance between the lines, Hz.
        spacing: f64,
        /// Least distance for this window and record, Hz.
        least: f64,
    },
    /// The positions of a history are not among those of the reference.
    #[error("{positions} positions a cycle are not among the reference's {reference}")]
    OtherPositions {
        /// Number of positions of the history.
        positions: usize,
        /// Number of positions of the reference.
        reference: usize,
    },
}

impl StudyError {
    /// Hint for the user: what to do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::NotWholeCycles { .. } => {
                Some("sample every cycle at the same number of evenly spaced positions".into())
            }
            Self::NoColumn { .. } => Some("docs/outputs.md lists the columns of every kind of analysis".into()),
            Self::NotFinite { .. } => Some("look at that position of the history: it was not solved".into()),
            Self::NoGrid { .. } => Some("give a rising, finite range, at least one step and one station".into()),
            Self::NoPowerLaw { .. } => Some("measure at least two sizes".into()),
            Self::TooFewSamples { .. } => Some("take a longer record".into()),
            Self::NotPositive { quantity, .. } => Some(format!("give a positive {quantity}")),
            Self::Lengths { .. } => Some("sample all quantities at the same times or values".into()),
            Self::NotAscending { .. } => Some("sort times and speeds, and leave out doubles".into()),
            Self::Unresolved { .. } => {
                Some("take a longer record, or a window with a narrower main lobe such as `Hann`".into())
            }
            Self::OtherPositions { .. } => Some("take a number of positions that divides the reference's".into()),
        }
    }
}

/// `value` is a number above 0.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<(), StudyError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(StudyError::NotPositive { quantity, value }) }
}

/// Every cycle has the same number of samples, at least one, and each is finite.
pub(crate) fn check(samples: &[f64], cycles: usize) -> Result<usize, StudyError> {
    if cycles == 0 || samples.is_empty() || !samples.len().is_multiple_of(cycles) {
        return Err(StudyError::NotWholeCycles { samples: samples.len(), cycles });
    }
    match samples.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(StudyError::NotFinite { index, value: samples[index] }),
        None => Ok(samples.len() / cycles),
    }
}
