//! A motion into files: rows as they come, checkpoints, the gears in space.

use std::path::Path;

use analysis::{
    Observer, PhaseWork, SinkResult,
    facts::MeshFacts,
    motion::{MotionCheckpoint, MotionLayout, MotionRow, MotionSink},
    run_phase,
};
use dynamics::SideLoads;
use ltca::{StaticModel, StaticPosition};
use scene::Scene;

use crate::{
    paraview::FieldWriter,
    view::{View, ViewRecorder},
};
use store::checkpoint::{CheckpointError, Checkpoints, PairState, Rows, Stored};
use store::{ResultFiles, StoreError};

/// Where rows and checkpoints of a motion go.
pub struct MotionFileSink<'a> {
    scene: &'a Scene,
    /// Folder of the rows.
    folder: &'a Path,
    checkpoints: Option<Checkpoints<'a>>,
    /// State that the run goes on from.
    from: Option<&'a Stored<PairState>>,
    meshes: Vec<MeshFacts>,
    recorder: ViewRecorder,
    rows: Option<Rows>,
    fields: Option<FieldWriter<'a>>,
    /// The gears in space, once the quasi-static mesh cycle is solved.
    pub view: Option<View>,
}

impl<'a> MotionFileSink<'a> {
    /// Sink of a scene. Rows go into `folder`, with checkpoints where there are some; `from` is what the run goes on
    /// from.
    pub fn new(
        scene: &'a Scene,
        folder: &'a Path,
        checkpoints: Option<Checkpoints<'a>>,
        from: Option<&'a Stored<PairState>>,
    ) -> Self {
        let recorder = ViewRecorder::new(scene);
        let (rows, fields, view) = (None, None, None);
        Self { scene, folder, checkpoints, from, meshes: Vec::new(), recorder, rows, fields, view }
    }

    /// With fields for ParaView into `results`, as the scene asks for them.
    #[must_use]
    pub fn with_fields(self, results: &'a dyn ResultFiles) -> Self {
        Self { fields: Some(FieldWriter::new(self.scene, results)), ..self }
    }

    /// Checks that the meshes are those of the checkpoint.
    fn check_inputs(&self) -> Result<(), CheckpointError> {
        self.from.map_or(Ok(()), |stored| stored.check_meshes(self.scene, &self.meshes))
    }

    fn open(&self, layout: &MotionLayout, resumes: bool) -> Result<Rows, StoreError> {
        if let (true, Some(stored)) = (resumes, self.from) {
            return Rows::resume(layout, self.folder, &stored.state.rows);
        }
        if let Some(Checkpoints { folder, .. }) = self.checkpoints {
            folder.start()?;
        }
        Rows::new(layout, self.folder)
    }
}

impl MotionSink for MotionFileSink<'_> {
    fn meshes(&mut self, meshes: &[MeshFacts]) -> SinkResult {
        meshes.clone_into(&mut self.meshes);
        Ok(self.check_inputs().map_err(StoreError::from)?)
    }

    fn begin(&mut self) {
        (self.recorder, self.rows, self.view) = (ViewRecorder::new(self.scene), None, None);
    }

    fn position(&mut self, index: usize, position: &StaticPosition, model: &StaticModel) {
        self.recorder.position(index, position, model);
    }

    fn quasi_static(&mut self, model: &StaticModel, observer: &mut dyn Observer) -> Vec<answer::Remark> {
        let recorder = std::mem::replace(&mut self.recorder, ViewRecorder::new(self.scene));
        let mut remarks = Vec::new();
        let view = run_phase(observer, "view", PhaseWork::Unknown, |_| {
            recorder.view_or_remark(self.scene, model, &mut remarks)
        });
        self.view = view.map(View::quasi_static);
        remarks
    }

    fn begin_rows(&mut self, layout: &MotionLayout, from: Option<&MotionCheckpoint>) -> SinkResult {
        self.rows = Some(self.open(layout, from.is_some())?);
        Ok(())
    }

    fn row(&mut self, row: &MotionRow) -> SinkResult {
        if let Some(rows) = &mut self.rows {
            rows.push(row);
        }
        Ok(())
    }

    fn wants_fields(&self, row: u64) -> bool {
        self.fields.as_ref().is_some_and(|fields| fields.is_due(row as usize))
    }

    fn fields(&mut self, row: u64, time_s: f64, sides: &[SideLoads<'_>]) -> SinkResult {
        let Some(fields) = &mut self.fields else { return Ok(()) };
        Ok(fields.row(row as usize, time_s, sides)?)
    }

    fn checkpoint(&mut self, state: MotionCheckpoint) -> SinkResult {
        if let (Some(Checkpoints { folder, inputs }), Some(rows)) = (self.checkpoints, &mut self.rows) {
            let kept = rows.flush()?;
            folder.write(&Stored::new(inputs, PairState::new(&self.meshes, state, kept)))?;
        }
        Ok(())
    }

    fn finish(&mut self) -> SinkResult {
        if let Some(rows) = &mut self.rows {
            rows.flush()?;
        }
        if let Some(fields) = &mut self.fields {
            fields.finish()?;
        }
        Ok(())
    }
}
