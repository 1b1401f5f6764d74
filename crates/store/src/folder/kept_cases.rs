//! Cases of a study that are done, in a folder beside the results: a run that is cut short goes on from there.

use std::{
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
};

use files::{Lock, most, read_regular_text, take_away_left_overs};

use super::record::{RESULT, names, remove_result};
use crate::StoreError;

/// Says whose folder it is, and of which study; locked as long as a run uses it.
const MARK: &str = ".ale-gear-cases";
/// Letters of a digest.
const DIGEST: usize = 64;

/// Where the cases of a study or a plan are kept until the results are whole: `OUT.cases`.
pub fn beside_results(out: &Path) -> PathBuf {
    let mut name = out.file_name().unwrap_or_default().to_owned();
    name.push(".cases");
    out.with_file_name(name)
}

/// What is said where another run keeps its cases.
pub fn in_use(out: &Path, cases: &Path) -> StoreError {
    StoreError::Folder {
        folder: out.to_owned(),
        what: format!("another run into it is under way, its cases are in {}", cases.display()),
        hint: "wait for its end, or give another `--out`",
    }
}

/// The folder of cases that are done.
#[derive(Debug)]
pub struct KeptCases {
    path: PathBuf,
    mark: Lock,
}

impl KeptCases {
    /// Beside the results `out`, with the cases of the study of this digest; those of another one are taken away.
    ///
    /// # Errors
    /// [`StoreError::Folder`] where something else has that name, something else is in the folder, or another run uses
    /// it; [`StoreError::Write`].
    pub fn beside(out: &Path, digest: &str) -> Result<Self, StoreError> {
        let path = beside_results(out);
        let failed = |cause: io::Error| StoreError::Write { file: path.clone(), cause };
        let foreign = |what: String| StoreError::Folder {
            folder: out.to_owned(),
            what,
            hint: "cases that are done are kept there until the study is whole: give another `--out`, or move it away",
        };
        match fs::create_dir(&path) {
            Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {
                let at = path.join(MARK);
                let ours = fs::symlink_metadata(&path).is_ok_and(|found| found.is_dir())
                    && fs::symlink_metadata(&at).is_ok_and(|found| found.is_file());
                if !ours && names(&path).ok().is_none_or(|all| !all.is_empty()) {
                    return Err(foreign(format!("{} is not a folder of cases", path.display())));
                }
            }
            made => made.map_err(failed)?,
        }
        let mark = Lock::take(&path.join(MARK)).map_err(failed)?.ok_or_else(|| in_use(out, &path))?;
        let of = read_regular_text(mark.path(), most::DOCUMENT).map_err(failed)?;
        if of != digest {
            // One that was cut short is a beginning of a digest.
            if of.len() > DIGEST || !of.bytes().all(|b| b.is_ascii_hexdigit()) {
                return Err(foreign(format!("{} is not a folder of cases", path.display())));
            }
            take_away_left_overs(&path, &RESULT);
            for case in names(&path).map_err(failed)?.iter().filter(|name| *name != MARK) {
                remove_result(&path.join(case)).map_err(|e| {
                    foreign(format!("{} holds `{case}`, which is not a case of a study: {e}", path.display()))
                })?;
            }
            mark.file().set_len(0).and_then(|()| mark.file().write_all(digest.as_bytes())).map_err(failed)?;
        }
        Ok(Self { path, mark })
    }

    /// Where a case is, or will be once it is done.
    pub fn folder(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Takes the folder away where no case is done.
    pub fn remove_if_empty(self) {
        take_away_left_overs(&self.path, &RESULT);
        if names(&self.path).is_ok_and(|all| all == [MARK]) {
            // It is nobody's loss if it stays.
            let _ = self.mark.remove().and_then(|()| fs::remove_dir(&self.path));
        }
    }

    /// Moves the cases that are done to where they stay, and takes the folder away if nothing else is in it.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn move_into<'a>(self, to: &Path, names: impl Iterator<Item = &'a str>) -> Result<(), StoreError> {
        let moved = || -> io::Result<()> {
            for name in names.filter(|name| self.folder(name).is_dir()) {
                fs::create_dir_all(to)?;
                fs::rename(self.folder(name), to.join(name))?;
            }
            Ok(())
        };
        moved().map_err(|cause| StoreError::Write { file: self.path.clone(), cause })?;
        let Self { path, mark } = self;
        mark.remove().map_err(|cause| StoreError::Write { file: path.clone(), cause })?;
        take_away_left_overs(&path, &RESULT);
        // What is not ours stays, and the folder with it.
        let _ = fs::remove_dir(path);
        Ok(())
    }
}
