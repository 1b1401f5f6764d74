//! A result folder read back.

use std::path::{Path, PathBuf};

use files::{most, read_regular_text};
use serde_json::Value;

use study::Columns;

use crate::{ReportError, SUMMARY_SCHEMA, parse_columns};

/// Files of rows that can be laid over each other, in the order in which they are looked for.
const ROWS: [&str; 2] = ["history.csv", "resonance.csv"];
/// The first column of words behind the numbers of a sweep.
const WORDS: &str = "start";
/// Ways of a sweep: up and down, and some to spare.
const MOST_WAYS: usize = 16;
/// Columns of a file: some hundred with those of single pairs. Each becomes a picture.
const MOST_COLUMNS: usize = 2000;

/// What those are told who gave another folder.
const MAKE_ONE: &str = "give folders that `ale-gear run SCENE.toml --out DIR` has made";

/// What a run has left in its folder.
#[derive(Debug, Clone)]
pub struct ResultFolder {
    path: PathBuf,
    summary: Value,
    /// Rows, in parts where a column of words tells ways apart.
    parts: Vec<(String, Columns)>,
}

impl ResultFolder {
    /// Reads `summary.json`, and the file of rows if there is one.
    ///
    /// # Errors
    /// [`ReportError::NoResult`] when the folder is no result of this program, or of a version with other summaries.
    pub fn read(path: &Path) -> Result<Self, ReportError> {
        let mut new = Self { path: path.to_owned(), summary: summary(path)?, parts: Vec::new() };
        for name in ROWS {
            let file = path.join(name);
            match read_regular_text(&file, most::ROWS) {
                Ok(text) => {
                    new.parts = parts(&text, &file)?;
                    break;
                }
                Err(e) if e.kind() == std::io::ErrorKind::NotFound => {}
                Err(e) => return Err(damaged(&file, &e.to_string())),
            }
        }
        Ok(new)
    }

    /// The same from the texts of `summary.json` and of the file of rows; `path` is what messages name.
    ///
    /// # Errors
    /// As [`ResultFolder::read`].
    pub fn parse(path: &Path, summary: &str, rows: Option<&str>) -> Result<Self, ReportError> {
        let summary = summary_in(summary, path)?;
        let parts = rows.map_or_else(|| Ok(Vec::new()), |text| parts(text, &path.join(ROWS[0])))?;
        Ok(Self { path: path.to_owned(), summary, parts })
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

    /// Everything but the rows.
    pub fn summary(&self) -> &Value {
        &self.summary
    }

    /// Whether the rows are of motion in time.
    pub fn is_motion(&self) -> bool {
        self.summary["inputs"]["analysis"]["kind"] == "dynamic"
    }

    /// Rows; a sweep has a part for each way, all others one without a name.
    pub(super) fn parts(&self) -> &[(String, Columns)] {
        &self.parts
    }
}

fn damaged(file: &Path, what: &str) -> ReportError {
    ReportError::NoResult { file: file.to_owned(), what: what.to_owned(), hint: "run the scene again into this folder" }
}

/// The summary of a result folder.
///
/// # Errors
/// [`ReportError::NoResult`] when it has none that this version reads.
pub fn summary(folder: &Path) -> Result<Value, ReportError> {
    let refuse = |what: String, hint: &'static str| Err(ReportError::NoResult { file: folder.to_owned(), what, hint });
    if !folder.is_dir() {
        return refuse(if folder.exists() { "is no folder" } else { "there is no such folder" }.into(), MAKE_ONE);
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
        Err(e) => return refuse(format!("summary.json is no JSON: {e}"), "run the scene again into this folder"),
    };
    if summary["program"] != "ale-gear" {
        return refuse("summary.json is of another program".into(), MAKE_ONE);
    }
    if summary["schema"].is_null() {
        return refuse("holds no run of a scene".into(), MAKE_ONE);
    }
    if summary["schema"] != SUMMARY_SCHEMA || !summary["headline"].is_object() {
        let version = summary["version"].as_str().unwrap_or("unknown");
        return refuse(
            format!(
                "summary.json has schema {}, this program reads {SUMMARY_SCHEMA} (written by version {version})",
                summary["schema"]
            ),
            "run the scene again with this version",
        );
    }
    Ok(summary)
}

/// Rows of a file in parts.
fn parts(text: &str, file: &Path) -> Result<Vec<(String, Columns)>, ReportError> {
    by_way(text).ok_or_else(|| damaged(file, "holds what is no number"))
}

/// Rows in parts by the words of a column `way`, in the order in which they appear; all in one where there is none.
fn by_way(text: &str) -> Option<Vec<(String, Columns)>> {
    let (header, rows) = text.split_once('\n')?;
    if header.matches(',').count() >= MOST_COLUMNS {
        return None;
    }
    let Some(header) = header.strip_prefix("way,") else {
        return Some(vec![(String::new(), parse_columns(text)?)]);
    };
    // Behind the numbers stand words: where a speed began, whether it has an answer, and why not. A speed without one
    // has no numbers.
    let names: Vec<&str> = header.split(',').take_while(|name| *name != WORDS).collect();
    let header = names.join(",");
    let mut parts: Vec<(String, String)> = Vec::new();
    for row in rows.lines() {
        let (way, rest) = row.split_once(',')?;
        let mut fields = rest.splitn(names.len() + 1, ',');
        let numbers = fields.by_ref().take(names.len()).collect::<Vec<_>>().join(",");
        if fields.next().is_some_and(|words| words.contains(",failed,")) {
            continue;
        }
        let at = parts.iter().position(|(name, _)| name == way).unwrap_or_else(|| {
            parts.push((way.to_owned(), format!("{header}\n")));
            parts.len() - 1
        });
        // Each way has a header of its own.
        if parts.len() > MOST_WAYS {
            return None;
        }
        parts[at].1.push_str(&numbers);
        parts[at].1.push('\n');
    }
    parts.into_iter().map(|(way, text)| Some((way, parse_columns(&text)?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_a_sweep_are_parted_by_their_way() {
        let parts = by_way("way,speed_rpm,a\nup,1,10\nup,2,20\ndown,2,21\n").unwrap();
        assert_eq!(parts.iter().map(|p| p.0.as_str()).collect::<Vec<_>>(), ["up", "down"]);
        assert_eq!((parts[0].1.find("a"), parts[1].1.find("speed_rpm")), (Some(&[10.0, 20.0][..]), Some(&[2.0][..])));
        let sweep = "way,speed_rpm,a,start,status,reason\nup,1,10,neighbour,periodic,\nup,2,NaN,quasi-static,failed,\"at 1 s, no\"\n";
        let parts = by_way(sweep).unwrap();
        assert_eq!((parts.len(), parts[0].1.find("a"), parts[0].1.find("status")), (1, Some(&[10.0][..]), None));
        assert_eq!(by_way("x,y\n1,NaN\n").unwrap()[0].1.find("x"), Some(&[1.0][..]));
        assert!(by_way("x,y\n1,word\n").is_none());
        let many: String = (0..=MOST_WAYS).map(|i| format!("w{i},1\n")).collect();
        assert!(by_way(&format!("way,a\n{many}")).is_none());
    }
}
