//! By what a result folder is known: its `summary.json`, which says whose it is and lists its files.

use std::{
    fs, io,
    path::{Component, Path},
};

use files::{Kind, is_left_over, is_work_folder, most, read_regular_text, stranger, take_away_left_overs};
use serde_json::{Value, json};

use super::names::is_ours;
use crate::CASES;

const SUMMARY: &str = "summary.json";

/// What belongs to this program of a result folder, and of one that grows.
pub(super) const RESULT: Kind = Kind { growing: strange_in_growing, earlier: first_stranger, remove: remove_result };

/// Names of the entries of a folder, ascending.
pub(super) fn names(folder: &Path) -> io::Result<Vec<String>> {
    let mut names: Vec<String> = fs::read_dir(folder)?
        .map(|entry| entry.map(|e| e.file_name().to_string_lossy().into_owned()))
        .collect::<Result<_, _>>()?;
    names.sort_unstable();
    Ok(names)
}

/// Files that the summary of a folder lists, itself among them; none where no summary of this program is there.
fn listed(folder: &Path) -> Option<Vec<String>> {
    let text = read_regular_text(&folder.join(SUMMARY), most::SUMMARY).ok()?;
    let summary: Value = serde_json::from_str(&text).ok()?;
    if summary["program"] != "ale-gear" {
        return None;
    }
    let files = summary["files"].as_array()?.iter().filter_map(Value::as_str).filter(|name| may_be_listed(name));
    Some(files.chain([SUMMARY]).map(str::to_owned).collect())
}

/// Whether a result may list a file of that name: a plain name of its own, which no way leads out of the folder. A
/// summary that somebody else has written is not trusted with anything else.
fn may_be_listed(name: &str) -> bool {
    let mut parts = Path::new(name).components();
    let is_plain = matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None));
    is_plain && (is_ours(name) || name == CASES)
}

/// Gives a result that has no summary one that says whose it is.
pub(super) fn complete(growing: &Path) -> io::Result<()> {
    let files = names(growing)?;
    if !files.iter().any(|name| name == SUMMARY) {
        let summary = json!({ "program": "ale-gear", "version": env!("CARGO_PKG_VERSION"), "files": files });
        return fs::write(growing.join(SUMMARY), format!("{summary:#}\n"));
    }
    debug_assert!(
        listed(growing).is_some_and(|all| files.iter().all(|name| all.contains(name))),
        "{SUMMARY} does not list all of {files:?}: a second run would refuse its own folder"
    );
    Ok(())
}

/// The first entry of a result folder that is no file of this result.
pub(super) fn first_stranger(folder: &Path) -> io::Result<Option<String>> {
    let listed = listed(folder);
    for name in names(folder)? {
        let path = folder.join(&name);
        let found = fs::symlink_metadata(&path)?;
        let is_listed = listed.as_ref().is_some_and(|all| all.contains(&name));
        let ours = match found.is_dir() {
            // A page that was being made again when its program was killed.
            true if is_left_over(&path) => true,
            true if name == CASES && is_listed => match strange_case(&path, first_stranger)? {
                Some(stranger) => return Ok(Some(stranger)),
                None => true,
            },
            true => false,
            false => is_listed && found.is_file(),
        };
        if !ours {
            return Ok(Some(name));
        }
    }
    Ok(None)
}

/// What is strange in a folder in which a result grows, which has no summary yet.
fn strange_in_growing(folder: &Path) -> io::Result<Option<String>> {
    for name in names(folder)? {
        let path = folder.join(&name);
        let found = fs::symlink_metadata(&path)?;
        if found.is_dir() && name == CASES {
            if let Some(stranger) = strange_case(&path, strange_in_growing)? {
                return Ok(Some(stranger));
            }
        } else if !found.is_file() || !is_ours(&name) {
            return Ok(Some(name));
        }
    }
    Ok(None)
}

/// The first entry below the folder of a study's cases that no run of this program writes.
fn strange_case(cases: &Path, judge: fn(&Path) -> io::Result<Option<String>>) -> io::Result<Option<String>> {
    for case in names(cases)? {
        let folder = cases.join(&case);
        let stranger = match fs::symlink_metadata(&folder)?.is_dir() {
            // A case that was being written when the study was killed.
            true if is_work_folder(&folder) => stranger(&folder, &RESULT)?,
            true => judge(&folder)?,
            false => Some(String::new()),
        };
        if let Some(name) = stranger {
            return Ok(Some(format!("{CASES}/{case}/{name}").trim_end_matches('/').to_owned()));
        }
    }
    Ok(None)
}

/// Takes away the regular files that the record of a result lists, the record last, and the folder.
///
/// # Errors
/// [`io::ErrorKind::DirectoryNotEmpty`] where anything else is in it; that stays, and the record with it.
pub(crate) fn remove_result(folder: &Path) -> io::Result<()> {
    take_away_left_overs(folder, &Kind::FILE);
    for name in listed(folder).unwrap_or_default().iter().filter(|name| *name != SUMMARY) {
        let path = folder.join(name);
        match fs::symlink_metadata(&path) {
            Ok(found) if found.is_file() => fs::remove_file(&path)?,
            Ok(found) if found.is_dir() && name == CASES => {
                for case in names(&path)? {
                    remove_result(&path.join(case))?;
                }
                fs::remove_dir(&path)?;
            }
            _ => {}
        }
    }
    if names(folder)? == [SUMMARY] {
        fs::remove_file(folder.join(SUMMARY))?;
    }
    fs::remove_dir(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A summary that lists files elsewhere once had them deleted.
    #[test]
    fn a_forged_list_takes_nothing_away() {
        let scratch = tempfile::tempdir().unwrap();
        let folder = scratch.path().join("o");
        fs::create_dir(&folder).unwrap();
        let thesis = scratch.path().join("thesis.tex");
        fs::write(&thesis, "years of work").unwrap();
        let absolute = thesis.display().to_string();
        let own = scratch.path().join("fields.vtu");
        fs::write(&own, "fields").unwrap();
        let list = [absolute.as_str(), "../thesis.tex", "../fields.vtu", "./history.csv", "notes.md", "history.csv"];
        fs::write(folder.join("history.csv"), "time_s\n").unwrap();
        fs::write(folder.join("notes.md"), "notes").unwrap();
        fs::write(folder.join(SUMMARY), json!({ "program": "ale-gear", "files": list }).to_string()).unwrap();
        assert_eq!(first_stranger(&folder).unwrap().as_deref(), Some("notes.md"));
        assert_eq!(remove_result(&folder).unwrap_err().kind(), io::ErrorKind::DirectoryNotEmpty);
        assert_eq!(fs::read_to_string(&thesis).unwrap(), "years of work");
        assert!(own.is_file() && folder.join("notes.md").is_file() && folder.join(SUMMARY).is_file());
        assert!(!folder.join("history.csv").exists());
    }
}
