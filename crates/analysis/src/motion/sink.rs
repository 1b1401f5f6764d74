//! Receives the rows of a motion as they are computed, and the states from which it can be resumed.

use dynamics::SideLoads;
use gearbox::motion::GearboxMemory;
use integrate::Checkpoint;
use ltca::{StaticModel, StaticPosition};
use serde::{Deserialize, Serialize};
use study::FlankPattern;

use super::{MotionLayout, MotionRow};
use crate::{Observer, SinkResult, facts::MeshFacts};

/// State of a motion at the end of a mesh cycle, without its rows so far; it continues from here to the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MotionCheckpoint {
    /// Number of teeth of the window.
    pub window: usize,
    /// State of the motion and its stage.
    pub motion: Checkpoint<GearboxMemory>,
    /// Pressure patterns of the flanks so far.
    pub patterns: [FlankPattern; 2],
}

/// Receives the results of a motion as they are computed. All methods do nothing by default. An error of any of them
/// ends the analysis and is returned as [`crate::AnalysisError::Sink`].
pub trait MotionSink {
    /// Called when the meshes have been read.
    ///
    /// # Errors
    /// Any error ends the analysis.
    fn meshes(&mut self, _meshes: &[MeshFacts]) -> SinkResult {
        Ok(())
    }

    /// Called when the analysis begins, and again if a wider window is needed; earlier results are then discarded.
    fn begin(&mut self) {}

    /// Called for each position of the quasi-static mesh cycle with which the motion starts, in order; the model is in
    /// the state of that position.
    fn position(&mut self, _index: usize, _position: &StaticPosition, _model: &StaticModel) {}

    /// Called when the quasi-static mesh cycle is solved; returns remarks.
    fn quasi_static(&mut self, _model: &StaticModel, _observer: &mut dyn Observer) -> Vec<answer::Remark> {
        Vec::new()
    }

    /// Called when rows begin, or continue after a checkpoint.
    ///
    /// # Errors
    /// Any error ends the analysis.
    fn begin_rows(&mut self, _layout: &MotionLayout, _from: Option<&MotionCheckpoint>) -> SinkResult {
        Ok(())
    }

    /// Called for each row in order.
    ///
    /// # Errors
    /// Any error ends the analysis.
    fn row(&mut self, _row: &MotionRow) -> SinkResult {
        Ok(())
    }

    /// Whether fields of the gears are wanted at a row, counted from 0.
    fn wants_fields(&self, _row: u64) -> bool {
        false
    }

    /// Called with the loads on the flanks at a row that [`MotionSink::wants_fields`]; time in s.
    ///
    /// # Errors
    /// Any error ends the analysis.
    fn fields(&mut self, _row: u64, _time_s: f64, _sides: &[SideLoads<'_>]) -> SinkResult {
        Ok(())
    }

    /// Called when a mesh cycle of rows is complete; `recorded` is their number.
    ///
    /// # Errors
    /// Any error ends the analysis.
    fn end_cycle(&mut self, _recorded: u64) -> SinkResult {
        Ok(())
    }

    /// Called with a state from which the motion can be continued after all rows so far: as often as the scene requests
    /// one, and where the analysis stops before its end.
    ///
    /// # Errors
    /// Any error ends the analysis.
    fn checkpoint(&mut self, _state: MotionCheckpoint) -> SinkResult {
        Ok(())
    }

    /// Called when all rows have been computed.
    ///
    /// # Errors
    /// Any error ends the analysis.
    fn finish(&mut self) -> SinkResult {
        Ok(())
    }
}

/// Sink that takes nothing: the result has all rows.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoMotionSink;

impl MotionSink for NoMotionSink {}
