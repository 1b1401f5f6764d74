//! Files named by keys of a document.

use std::{fs, path::PathBuf};

use toml::Spanned;

use super::{
    SceneError,
    data_file::{Content, DataFile},
    origin::{Origin, in_program, resolved},
    source::Source,
};

/// The file that a key names, read once for all who name it; messages about one that is not there name the key's place.
pub(super) fn named<T: Content>(s: &Source<'_>, key: &str, word: &Spanned<String>) -> Result<DataFile<T>, SceneError> {
    let path = PathBuf::from(word.get_ref());
    let found = resolved(s.file, &path);
    if let Some(file) = s.data_files().known(&found, &path) {
        return Ok(file);
    }
    let refuse = |what: String, advice: &str| {
        Err(s.conflict(&word.span(), format!("`{key}` is \"{}\", but {what}", word.get_ref()), advice))
    };
    let missing = || refuse(format!("there is no file {}", found.display()), "paths are relative to the scene file");
    match s.origin() {
        Origin::Program if in_program(&path).is_some() => {}
        Origin::Program => return missing(),
        Origin::Disk => match fs::metadata(&found).map(|data| files::regular(&data)) {
            Err(_) => return missing(),
            Ok(Err(e)) => return refuse(e.to_string(), "give the path of a file on disk"),
            Ok(Ok(())) => {}
        },
    }
    s.data_files().read(s.origin(), s.file, path)
}
