//! `cases.csv`: a row a case, written as they come and put in order at the end.

use std::{
    collections::BTreeMap,
    fs::{self, File, OpenOptions},
    io::{self, Write},
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

use scene::plan::{Plan, PlanAxis, PlanOutput};

use crate::csv::always_quoted;

/// What came of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseRow {
    /// Its number, from 0.
    pub case: usize,
    /// Values of the axes.
    pub values: Vec<f64>,
    /// The numbers wanted, or why there are none.
    pub outcome: Result<Vec<f64>, String>,
}

/// The rows of a plan.
#[derive(Debug, Clone)]
pub struct CaseTable {
    header: String,
    outputs: usize,
}

impl CaseTable {
    /// Of a plan.
    pub fn of(plan: &Plan) -> Self {
        let axes = plan.axes.iter().map(PlanAxis::name).map(str::to_owned);
        let outputs = plan.outputs.iter().map(PlanOutput::name);
        let names: Vec<String> = ["case".to_owned()].into_iter().chain(axes).chain(outputs).collect();
        Self { header: names.join(",") + ",status,reason\n", outputs: plan.outputs.len() }
    }

    /// First line of the file.
    pub fn header(&self) -> &str {
        &self.header
    }

    /// A row as its line; numbers read back to the same bits.
    pub fn line(&self, row: &CaseRow) -> String {
        let mut line = row.case.to_string();
        for value in &row.values {
            line.push_str(&format!(",{value}"));
        }
        match &row.outcome {
            Ok(numbers) => {
                for number in numbers {
                    line.push_str(&format!(",{number}"));
                }
                line.push_str(",ok,\n");
            }
            Err(why) => {
                line.push_str(&",".repeat(self.outputs));
                line.push_str(",failed,");
                line.push_str(&always_quoted(&why.replace(['\n', '\r'], " ")));
                line.push('\n');
            }
        }
        line
    }
}

/// The cases of a plan that are done, in a file beside the results: a run that is cut short goes on from there.
///
/// The first line says which plan they belong to. A line that was cut short is none.
#[derive(Debug)]
pub struct DoneCases {
    /// None where they are kept in memory alone.
    file: Option<(PathBuf, Mutex<File>)>,
    lines: Mutex<BTreeMap<usize, String>>,
}

/// Beginning of the first line.
const OF: &str = "# cases of ";

impl DoneCases {
    /// In memory alone.
    pub fn in_memory(lines: BTreeMap<usize, String>) -> Self {
        Self { file: None, lines: Mutex::new(lines) }
    }

    /// Those of a plan with this digest; of another plan: none.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn open(path: &Path, digest: &str) -> io::Result<Self> {
        let first = format!("{OF}{digest}\n");
        let mut lines = BTreeMap::new();
        match fs::read_to_string(path) {
            Ok(text) if text.starts_with(&first) => {
                for line in text[first.len()..].split_inclusive('\n').filter(|line| line.ends_with('\n')) {
                    if let Some(case) = line.split(',').next().and_then(|n| n.parse::<usize>().ok()) {
                        lines.insert(case, line.to_owned());
                    }
                }
            }
            Ok(_) => {}
            Err(e) if e.kind() == io::ErrorKind::NotFound => {}
            Err(e) => return Err(e),
        }
        // What was cut short is left out, and what another plan left too.
        let whole: String = [first].into_iter().chain(lines.values().cloned()).collect();
        let beside = path.with_extension("new");
        fs::write(&beside, whole)?;
        fs::rename(&beside, path)?;
        let file = OpenOptions::new().append(true).open(path)?;
        Ok(Self { file: Some((path.to_owned(), Mutex::new(file))), lines: Mutex::new(lines) })
    }

    /// Whether a case is done.
    pub fn has(&self, case: usize) -> bool {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).contains_key(&case)
    }

    /// How many are.
    pub fn count(&self) -> usize {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// One more.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn add(&self, case: usize, line: String) -> io::Result<()> {
        if let Some((_, file)) = &self.file {
            file.lock().unwrap_or_else(PoisonError::into_inner).write_all(line.as_bytes())?;
        }
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).insert(case, line);
        Ok(())
    }

    /// All lines in the order of their cases.
    pub fn text(&self) -> String {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).values().map(String::as_str).collect()
    }

    /// Takes the file away: the results hold everything.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn remove(self) -> io::Result<()> {
        self.file.map_or(Ok(()), |(path, _)| fs::remove_file(path))
    }
}
