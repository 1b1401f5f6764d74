//! A result folder read back.

use std::path::{Path, PathBuf};

use answer::Table;
use files::{most, read_regular_text};
use serde_json::Value;

use crate::{ReportError, SUMMARY_SCHEMA};

/// Columns of a table: some hundred with those of single pairs. Each becomes a picture.
const MOST_COLUMNS: usize = 2000;
/// Tables of an answer: a motion has some ten.
const MOST_TABLES: usize = 50;

/// What those are told who gave another folder.
const MAKE_ONE: &str = "give folders that ale-gear has made, with `--out DIR`";

/// What an answer has left in its folder.
#[derive(Debug, Clone)]
pub struct ResultFolder {
    path: PathBuf,
    pub(super) summary: Value,
    pub(super) tables: Vec<Table>,
}

impl ResultFolder {
    /// Reads `summary.json` alone.
    ///
    /// # Errors
    /// [`ReportError::NoResult`] when the folder is no result of this program, or of a version with other summaries.
    pub fn open(path: &Path) -> Result<Self, ReportError> {
        Ok(Self { path: path.to_owned(), summary: summary(path)?, tables: Vec::new() })
    }

    /// Reads `summary.json` and the tables that it names.
    ///
    /// # Errors
    /// As [`ResultFolder::open`], and where a table is damaged.
    pub fn read(path: &Path) -> Result<Self, ReportError> {
        let mut new = Self::open(path)?;
        for name in new.table_names() {
            let file = path.join(format!("{name}.csv"));
            let text = read_regular_text(&file, most::ROWS).map_err(|e| damaged(&file, &e.to_string()))?;
            new.push(&name, &text)?;
        }
        Ok(new)
    }

    /// A result from the texts of `summary.json` and of its first table; `path` is what messages name.
    ///
    /// # Errors
    /// As [`ResultFolder::read`].
    pub fn parse(path: &Path, summary: &str, rows: Option<&str>) -> Result<Self, ReportError> {
        let mut new = Self { path: path.to_owned(), summary: summary_in(summary, path)?, tables: Vec::new() };
        if let (Some(name), Some(rows)) = (new.table_names().first(), rows) {
            new.push(name, rows)?;
        }
        Ok(new)
    }

    /// Tables that the summary names; a name that leads out of the folder is none.
    fn table_names(&self) -> Vec<String> {
        let is_plain = |name: &&str| name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
        let listed = self.summary["tables"].as_array().into_iter().flatten().filter_map(Value::as_str);
        listed.filter(is_plain).take(MOST_TABLES).map(str::to_owned).collect()
    }

    fn push(&mut self, name: &str, text: &str) -> Result<(), ReportError> {
        let table = Table::read(name, text, MOST_COLUMNS).map_err(|e| damaged(&self.path, &e.to_string()))?;
        self.tables.push(table);
        Ok(())
    }

    /// The folder as the user named it.
    pub fn label(&self) -> String {
        self.path.display().to_string()
    }

    /// What does not hold of it, in words; nothing where all does.
    pub fn missed(&self) -> Vec<&str> {
        let listed = self.summary["certificate_missed"].as_array();
        listed.into_iter().flatten().filter_map(Value::as_str).collect()
    }

    /// Kind of question that it answers.
    pub fn kind(&self) -> &str {
        self.summary["kind"].as_str().unwrap_or_default()
    }

    /// Everything but the rows.
    pub fn summary(&self) -> &Value {
        &self.summary
    }

    /// Whether the rows are of motion in time.
    pub fn is_motion(&self) -> bool {
        self.summary["inputs"]["analysis"]["kind"] == "dynamic"
    }

    /// Rows.
    pub(super) fn tables(&self) -> &[Table] {
        &self.tables
    }
}

fn damaged(file: &Path, what: &str) -> ReportError {
    ReportError::NoResult {
        file: file.to_owned(),
        what: what.to_owned(),
        hint: "make the result again into this folder",
    }
}

/// The summary of a result folder.
///
/// # Errors
/// [`ReportError::NoResult`] when it has none that this version reads.
pub fn summary(folder: &Path) -> Result<Value, ReportError> {
    let refuse = |what: String, hint: &'static str| Err(ReportError::NoResult { file: folder.to_owned(), what, hint });
    if !folder.is_dir() {
        return refuse(if folder.exists() { "is not a folder" } else { "there is no such folder" }.into(), MAKE_ONE);
    }
    let text = match read_regular_text(&folder.join("summary.json"), most::SUMMARY) {
        Ok(text) => text,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return refuse("has no summary.json".into(), MAKE_ONE),
        Err(e) => return refuse(format!("summary.json cannot be read: {e}"), MAKE_ONE),
    };
    summary_in(&text, folder)
}

/// The summary in the text of its file.
fn summary_in(text: &str, folder: &Path) -> Result<Value, ReportError> {
    let refuse = |what: String, hint: &'static str| Err(ReportError::NoResult { file: folder.to_owned(), what, hint });
    let summary: Value = match serde_json::from_str(text) {
        Ok(summary) => summary,
        Err(e) => return refuse(format!("summary.json is no JSON: {e}"), "make the result again into this folder"),
    };
    if summary["program"] != "ale-gear" {
        return refuse("summary.json is of another program".into(), MAKE_ONE);
    }
    if summary["schema"] != SUMMARY_SCHEMA || !summary["headline"].is_object() {
        let version = summary["version"].as_str().unwrap_or("unknown");
        return refuse(
            format!(
                "summary.json has schema {}, this program reads {SUMMARY_SCHEMA} (written by version {version})",
                summary["schema"]
            ),
            "make the result again with this version",
        );
    }
    Ok(summary)
}
