//! One file, whole or as it was.

use std::{
    fs::{self, File},
    io::{self, ErrorKind, Write},
    path::{Path, PathBuf},
};

use crate::{Kind, WorkFolder, place::parent, regular, sync};

/// Writes a file, in place of one that is there; at no moment anything half written has its name.
///
/// The bytes go into a [`WorkFolder`] beside it, are synchronised, and the file is renamed. Where that fails it is as it
/// was, and nothing is left. What killed processes have left there goes as well. A link is followed, permissions of the
/// earlier file stay; a device or a pipe is written into as it is.
///
/// # Errors
/// When the system refuses, as it does for a file that is write-protected.
pub fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let target = behind_links(path)?;
    let permissions = match fs::metadata(&target) {
        Ok(found) if found.is_dir() => return regular(&found),
        Ok(found) => {
            // Whoever protects a file means the name as well.
            let mut file = File::options().write(true).open(&target)?;
            if !found.is_file() {
                return file.write_all(bytes);
            }
            Some(found.permissions())
        }
        Err(e) if e.kind() == ErrorKind::NotFound => None,
        Err(e) => return Err(e),
    };
    through_work_folder(&target, bytes, permissions, |new| fs::rename(new, &target))
}

/// Writes a file that is not there yet.
///
/// # Errors
/// [`ErrorKind::AlreadyExists`] where something has that name, whoever made it and when; else as [`write_file`].
pub fn write_new_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if fs::symlink_metadata(path).is_ok() {
        return Err(ErrorKind::AlreadyExists.into());
    }
    through_work_folder(path, bytes, None, |new| match fs::hard_link(new, path) {
        // A second name on one file is refused where the name is taken, but not every file system has them.
        Err(e) if e.kind() != ErrorKind::AlreadyExists && fs::symlink_metadata(path).is_err() => fs::rename(new, path),
        linked => linked,
    })
}

fn through_work_folder(
    target: &Path,
    bytes: &[u8],
    permissions: Option<fs::Permissions>,
    place: impl FnOnce(&Path) -> io::Result<()>,
) -> io::Result<()> {
    if target.file_name().is_none() {
        return Err(io::Error::new(ErrorKind::InvalidInput, "it is no name of a file"));
    }
    let work = WorkFolder::beside(target, &Kind::FILE)?;
    let new = work.new_result();
    let mut file = File::options().write(true).create_new(true).open(&new)?;
    file.write_all(bytes)?;
    if let Some(permissions) = permissions {
        file.set_permissions(permissions)?;
    }
    file.sync_all()?;
    drop(file);
    place(&new)?;
    sync::folder(parent(target));
    Ok(())
}

/// What a path leads to where it is a link, else the path, without a slash at its end.
///
/// # Errors
/// Where a link leads nowhere.
pub fn behind_links(wanted: &Path) -> io::Result<PathBuf> {
    let plain: PathBuf = wanted.components().collect();
    match fs::symlink_metadata(&plain) {
        Ok(found) if found.is_symlink() => fs::canonicalize(&plain),
        _ => Ok(plain),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_replaced_as_a_whole() {
        let scratch = tempfile::tempdir().unwrap();
        let file = scratch.path().join("a.msh");
        for text in ["first", "later"] {
            write_file(&file, text.as_bytes()).unwrap();
            assert_eq!(
                (fs::read_to_string(&file).unwrap().as_str(), names(scratch.path())),
                (text, vec!["a.msh".into()])
            );
        }
        assert_eq!(write_new_file(&file, b"new").unwrap_err().kind(), ErrorKind::AlreadyExists);
        write_new_file(&scratch.path().join("b"), b"new").unwrap();
        assert_eq!(fs::read(scratch.path().join("b")).unwrap(), b"new");
        assert_eq!(names(scratch.path()), ["a.msh", "b"]);
        assert!(write_file(scratch.path(), b"").unwrap_err().to_string().contains("it is a folder"));
        assert_eq!(write_file(&scratch.path().join("no/c"), b"").unwrap_err().kind(), ErrorKind::NotFound);
    }

    #[cfg(unix)]
    #[test]
    fn links_devices_and_permissions_stay() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let scratch = tempfile::tempdir().unwrap();
        let (file, link) = (scratch.path().join("a"), scratch.path().join("b"));
        fs::write(&file, "first").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        symlink("a", &link).unwrap();
        write_file(&link, b"later").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"later");
        assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
        write_file(Path::new("/dev/null"), b"nothing").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file(), "a device became a file");
    }
}
