//! Folders in which something is being written: gone when it does not become whole.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::{Mutex, MutexGuard, PoisonError},
    thread,
    time::Duration,
};

/// A folder of this process that is taken away with the value.
#[derive(Debug)]
pub struct Partial(PathBuf);

/// Folders of this process, for the case that the user stops it.
static PARTIAL: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

impl Partial {
    /// Makes the folder; one that is there already is somebody else's.
    ///
    /// # Errors
    /// As [`fs::create_dir`].
    pub fn make(path: PathBuf) -> std::io::Result<Self> {
        let mut paths = paths();
        fs::create_dir(&path)?;
        paths.push(path.clone());
        Ok(Self(path))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// It stays where it is, with all that is in it.
    pub fn keep(self) {
        paths().retain(|p| *p != self.0);
    }
}

impl Drop for Partial {
    fn drop(&mut self) {
        let mut paths = paths();
        // Kept ones are no longer in the list.
        if let Some(at) = paths.iter().position(|p| *p == self.0) {
            paths.remove(at);
            // Nothing more can be done about a failure here, and the folder's name says what it is.
            let _ = fs::remove_dir_all(&self.0);
        }
    }
}

/// Takes away all folders of this process that have not become whole: for whoever stops it. As long as the value lives
/// no other can be made, and none becomes whole.
pub fn hold_still() -> impl Sized {
    let paths = paths();
    for path in paths.iter() {
        // Other threads still write into it: what is made while the folder is emptied is met the next time.
        for _ in 0..PATIENCE {
            match fs::remove_dir_all(path) {
                Err(_) if path.exists() => thread::sleep(Duration::from_millis(1)),
                _ => break,
            }
        }
    }
    paths
}

/// How often a folder is emptied into which others write.
const PATIENCE: u32 = 1000;

/// As long as the value lives nobody stops the program by [`hold_still`], nor takes a folder away: for changes that must
/// be whole.
pub(crate) fn in_one_piece() -> impl Sized {
    paths()
}

fn paths() -> MutexGuard<'static, Vec<PathBuf>> {
    PARTIAL.lock().unwrap_or_else(PoisonError::into_inner)
}
