//! What a run gives: columns as arrays, headline numbers, and every file that the command writes.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::OnceLock,
};

use analysis::{Solved, in_time::SolvedInTime};
use numpy::{PyArray1, ndarray::ArrayView1};
use pyo3::{
    exceptions::PyKeyError,
    prelude::*,
    types::{PyDict, PyList},
};
use report::{charts::stills, columns::solved_rows, folder::ResultDirectory};
use tempfile::TempDir;

use crate::{
    arguments::{path, text},
    at_rest::{AtRest, names},
    error::{Complaint, Kind},
    scene::of_json,
    views::view,
};

/// The answer to a scene: columns by name, headline numbers, files.
#[pyclass(frozen, module = "ale_gear", mapping)]
pub struct Result {
    kind: &'static str,
    name: String,
    table: Table,
    headline: String,
    warnings: Vec<String>,
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
/// The file of rows of a result, whichever it has.
const ROWS: [&str; 9] = [
    "positions.csv",
    "history.csv",
    "branch.csv",
    "sweep.csv",
    "bifurcation.csv",
    "basins.csv",
    "resonance.csv",
    "cases.csv",
    "steps.csv",
];

/// Columns of numbers, and of words, in the order of the file.
#[derive(Debug, Default)]
pub struct Table {
    order: Vec<String>,
    numbers: BTreeMap<String, Vec<f64>>,
    words: BTreeMap<String, Vec<String>>,
}

impl Table {
    /// Of columns of numbers.
    fn of(columns: &study::Columns) -> Self {
        let names: Vec<String> = columns.names().into_iter().map(str::to_owned).collect();
        let column = |name: &String| Some((name.clone(), columns.find(name)?.to_vec()));
        let numbers = names.iter().filter_map(column).collect();
        Self { order: names, numbers, words: BTreeMap::new() }
    }

    /// Of a file with commas; a column with a field that is no number is one of words.
    fn parse(csv: &str) -> Self {
        let mut lines = csv.lines().map(fields);
        let order = lines.next().unwrap_or_default();
        let rows: Vec<Vec<String>> = lines.collect();
        let mut table = Self { order, ..Self::default() };
        for (k, name) in table.order.iter().enumerate() {
            let column = || rows.iter().map(move |row| row.get(k).map_or("", String::as_str));
            let numbers: Option<Vec<f64>> = column().map(number).collect();
            match numbers.filter(|_| column().any(|field| !field.is_empty())) {
                Some(numbers) => drop(table.numbers.insert(name.clone(), numbers)),
                None => drop(table.words.insert(name.clone(), column().map(str::to_owned).collect())),
            }
        }
        table
    }

    fn rows(&self) -> usize {
        let words = self.words.values().next().map(Vec::len);
        self.numbers.values().next().map(Vec::len).or(words).unwrap_or(0)
    }
}

/// A number of a file; where a field is empty there is none.
fn number(field: &str) -> Option<f64> {
    if field.is_empty() { Some(f64::NAN) } else { field.parse().ok() }
}

/// Fields of a line, without their quotes.
fn fields(line: &str) -> Vec<String> {
    let (mut all, mut field, mut quoted) = (Vec::new(), String::new(), false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => field.extend(letters.next()),
            '"' => quoted = !quoted,
            ',' if !quoted => all.push(std::mem::take(&mut field)),
            other => field.push(other),
        }
    }
    all.push(field);
    all
}

impl Result {
    /// Of a scene at rest.
    pub fn at_rest(name: &str, solved: AtRest) -> std::result::Result<Self, Complaint> {
        Ok(Self {
            kind: "static",
            name: name.to_owned(),
            table: Table::of(&solved.columns()),
            headline: solved.headline()?,
            warnings: solved.warnings().iter().map(ToString::to_string).collect(),
            failure: solved.verdict().err().map(Complaint::from),
            files: Files::Held(Box::new(solved), OnceLock::new()),
        })
    }

