//! Files that a scene names, and the scene that is part of the program.

use std::{
    borrow::Cow,
    fs, io,
    path::{Path, PathBuf},
};

use toml::Spanned;

use super::{GearScene, Scene, SceneError, Setting, origin::Origin, source::Source};

/// What messages call the default scene.
const NAME: &str = "default scene";
const TEXT: &str = include_str!("../../../scenes/default.toml");
/// Files of the default scene, as it names them.
const FILES: [(&str, &[u8]); 2] = [
    ("../meshes/coarse_hex20_pinion.msh", include_bytes!("../../../meshes/coarse_hex20_pinion.msh")),
    ("../meshes/coarse_hex20_wheel.msh", include_bytes!("../../../meshes/coarse_hex20_wheel.msh")),
];

fn in_program(path: &Path) -> Option<&'static [u8]> {
    FILES.iter().find(|(name, _)| Path::new(name) == path).map(|(_, bytes)| *bytes)
}

impl Scene {
    /// The default scene, `scenes/default.toml` of the repository: it is part of the program with its meshes and needs
    /// no file.
    ///
    /// # Errors
    /// None, as a test holds; the type is that of every scene.
    pub fn default_scene() -> Result<Self, SceneError> {
        Self::default_scene_with(&[])
    }

    /// The same with some of its keys set otherwise.
    ///
    /// # Errors
    /// [`SceneError`]: what the settings do not allow.
    pub fn default_scene_with(settings: &[Setting]) -> Result<Self, SceneError> {
        Self::parse_from(TEXT, Path::new(NAME), settings, Origin::Program)
    }

    /// Whether it is the default scene of the program.
    pub fn is_default_scene(&self) -> bool {
        self.written.origin() == Origin::Program
    }

    /// The content of a file that the scene names.
    ///
    /// # Errors
    /// As the system says; [`io::ErrorKind::InvalidInput`] for folders, devices and named pipes.
    pub fn content(&self, path: &Path) -> io::Result<Cow<'static, [u8]>> {
        content(self.written.origin(), &self.file, path)
    }

    /// Every file that the scene names, as it names them: meshes, topographies, pitch errors; pinion first, each once.
    pub fn files(&self) -> Vec<&Path> {
        let mut all: Vec<&Path> = Vec::new();
        for path in self.gears().into_iter().flat_map(files_of) {
            if !all.contains(&path) {
                all.push(path);
            }
        }
        all
    }
}

fn files_of(gear: &GearScene) -> impl Iterator<Item = &Path> {
    let flanks = [&gear.modification.drive, &gear.modification.coast];
    let topographies = flanks.into_iter().filter_map(|f| f.topography.as_deref());
    gear.mesh.as_deref().into_iter().chain(topographies).chain(gear.pitch_errors_file.as_deref())
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The program holds what the repository has, with every file that the scene names.
    #[test]
    fn the_default_scene_is_that_of_the_repository() {
        let of_program = Scene::default_scene().unwrap();
        let top = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap();
        let of_file = Scene::read(&top.join("scenes/default.toml")).unwrap();
        assert_eq!(of_program.to_toml(), of_file.to_toml());
        assert_eq!(of_program.files().len(), 2);
        for path in of_program.files() {
            assert!(of_program.content(path).unwrap() == of_file.content(path).unwrap(), "{}", path.display());
        }
    }
}
