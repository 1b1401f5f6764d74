//! Receives the rows of a gearbox motion as they are computed, and the states from which it can be resumed.

use gearbox::motion::{GearboxCheckpoint, GearboxInstant};

use crate::{SinkResult, motion::EnergyRow};

/// Receives the results of a motion as they are computed. All methods do nothing by default. An error of any of them
/// ends the analysis and is returned as [`crate::AnalysisError::Sink`].
pub trait GearboxSink {
    /// Called when rows begin, or continue after a checkpoint.
    ///
    /// # Errors
    /// Any error ends the analysis.
    fn begin_rows(&mut self, _resumes: bool) -> SinkResult {
        Ok(())
    }

    /// Called for each row in order, with the energy balance so far; the initial state comes first.
    ///
    /// # Errors
    /// Any error ends the analysis.
    fn row(&mut self, _row: &GearboxInstant, _energy: &EnergyRow) -> SinkResult {
        Ok(())
    }

    /// Called with a state from which the motion can be continued after all rows so far: as often as the file requests
    /// one, and where the analysis stops before its end.
    ///
    /// # Errors
    /// Any error ends the analysis.
    fn checkpoint(&mut self, _state: GearboxCheckpoint) -> SinkResult {
        Ok(())
    }
}

/// Sink that takes nothing: the result has all rows.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoGearboxSink;

impl GearboxSink for NoGearboxSink {}
