//! Content of a file that a user names.

use std::{
    fs::{self, Metadata},
    io::{Error, ErrorKind, Result},
    path::Path,
};

/// All bytes of a regular file.
///
/// Folders, devices and named pipes are refused before they are opened: `/dev/zero` has no end, and a pipe that nobody
/// writes into has no beginning.
///
/// # Errors
/// [`ErrorKind::InvalidInput`] for what is no regular file, else as [`fs::read`].
pub fn read_regular_file(path: &Path) -> Result<Vec<u8>> {
    regular(&fs::metadata(path)?)?;
    fs::read(path)
}

/// The same as text.
///
/// # Errors
/// As [`read_regular_file`], and [`ErrorKind::InvalidData`] for what is not UTF-8.
pub fn read_regular_text(path: &Path) -> Result<String> {
    String::from_utf8(read_regular_file(path)?).map_err(|_| Error::new(ErrorKind::InvalidData, NO_TEXT))
}

/// As the standard library says it of a file of another encoding.
const NO_TEXT: &str = "stream did not contain valid UTF-8";

/// Says what it is that is no regular file.
///
/// # Errors
/// [`ErrorKind::InvalidInput`].
pub fn regular(found: &Metadata) -> Result<()> {
    if found.is_file() {
        return Ok(());
    }
    let what = if found.is_dir() { "it is a folder, not a file" } else { "it is a device or a pipe, not a file" };
    Err(Error::new(ErrorKind::InvalidInput, what))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_file_is_refused_unread() {
        let here = Path::new(env!("CARGO_MANIFEST_DIR"));
        let of = |path: &Path| read_regular_text(path).map_err(|e| e.to_string());
        assert!(of(&here.join("Cargo.toml")).unwrap().contains("geometry"));
        assert_eq!(of(here).unwrap_err(), "it is a folder, not a file");
        if Path::new("/dev/zero").exists() {
            assert_eq!(of(Path::new("/dev/zero")).unwrap_err(), "it is a device or a pipe, not a file");
        }
    }
}
