//! A result folder that is there as a whole or not at all.

use std::fs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use super::work_folder::{self, WorkFolder};
use crate::{ReportError, ResultFiles, study_files::CASES};

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
    /// [`ReportError::Folder`] when `wanted` is a file, cannot be made, or a folder that holds anything but an earlier
    /// result: nothing that this program did not write is ever replaced.
    pub fn create(wanted: &Path) -> Result<Self, ReportError> {
        let complaint = |what: String, hint| ReportError::Folder { folder: wanted.to_owned(), what, hint };
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
                    format!("holds `{stranger}`, which is no result file"),
                    "results replace the whole folder: give a new one, or move that file away",
                ));
            }
        }
        let work = WorkFolder::beside(&place, first_stranger)
            .map_err(|e| complaint(format!("cannot be made: {e}"), "give a folder that you may write to"))?;
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
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), ReportError> {
        ResultFiles::write(self, name, content)
    }

    /// Folder of the files while the result is being written.
    pub fn folder(&self) -> &Path {
        &self.growing
    }

    /// Takes over a file from elsewhere, as it is.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn copy(&self, from: &Path, name: &str) -> Result<(), ReportError> {
        fs::copy(from, self.path(name))
            .map(|_| ())
            .map_err(|cause| ReportError::Write { file: self.wanted.join(name), cause })
    }

    /// Names of the files written so far, ascending.
    ///
    /// # Errors
    /// When the system refuses.
    pub fn files(&self) -> Result<Vec<String>, ReportError> {
        names(&self.growing).map_err(|cause| ReportError::Write { file: self.wanted.clone(), cause })
    }

    /// Puts the result where it was wanted, in place of an earlier one; `note` hears where a file went that somebody
    /// put there during the run.
    ///
    /// # Errors
    /// When the system refuses; an earlier result is then still there.
    pub fn finish(self, mut note: impl FnMut(String)) -> Result<(), ReportError> {
        let Self { wanted, work, .. } = self;
        work.put_in_place(&mut note).map_err(|cause| ReportError::Write { file: wanted, cause })
    }
}

impl ResultFiles for ResultDirectory {
    fn write(&self, name: &str, content: &[u8]) -> Result<(), ReportError> {
        debug_assert!(
            is_ours(name),
            "{name} is not in the list of result files: a second run would refuse its own folder"
        );
        fs::write(self.path(name), content).map_err(|cause| ReportError::Write { file: self.wanted.join(name), cause })
    }

    fn create(&self, name: &str) -> Result<Box<dyn Write + '_>, ReportError> {
        let path = self.path(name);
        match fs::File::create(&path) {
            Ok(file) => Ok(Box::new(BufWriter::new(file))),
            Err(cause) => Err(ReportError::Write { file: path, cause }),
        }
    }
}

/// The folder itself where a path is a link to one, else the path, without a slash at its end.
fn behind_links(wanted: &Path) -> std::io::Result<PathBuf> {
    let plain: PathBuf = wanted.components().collect();
    match fs::symlink_metadata(&plain) {
        Ok(found) if found.is_symlink() => fs::canonicalize(&plain),
        _ => Ok(plain),
    }
}

/// Names of the entries of a folder, ascending.
fn names(folder: &Path) -> std::io::Result<Vec<String>> {
    let mut names: Vec<String> = fs::read_dir(folder)?
        .map(|entry| entry.map(|e| e.file_name().to_string_lossy().into_owned()))
        .collect::<Result<_, _>>()?;
    names.sort_unstable();
    Ok(names)
}

