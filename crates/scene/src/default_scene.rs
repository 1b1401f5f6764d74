//! The scene that is part of the program, and the files that a scene names.

use std::{borrow::Cow, io, path::Path};

use super::{DataFile, GearScene, Scene, SceneError, Setting, inputs, origin::Origin};

/// What messages call the default scene.
const NAME: &str = "default scene";
const TEXT: &str = include_str!("../../../scenes/default.toml");

impl Scene {
    /// The default scene, `scenes/default.toml` of the repository: it is part of the program with its meshes and needs
    /// no file.
    ///
    /// # Errors
    /// None, as a test holds; the type is that of every scene.
    pub fn default_scene() -> Result<Self, SceneError> {
        Self::default_scene_with(&[])
    }

    /// The default scene with some of its keys set otherwise.
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

    /// The content of a file that the scene names: of topographies and pitch errors as it was when the scene was read, of
    /// meshes as it is now.
    ///
    /// # Errors
    /// As the system says; [`io::ErrorKind::InvalidInput`] for folders, devices and named pipes.
    pub fn content(&self, path: &Path) -> io::Result<Cow<'_, [u8]>> {
        if let Some(content) = self.gears().into_iter().find_map(|gear| data_of(gear, path)) {
            return Ok(content);
        }
        inputs::content(self.written.origin(), &self.file, path)
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

/// The content of a data file that a gear names so.
fn data_of<'a>(gear: &'a GearScene, path: &Path) -> Option<Cow<'a, [u8]>> {
    let flanks = [&gear.modification.drive, &gear.modification.coast];
    let topography = flanks.into_iter().filter_map(|f| f.topography.as_ref()).find(|file| file.path() == path);
    let errors = gear.pitch_errors_file.as_ref().filter(|file| file.path() == path);
    topography.map(DataFile::content).or_else(|| errors.map(DataFile::content))
}

fn files_of(gear: &GearScene) -> impl Iterator<Item = &Path> {
    let flanks = [&gear.modification.drive, &gear.modification.coast];
    let topographies = flanks.into_iter().filter_map(|f| f.topography.as_ref().map(DataFile::path));
    gear.mesh.as_deref().into_iter().chain(topographies).chain(gear.pitch_errors_file.as_ref().map(DataFile::path))
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
