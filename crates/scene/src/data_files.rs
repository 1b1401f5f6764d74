//! Topographies and pitch errors that a scene names, each file read once.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

use geometry::modification::{DataFileError, Topography, read_pitch_errors};

/// What the files say that were asked for, by their paths.
#[derive(Debug, Default)]
pub(crate) struct DataFiles {
    topographies: Files<Topography>,
    pitch_errors: Files<Vec<f64>>,
}

impl DataFiles {
    /// Measured depths of a flank.
    pub fn topography(&self, path: &Path) -> Result<Topography, DataFileError> {
        self.topographies.read(path, Topography::read)
    }

    /// Cumulative pitch deviation of each tooth, mm.
    pub fn pitch_errors(&self, path: &Path) -> Result<Vec<f64>, DataFileError> {
        self.pitch_errors.read(path, read_pitch_errors)
    }
}

/// Files of one kind.
#[derive(Debug)]
struct Files<T>(Mutex<BTreeMap<PathBuf, T>>);

impl<T> Default for Files<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<T: Clone> Files<T> {
    /// What a file says; what cannot be read is read again when it is asked for again.
    fn read(&self, path: &Path, read: fn(&Path) -> Result<T, DataFileError>) -> Result<T, DataFileError> {
        // An entry is whole or missing, whatever became of the thread that held the lock.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(said) = known.get(path) {
            return Ok(said.clone());
        }
        let said = read(path)?;
        known.insert(path.to_owned(), said.clone());
        Ok(said)
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use crate::{Scene, SceneError};

    /// What was read stays, in clones too; a scene that is read anew reads the files anew, and what is not there is
    /// looked for until it is.
    #[test]
    fn a_scene_reads_its_data_files_once() {
        let folder = tempfile::tempdir().unwrap();
        let [errors, depths] = ["errors.txt", "depths.csv"].map(|name| folder.path().join(name));
        let write = |error: f64, depth: f64| {
            fs::write(&errors, format!("{error} {}", "0 ".repeat(20))).unwrap();
            fs::write(&depths, format!("roll_deg, -15, 15\n5, {depth}, 0\n40, {depth}, 0\n")).unwrap();
        };
        let text = "[pinion]\nteeth = 21\nhelix_angle_deg = 0.0\npitch_errors_file = \"errors.txt\"\n\
                    modification.drive.topography = \"depths.csv\"\n[wheel]\nteeth = 32\n[pair]\n\
                    normal_module_mm = 3.0\nface_width_mm = 30.0\n[operation]\ntorque_nm = 100.0\n";
        let read = || Scene::parse(text, &folder.path().join("a.toml")).unwrap();
        let of = |scene: &Scene| {
            let pair = scene.gear_pair().unwrap();
            let said = pair.pinion.modifications();
            let depth = [&said.left, &said.right].into_iter().find_map(|f| f.topography.as_ref()).unwrap().depths()[0];
            [said.pitch_errors[0], depth].map(|mm| (1e3 * mm).round())
        };

        write(7.0, 3.0);
        let scene = read();
        assert_eq!(of(&scene), [7.0, 3.0]);
        write(8.0, 4.0);
        assert_eq!(of(&scene.clone()), [7.0, 3.0], "a clone");
        assert_eq!(of(&read()), [8.0, 4.0], "read anew");

        let scene = read();
        fs::remove_file(&errors).unwrap();
        assert!(matches!(scene.gear_pair(), Err(SceneError::DataFile(_))));
        write(9.0, 5.0);
        assert_eq!(of(&scene)[0], 9.0, "there again");
    }
}