/// Every file that a result may hold, beside those whose names depend on what is in them.
const OURS: [&str; 66] = [
    "summary.json",
    "history.csv",
    "history.parquet",
    "report.html",
    "report.json.gz",
    "contact_lines.csv",
    "contact_pattern_pinion.csv",
    "contact_pattern_wheel.csv",
    "contact_pattern.svg",
    "energy.csv",
    "spectrum.csv",
    "section.csv",
    "waterfall.csv",
    "cycles.csv",
    "order_cuts.csv",
    "resonance.csv",
    "campbell.csv",
    "sweep.csv",
    "bifurcation.csv",
    "bifurcations.csv",
    "basins.csv",
    "basins.svg",
    "attractors.csv",
    "branch.csv",
    "branch.svg",
    "in_time.csv",
    "bifurcation.svg",
    "study.csv",
    "positions.csv",
    "shafts.csv",
    "modes.csv",
    "crossings.csv",
    "response.csv",
    "rms.csv",
    "bearing_forces.csv",
    "bearing_forces.uff",
    "line_load.csv",
    "motion.csv",
    "motion_orders.csv",
    "cases.csv",
    "cases.parquet",
    "optimum.toml",
    "steps.csv",
    "harris.csv",
    "influences.csv",
    "front.csv",
    "chart.csv",
    "chart.md",
    "motion_precision.csv",
    "motion_precision.md",
    "motion_precision.png",
    "motion_precision.svg",
    "resonance_curves.csv",
    "resonance_curves.png",
    "resonance_curves.svg",
    "resonance_precision.csv",
    "resonance_precision.md",
    "resonance_precision.png",
    "resonance_precision.svg",
    "envelope.csv",
    "maps.csv",
    "work_precision.svg",
    "work_precision.png",
    "compare.html",
    "compare.csv",
    "compare_curves.csv",
];

fn is_ours(name: &str) -> bool {
    OURS.contains(&name)
        || name.ends_with(".vtu")
        || name.ends_with(".pvd")
        || (name.starts_with("compare_") && name.ends_with(".svg"))
}

/// The first entry of the folder that no run of this program writes.
fn first_stranger(folder: &Path) -> std::io::Result<Option<String>> {
    for name in names(folder)? {
        if name == CASES && folder.join(CASES).is_dir() {
            if let Some(stranger) = strange_case(&folder.join(CASES))? {
                return Ok(Some(stranger));
            }
        } else if !is_ours(&name) {
            return Ok(Some(name));
        }
    }
    Ok(None)
}

/// The first entry below the folder of a study's cases that no run of this program writes.
fn strange_case(cases: &Path) -> std::io::Result<Option<String>> {
    for case in names(cases)? {
        let folder = cases.join(&case);
        let stranger = match folder.is_dir() {
            // A case that was being written when the study was killed.
            true if work_folder::is_work_folder(&folder) => work_folder::stranger(&folder, first_stranger)?,
            true => first_stranger(&folder)?,
            false => Some(String::new()),
        };
        if let Some(name) = stranger {
            return Ok(Some(format!("{CASES}/{case}/{name}").trim_end_matches('/').to_owned()));
        }
    }
    Ok(None)
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
            whole.write("summary.json", content).unwrap();
            whole.finish(|said| panic!("{said}")).unwrap();
            assert_eq!(fs::read(wanted.join("summary.json")).unwrap(), content);
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
        whole.write("summary.json", b"later").unwrap();
        fs::write(wanted.join("thesis.tex"), "years of work").unwrap();
        let mut told = Vec::new();
        whole.finish(|said| told.push(said)).unwrap();
        assert!(told.len() == 1 && told[0].starts_with("`thesis.tex`"), "{told:?}");
        assert_eq!(names(&wanted).unwrap(), ["summary.json"]);
        let aside = scratch.path().join(format!("out.replaced-{}", std::process::id()));
        assert_eq!(fs::read_to_string(aside.join("thesis.tex")).unwrap(), "years of work");
    }

    #[test]
    fn a_folder_with_other_files_is_left_alone() {
        let scratch = tempfile::tempdir().unwrap();
        fs::write(scratch.path().join("thesis.tex"), "years of work").unwrap();
        let error = ResultDirectory::create(scratch.path()).unwrap_err();
        assert!(error.to_string().ends_with("holds `thesis.tex`, which is no result file"), "{error}");
    }
}
