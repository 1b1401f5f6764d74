//! Content of a file that a user names.

use std::{
    fs::{self, File, Metadata},
    io::{Error, ErrorKind, Read, Result},
    path::Path,
};

/// All bytes of a regular file that has no more than `most` of them.
///
/// Folders, devices and named pipes are refused before they are opened: `/dev/zero` has no end, and a pipe that nobody
/// writes into has no beginning. A link is followed.
///
/// # Errors
/// [`ErrorKind::InvalidInput`] for what is no regular file, [`ErrorKind::FileTooLarge`] for a larger one,
/// [`ErrorKind::OutOfMemory`], else as [`fs::read`].
pub fn read_regular_file(path: &Path, most: u64) -> Result<Vec<u8>> {
    let (file, length) = open_regular_file(path, most)?;
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(length as usize).map_err(|_| ErrorKind::OutOfMemory)?;
    // One that grows meanwhile ends, too.
    file.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large(most)) } else { Ok(bytes) }
}

/// A regular file that has no more than `most` bytes, and their number, for one who reads it part by part.
///
/// # Errors
/// As [`read_regular_file`].
pub fn open_regular_file(path: &Path, most: u64) -> Result<(File, u64)> {
    regular(&fs::metadata(path)?)?;
    let file = File::open(path)?;
    // Somebody may have put something else there meanwhile.
    let found = file.metadata()?;
    regular(&found)?;
    if found.len() > most { Err(too_large(most)) } else { Ok((file, found.len())) }
}

/// Reads a regular file as text.
///
/// # Errors
/// As [`read_regular_file`], and [`ErrorKind::InvalidData`] for what is not UTF-8.
pub fn read_regular_text(path: &Path, most: u64) -> Result<String> {
    String::from_utf8(read_regular_file(path, most)?).map_err(|_| no_text())
}

/// The error that a file is no text.
pub fn no_text() -> Error {
    Error::new(ErrorKind::InvalidData, NO_TEXT)
}

/// As the standard library says it of a file of another encoding.
const NO_TEXT: &str = "stream did not contain valid UTF-8";

fn too_large(most: u64) -> Error {
    let limit = if most >= 1 << 30 { format!("{} GB", most >> 30) } else { format!("{} MB", most >> 20) };
    Error::new(ErrorKind::FileTooLarge, format!("it is larger than {limit}, the limit for a file of its kind"))
}

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
        let of = |path: &Path| read_regular_text(path, 1 << 20).map_err(|e| e.to_string());
        assert!(of(&here.join("Cargo.toml")).unwrap().contains("files"));
        assert_eq!(of(here).unwrap_err(), "it is a folder, not a file");
        if Path::new("/dev/zero").exists() {
            assert_eq!(of(Path::new("/dev/zero")).unwrap_err(), "it is a device or a pipe, not a file");
        }
    }

    /// A file of holes takes no room on disk, and would take all memory.
    #[test]
    fn a_file_larger_than_its_kind_is_refused_unread() {
        let scratch = tempfile::tempdir().unwrap();
        let file = scratch.path().join("holes.msh");
        File::create(&file).unwrap().set_len(1 << 40).unwrap();
        let error = read_regular_file(&file, 3 << 20).unwrap_err();
        assert_eq!(error.to_string(), "it is larger than 3 MB, the limit for a file of its kind");
        assert_eq!(error.kind(), ErrorKind::FileTooLarge);
        let error = read_regular_file(&file, 8 << 30).unwrap_err().to_string();
        assert!(error.starts_with("it is larger than 8 GB"), "{error}");
        std::fs::write(&file, "four").unwrap();
        assert_eq!(read_regular_file(&file, 4).unwrap(), b"four");
        assert!(read_regular_file(&file, 3).is_err());
    }
}
