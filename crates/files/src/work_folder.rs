//! The folder beside a target in which it is written; what a killed process has left there is taken away by the next
//! one.
//!
//! ```text
//! .NAME.partial-PID/
//!     .ale-gear-work     says whose it is; locked as long as its process lives
//!     new                the file or the folder as it grows
//!     old                the earlier folder, while the new one takes its place
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

use crate::{
    partial::{self, Partial},
    place::{around, parent},
    sync,
};

const MARK: &str = ".ale-gear-work";
/// The mark while it is made.
const UNSEEN: &str = ".ale-gear-work.new";
const NEW: &str = "new";
const OLD: &str = "old";
/// First line of the mark.
const HEADING: &str = "ale-gear is writing a result here";
/// Longer than any mark, bytes.
const LONGEST: u64 = 4096;
/// Between the name of a target and the number of a process.
const PARTIAL: &str = ".partial-";

/// Says what is in a folder that no run of this program writes.
pub type Judge = fn(&Path) -> io::Result<Option<String>>;

/// What belongs to this program of a kind of target.
#[derive(Debug)]
pub struct Kind {
    /// Judges a folder that grows.
    pub growing: Judge,
    /// Judges one that stood in its place before.
    pub earlier: Judge,
    /// Takes away what this program wrote of an earlier one, and the folder if nothing else is in it.
    pub remove: fn(&Path) -> io::Result<()>,
}

impl Kind {
    /// A single file.
    pub const FILE: Self = Self { growing: is_no_file, earlier: is_no_file, remove: |folder| fs::remove_dir(folder) };
    /// Whatever a process needs for a while.
    const SCRATCH: Self = Self { growing: |_| Ok(None), earlier: is_no_file, remove: |folder| fs::remove_dir(folder) };
}

fn is_no_file(folder: &Path) -> io::Result<Option<String>> {
    Ok(folder.file_name().map(|name| name.to_string_lossy().into_owned()))
}

/// A work folder of this process, gone with the value.
#[derive(Debug)]
pub struct WorkFolder {
    target: PathBuf,
    kind: &'static Kind,
    /// Let go before the folder is removed.
    _mark: Option<File>,
    partial: Partial,
}

impl WorkFolder {
    /// Makes one beside `target`, a path that ends in a name, and takes away those of killed processes that `kind` knows.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn beside(target: &Path, kind: &'static Kind) -> io::Result<Self> {
        let folder = parent(target);
        if !fs::metadata(folder)?.is_dir() {
            return Err(ErrorKind::NotADirectory.into());
        }
        take_away_left_over(target, kind, None);
        let own = around(".", target, &format!("{PARTIAL}{}", std::process::id()));
        let mut path = folder.join(&own);
        let mut count = 0;
        loop {
            match marked(path) {
                Ok((partial, mark)) => return Ok(Self { target: target.to_owned(), kind, _mark: mark, partial }),
                // Two machines on one disk may have processes of the same number; and one that cleans up may take a
                // folder without a mark away.
                Err(e) if matches!(e.kind(), ErrorKind::AlreadyExists | ErrorKind::NotFound) && count < 1000 => {
                    count += 1
                }
                Err(e) => return Err(e),
            }
            let mut name = own.clone();
            name.push(format!("-{count}"));
            path = folder.join(name);
        }
    }

    /// Where the new file or folder grows; nothing is there yet.
    pub fn new_result(&self) -> PathBuf {
        self.partial.path().join(NEW)
    }

    /// Puts a whole folder in the place of the target, and takes away what the program wrote of the one that was there;
    /// `note` hears where it went if there is more in it.
    ///
    /// # Errors
    /// When the system refuses; what was there is then still there.
    pub fn put_in_place(self, note: &mut dyn FnMut(String)) -> io::Result<()> {
        let (new, old) = (self.new_result(), self.partial.path().join(OLD));
        sync::tree(&new)?;
        {
            // Who stops the program now waits until one of them stands there.
            let whole = partial::in_one_piece();
            if let Err(e) = swap(&new, &self.target, &old) {
                if fs::symlink_metadata(&old).is_err() {
                    return Err(e);
                }
                // It could not be put back: nothing takes it away.
                drop(whole);
                let what = format!("{e}; what was there is now {}", old.display());
                self.partial.keep();
                return Err(io::Error::new(e.kind(), what));
            }
        }
        sync::folder(parent(&self.target));
        let Self { target, kind, _mark, partial } = self;
        if fs::symlink_metadata(&old).is_ok() {
            let stranger = (kind.earlier)(&old).unwrap_or_else(|e| Some(e.to_string()));
            // Whatever comes in between judging and removing is still there afterwards.
            if stranger.is_some() || (kind.remove)(&old).is_err() {
                let name = stranger.or_else(|| (kind.earlier)(&old).ok().flatten()).unwrap_or_default();
                if !aside(&old, &target, &name, note) {
                    partial.keep();
                    return Ok(());
                }
            }
        }
        // Once more: a run that was killed just before this one may have been dying still.
        take_away_left_over(&target, kind, Some(partial.path()));
        Ok(())
    }
}

/// A folder for a while where the system keeps such things; those of killed processes go with the next one of the name.
#[derive(Debug)]
pub struct Scratch {
    path: PathBuf,
    _work: WorkFolder,
}

