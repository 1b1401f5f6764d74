//! Topographies and pitch errors that a scene names: read once, with the scene.

use std::{
    borrow::Cow,
    path::{Path, PathBuf},
    sync::Arc,
};

use files::{most, read_regular_text};
use geometry::modification::DataFileError;
use serde::{Serialize, Serializer};
use toml::Spanned;

use crate::{SceneError, Source, inputs};

/// A data file with its values. In a scene it is its path, as the user wrote it; two are equal when path and text are.
#[derive(Debug, Clone)]
pub struct DataFile<T> {
    path: PathBuf,
    text: Arc<str>,
    values: Arc<T>,
}

impl<T> DataFile<T> {
    /// Reads the file that a key names. A file that several keys of a scene name is opened once.
    pub(crate) fn read(
        s: &Source<'_>,
        key: &str,
        word: &Spanned<String>,
        parse: fn(&str, &Path) -> Result<T, DataFileError>,
    ) -> Result<Self, SceneError> {
        let path = inputs::named(s, key, word)?;
        let whole = inputs::resolved(s.file, &path);
        let known = s.data_files.borrow().get(&path).cloned();
        let text = match known {
            Some(text) => text,
            None => {
                let text: Arc<str> = read_regular_text(&whole, most::DATA)
                    .map_err(|source| DataFileError::Read { path: whole.clone(), source })?
                    .into();
                s.data_files.borrow_mut().insert(path.clone(), Arc::clone(&text));
                text
            }
        };
        let values = Arc::new(parse(&text, &whole)?);
        Ok(Self { path, text, values })
    }

    /// The path as the scene names it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What the file says, in mm and rad.
    pub fn values(&self) -> &T {
        &self.values
    }

    /// The bytes of the file as they were read.
    pub(crate) fn content(&self) -> Cow<'_, [u8]> {
        Cow::Borrowed(self.text.as_bytes())
    }

    /// Replaces the path by another one of the same file.
    pub(crate) fn set_path(&mut self, path: PathBuf) {
        self.path = path;
    }
}

impl<T> PartialEq for DataFile<T> {
    fn eq(&self, other: &Self) -> bool {
        self.path == other.path && self.text == other.text
    }
}

impl<T> Serialize for DataFile<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.path.serialize(serializer)
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use crate::{Scene, SceneError};

    const TEXT: &str = "[pinion]\nteeth = 21\nhelix_angle_deg = 0.0\npitch_errors_file = \"errors.txt\"\n\
                        modification.topography = \"depths.csv\"\n[wheel]\nteeth = 32\n[pair]\n\
                        normal_module_mm = 3.0\nface_width_mm = 30.0\n[operation]\ntorque_nm = 100.0\n";

    /// A scene holds what its files said when it was read, whatever becomes of them: values, bytes, copies. A scene
    /// that is read again has the new values, and without the file it is refused.
    #[test]
    fn a_scene_reads_its_data_files_once() {
        let folder = tempfile::tempdir().unwrap();
        let [errors, depths] = ["errors.txt", "depths.csv"].map(|name| folder.path().join(name));
        let write = |error: f64, depth: f64| {
            fs::write(&errors, format!("{error} {}", "0 ".repeat(20))).unwrap();
            fs::write(&depths, format!("roll_deg, -15, 15\n5, {depth}, 0\n40, {depth}, 0\n")).unwrap();
        };
        let read = || Scene::parse(TEXT, &folder.path().join("a.toml"));
        let of = |scene: &Scene| {
            let pair = scene.gear_pair().unwrap();
            let said = pair.pinion.modifications();
            let depth = |flank: &geometry::FlankModification| flank.topography.as_ref().unwrap().depths()[0];
            [said.pitch_errors[0], depth(&said.left), depth(&said.right)].map(|mm| (1e3 * mm).round())
        };

        write(7.0, 3.0);
        let scene = read().unwrap();
        write(8.0, 4.0);
        assert_eq!(of(&scene), [7.0, 3.0, 3.0], "written over");
        let again = read().unwrap();
        assert_eq!(of(&again), [8.0, 4.0, 4.0], "read again");
        assert_ne!(scene, again);

        fs::remove_file(&errors).unwrap();
        fs::remove_file(&depths).unwrap();
        let alone = scene.standing_alone();
        assert_eq!((of(&scene), of(&alone)), ([7.0, 3.0, 3.0], [7.0, 3.0, 3.0]), "removed");
        for scene in [&scene, &alone] {
            let bytes: Vec<_> = scene.files().into_iter().map(|path| scene.content(path).unwrap()).collect();
            assert!(bytes.len() == 2 && bytes[0].starts_with(b"roll_deg") && bytes[1].starts_with(b"7 0"));
        }
        assert!(matches!(read(), Err(SceneError::Conflict { .. })));
    }

    /// A complaint about a data file comes with the scene, and names the file and its line.
    #[test]
    fn a_damaged_data_file_is_refused_with_the_scene() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("depths.csv"), "roll_deg, -15, 15\n5, 0, 0\n40, 0, 0\n").unwrap();
        fs::write(folder.path().join("errors.txt"), "1 2\nmany\n").unwrap();
        let refused = Scene::parse(TEXT, &folder.path().join("a.toml")).unwrap_err();
        assert!(matches!(refused, SceneError::DataFile(_)));
        assert!(refused.to_string().ends_with("errors.txt:2: expected a number, found `many`"), "{refused}");
    }
}
