//! A report and what it was made of, so that it can be made again.

use std::io::{Read, Write};
use std::path::Path;

use flate2::{Compression, read::GzDecoder, write::GzEncoder};
use minijinja::Value;
use serde::{Deserialize, Serialize};

use super::template::render;
use crate::ReportError;
use store::ResultFiles;

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
    context: Value,
}

impl Rendered {
    /// Fills in a template.
    ///
    /// # Errors
    /// [`ReportError::Page`] if it cannot be filled; that would be a fault of this program.
    pub fn new(template: &str, context: Value) -> Result<Self, ReportError> {
        let failed = |e: &dyn std::fmt::Display| ReportError::Page { file: SOURCE, cause: e.to_string() };
        let held = Source { template: template.to_owned(), context: context.clone() };
        // Little is gained by packing numbers harder, and every run waits for it.
        let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
        let json = answer::json(&held).map_err(|e| failed(&e))?;
        packed.write_all(json.as_bytes()).map_err(|e| failed(&e))?;
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
        Ok(results.write(SOURCE, &self.source)?)
    }
}

/// What the source of a page may unpack to: so many times its bytes, of small ones so many bytes. Sources of this program
/// unpack to two to four times their bytes; a hundred times as much is made in an instant, and every byte of it takes up
/// to a hundred of memory.
const RATIO: u64 = 8;
const LEAST: u64 = 8 << 20;

/// The page of a result folder, made again with the templates and scripts of this version.
///
/// # Errors
/// [`ReportError::NoResult`] when the folder has not what the page is made of.
pub fn report_again(folder: &Path) -> Result<String, ReportError> {
    let file = folder.join(SOURCE);
    let packed = files::read_regular_file(&file, files::most::STATE).map_err(|e| refused(&file, &e))?;
    report_from(&packed, &file)
}

/// Report from the bytes of the source (JSON, gzip); `file` is what messages name.
///
/// # Errors
/// As [`report_again`].
pub fn report_from(packed: &[u8], file: &Path) -> Result<String, ReportError> {
    let most = LEAST.max(RATIO * packed.len() as u64);
    let mut json = Vec::new();
    GzDecoder::new(packed).take(most + 1).read_to_end(&mut json).map_err(|e| refused(file, &e))?;
    if json.len() as u64 > most {
        return Err(refused(file, &format_args!("unpacks to more than {most} bytes")));
    }
    let Source { template, context } = serde_json::from_slice(&json).map_err(|e| refused(file, &e))?;
    render(&template, context).map_err(|e| refused(file, &format_args!("is of another version: {e}")))
}

fn refused(file: &Path, what: &dyn std::fmt::Display) -> ReportError {
    ReportError::NoResult {
        file: file.to_owned(),
        what: what.to_string(),
        hint: "run the scene again into this folder",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn packed(json: &str) -> Vec<u8> {
        let mut packed = GzEncoder::new(Vec::new(), Compression::best());
        packed.write_all(json.as_bytes()).unwrap();
        packed.finish().unwrap()
    }

    /// 200 kB of zeros once took 6 GB and half a minute.
    #[test]
    fn a_source_that_unpacks_without_end_is_refused() {
        let said = |json: &str| report_from(&packed(json), Path::new("report.json.gz")).unwrap_err().to_string();
        let zeros = "0,".repeat(LEAST as usize / 2);
        let many = said(&format!("{{\"template\":\"report.html\",\"context\":[{zeros}0]}}"));
        assert!(many.contains("unpacks to more than"), "{many}");
        let few = said("{\"template\":\"report.html\",\"context\":[0,0]}");
        assert!(few.contains("is of another version"), "{few}");
    }
}
