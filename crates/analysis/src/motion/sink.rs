//! Who gets the rows of a motion as they come, and the states that it can be resumed from.

use dynamics::SideLoads;
use gearbox::motion::GearboxMemory;
use integrate::Checkpoint;
use ltca::{StaticModel, StaticPosition};
use serde::{Deserialize, Serialize};
use study::FlankPattern;

use super::{MotionLayout, MotionRow};
use crate::{Observer, SinkResult, facts::MeshFacts};

/// All that a motion is at the end of a mesh cycle, but for its rows so far: it goes on from here to the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MotionCheckpoint {
    /// Teeth of the window.
    pub window: usize,
    /// The motion, and how far it has come.
    pub motion: Checkpoint<GearboxMemory>,
    /// What the flanks were pressed by so far.
    pub patterns: [FlankPattern; 2],
}

/// Gets what a motion gives as it comes. All methods do nothing by default; an error of any of them ends the analysis
/// and comes back as [`crate::AnalysisError::Sink`].
pub trait MotionSink {
    /// The meshes are read.
    ///
    /// # Errors
    /// Whatever ends the analysis.
    fn meshes(&mut self, _meshes: &[MeshFacts]) -> SinkResult {
        Ok(())
    }

    /// The analysis begins, again where a wider window is needed: what came before does not count.
    fn begin(&mut self) {}

    /// A position of the quasi-static mesh cycle that the motion starts from, in order; the model is where it was
    /// found.
    fn position(&mut self, _index: usize, _position: &StaticPosition, _model: &StaticModel) {}

    /// The quasi-static mesh cycle is solved. What comes back are remarks.
    fn quasi_static(&mut self, _model: &StaticModel, _observer: &mut dyn Observer) -> Vec<answer::Remark> {
        Vec::new()
    }

    /// Rows begin, or go on after a checkpoint.
    ///
    /// # Errors
    /// Whatever ends the analysis.
    fn begin_rows(&mut self, _layout: &MotionLayout, _from: Option<&MotionCheckpoint>) -> SinkResult {
        Ok(())
    }

    /// A row, in order.
    ///
    /// # Errors
    /// Whatever ends the analysis.
    fn row(&mut self, _row: &MotionRow) -> SinkResult {
        Ok(())
    }

    /// Whether fields of the gears are wanted at a row, counted from 0.
    fn wants_fields(&self, _row: u64) -> bool {
        false
    }

    /// What presses on the flanks at a row that [`MotionSink::wants_fields`]; time in s.
    ///
    /// # Errors
    /// Whatever ends the analysis.
    fn fields(&mut self, _row: u64, _time_s: f64, _sides: &[SideLoads<'_>]) -> SinkResult {
        Ok(())
    }

    /// A mesh cycle of rows is complete; `recorded`: how many there are.
    ///
    /// # Errors
    /// Whatever ends the analysis.
    fn end_cycle(&mut self, _recorded: u64) -> SinkResult {
        Ok(())
    }

    /// A state to go on from with all rows so far, as often as the scene asks for one, and where the analysis stops
    /// before its end.
    ///
    /// # Errors
    /// Whatever ends the analysis.
    fn checkpoint(&mut self, _state: MotionCheckpoint) -> SinkResult {
        Ok(())
    }

    /// All rows have come.
    ///
    /// # Errors
    /// Whatever ends the analysis.
    fn finish(&mut self) -> SinkResult {
        Ok(())
    }
}

/// Takes nothing: the result holds all rows.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoMotionSink;

impl MotionSink for NoMotionSink {}
