//! A file that one run uses at a time.

use std::{
    fs::{self, File, OpenOptions, TryLockError},
    io,
    path::{Path, PathBuf},
};

/// An open, locked file under its name. The lock goes with the value, whatever ends the process.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    file: File,
}

impl Lock {
    /// Opens a regular file, made empty where there is none, and locks it. `None`: another run has it.
    ///
    /// # Errors
    /// [`io::ErrorKind::InvalidInput`] for what is no regular file, else as the system says.
    pub fn take(path: &Path) -> io::Result<Option<Self>> {
        loop {
            if let Ok(found) = fs::symlink_metadata(path) {
                crate::regular(&found)?;
            }
            let file = OpenOptions::new().read(true).append(true).create(true).open(path)?;
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => return Ok(None),
                // Not every file system has locks.
                Ok(()) | Err(TryLockError::Error(_)) => {}
            }
            // The run that had it may have taken the name away, or put another file there.
            if is_still(&file, path) {
                return Ok(Some(Self { path: path.to_owned(), file }));
            }
        }
    }

    /// The file; writing appends.
    pub fn file(&self) -> &File {
        &self.file
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Takes the file away.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn remove(self) -> io::Result<()> {
        fs::remove_file(&self.path)
    }
}

/// Whether a name still leads to an open file.
#[cfg(unix)]
fn is_still(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let of = |found: io::Result<fs::Metadata>| found.map(|f| (f.dev(), f.ino()));
    matches!((of(file.metadata()), of(fs::symlink_metadata(path))), (Ok(a), Ok(b)) if a == b)
}

/// Elsewhere an open file keeps its name.
#[cfg(not(unix))]
fn is_still(_: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time_has_it() {
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("a.cases");
        let first = Lock::take(&path).unwrap().unwrap();
        assert!(Lock::take(&path).unwrap().is_none());
        first.remove().unwrap();
        drop(Lock::take(&path).unwrap().unwrap());
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
        assert_eq!(Lock::take(&path).unwrap_err().to_string(), "it is a folder, not a file");
    }
}
