//! Where a file is, and what may stand beside it.

use std::{ffi::OsString, path::Path};

/// The folder that a path is in.
pub(crate) fn parent(target: &Path) -> &Path {
    target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A file name with something before and behind it.
pub(crate) fn around(before: &str, path: &Path, behind: &str) -> OsString {
    let mut name = OsString::from(before);
    name.push(path.file_name().unwrap_or_default());
    name.push(behind);
    name
}
