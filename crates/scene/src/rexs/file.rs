//! Reads the text of a REXS file; packed files are rejected by name.

use std::{fs::File, io::ErrorKind, io::Read, path::Path};

use super::RexsError;
use crate::read_text;

/// First bytes of a zip archive.
const ZIP: [u8; 4] = *b"PK\x03\x04";

/// The text of a REXS file (XML).
///
/// # Errors
/// [`RexsError::Packed`] for a zip archive (`.rexsz`), [`RexsError::Read`] if the file is not text or cannot be read.
pub fn read_rexs(path: &Path) -> Result<String, RexsError> {
    read_text(path).map_err(|e| match e.kind() {
        ErrorKind::InvalidData if begins_as_zip(path) => RexsError::Packed,
        _ => e.into(),
    })
}

fn begins_as_zip(path: &Path) -> bool {
    let mut first = [0; 4];
    File::open(path).and_then(|mut file| file.read_exact(&mut first)).is_ok() && first == ZIP
}
