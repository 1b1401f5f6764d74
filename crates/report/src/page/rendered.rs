//! A report and what it was made of, so that it can be made again.

use std::io::{Read, Write};
use std::path::Path;

use flate2::{Compression, read::GzDecoder, write::GzEncoder};
use minijinja::{Value, value::Serde};
use serde::{Deserialize, Serialize};

use super::template::render;
use crate::{ReportError, ResultFiles};

const PAGE: &str = "report.html";
/// Charts, numbers and fields of the page without the page.
const SOURCE: &str = "report.json.gz";

/// A page with its source.
#[derive(Debug)]
pub struct Rendered {
    html: String,
    source: Vec<u8>,
}

#[derive(Serialize, Deserialize)]
struct Source {
    /// Name of the template.
    template: String,
    /// What is filled in.
    context: serde_json::Value,
}

impl Rendered {
    /// Fills in a template.
    ///
    /// # Errors
    /// [`ReportError::Page`] if it cannot be filled; that would be a fault of this program.
    pub fn new(template: &str, context: Value) -> Result<Self, ReportError> {
        let failed = |e: &dyn std::fmt::Display| ReportError::Page { file: SOURCE, cause: e.to_string() };
        let held =
            Source { template: template.to_owned(), context: serde_json::to_value(&context).map_err(|e| failed(&e))? };
        // Little is gained by packing numbers harder, and every run waits for it.
        let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
        let json = serde_json::to_vec(&held).map_err(|e| failed(&e))?;
        packed.write_all(&json).map_err(|e| failed(&e))?;
        Ok(Self { html: render(template, context)?, source: packed.finish().map_err(|e| failed(&e))? })
    }

    /// The page.
    pub fn html(&self) -> &str {
        &self.html
    }

    /// Writes page and source into a result.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn write(&self, results: &dyn ResultFiles) -> Result<(), ReportError> {
        results.write(PAGE, self.html.as_bytes())?;
        results.write(SOURCE, &self.source)
    }
}

/// The page of a result folder, made again with the templates and scripts of this version.
///
/// # Errors
/// [`ReportError::NoResult`] when the folder has not what the page is made of.
pub fn report_again(folder: &Path) -> Result<String, ReportError> {
    let file = folder.join(SOURCE);
    let refuse = |what: &dyn std::fmt::Display| ReportError::NoResult {
        file: file.clone(),
        what: what.to_string(),
        hint: "run the scene again into this folder",
    };
    let bytes = std::fs::read(&file).map_err(|e| refuse(&e))?;
    let mut json = Vec::new();
    GzDecoder::new(bytes.as_slice()).read_to_end(&mut json).map_err(|e| refuse(&e))?;
    let Source { template, context } = serde_json::from_slice(&json).map_err(|e| refuse(&e))?;
    render(&template, Value::from(Serde(&context))).map_err(|e| refuse(&format_args!("is of another version: {e}")))
}
