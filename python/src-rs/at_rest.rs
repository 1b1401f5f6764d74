//! A scene at rest: solved on what the pair holds, kept in memory, written when it is asked for.

use std::{sync::Mutex, sync::PoisonError};

use ::scene::Scene;
use analysis::Recorder;
use analysis::{
    AnalysisError, DerivativeRecorder, Derivatives, GearCache, SharedModels, SinkResult, StaticAnalysis, StaticResult,
    StaticSink,
    facts::RunInfo,
    remark::Remark,
    results::{root_stress_headline, root_stress_remarks, static_headline},
    static_certificate,
};
use answer::Table;
use columns::history_table;
use export::paraview::FieldWriter;
use export::view::{View, ViewRecorder};
use ltca::{StaticHistory, StaticModel, StaticPosition};
use report::{Cost, ReportError, write_static_result};
use store::folder::ResultDirectory;
use tempfile::TempDir;

use crate::{error::Complaint, work::Watch};

/// A solved scene with all that its files are made of.
pub struct AtRest {
    scene: Scene,
    history: StaticHistory,
    facts: RunInfo,
    cost: Cost,
    /// Where the scene asks for some.
    derivatives: Option<Derivatives>,
    /// Files for ParaView, where they were asked for.
    fields: Option<TempDir>,
    gears: Mutex<InSpace>,
}

/// The gears in space: remembered, then drawn when somebody writes the result.
enum InSpace {
    Remembered(Box<(ViewRecorder, StaticModel)>),
    Drawn(Option<Box<View>>, Vec<Remark>),
}

/// Remembers what the files are made of, and writes fields on the way.
struct Keeper<'a> {
    scene: &'a Scene,
    recorder: ViewRecorder,
    /// Why there is none is told at the first position.
    derivatives: Result<Option<DerivativeRecorder>, Option<AnalysisError>>,
    fields: Option<(FieldWriter<'a>, &'a ResultDirectory)>,
    start: std::time::Instant,
    first_result_s: Option<f64>,
}

impl StaticSink for Keeper<'_> {
    fn begin(&mut self, scene: &Scene) {
        self.recorder = ViewRecorder::new(scene);
        self.derivatives = DerivativeRecorder::new(scene).map_err(Some);
        self.fields = self.fields.take().map(|(_, results)| (FieldWriter::new(self.scene, results), results));
    }

    fn position(&mut self, index: usize, position: &StaticPosition, model: &StaticModel) -> SinkResult {
        self.first_result_s.get_or_insert_with(|| self.start.elapsed().as_secs_f64());
        self.recorder.position(index, position, model);
        match &mut self.derivatives {
            Ok(Some(recorder)) => recorder.position(model)?,
            Ok(None) => {}
            Err(why) => return why.take().map_or(Ok(()), |why| Err(why.into())),
        }
        Ok(self.fields.as_mut().map_or(Ok(()), |(fields, _)| fields.position(index, position, model))?)
    }

    fn finish(&mut self) -> SinkResult {
        Ok(self.fields.as_mut().map_or(Ok(()), |(fields, _)| fields.finish())?)
    }
}

impl AtRest {
    /// Solves a scene on what earlier ones have left.
    pub fn solve(
        scene: &Scene,
        models: &SharedModels<'_>,
        cache: &dyn GearCache,
        watch: &mut Watch,
    ) -> Result<Self, Complaint> {
        let folder = if scene.output.vtu { Some(TempDir::new()?) } else { None };
        let results = folder.as_ref().map(|f| ResultDirectory::create(&f.path().join(FIELDS))).transpose()?;
        let mut keeper = Keeper {
            scene,
            recorder: ViewRecorder::new(scene),
            derivatives: Ok(None),
            fields: results.as_ref().map(|r| (FieldWriter::new(scene, r), r)),
            start: watch.start(),
            first_result_s: None,
        };
        let analysis = StaticAnalysis::new(scene).with_cache(cache).with_shared(models);
        let result = analysis.solve_into(watch, &mut keeper)?;
        let Keeper { recorder, derivatives, first_result_s, .. } = keeper;
        let derivatives = derivatives.ok().flatten().map(DerivativeRecorder::into_derivatives);
        if let Some(results) = results {
            results.finish(drop)?;
        }
        let StaticResult { scene: solved, mut history, mut facts, model, .. } = result;
        facts.certificate = static_certificate(&solved, &history.positions);
        let gears = match model {
            Some(model) => {
                facts.first_result_s = first_result_s;
                let root = root_stress_headline(&history).map(|root| root.largest_tensions());
                history.remarks.extend(root.into_iter().flat_map(root_stress_remarks));
                InSpace::Remembered(Box::new((recorder, model)))
            }
            None => InSpace::Drawn(None, Vec::new()),
        };
        let cost = watch.cost();
        Ok(Self { scene: solved, history, facts, cost, derivatives, fields: folder, gears: Mutex::new(gears) })
    }

    /// The rows, column by column.
    pub fn table(&self) -> Table {
        history_table(&self.scene, &self.history, self.derivatives.as_ref())
    }

    /// The headline numbers.
    pub fn headline(&self) -> Result<serde_json::Value, Complaint> {
        let headline = static_headline(&self.scene, &self.history).map_err(ReportError::from)?;
        Ok(serde_json::to_value(&headline).unwrap_or_default())
    }

    /// What a user should hear.
    pub fn remarks(&self) -> &[Remark] {
        &self.history.remarks
    }

    /// Whether it holds.
    pub fn verdict(&self) -> Result<(), AnalysisError> {
        self.facts.verdict(&self.scene)
    }

    /// The folder of the files for ParaView.
    pub fn fields(&self) -> Option<std::path::PathBuf> {
        self.fields.as_ref().map(|folder| folder.path().join(FIELDS))
    }

    /// Writes all files that the command writes; what comes back is the closing table.
    pub fn write(&self, results: &ResultDirectory) -> Result<String, ReportError> {
        if let Some(folder) = self.fields() {
            // Each folder has a record of its own.
            for file in names(&folder)?.iter().filter(|name| *name != "summary.json") {
                results.copy(&folder.join(file), file)?;
            }
        }
        let mut gears = self.gears.lock().unwrap_or_else(PoisonError::into_inner);
        if let InSpace::Remembered(remembered) = &mut *gears {
            let (recorder, model) = &mut **remembered;
            let recorder = std::mem::replace(recorder, ViewRecorder::new(&self.scene));
            let mut said = Vec::new();
            let view = recorder.view_or_remark(&self.scene, model, &mut said).map(Box::new);
            *gears = InSpace::Drawn(view, said);
        }
        let (view, said) = match &*gears {
            InSpace::Drawn(view, said) => (view.as_deref(), &said[..]),
            InSpace::Remembered(_) => (None, &[][..]),
        };
        let mut history = self.history.clone();
        history.remarks.extend_from_slice(said);
        let rows = (&history, self.derivatives.as_ref());
        write_static_result(&self.scene, rows, (&self.facts, &self.cost), view, results).map(|written| written.table)
    }
}

/// Name of the folder of fields in a folder of its own.
const FIELDS: &str = "fields";

/// Names of the files of a folder, ascending.
pub fn names(folder: &std::path::Path) -> Result<Vec<String>, ReportError> {
    let failed = |cause| columns::ColumnsError::Read { file: folder.to_owned(), cause };
    let entries = std::fs::read_dir(folder).map_err(failed)?;
    let names = entries.map(|entry| entry.map(|e| e.file_name().to_string_lossy().into_owned()));
    let mut names = names.collect::<Result<Vec<_>, _>>().map_err(failed)?;
    names.sort_unstable();
    Ok(names)
}
