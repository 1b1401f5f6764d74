//! The folder beside a result in which it is written; what a killed process has left there is taken away by the next
//! one.
//!
//! ```text
//! .NAME.partial-PID/
//!     .ale-gear-work     says whose it is; locked as long as its process lives
//!     new/               the result as it grows
//!     old/               the earlier result, while the new one takes its place
//! ```
//!
//! A process that dies drops its lock, whatever kills it, and a number that another process has by now says nothing.
//! Only a folder with that file, of this machine (locks need not reach further), not locked and without anything that
//! this program does not write is removed.

use std::{
    ffi::OsString,
    fs::{self, File, TryLockError},
    io::{self, ErrorKind, Read, Write},
    path::{Path, PathBuf},
    process::Command,
};

use super::partial::{self, Partial};

const MARK: &str = ".ale-gear-work";
/// The mark while it is made.
const UNSEEN: &str = ".ale-gear-work.new";
const NEW: &str = "new";
const OLD: &str = "old";
/// First line of the mark.
const HEADING: &str = "ale-gear is writing a result here";
/// Longer than any mark, bytes.
const LONGEST: u64 = 4096;

/// A work folder of this process, gone with the value.
#[derive(Debug)]
pub(crate) struct WorkFolder {
    target: PathBuf,
    ours: Judge,
    /// Let go before the folder is removed.
    _mark: Option<File>,
    partial: Partial,
}

impl WorkFolder {
    /// Makes one beside `target`, a path that ends in a name.
    ///
    /// `ours` says what there is in a folder of results that this program does not write, if anything; only by its
    /// leave are folders of killed processes removed.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn beside(target: &Path, ours: Judge) -> io::Result<Self> {
        let folder = parent(target);
        fs::create_dir_all(folder)?;
        take_away_left_over(target, ours, None);
        let own = format!("{}{}", beginning(target).to_string_lossy(), std::process::id());
        let mut path = folder.join(&own);
        let mut count = 0;
        loop {
            match furnished(path) {
                Ok((partial, mark)) => return Ok(Self { target: target.to_owned(), ours, _mark: mark, partial }),
                // Two machines on one disk may have processes of the same number; and one that cleans up may take a
                // folder without a mark away.
                Err(e) if matches!(e.kind(), ErrorKind::AlreadyExists | ErrorKind::NotFound) && count < 1000 => {
                    count += 1
                }
                Err(e) => return Err(e),
            }
            path = folder.join(format!("{own}-{count}"));
        }
    }

    /// Where the result grows.
    pub fn new_result(&self) -> PathBuf {
        self.partial.path().join(NEW)
    }

    /// Puts the result in its place, and what was there away; `note` hears where a file went that came in meanwhile.
    ///
    /// # Errors
    /// When the system refuses; what was there is then still there.
    pub fn put_in_place(self, note: &mut dyn FnMut(String)) -> io::Result<()> {
        let old = match (self.ours)(&self.target) {
            Ok(Some(name)) => aside(&self.target, &name, note),
            _ => self.partial.path().join(OLD),
        };
        {
            // Who stops the program now waits until one of them stands there.
            let _whole = partial::in_one_piece();
            swap(&self.partial.path().join(NEW), &self.target, &old)?;
        }
        // Once more: a run that was killed just before this one may have been dying still.
        take_away_left_over(&self.target, self.ours, Some(self.partial.path()));
        Ok(())
    }
}

/// A work folder with its mark, locked, and room for the new result.
fn furnished(path: PathBuf) -> io::Result<(Partial, Option<File>)> {
    fs::create_dir(&path)?;
    let partial = Partial::new(path);
    // Without a lock (not every file system has them) nobody may ever take the folder for a dead one.
    let mark = mark(partial.path()).ok();
    fs::create_dir(partial.path().join(NEW))?;
    Ok((partial, mark))
}

/// `new` takes the place of `target`, which becomes `old`.
fn swap(new: &Path, target: &Path, old: &Path) -> io::Result<()> {
    let replaces = target.exists();
    if replaces {
        fs::rename(target, old)?;
    }
    fs::rename(new, target).inspect_err(|_| {
        if replaces {
            // Back to where it was; the first error is the one to tell.
            let _ = fs::rename(old, target);
        }
    })
}

/// Where an earlier result goes into which somebody has put a file of theirs during the run: beside, and told.
fn aside(target: &Path, name: &str, note: &mut dyn FnMut(String)) -> PathBuf {
    let mut path = target.as_os_str().to_owned();
    path.push(format!(".replaced-{}", std::process::id()));
    let path = PathBuf::from(path);
    let (into, now) = (target.display(), path.display());
    note(format!("`{name}`, which is no result file, came into {into} during the run: it goes to {now}"));
    path
}

