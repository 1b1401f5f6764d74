//! `ale-gear report`: the page of a result folder made again.

use std::path::PathBuf;

use report::compare::ResultFolder;

use super::target::Target;
use crate::{error::CommandError, output::report_again};

/// Words of `ale-gear report`.
#[derive(Debug, clap::Args)]
pub(super) struct ReportArgs {
    /// Result folder
    folder: PathBuf,
    /// File to write, `-` for stdout [default: report.html in the folder]
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl ReportArgs {
    /// Writes the page; the text says where.
    pub(super) fn execute(self, quiet: bool) -> Result<String, CommandError> {
        // Says what is wrong with a folder that is none.
        let missed = ResultFolder::open(&self.folder)?.missed().join("; ");
        let page = report_again(&self.folder)?;
        let file = match self.output {
            Some(file) if file.as_os_str() == "-" => return Ok(page),
            Some(file) => {
                Target::Page.check("--output", &file)?;
                file
            }
            None => self.folder.join("report.html"),
        };
        files::write_file(&file, page.as_bytes()).map_err(|e| CommandError::write(&file, &e))?;
        let mut said = format!("{}: written\n", file.display());
        if !missed.is_empty() {
            said.push_str(&format!("CHECK FAILED: {missed}\n"));
        }
        Ok(if quiet { String::new() } else { said })
    }
}
