//! What a run gives: columns as arrays, headline numbers, and every file that the command writes.

use std::{
    borrow::Cow,
    path::{Path, PathBuf},
    sync::OnceLock,
};

use answer::{Answer, Column, Table, Values};
use numpy::{PyArray1, ndarray::ArrayView1};
use pyo3::{
    exceptions::PyKeyError,
    prelude::*,
    types::{PyDict, PyList},
};
use report::charts::stills;
use serde_json::Value;
use store::folder::ResultDirectory;
use tempfile::TempDir;

use crate::{
    arguments::{path, text},
    at_rest::{AtRest, names},
    error::{Complaint, Kind},
    remark::Remark,
    scene::{of_json, of_value},
    views::view,
};

/// The answer to a scene: columns by name, headline numbers, files.
#[pyclass(frozen, module = "ale_gear", mapping)]
pub struct Result {
    kind: &'static str,
    name: String,
    /// Tables of the result; the first one is that of its rows.
    tables: Vec<Table>,
    headline: Value,
    remarks: Vec<answer::Remark>,
    files: Files,
    /// Why it does not hold; nothing where it does.
    failure: Option<Complaint>,
}

/// Where the files of a result are.
enum Files {
    /// Made when they are asked for; the folder is for those that show them.
    Held(Box<AtRest>, OnceLock<TempDir>),
    /// In a folder that goes with the result.
    Written(TempDir),
}

/// Name of the folder of the files in a folder of its own.
pub const FILES: &str = "result";
/// Numbers of a column, or its words as a list.
fn values<'py>(py: Python<'py>, values: &Values) -> PyResult<Bound<'py, PyAny>> {
    match values {
        Values::Numbers(list) => Ok(PyArray1::from_slice(py, list).into_any()),
        Values::Texts(list) => Ok(PyList::new(py, list)?.into_any()),
        // All tables are in memory.
        Values::Kept(_) => Ok(PyList::empty(py).into_any()),
    }
}

impl Result {
    /// Result of a scene at rest.
    pub fn at_rest(name: &str, solved: AtRest) -> std::result::Result<Self, Complaint> {
        Ok(Self {
            kind: "static",
            name: name.to_owned(),
            tables: vec![solved.table()],
            headline: solved.headline()?,
            remarks: solved.remarks().to_vec(),
            failure: solved.verdict().err().map(Complaint::from),
            files: Files::Held(Box::new(solved), OnceLock::new()),
        })
    }

    /// Result of an answer whose files are written in the folder [`FILES`] of `folder`; `failure`: why it does not
    /// hold.
    pub fn written(
        kind: &'static str,
        answer: Answer,
        folder: TempDir,
        failure: Option<Complaint>,
    ) -> std::result::Result<Self, Complaint> {
        let Answer { name, tables, headline, remarks, checks, .. } = answer;
        // Arrays are views of what is in memory.
        let tables = tables.into_iter().map(Table::in_memory).collect::<std::result::Result<Vec<_>, _>>();
        let tables = tables.map_err(report::ReportError::from)?;
        let failure = failure.or_else(|| {
            let failed = checks.failed()?;
            let message = format!("{name}: check failed: {}", failed.missed);
            Some(Complaint::new(Kind::NoResult, message, Some(failed.hint.to_owned())))
        });
        Ok(Self { kind, name, tables, headline, remarks, files: Files::Written(folder), failure })
    }

    /// Columns of the rows, in their order.
    fn own_columns(&self) -> &[Column] {
        self.tables.first().map_or(&[], |table| &table.columns)
    }

    /// Why it does not hold.
    pub fn failure(&self) -> Option<Complaint> {
        self.failure.clone()
    }

