//! Who gets the rows of a gearbox's motion as they come, and the states that it can be resumed from.

use gearbox::motion::{GearboxCheckpoint, GearboxInstant};

use crate::{SinkResult, motion::EnergyRow};

/// Gets what a motion gives as it comes. All methods do nothing by default; an error of any of them ends the analysis and
/// comes back as [`crate::AnalysisError::Sink`].
pub trait GearboxSink {
    /// Rows begin, or go on after a checkpoint.
    ///
    /// # Errors
    /// Whatever ends the analysis.
    fn begin_rows(&mut self, _resumes: bool) -> SinkResult {
        Ok(())
    }

    /// A row with the energy so far, in order, the start first.
    ///
    /// # Errors
    /// Whatever ends the analysis.
    fn row(&mut self, _row: &GearboxInstant, _energy: &EnergyRow) -> SinkResult {
        Ok(())
    }

    /// A state to go on from with all rows so far, as often as the file asks for one, and where the analysis stops before
    /// its end.
    ///
    /// # Errors
    /// Whatever ends the analysis.
    fn checkpoint(&mut self, _state: GearboxCheckpoint) -> SinkResult {
        Ok(())
    }
}

/// Takes nothing: the result holds all rows.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoGearboxSink;

impl GearboxSink for NoGearboxSink {}
