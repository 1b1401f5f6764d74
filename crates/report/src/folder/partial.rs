//! Files and folders that are being written: gone when they do not become whole.

use std::{
    fs,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

/// A path that is taken away with the value, unless [`Partial::keep`] says that it has become something.
#[derive(Debug)]
pub struct Partial(PathBuf);

/// Paths of this process, for the case that the user stops it.
static PARTIAL: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

impl Partial {
    /// Watches a path from before anything is there.
    pub fn new(path: PathBuf) -> Self {
        paths().push(path.clone());
        Self(path)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// It is whole and stands elsewhere: there is nothing to take away.
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
            remove(&self.0);
        }
    }
}

/// Takes away all paths of this process that have not become whole: for whoever stops it.
pub fn remove_partial_paths() {
    paths().iter().for_each(|path| remove(path));
}

/// As long as the value lives nobody stops the program by [`remove_partial_paths`], nor takes a path away: for changes
/// that must be whole.
pub(crate) fn in_one_piece() -> impl Sized {
    paths()
}

fn paths() -> std::sync::MutexGuard<'static, Vec<PathBuf>> {
    PARTIAL.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Nothing more can be done about a failure here, and the path's name says what it is.
fn remove(path: &Path) {
    let _ = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
}