    /// A folder with all files of the result.
    fn folder(&self) -> std::result::Result<PathBuf, Complaint> {
        match &self.files {
            Files::Written(folder) => Ok(folder.path().join(FILES)),
            Files::Held(solved, made) => {
                if let Some(folder) = made.get() {
                    return Ok(folder.path().join(FILES));
                }
                let folder = TempDir::new()?;
                let results = ResultDirectory::create(&folder.path().join(FILES))?;
                solved.write(&results)?;
                results.finish(drop)?;
                // Of two at once the first one's folder stays.
                Ok(made.get_or_init(|| folder).path().join(FILES))
            }
        }
    }

    fn write(&self, to: &Path) -> std::result::Result<(), Complaint> {
        let from = self.folder()?;
        let results = ResultDirectory::create(to)?;
        for file in names(&from)? {
            results.copy(&from.join(&file), &file)?;
        }
        Ok(results.finish(drop)?)
    }

    fn column<'py>(own: &Bound<'py, Self>, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        match own.get().own_columns().iter().find(|column| column.name == name).map(|column| &column.values) {
            Some(Values::Numbers(list)) => view(own.clone().into_any(), &ArrayView1::from(&list[..])).map(Some),
            Some(words) => values(own.py(), words).map(Some),
            None => Ok(None),
        }
    }
}

