//! A result folder that is there as a whole or not at all.

use std::fs;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use files::{WorkFolder, behind_links};

use super::{
    names::is_ours,
    record::{self, RESULT, first_stranger, names},
};
use crate::{ResultFiles, StoreError};

/// Files are written into a work folder beside the wanted one; [`ResultDirectory::finish`] puts them in its place.
/// Dropped before that, it takes its files with it.
#[derive(Debug)]
pub struct ResultDirectory {
    wanted: PathBuf,
    work: WorkFolder,
    /// Where files are while the result is being written.
    growing: PathBuf,
}

impl ResultDirectory {
    /// Makes the work folder, and takes away those that killed runs into the same place have left.
    ///
    /// A link to a folder stays one: the folder that it leads to is replaced.
    ///
    /// # Errors
    /// [`StoreError::Folder`] when `wanted` is a file, cannot be made, or a folder that holds anything but an earlier
    /// result, known by a `summary.json` of this program that lists its files: nothing else is ever replaced.
    /// [`StoreError::Write`] when the disk is full.
    pub fn create(wanted: &Path) -> Result<Self, StoreError> {
        let complaint = |what: String, hint| StoreError::Folder { folder: wanted.to_owned(), what, hint };
        if wanted.file_name().is_none() {
            return Err(complaint("is no name of a folder".into(), "give the name of a new folder"));
        }
        let place = behind_links(wanted).map_err(|e| {
            complaint(
                format!("is a link that leads nowhere: {e}"),
                "make the folder that it leads to, or give another name",
            )
        })?;
        if place.exists() {
            if !place.is_dir() {
                return Err(complaint("is a file".into(), "give the name of a new folder"));
            }
            if let Some(stranger) =
                first_stranger(&place).map_err(|e| complaint(e.to_string(), "give another folder"))?
            {
                return Err(complaint(
                    format!("holds `{stranger}`, which is not a result file"),
                    "a result has a summary.json that lists its files, and nothing else is replaced: give a new folder, or move that file away",
                ));
            }
        }
        let work = work_folder(&place).map_err(|e| match e.kind() {
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
                StoreError::Write { file: wanted.to_owned(), cause: e }
            }
            _ => complaint(format!("cannot be made: {e}"), "give a folder that you may write to"),
        })?;
        Ok(Self { wanted: wanted.to_owned(), growing: work.new_result(), work })
    }

    /// Path of a file while the result is being written.
    pub fn path(&self, name: &str) -> PathBuf {
        self.growing.join(name)
    }

    /// Writes one file.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), StoreError> {
        ResultFiles::write(self, name, content)
    }

    /// Writes the files of a table, with commas and Parquet, each where it is wanted, block by block.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn write_table(&self, table: &answer::Table, with_csv: bool, with_parquet: bool) -> Result<(), StoreError> {
        let refused = |name: &str| {
            let file = self.wanted.join(name);
            move |cause| StoreError::Write { file: file.clone(), cause }
        };
        let create = |ending: &str| {
            let name = format!("{}.{ending}", table.name);
            debug_assert!(
                is_ours(&name),
                "{name} is not in the list of result files: what a killed run leaves would stay"
            );
            let file = fs::File::create(self.path(&name)).map_err(refused(&name))?;
            Ok::<_, StoreError>((file, name))
        };
        let text = with_csv.then(|| create("csv")).transpose()?;
        let mut lines = text.map(|(mut file, name)| {
            let refused = refused(&name);
            move |block: &str| file.write_all(block.as_bytes()).map_err(&refused)
        });
        let mut columns = with_parquet.then(|| create("parquet")).transpose()?;
        answer::write_table(
            table,
            lines.as_mut().map(|take| take as answer::TakeLines<'_, StoreError>),
            columns.as_mut().map(|(file, _)| file as &mut (dyn Write + Send)),
        )
    }

    /// Folder of the files while the result is being written.
    pub fn folder(&self) -> &Path {
        &self.growing
    }

    /// Takes over a file from elsewhere, as it is.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn copy(&self, from: &Path, name: &str) -> Result<(), StoreError> {
        fs::copy(from, self.path(name))
            .map(|_| ())
            .map_err(|cause| StoreError::Write { file: self.wanted.join(name), cause })
    }

    /// Names of the files written so far, ascending.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn files(&self) -> Result<Vec<String>, StoreError> {
        names(&self.growing).map_err(|cause| StoreError::Write { file: self.wanted.clone(), cause })
    }

    /// Puts the result where it was wanted, in place of an earlier one; `note` hears where a file went that somebody
    /// put there during the run. A result without a `summary.json` gets one that says whose it is and lists its files.
    ///
    /// # Errors
    /// When the system refuses; an earlier result is then still there.
    pub fn finish(self, mut note: impl FnMut(String)) -> Result<(), StoreError> {
        let Self { wanted, work, growing } = self;
        let whole = record::complete(&growing).and_then(|()| work.put_in_place(&mut note));
        whole.map_err(|cause| StoreError::Write { file: wanted, cause })
    }
}

