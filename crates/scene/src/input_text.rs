//! Text files that the user gives to a command: a scene, a study, gear data.

use std::{
    fs::File,
    io::{Error, ErrorKind, Read, Result},
    path::Path,
};

use files::{most, read_regular_text};

/// What a pipe may deliver at the most, bytes; a scene has a few thousand.
const MOST: u64 = 16 << 20;

/// The text of a file, up to 16 MB; also of a file opened by the shell (`/dev/stdin`, `<(command)`).
///
/// # Errors
/// [`ErrorKind::InvalidInput`] for folders, devices and named pipes, and for a pipe without an end; otherwise the error
/// of the operating system.
pub fn read_text(path: &Path) -> Result<String> {
    if !is_handed_over(path) {
        return read_regular_text(path, most::DOCUMENT);
    }
    let mut text = String::new();
    File::open(path)?.take(MOST + 1).read_to_string(&mut text)?;
    if text.len() as u64 > MOST {
        let what = format!("it goes on beyond {} MB, which no scene does", MOST >> 20);
        return Err(Error::new(ErrorKind::InvalidInput, what));
    }
    Ok(text)
}

/// Whether it is an open file of this process, under the names that shells and systems give these.
fn is_handed_over(path: &Path) -> bool {
    path == Path::new("/dev/stdin") || path.starts_with("/dev/fd") || path.starts_with("/proc/self/fd")
}
