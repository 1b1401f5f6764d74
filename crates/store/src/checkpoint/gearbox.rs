//! What a gearbox's motion keeps: its state, and its rows with all their digits.

use std::{io::BufRead, path::Path};

use analysis::{
    SinkResult,
    gearbox::{GearboxRows, GearboxSink},
    motion::EnergyRow,
};
use columns::ColumnsError;
use gearbox::motion::{GearboxCheckpoint, GearboxInstant};
use serde::{Deserialize, Serialize};

use super::{
    CheckpointError, Checkpoints,
    growing::{Growing, Kept, digested},
    store::{FARTHEST_TOOTH, GEARBOX_ROWS, Stored, StoredState},
};
use crate::StoreError;

/// State of a gearbox's motion.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct GearboxState {
    /// The motion.
    pub motion: GearboxCheckpoint,
    /// The file of rows.
    rows: Kept,
}

impl StoredState for GearboxState {
    const KIND: &'static str = "motion of a gearbox";

    fn rows(&self) -> Vec<(&'static str, &Kept)> {
        vec![(GEARBOX_ROWS, &self.rows)]
    }

    fn consistent(&self) -> Result<(), &'static str> {
        let crossings = self.motion.counts.crossings.len();
        if !(self.motion.is_consistent() && crossings == 2 * self.motion.memory.meshes.len()) {
            return Err("velocities of other coordinates, or counts of other meshes");
        }
        if self.motion.memory.farthest_tooth() > FARTHEST_TOOTH {
            return Err("a window beyond all cycles");
        }
        Ok(())
    }
}

impl GearboxState {
    /// The rows of the run so far, from the file as far as it was kept; `folder`: that of the checkpoint.
    ///
    /// # Errors
    /// When the file cannot be read, holds what is no row, or other rows than the state has.
    pub fn read_rows(&self, folder: &Path) -> Result<GearboxRows, StoreError> {
        let file = folder.join(GEARBOX_ROWS);
        let damaged = |what: String| CheckpointError::Damaged { file: file.clone(), what };
        let (mut rows, mut ledger) = GearboxRows::default();
        for line in self.rows.reader(&file)?.lines() {
            let line = line.map_err(|cause| ColumnsError::Read { file: file.clone(), cause })?;
            let (row, energy) =
                serde_json::from_str(&line).map_err(|e| damaged(format!("holds what is no row: {e}")))?;
            rows.push(row)?;
            ledger.push(energy)?;
        }
        if rows.len() as u64 != self.motion.stage.rows {
            let what = format!("has {} rows, and the state {}", rows.len(), self.motion.stage.rows);
            return Err(damaged(what).into());
        }
        Ok((rows, ledger))
    }
}

/// Where rows and states of a gearbox's motion go.
pub struct GearboxFileSink<'a> {
    checkpoints: Checkpoints<'a>,
    /// State that the run goes on from.
    from: Option<&'a Stored<GearboxState>>,
    rows: Option<Growing>,
}

impl<'a> GearboxFileSink<'a> {
    /// `from` is what the run goes on from.
    pub fn new(checkpoints: Checkpoints<'a>, from: Option<&'a Stored<GearboxState>>) -> Self {
        Self { checkpoints, from, rows: None }
    }

    fn open(&self, resumes: bool) -> Result<Growing, StoreError> {
        let folder = self.checkpoints.folder;
        let path = folder.path().join(GEARBOX_ROWS);
        if let (true, Some(stored)) = (resumes, self.from) {
            let digest = digested(&path, &stored.state.rows)?;
            return Growing::resume(path, digest);
        }
        folder.start()?;
        Growing::new(path, "")
    }
}

impl GearboxSink for GearboxFileSink<'_> {
    fn begin_rows(&mut self, resumes: bool) -> SinkResult {
        self.rows = Some(self.open(resumes)?);
        Ok(())
    }

    fn row(&mut self, row: &GearboxInstant, energy: &EnergyRow) -> SinkResult {
        if let Some(rows) = &mut self.rows {
            rows.push(&(serde_json::to_string(&(row, energy))? + "\n"));
        }
        Ok(())
    }

    fn checkpoint(&mut self, motion: GearboxCheckpoint) -> SinkResult {
        if let Some(rows) = &mut self.rows {
            let Checkpoints { folder, inputs } = self.checkpoints;
            let state = GearboxState { motion, rows: rows.flush()? };
            folder.write(&Stored::new(inputs, state))?;
        }
        Ok(())
    }
}
