//! A gearbox file: shafts, bearings and several meshes, at rest, swinging and in motion.

use std::{path::Path, sync::Arc};

use ::scene::{Document, gearbox::Gearbox as GearboxFile};
use analysis::{Context, GearCache, Recorder, SharedModels};
use pyo3::prelude::*;
use report::gearbox_files::write_gearbox;
use store::folder::ResultDirectory;
use tempfile::TempDir;

use crate::{
    analyses::{self, Held},
    arguments::{Given, path, text},
    error::Complaint,
    pair::{cache_of, that_holds, threads_of},
    result::{FILES, Result},
    words::{numbers_of, plan_of},
    work::{Watch, run},
};

type Answer<T> = std::result::Result<T, Complaint>;

/// A gearbox file that was checked, with the scenes of its pairs.
#[pyclass(frozen, module = "ale_gear")]
pub struct Gearbox {
    file: Arc<GearboxFile>,
    document: Document,
}

#[pymethods]
impl Gearbox {
    /// Gearbox of a file; paths in it are relative to it.
    #[staticmethod]
    fn read(file: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self::of(Document::read(&path("file", file)?).map_err(Complaint::from)?)?)
    }

    /// Gearbox of the text of a file; `file` is what messages name, and what paths in it are relative to.
    #[staticmethod]
    #[pyo3(signature = (toml, file = None))]
    fn parse(toml: &Bound<'_, PyAny>, file: Given<'_, '_>) -> PyResult<Self> {
        let at = file.map(|any| path("file", any)).transpose()?;
        let at = at.as_deref().unwrap_or(Path::new("gearbox.toml"));
        Ok(Self::of(Document::new(text("toml", toml)?, at))?)
    }

    /// Title.
    #[getter]
    fn name(&self) -> &str {
        &self.file.name
    }

    /// Names of the shafts, in the order of the file.
    #[getter]
    fn shafts(&self) -> Vec<&str> {
        self.file.shafts.iter().map(|own| own.name.as_str()).collect()
    }

    /// Names of the bearings.
    #[getter]
    fn bearings(&self) -> Vec<&str> {
        self.file.bearings.iter().map(|own| own.name.as_str()).collect()
    }

    /// Names of the meshes.
    #[getter]
    fn meshes(&self) -> Vec<&str> {
        self.file.meshes.iter().map(|own| own.name.as_str()).collect()
    }

    /// Solves it as its file asks: `ale-gear run`. Rows are those of `positions.csv`; `read` has all other files.
    #[pyo3(signature = (*, cache = None, threads = None, progress = None))]
    fn run(
        &self,
        py: Python<'_>,
        cache: Given<'_, '_>,
        threads: Given<'_, '_>,
        progress: Given<'_, '_>,
    ) -> PyResult<Py<Result>> {
        let (file, cache) = (Arc::clone(&self.file), cache_of(cache)?);
        let threads = threads.map(threads_of).transpose()?;
        let result = run(py, progress, threads, move |watch| solved(&file, &*cache, watch))?;
        that_holds(py, result)
    }

    /// Solves many cases of it: by list, grid or sample; a row of wanted numbers of the headline a case. Keys are those of
    /// `ale-gear vary`: `bearing.0.stiffness_n_per_mm.0`, `mesh.0.scene.pinion.modification.lead_slope_um`.
    #[pyo3(signature = (
        vary, outputs, *, samples = None, design = None, seed = None, cache = None, threads = None, progress = None
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn vary(
        &self,
        py: Python<'_>,
        vary: &Bound<'_, PyAny>,
        outputs: &Bound<'_, PyAny>,
        samples: Given<'_, '_>,
        design: Given<'_, '_>,
        seed: Given<'_, '_>,
        cache: Given<'_, '_>,
        threads: Given<'_, '_>,
        progress: Given<'_, '_>,
    ) -> PyResult<Py<Result>> {
        let (plan, words) = plan_of((self.document.clone(), Vec::new()), (vary, outputs), (samples, design, seed))?;
        let again = format!("ale_gear.Gearbox.read(file).vary({words})");
        let (cache, threads) = (cache_of(cache)?, threads.map(threads_of).transpose()?);
        let result = run(py, progress, threads, move |watch| {
            let models = SharedModels::new(&*cache);
            analyses::vary(&plan, &again, Held { models: &models, cache: &*cache, meshes: None }, watch)
        })?;
        that_holds(py, result)
    }

    /// Searches the design whose numbers of the headline are smallest in the mean, within limits, by differences:
    /// `ale-gear optimise --goal`.
    #[pyo3(signature = (
        parameters, goals, *, limits = None, evaluations = None, cache = None, threads = None, progress = None
    ))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn optimise(
        &self,
        py: Python<'_>,
        parameters: &Bound<'_, PyAny>,
        goals: &Bound<'_, PyAny>,
        limits: Given<'_, '_>,
        evaluations: Given<'_, '_>,
        cache: Given<'_, '_>,
        threads: Given<'_, '_>,
        progress: Given<'_, '_>,
    ) -> PyResult<Py<Result>> {
        let (plan, words) =
            numbers_of((self.document.clone(), Vec::new()), (parameters, goals), (limits, evaluations))?;
        let again = format!("ale_gear.Gearbox.read(file).optimise({words})");
        let (cache, threads) = (cache_of(cache)?, threads.map(threads_of).transpose()?);
        let result = run(py, progress, threads, move |watch| {
            let models = SharedModels::new(&*cache);
            analyses::number_optimum(&plan, &again, Held { models: &models, cache: &*cache, meshes: None }, watch)
        })?;
        that_holds(py, result)
    }

    fn __repr__(&self) -> String {
        let [shafts, bearings, meshes] = [self.file.shafts.len(), self.file.bearings.len(), self.file.meshes.len()];
        format!("Gearbox({:?}: {shafts} shafts, {bearings} bearings, {meshes} meshes)", self.file.name)
    }
}

impl Gearbox {
    fn of(document: Document) -> Answer<Self> {
        Ok(Self { file: Arc::new(document.gearbox(&[])?), document })
    }
}

fn solved(file: &GearboxFile, cache: &dyn GearCache, watch: &mut Watch) -> Answer<Result> {
    let solved = analysis::solve(file, Context::new(watch).with_cache(cache))?.finished()?;
    let folder = TempDir::new()?;
    let results = ResultDirectory::create(&folder.path().join(FILES))?;
    let written = write_gearbox(file, &solved, watch.cost(), &results)?;
    results.finish(drop)?;
    let failure = solved.verdict(file).err().map(Complaint::from);
    Result::written("gearbox", written.answer, folder, failure)
}
