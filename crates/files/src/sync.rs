//! What is written is on the disk before its name says that it is whole.

use std::{
    fs::{self, File},
    io,
    path::Path,
};

/// All files of a tree, and its folders.
///
/// # Errors
/// What the disk says now that it did not say when the bytes were handed over, such as that it is full.
pub(crate) fn tree(path: &Path) -> io::Result<()> {
    let found = fs::symlink_metadata(path)?;
    if found.is_symlink() {
        return Ok(());
    }
    if found.is_dir() {
        for entry in fs::read_dir(path)? {
            tree(&entry?.path())?;
        }
        folder(path);
        return Ok(());
    }
    File::open(path)?.sync_all()
}

/// The names in a folder. Not every system lets a folder be synchronised; then the names follow when it likes.
pub(crate) fn folder(path: &Path) {
    let _ = File::open(path).and_then(|folder| folder.sync_all());
}