    /// Of a scene in time whose files are written, in the folder [`FILES`] of `folder`; `failure`: why it does not hold.
    pub fn in_time(
        name: &str,
        solved: Box<SolvedInTime>,
        folder: TempDir,
        failure: Option<Complaint>,
    ) -> std::result::Result<Self, Complaint> {
        let solved = Solved::InTime(solved);
        let rows = solved_rows(&solved);
        if rows.is_empty() {
            // Of many motions the files have tables of their own.
            return Self::written(("dynamic", name), folder, failure);
        }
        Ok(Self {
            kind: "dynamic",
            name: name.to_owned(),
            table: Table::of(&rows),
            headline: solved.headline()?.to_string(),
            warnings: solved.warnings().iter().map(ToString::to_string).collect(),
            files: Files::Written(folder),
            failure,
        })
    }

    /// Of files that are written, in the folder [`FILES`] of `folder`.
    pub fn written(
        (kind, name): (&'static str, &str),
        folder: TempDir,
        failure: Option<Complaint>,
    ) -> std::result::Result<Self, Complaint> {
        let at = folder.path().join(FILES);
        let read = |file: &str| std::fs::read_to_string(at.join(file)).map_err(Complaint::from);
        let summary: serde_json::Value = serde_json::from_str(&read("summary.json")?).unwrap_or_default();
        let rows = ROWS.iter().find(|file| at.join(file).is_file());
        let table = rows.map(|file| Ok::<_, Complaint>(Table::parse(&read(file)?))).transpose()?.unwrap_or_default();
        let words = summary["remarks"].as_array().into_iter().flatten().filter_map(|remark| {
            let text = remark["text"].as_str()?;
            Some(remark["hint"].as_str().map_or_else(|| text.to_owned(), |hint| format!("{text}; {hint}")))
        });
        Ok(Self {
            kind,
            name: name.to_owned(),
            table,
            headline: summary["headline"].to_string(),
            warnings: words.collect(),
            files: Files::Written(folder),
            failure,
        })
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
        let table = &own.get().table;
        if let Some(numbers) = table.numbers.get(name) {
            return view(own.clone().into_any(), &ArrayView1::from(&numbers[..])).map(Some);
        }
        let words = table.words.get(name).map(|words| PyList::new(own.py(), words)).transpose()?;
        Ok(words.map(Bound::into_any))
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
            let names: Vec<&str> = slf.get().table.order.iter().map(String::as_str).collect();
            let near = ::scene::nearest(&name, &names).map(|near| format!("; did you mean {near:?}?"));
            PyKeyError::new_err(format!("there is no column {name:?}{}", near.unwrap_or_default()))
        })
    }

    fn __len__(&self) -> usize {
        self.table.order.len()
    }

    fn __contains__(&self, name: &Bound<'_, PyAny>) -> bool {
        name.extract::<String>().is_ok_and(|name| self.table.order.contains(&name))
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(PyList::new(py, &self.table.order)?.try_iter()?.into_any())
    }

    /// Names of the columns, in the order of the file.
    fn keys(&self) -> Vec<String> {
        self.table.order.clone()
    }

    /// Number of rows.
    #[getter]
    fn rows(&self) -> usize {
        self.table.rows()
    }

    /// All columns by name.
    #[getter]
    fn columns<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(slf.py());
        for name in &slf.get().table.order {
            all.set_item(name, Self::column(slf, name)?)?;
        }
        Ok(all)
    }

    /// Where the numbers of a column begin in memory.
    fn address(&self, name: &Bound<'_, PyAny>) -> PyResult<usize> {
        let name = text("name", name)?;
        let column = self.table.numbers.get(&name);
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
        of_json(py, &self.headline)
    }

    /// What a user should hear.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
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
        let table = Table::parse(&self.text(py, &text("file", file)?)?);
        let all = PyDict::new(py);
        for name in &table.order {
            match (table.numbers.get(name), table.words.get(name)) {
                (Some(numbers), _) => all.set_item(name, PyArray1::from_slice(py, numbers))?,
                (_, words) => all.set_item(name, words)?,
            }
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
        let word = if self.holds() { "" } else { ", which does not hold" };
        let (rows, columns) = (self.table.rows(), self.table.order.len());
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