impl Scratch {
    /// Makes it.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn make(name: &str) -> io::Result<Self> {
        let work = WorkFolder::beside(&std::env::temp_dir().join(name), &Kind::SCRATCH)?;
        let path = work.new_result();
        fs::create_dir(&path)?;
        Ok(Self { path, _work: work })
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// A work folder with its mark, locked.
fn marked(path: PathBuf) -> io::Result<(Partial, Option<File>)> {
    let partial = Partial::make(path)?;
    let mark = mark(partial.path())?;
    Ok((partial, mark))
}

/// `new` takes the place of `target`, which becomes `old`.
fn swap(new: &Path, target: &Path, old: &Path) -> io::Result<()> {
    let replaces = fs::symlink_metadata(target).is_ok();
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

/// Where an earlier result goes into which somebody has put a file of theirs during the run: beside, and told. Whether
/// it went.
fn aside(old: &Path, target: &Path, name: &str, note: &mut dyn FnMut(String)) -> bool {
    let free = |path: &PathBuf| fs::symlink_metadata(path).is_err();
    let own = around("", target, &format!(".replaced-{}", std::process::id()));
    let path = (0..1000).map(|count| {
        let mut name = own.clone();
        if count > 0 {
            name.push(format!("-{count}"));
        }
        target.with_file_name(name)
    });
    let to = path.into_iter().find(free).filter(|path| fs::rename(old, path).is_ok());
    let (into, now) = (target.display(), to.as_deref().unwrap_or(old).display());
    note(format!("`{name}`, which is no result file, came into {into} during the run: it goes to {now}"));
    to.is_some()
}

/// Names of work folders of a target begin so; what follows are digits.
fn beginning(target: &Path) -> OsString {
    around(".", target, PARTIAL)
}

fn is_number(word: &str) -> bool {
    !word.is_empty() && word.bytes().all(|b| b.is_ascii_digit() || b == b'-')
}

/// Makes the mark of a folder and locks it before anybody can see it under its name. Without a lock (not every file
/// system has them) there is no mark, and nobody may ever take the folder for a dead one.
fn mark(folder: &Path) -> io::Result<Option<File>> {
    let unseen = folder.join(UNSEEN);
    let mut file = File::options().read(true).write(true).create_new(true).open(&unseen)?;
    if file.try_lock().is_err() {
        return fs::remove_file(&unseen).map(|()| None);
    }
    write!(file, "{HEADING}\nhost {}\nprocess {}\n", this_host().unwrap_or_default(), std::process::id())?;
    fs::rename(&unseen, folder.join(MARK))?;
    Ok(Some(file))
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
fn take_away_left_over(target: &Path, kind: &Kind, own: Option<&Path>) {
    let beginning = beginning(target);
    let Some(beginning) = beginning.to_str() else { return };
    let Ok(entries) = fs::read_dir(parent(target)) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let number = name.to_str().and_then(|n| n.strip_prefix(beginning));
        if number.is_some_and(is_number) && own != Some(&entry.path()) {
            // Nothing depends on it.
            let _ = take_away(&entry.path(), target, kind);
        }
    }
}

/// Removes the work folders in a folder, whatever they were to become, whose processes have died and that `kind` knows.
pub fn take_away_left_overs(folder: &Path, kind: &Kind) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        if let Some(target) = target_of(&path) {
            let _ = take_away(&path, &folder.join(target), kind);
        }
    }
}

/// What a folder would have become, by its name.
fn target_of(folder: &Path) -> Option<String> {
    let (name, number) = folder.file_name()?.to_str()?.strip_prefix('.')?.rsplit_once(PARTIAL)?;
    (!name.is_empty() && is_number(number)).then(|| name.to_owned())
}

/// Whether it is the work folder of a single file whose process has died.
pub fn is_left_over(folder: &Path) -> bool {
    target_of(folder).is_some()
        && is_work_folder(folder)
        && dead(folder).is_some()
        && matches!(stranger(folder, &Kind::FILE), Ok(None))
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

fn take_away(folder: &Path, target: &Path, kind: &Kind) -> io::Result<()> {
    if !is_work_folder(folder) {
        return take_away_bare(folder);
    }
    let Some(_held) = dead(folder) else { return Ok(()) };
    if stranger(folder, kind)?.is_some() {
        return Ok(());
    }
    if folder.join(OLD).exists() && !target.exists() {
        // It died between the two renames: the new result is whole.
        fs::rename(folder.join(NEW), target).or_else(|_| fs::rename(folder.join(OLD), target))?;
    }
    fs::remove_dir_all(folder)
}

/// Whether a folder bears the mark of a work folder, dead or alive.
pub fn is_work_folder(folder: &Path) -> bool {
    fs::symlink_metadata(folder.join(MARK)).is_ok_and(|m| m.is_file())
}

/// What is in a work folder that this program does not write.
///
/// # Errors
/// When the system refuses.
pub fn stranger(folder: &Path, kind: &Kind) -> io::Result<Option<String>> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let (name, of) = (entry.file_name().to_string_lossy().into_owned(), entry.file_type()?);
        let strange = match name.as_str() {
            MARK => None,
            NEW if of.is_file() => None,
            NEW if of.is_dir() => (kind.growing)(&entry.path())?,
            OLD if of.is_dir() => (kind.earlier)(&entry.path())?,
            _ => Some(name),
        };
        if strange.is_some() {
            return Ok(strange);
        }
    }
    Ok(None)
}