/// Says what is in a folder that no run of this program writes.
pub(crate) type Judge = fn(&Path) -> io::Result<Option<String>>;

fn parent(target: &Path) -> &Path {
    target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Names of work folders of a target begin so; what follows are digits.
fn beginning(target: &Path) -> OsString {
    let mut name = OsString::from(".");
    name.push(target.file_name().unwrap_or_default());
    name.push(".partial-");
    name
}

/// Makes the mark of a folder and locks it before anybody can see it under its name.
fn mark(folder: &Path) -> io::Result<File> {
    let unseen = folder.join(UNSEEN);
    let mut file = File::options().read(true).write(true).create_new(true).open(&unseen)?;
    file.try_lock()?;
    write!(file, "{HEADING}\nhost {}\nprocess {}\n", this_host().unwrap_or_default(), std::process::id())?;
    fs::rename(&unseen, folder.join(MARK))?;
    Ok(file)
}

/// Name of this machine, where the system tells it.
fn this_host() -> Option<String> {
    let of_program = || String::from_utf8(Command::new("hostname").output().ok()?.stdout).ok();
    let told = fs::read_to_string("/proc/sys/kernel/hostname").ok().or_else(of_program)?;
    let name = told.trim().to_owned();
    (!name.is_empty()).then_some(name)
}

/// Whether a folder is a work folder: its mark, unlocked as long as the file is held, else `None`.
fn dead(folder: &Path) -> Option<File> {
    let path = folder.join(MARK);
    // No link leads anywhere else.
    let kinds = [fs::symlink_metadata(folder).ok()?, fs::symlink_metadata(&path).ok()?];
    if !kinds[0].is_dir() || !kinds[1].is_file() {
        return None;
    }
    let file = File::options().read(true).write(true).open(&path).ok()?;
    let mut text = String::new();
    (&file).take(LONGEST).read_to_string(&mut text).ok()?;
    let mut lines = text.lines();
    let heading = lines.next()?;
    let host = lines.next()?.strip_prefix("host ")?;
    if heading != HEADING || this_host().as_deref() != Some(host) {
        return None;
    }
    match file.try_lock() {
        Ok(()) => Some(file),
        Err(TryLockError::WouldBlock | TryLockError::Error(_)) => None,
    }
}

/// Removes work folders of this target whose processes have died. What cannot be removed, or must not be, stays, and is
/// no error.
fn take_away_left_over(target: &Path, ours: Judge, own: Option<&Path>) {
    let beginning = beginning(target);
    let Some(beginning) = beginning.to_str() else { return };
    let Ok(entries) = fs::read_dir(parent(target)) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let number = name.to_str().and_then(|n| n.strip_prefix(beginning));
        let is_number = |n: &str| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit() || b == b'-');
        if number.is_some_and(is_number) && own != Some(&entry.path()) {
            // Nothing depends on it.
            let _ = take_away(&entry.path(), target, ours);
        }
    }
}

/// Removes a folder whose process died before it had a mark: there is nothing in it, or an unlocked mark in the making.
/// A process that lives and has come no farther takes another folder.
fn take_away_bare(folder: &Path) -> io::Result<()> {
    if !fs::symlink_metadata(folder)?.is_dir() {
        return Ok(());
    }
    if let Ok(file) = File::options().read(true).write(true).open(folder.join(UNSEEN)) {
        if file.try_lock().is_err() || fs::read_dir(folder)?.count() != 1 {
            return Ok(());
        }
        fs::remove_file(folder.join(UNSEEN))?;
    }
    // Of an empty folder only.
    fs::remove_dir(folder)
}

fn take_away(folder: &Path, target: &Path, ours: Judge) -> io::Result<()> {
    if !is_work_folder(folder) {
        return take_away_bare(folder);
    }
    let Some(_held) = dead(folder) else { return Ok(()) };
    if stranger(folder, ours)?.is_some() {
        return Ok(());
    }
    if folder.join(OLD).exists() && !target.exists() {
        // It died between the two renames: the new result is whole.
        fs::rename(folder.join(NEW), target).or_else(|_| fs::rename(folder.join(OLD), target))?;
    }
    fs::remove_dir_all(folder)
}

/// Whether a folder bears the mark of a work folder, dead or alive.
pub(crate) fn is_work_folder(folder: &Path) -> bool {
    fs::symlink_metadata(folder.join(MARK)).is_ok_and(|m| m.is_file())
}

/// What is in a work folder that this program does not write.
pub(crate) fn stranger(folder: &Path, ours: Judge) -> io::Result<Option<String>> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let strange = match name.as_str() {
            MARK => None,
            NEW | OLD if entry.file_type()?.is_dir() => ours(&entry.path())?,
            _ => Some(name),
        };
        if strange.is_some() {
            return Ok(strange);
        }
    }
    Ok(None)
}
