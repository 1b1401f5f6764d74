//! The scene built into the program, and the files that a scene names.

use std::{path::Path, sync::Arc};

use super::{Document, GearScene, Scene, SceneError, Setting, origin::Origin};

/// What messages call the default scene.
const NAME: &str = "default scene";
const TEXT: &str = include_str!("../../../scenes/default.toml");

impl Scene {
    /// The default scene, `scenes/default.toml` of the repository. It is built into the program with its meshes and
    /// needs no file.
    ///
    /// # Errors
    /// No error occurs, as a test ensures; the type is that of every scene.
    pub fn default_scene() -> Result<Self, SceneError> {
        Self::default_scene_with(&[])
    }

    /// The default scene with some keys set to other values.
    ///
    /// # Errors
    /// [`SceneError`] if a setting is not permitted.
    pub fn default_scene_with(settings: &[Setting]) -> Result<Self, SceneError> {
        Document::default_scene().scene(settings)
    }

    /// Whether this is the default scene of the program.
    pub fn is_default_scene(&self) -> bool {
        self.written.origin() == Origin::Program
    }

    /// All files that the scene names, as written, with the BLAKE3 (hexadecimal) of their bytes when they were read:
    /// meshes, topographies, pitch errors, those of the pinion first, then tables of materials and lubricants, load
    /// spectra; each once.
    pub fn files(&self) -> Vec<(&Path, String)> {
        let mut all: Vec<(&Path, String)> = Vec::new();
        let rating = self.rating.iter().flat_map(|rating| {
            let materials = rating.materials.as_ref().map(|file| (file.path(), file.blake3()));
            let spectrum = rating.spectrum.as_ref().map(|file| (file.path(), file.blake3()));
            materials
                .into_iter()
                .chain(spectrum)
                .chain(rating.lubricants.as_ref().map(|file| (file.path(), file.blake3())))
        });
        for file in self.gears().into_iter().flat_map(files_of).chain(rating) {
            if !all.contains(&file) {
                all.push(file);
            }
        }
        all
    }
}

impl Document {
    /// The default scene of the program.
    pub fn default_scene() -> Self {
        Self::made(TEXT.to_owned(), Path::new(NAME), Origin::Program, Arc::default())
    }
}

fn files_of(gear: &GearScene) -> impl Iterator<Item = (&Path, String)> {
    let mesh = gear.mesh.as_ref().map(|file| (file.path(), file.blake3()));
    let flanks = [&gear.modification.drive, &gear.modification.coast];
    let topographies = flanks.into_iter().filter_map(|f| f.topography.as_ref().map(|f| (f.path(), f.blake3())));
    mesh.into_iter().chain(topographies).chain(gear.pitch_errors_file.as_ref().map(|f| (f.path(), f.blake3())))
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
        assert_eq!(of_program.files(), of_file.files());
    }
}
