//! An answer of any kind as the files of a result.

use answer::{Answer, Checks, Cost, Remark};
use described::Key;
use serde::Serialize;
use serde_json::{Map, Value};

use crate::{
    ReportError, SUMMARY_SCHEMA,
    page::{Page, Rendered, closing_text},
};
use store::folder::ResultDirectory;

/// An object of a summary: its name, and its keys. The name goes on behind a comma where several objects have one key.
pub(crate) type Object = (&'static str, &'static [Key]);

described::described! {
    /// `summary.json` of an answer of any kind.
    #[derive(Serialize)]
    pub(crate) struct Summary<'a> {
        /// `ale-gear`
        program: &'static str,
        /// version of the program
        version: &'static str,
        /// 4; grows with every change after which an older reader would misread the file
        schema: u32,
        /// kind of question that is answered: `pair`, `gearbox`, `plan`, `study`, `optimum`, `chart`, `envelope`, `comparison`
        kind: &'static str,
        /// title of the document
        name: &'a str,
        /// document with every default filled in
        inputs: &'a Value,
        /// facts of one kind of answer
        #[serde(flatten)]
        info: &'a Map<String, Value>,
        /// what must hold of the result
        #[serde(flatten)]
        checks: &'a Checks,
        /// time and memory of the run
        cost: &'a Cost,
        /// numbers of the result
        headline: &'a Value,
        /// remarks about the result
        remarks: &'a [Remark],
        /// names of the tables, the rows first; `NAME.csv` is the file of each
        tables: Vec<&'a str>,
        /// all other files of the result
        files: &'a [String],
    }
}

/// An answer whose files are written.
#[derive(Debug, Clone)]
pub struct Written {
    /// The answer.
    pub answer: Answer,
    /// The closing table.
    pub table: String,
}

/// Writes tables (with commas, and column by column where `with_parquet` is set), page, and `summary.json` last: where it
/// is, everything is.
///
/// # Errors
/// When the system refuses, or the page cannot be filled.
pub fn write_result(
    answer: Answer,
    page: &Page,
    with_parquet: bool,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let table = write_tables_and_page(&answer, page, with_parquet, results)?;
    write_summary(&answer, results)?;
    Ok(Written { answer, table })
}

/// All but `summary.json`: for a result that moves more files into its folder before [`write_summary`] ends it.
///
/// # Errors
/// When the system refuses, or the page cannot be filled.
pub fn write_tables_and_page(
    answer: &Answer,
    page: &Page,
    with_parquet: bool,
    results: &ResultDirectory,
) -> Result<String, ReportError> {
    write_tables(answer, with_parquet, results)?;
    Rendered::new("parts.html", minijinja::Value::from(minijinja::value::Serde(page)))?.write(results)?;
    Ok(closing_text(page, &answer.cost))
}

/// `summary.json`, which ends a result.
///
/// # Errors
/// When the system refuses.
pub fn write_summary(answer: &Answer, results: &ResultDirectory) -> Result<(), ReportError> {
    Ok(results.write("summary.json", summary(answer, &results.files()?).as_bytes())?)
}

/// Writes tables and `summary.json`, without a page.
///
/// # Errors
/// When the system refuses.
pub fn write_rows(answer: &Answer, results: &ResultDirectory) -> Result<(), ReportError> {
    write_tables(answer, false, results)?;
    write_summary(answer, results)
}

/// The files of all tables; one whose rows were written as they came is there already.
fn write_tables(answer: &Answer, with_parquet: bool, results: &ResultDirectory) -> Result<(), ReportError> {
    for table in &answer.tables {
        results.write_table(table, !table.is_written, with_parquet)?;
    }
    Ok(())
}

/// `summary.json`: everything about an answer but its rows; numbers without a value (NaN) are `null`. `files` are the
/// other files of the result.
fn summary(answer: &Answer, files: &[String]) -> String {
    let summary = Summary {
        program: "ale-gear",
        version: env!("CARGO_PKG_VERSION"),
        schema: SUMMARY_SCHEMA,
        kind: answer.kind,
        name: &answer.name,
        inputs: &answer.inputs,
        info: &answer.info,
        checks: &answer.checks,
        cost: &answer.cost,
        headline: &answer.headline,
        remarks: &answer.remarks,
        tables: answer.tables.iter().map(|table| &*table.name).collect(),
        files,
    };
    // Strings and numbers only, all keys are strings: there is nothing that JSON could refuse.
    let mut text = serde_json::to_string_pretty(&summary).unwrap_or_default();
    text.push('\n');
    text
}
