//! Cases of a study that are done, in a folder beside the results: a run that is cut short goes on from there.

use std::{
    fs, io,
    path::{Path, PathBuf},
};

use crate::error::CommandError;

/// Says whose folder it is, and of which study.
const MARK: &str = ".ale-gear-cases";

/// The folder of cases that are done, `DIR.cases`.
#[derive(Debug)]
pub(crate) struct KeptCases {
    path: PathBuf,
}

impl KeptCases {
    /// Beside the results `out`, with the cases of the study of this digest; those of another one are taken away.
    ///
    /// # Errors
    /// Where something else has that name, or the system refuses.
    pub fn beside(out: &Path, digest: &str) -> Result<Self, CommandError> {
        let mut name = out.file_name().unwrap_or_default().to_owned();
        name.push(".cases");
        let path = out.with_file_name(name);
        let mark = path.join(MARK);
        let complain = |e: io::Error| CommandError::write(&path, &e);
        if path.exists() {
            let Ok(of) = fs::read_to_string(&mark) else {
                let hint = "cases that are done are kept there until the study is whole: give another `--out`";
                let what = format_args!("{}: is no folder of cases", path.display());
                return Err(CommandError::input(what, Some(hint.into())));
            };
            if of == digest {
                return Ok(Self { path });
            }
            fs::remove_dir_all(&path).map_err(complain)?;
        }
        fs::create_dir_all(&path).and_then(|()| fs::write(&mark, digest)).map_err(complain)?;
        Ok(Self { path })
    }

    /// Where a case is, or will be once it is done.
    pub fn folder(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Moves the cases that are done to where they stay, and takes the folder away.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn move_into<'a>(self, to: &Path, names: impl Iterator<Item = &'a str>) -> Result<(), CommandError> {
        let moved = || -> io::Result<()> {
            for name in names.filter(|name| self.folder(name).is_dir()) {
                fs::create_dir_all(to)?;
                fs::rename(self.folder(name), to.join(name))?;
            }
            fs::remove_dir_all(&self.path)
        };
        moved().map_err(|e| CommandError::write(&self.path, &e))
    }
}