/// A helper of the package in Python, called with a result.
fn helper<'py>(own: &Bound<'py, Result>, name: &str, words: &[&Bound<'py, PyAny>]) -> PyResult<Bound<'py, PyAny>> {
    let all: Vec<&Bound<'py, PyAny>> = [own.as_any()].into_iter().chain(words.iter().copied()).collect();
    let arguments = pyo3::types::PyTuple::new(own.py(), all)?;
    own.py().import("ale_gear._frames")?.getattr(name)?.call1(arguments)
}

#[pymethods]
impl Result {
    /// A column: read-only, in the solver's own memory; a column of words as a list.
    fn __getitem__<'py>(slf: &Bound<'py, Self>, name: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let name = text("name", name)?;
        Self::column(slf, &name)?.ok_or_else(|| {
            let names: Vec<&str> = slf.get().own_columns().iter().map(|column| &*column.name).collect();
            let near = ::scene::nearest(&name, &names).map(|near| format!("; did you mean {near:?}?"));
            PyKeyError::new_err(format!("there is no column {name:?}{}", near.unwrap_or_default()))
        })
    }

    fn __len__(&self) -> usize {
        self.own_columns().len()
    }

    fn __contains__(&self, name: &Bound<'_, PyAny>) -> bool {
        name.extract::<String>().is_ok_and(|name| self.keys().contains(&name))
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(PyList::new(py, self.keys())?.try_iter()?.into_any())
    }

    /// Names of the columns, in the order of the file.
    fn keys(&self) -> Vec<String> {
        self.own_columns().iter().map(|column| column.name.to_string()).collect()
    }

    /// Number of rows.
    #[getter]
    fn rows(&self) -> usize {
        self.tables.first().map_or(0, Table::rows)
    }

    /// All columns by name.
    #[getter]
    fn columns<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(slf.py());
        for column in slf.get().own_columns() {
            all.set_item(&*column.name, Self::column(slf, &column.name)?)?;
        }
        Ok(all)
    }

    /// Where the numbers of a column begin in memory.
    fn address(&self, name: &Bound<'_, PyAny>) -> PyResult<usize> {
        let name = text("name", name)?;
        let column = self.tables.first().and_then(|table| table.find(&name));
        Ok(column.map(|c| c.as_ptr().addr()).ok_or_else(|| {
            Complaint::argument("name", format_args!("is {name:?}, which is no column of numbers"), "see `keys()`")
        })?)
    }

    /// What was run: static, dynamic, plan, optimum or gearbox.
    #[getter]
    fn kind(&self) -> &str {
        self.kind
    }

    /// Name of the case.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// The headline numbers of `summary.json`.
    #[getter]
    fn headline<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        of_value(py, &self.headline)
    }

    /// What a user should hear.
    #[getter]
    fn remarks(&self) -> Vec<Remark> {
        Remark::all(&self.remarks)
    }

    /// Whether the result holds: its certificate, and the accuracy that was asked for.
    #[getter]
    fn holds(&self) -> bool {
        self.failure.is_none()
    }

    /// `summary.json`: inputs with all defaults, geometry, cost, certificate, headline.
    #[getter]
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        of_json(py, &self.text(py, "summary.json")?)
    }

    /// Names of the files that [`Result::save`] writes.
    #[getter]
    fn files(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        Ok(py.detach(|| Ok::<_, Complaint>(names(&self.folder()?)?))?)
    }

    /// The columns of one of the files, as `result.read("harris.csv")`.
    fn read<'py>(&self, py: Python<'py>, file: &Bound<'_, PyAny>) -> PyResult<Bound<'py, PyDict>> {
        let file = text("file", file)?;
        let known = self.tables.iter().find(|table| file.strip_suffix(".csv") == Some(&table.name));
        let read = || -> std::result::Result<Table, Complaint> {
            let text = self.text(py, &file)?;
            let wrong = |e: answer::TableError| Complaint::new(Kind::Argument, e.to_string(), Some(e.hint().into()));
            Table::read(file.trim_end_matches(".csv"), &text, usize::MAX).map_err(wrong)
        };
        let table = known.map_or_else(|| read().map(Cow::Owned), |table| Ok(Cow::Borrowed(table)))?;
        let all = PyDict::new(py);
        for column in &table.columns {
            all.set_item(&*column.name, values(py, &column.values)?)?;
        }
        Ok(all)
    }

    /// Writes the files that the command writes into a folder, which appears when they are complete.
    fn save(&self, py: Python<'_>, folder: &Bound<'_, PyAny>) -> PyResult<()> {
        let to = path("folder", folder)?;
        Ok(py.detach(|| self.write(&to))?)
    }

    /// The folder of the files for ParaView, of a result at rest with fields.
    fn _fields(&self) -> Option<PathBuf> {
        match &self.files {
            Files::Held(solved, _) => solved.fields(),
            Files::Written(folder) => Some(folder.path().join(FILES)),
        }
    }

    /// A table of pandas, a row a row.
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        helper(slf, "to_pandas", &[])
    }

    /// A data set of xarray over the first column, with units.
    fn to_xarray<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        helper(slf, "to_xarray", &[])
    }

    /// Both gears with their fields at a position, where fields were asked for.
    #[pyo3(signature = (position = None))]
    fn to_pyvista<'py>(slf: &Bound<'py, Self>, position: Option<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        let position = position.unwrap_or_else(|| slf.py().None().into_bound(slf.py()));
        helper(slf, "to_pyvista", &[&position])
    }

    fn __repr__(&self) -> String {
        let word = if self.holds() { "" } else { ", which failed a check" };
        let (rows, columns) = (self.rows(), self.own_columns().len());
        format!("Result({:?}, {}: {rows} rows of {columns} columns{word})", self.name, self.kind)
    }

    /// The report's charts.
    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        let own = slf.get();
        let page = own.text(slf.py(), "report.html")?;
        let pictures = PyList::new(slf.py(), stills(&page))?;
        helper(slf, "html", &[pictures.as_any()])?.extract()
    }
}

impl Result {
    /// The text of one of its files.
    fn text(&self, py: Python<'_>, file: &str) -> std::result::Result<String, Complaint> {
        py.detach(|| {
            let folder = self.folder()?;
            let all = names(&folder)?;
            if !all.iter().any(|name| name == file) {
                let hint = format!("it has {}", all.join(", "));
                return Err(Complaint::new(
                    Kind::Argument,
                    format_args!("the result has no file {file:?}"),
                    Some(hint),
                ));
            }
            std::fs::read_to_string(folder.join(file)).map_err(|e| {
                let hint = Some("`save` writes it; read it as what it is".into());
                Complaint::new(Kind::Argument, format_args!("{file}: is no text: {e}"), hint)
            })
        })
    }
}
