//! A gearbox file: shafts, bearings and several meshes, at rest, swinging and in motion.

use std::{path::Path, sync::Arc};

use ::scene::gearbox::Gearbox as GearboxFile;
use analysis::Recorder;
use analysis::{Context, GearCache};
use pyo3::prelude::*;
use report::gearbox_files::write_gearbox;
use store::folder::ResultDirectory;
use tempfile::TempDir;

use crate::{
    arguments::{Given, path, text},
    error::{Complaint, Kind},
    pair::{cache_of, that_holds, threads_of},
    result::{FILES, Result},
    work::{Watch, run},
};

type Answer<T> = std::result::Result<T, Complaint>;

/// A gearbox file that was checked, with the scenes of its pairs.
#[pyclass(frozen, module = "ale_gear")]
pub struct Gearbox {
    file: Arc<GearboxFile>,
}

#[pymethods]
impl Gearbox {
    /// Of a file; paths in it are relative to it.
    #[staticmethod]
    fn read(file: &Bound<'_, PyAny>) -> PyResult<Self> {
        let read = GearboxFile::read(&path("file", file)?).map_err(Complaint::from)?;
        Ok(Self { file: Arc::new(read) })
    }

    /// Of the text of a file; `file` is what messages name, and what paths in it are relative to.
    #[staticmethod]
    #[pyo3(signature = (toml, file = None))]
    fn parse(toml: &Bound<'_, PyAny>, file: Given<'_, '_>) -> PyResult<Self> {
        let at = file.map(|any| path("file", any)).transpose()?;
        let at = at.as_deref().unwrap_or(Path::new("gearbox.toml"));
        let read = GearboxFile::parse(&text("toml", toml)?, at).map_err(Complaint::from)?;
        Ok(Self { file: Arc::new(read) })
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

    fn __repr__(&self) -> String {
        let [shafts, bearings, meshes] = [self.file.shafts.len(), self.file.bearings.len(), self.file.meshes.len()];
        format!("Gearbox({:?}: {shafts} shafts, {bearings} bearings, {meshes} meshes)", self.file.name)
    }
}

fn solved(file: &GearboxFile, cache: &dyn GearCache, watch: &mut Watch) -> Answer<Result> {
    let solved = analysis::solve(file, Context::new(watch).with_cache(cache))?.finished()?;
    let folder = TempDir::new()?;
    let results = ResultDirectory::create(&folder.path().join(FILES))?;
    let written = write_gearbox(file, &solved, watch.cost(), &results)?;
    results.finish(drop)?;
    let failure = solved.checks().failed().map(|failed| {
        let words = format_args!("the result does not hold: {}", failed.missed);
        Complaint::new(Kind::NoResult, words, Some(failed.hint.into()))
    });
    Ok(Result::written("gearbox", written.answer, folder, failure))
}
