//! What can be wrong with a history.

/// Why no statistics come out.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// Fewer samples than one a cycle, or no cycle at all.
    #[error("{samples} samples cannot be divided into {cycles} whole cycles")]
    NotWholeCycles {
        /// Samples in the history.
        samples: usize,
        /// Cycles they are said to span.
        cycles: usize,
    },
    /// A column is asked for that the rows do not have.
    #[error("the rows have no column `{name}`")]
    NoColumn {
        /// The name.
        name: String,
    },
    /// A sample is NaN or infinite.
    #[error("sample {index} is {value}, not a finite number")]
    NotFinite {
        /// Index of the first such sample.
        index: usize,
        /// What stands there.
        value: f64,
    },
    /// No grid can be laid over a flank.
    #[error("no grid of {steps} steps from roll angle {low} to {high} rad at {stations} stations")]
    NoGrid {
        /// Where it begins, rad.
        low: f64,
        /// Where it ends, rad.
        high: f64,
        /// Steps along the profile.
        steps: usize,
        /// Axial stations.
        stations: usize,
    },
    /// No power law can be laid through measured costs.
    #[error("no power law through {points} points: it takes two different sizes, and all values above 0")]
    NoPowerLaw {
        /// Points given.
        points: usize,
    },
    /// Fewer samples than it takes.
    #[error("{samples} samples, at least {least} are needed")]
    TooFewSamples {
        /// Samples given.
        samples: usize,
        /// How many it takes.
        least: usize,
    },
    /// A period, a rate, an order that must be above zero is not.
    #[error("{quantity} = {value} must be above 0")]
    NotPositive {
        /// Name of the input.
        quantity: &'static str,
        /// Value of the input.
        value: f64,
    },
    /// Lists that belong together are of different lengths.
    #[error("{found} entries where {wanted} are wanted")]
    Lengths {
        /// Entries of the list.
        found: usize,
        /// Entries of the others.
        wanted: usize,
    },
    /// Times or speeds that do not ascend.
    #[error("entry {index} is not above the one before it")]
    NotAscending {
        /// Which, from 0.
        index: usize,
    },
    /// Lines closer than the window can tell apart.
    #[error("lines {spacing} Hz apart are not separated: {least} Hz is needed")]
    Unresolved {
        /// Distance of the lines, Hz.
        spacing: f64,
        /// Least distance with this window and record, Hz.
        least: f64,
    },
    /// A history has no counterpart in the reference.
    #[error("{positions} positions a cycle are not among the reference's {reference}")]
    OtherPositions {
        /// Positions of the history.
        positions: usize,
        /// Positions of the reference.
        reference: usize,
    },
}

impl StudyError {
    /// What the user can do next.
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
