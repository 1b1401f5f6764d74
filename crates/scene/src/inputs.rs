//! Files that a scene names.

use std::{
    borrow::Cow,
    fs, io,
    path::{Path, PathBuf},
};

use toml::Spanned;

use super::{SceneError, origin::Origin, source::Source};

/// Files of the default scene, as it names them.
const FILES: [(&str, &[u8]); 2] = [
    ("../meshes/coarse_hex20_pinion.msh", include_bytes!("../../../meshes/coarse_hex20_pinion.msh")),
    ("../meshes/coarse_hex20_wheel.msh", include_bytes!("../../../meshes/coarse_hex20_wheel.msh")),
];

fn in_program(path: &Path) -> Option<&'static [u8]> {
    FILES.iter().find(|(name, _)| Path::new(name) == path).map(|(_, bytes)| *bytes)
}

/// The content of a file that the scene `scene` names.
pub(super) fn content(origin: Origin, scene: &Path, path: &Path) -> io::Result<Cow<'static, [u8]>> {
    match origin {
        Origin::Disk => files::read_regular_file(&resolved(scene, path), files::most::MESH).map(Cow::Owned),
        Origin::Program => in_program(path).map(Cow::Borrowed).ok_or(io::ErrorKind::NotFound.into()),
    }
}

/// A path in a scene as seen from here.
pub(super) fn resolved(scene: &Path, path: &Path) -> PathBuf {
    scene.parent().map_or_else(|| path.to_owned(), |folder| folder.join(path))
}

/// A file that is there; the path as written.
pub(super) fn named(s: &Source<'_>, key: &str, word: &Spanned<String>) -> Result<PathBuf, SceneError> {
    let path = PathBuf::from(word.get_ref());
    let found = resolved(s.file, &path);
    let refuse = |what: String, advice: &str| {
        Err(s.conflict(&word.span(), format!("`{key}` is \"{}\", but {what}", word.get_ref()), advice))
    };
    let missing = || refuse(format!("there is no file {}", found.display()), "paths are relative to the scene file");
    match s.origin {
        Origin::Program if in_program(&path).is_some() => Ok(path),
        Origin::Program => missing(),
        Origin::Disk => match fs::metadata(&found).map(|data| files::regular(&data)) {
            Err(_) => missing(),
            Ok(Err(e)) => refuse(e.to_string(), "give the path of a file on disk"),
            Ok(Ok(())) => Ok(path),
        },
    }
}