impl ResultFiles for ResultDirectory {
    fn write(&self, name: &str, content: &[u8]) -> Result<(), StoreError> {
        debug_assert!(is_ours(name), "{name} is not in the list of result files: what a killed run leaves would stay");
        fs::write(self.path(name), content).map_err(|cause| StoreError::Write { file: self.wanted.join(name), cause })
    }

    fn create(&self, name: &str) -> Result<Box<dyn Write + '_>, StoreError> {
        let path = self.path(name);
        match fs::File::create(&path) {
            Ok(file) => Ok(Box::new(BufWriter::new(file))),
            Err(cause) => Err(StoreError::Write { file: path, cause }),
        }
    }
}

/// The work folder of a result, with room for it.
fn work_folder(place: &Path) -> io::Result<WorkFolder> {
    if let Some(parent) = place.parent().filter(|p| !p.as_os_str().is_empty()) {
        fs::create_dir_all(parent)?;
    }
    let work = WorkFolder::beside(place, &RESULT)?;
    fs::create_dir(work.new_result())?;
    Ok(work)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_is_whole_or_not_there() {
        let scratch = tempfile::tempdir().unwrap();
        let wanted = scratch.path().join("out");
        let half = ResultDirectory::create(&wanted).unwrap();
        half.write("history.csv", b"half").unwrap();
        drop(half);
        assert_eq!(fs::read_dir(scratch.path()).unwrap().count(), 0);

        for content in [b"first", b"later"] {
            let whole = ResultDirectory::create(&wanted).unwrap();
            whole.write("history.csv", content).unwrap();
            whole.finish(|said| panic!("{said}")).unwrap();
            assert_eq!(fs::read(wanted.join("history.csv")).unwrap(), content);
        }
        assert_eq!(fs::read_dir(scratch.path()).unwrap().count(), 1);
    }

    /// What somebody puts into the folder while the run goes on is not lost with the earlier result.
    #[test]
    fn a_file_that_came_in_during_the_run_is_spared() {
        let scratch = tempfile::tempdir().unwrap();
        let wanted = scratch.path().join("out");
        fs::create_dir(&wanted).unwrap();
        let whole = ResultDirectory::create(&wanted).unwrap();
        whole.write("history.csv", b"later").unwrap();
        fs::write(wanted.join("thesis.tex"), "years of work").unwrap();
        let mut told = Vec::new();
        whole.finish(|said| told.push(said)).unwrap();
        assert!(told.len() == 1 && told[0].starts_with("`thesis.tex`"), "{told:?}");
        assert_eq!(names(&wanted).unwrap(), ["history.csv", "summary.json"]);
        let aside = scratch.path().join(format!("out.replaced-{}", std::process::id()));
        assert_eq!(fs::read_to_string(aside.join("thesis.tex")).unwrap(), "years of work");
    }

    #[test]
    fn a_folder_with_other_files_is_left_alone() {
        let scratch = tempfile::tempdir().unwrap();
        fs::write(scratch.path().join("thesis.tex"), "years of work").unwrap();
        let error = ResultDirectory::create(scratch.path()).unwrap_err();
        assert!(error.to_string().ends_with("holds `thesis.tex`, which is not a result file"), "{error}");
    }
}
