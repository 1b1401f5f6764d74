//! Pitch errors from a file.

use std::path::Path;

use super::data_file::{DataFileError, number, rows};

/// Parses cumulative pitch deviations (um) from plain text and returns them in mm. The text has one number per tooth,
/// tooth 0 first, on any number of lines, separated by commas, semicolons or blanks; `#` begins a comment.
///
/// # Errors
/// [`DataFileError`] with file and line.
pub fn parse_pitch_errors(text: &str, path: &Path) -> Result<Vec<f64>, DataFileError> {
    let mut errors = Vec::new();
    for (line, words) in rows(text) {
        for word in words {
            errors.push(1e-3 * number(path, line, word)?);
        }
    }
    if errors.is_empty() {
        return Err(DataFileError::TooFew { path: path.to_owned(), what: "pitch errors", found: 0, wanted: 1 });
    }
    Ok(errors)
}
