//! `history.parquet`, where the scene asks for it.

use report::write_parquet;

use super::ResultDirectory;
use crate::{error::CommandError, scene::Scene};

/// Writes `history.parquet` beside `history.csv` of a result, where the scene asks for it.
///
/// # Errors
/// Exit status 1 when a file cannot be read or written.
pub(crate) fn write_columnar(scene: &Scene, results: &ResultDirectory) -> Result<(), CommandError> {
    if scene.output.parquet {
        write_parquet(results.folder())?;
    }
    Ok(())
}
