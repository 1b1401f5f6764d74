//! Files that a document names: meshes, topographies, pitch errors, load spectra, tables of materials. Each file is
//! read once.

use std::{
    collections::BTreeMap,
    fmt, fs,
    path::{Path, PathBuf},
    str::from_utf8,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::SystemTime,
};

use files::most;
use geometry::modification::{DataFileError, Topography, parse_pitch_errors};
use mesh::{Mesh, MeshError};
use rating::{Lubricants, Materials, RatingError, Spectrum};
use serde::{Serialize, Serializer};

use crate::{
    SceneError,
    origin::{Origin, resolved},
};

/// A file and its content. In a scene it is its path as the user wrote it. Two are equal if path and bytes are equal.
pub struct DataFile<T> {
    path: PathBuf,
    blake3: blake3::Hash,
    values: Arc<T>,
}

impl<T> DataFile<T> {
    /// The path as written in the scene.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The content of the file when it was read, in mm and rad.
    pub fn values(&self) -> &T {
        &self.values
    }

    /// BLAKE3 of its bytes when it was read, hexadecimal.
    pub fn blake3(&self) -> String {
        self.blake3.to_hex().to_string()
    }

    /// Replaces the path by another path of the same file.
    pub fn set_path(&mut self, path: PathBuf) {
        self.path = path;
    }
}

impl<T> Clone for DataFile<T> {
    fn clone(&self) -> Self {
        Self { path: self.path.clone(), blake3: self.blake3, values: Arc::clone(&self.values) }
    }
}

impl<T> fmt::Debug for DataFile<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DataFile").field("path", &self.path).field("blake3", &self.blake3()).finish()
    }
}

impl<T> PartialEq for DataFile<T> {
    fn eq(&self, other: &Self) -> bool {
        self.path == other.path && self.blake3 == other.blake3
    }
}

impl<T> Serialize for DataFile<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.path.serialize(serializer)
    }
}

/// What the files say that a document and those beside it have named so far. One that cannot be read is looked for again
/// when it is named again.
#[derive(Debug, Default)]
pub(crate) struct DataFiles {
    topographies: Known<Topography>,
    pitch_errors: Known<Vec<f64>>,
    meshes: Known<Mesh>,
    materials: Known<Materials>,
    lubricants: Known<Lubricants>,
    spectra: Known<Spectrum>,
}

/// Files of one kind by where they are.
#[derive(Debug)]
pub(crate) struct Known<T>(Mutex<BTreeMap<PathBuf, Entry<T>>>);

#[derive(Debug)]
struct Entry<T> {
    file: DataFile<T>,
    /// Before it was read; none of a file of the program.
    stamp: Option<Stamp>,
    /// Whether this document names it, and not only one before it.
    named: bool,
}

/// Size and time of a file.
type Stamp = (u64, SystemTime);

fn stamp(path: &Path) -> Option<Stamp> {
    let data = fs::metadata(path).ok()?;
    Some((data.len(), data.modified().ok()?))
}

impl<T> Known<T> {
    /// An entry is whole or missing, whatever became of the thread that held the lock.
    fn lock(&self) -> MutexGuard<'_, BTreeMap<PathBuf, Entry<T>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Files that the document names, unchanged since it was read.
    fn unchanged(&self) -> Self {
        let all = self.lock();
        let same = all.iter().filter(|(path, own)| own.named && (own.stamp.is_none() || own.stamp == stamp(path)));
        let kept = |own: &Entry<T>| Entry { file: own.file.clone(), stamp: own.stamp, named: false };
        Self(Mutex::new(same.map(|(path, own)| (path.clone(), kept(own))).collect()))
    }
}

impl<T> Default for Known<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl DataFiles {
    /// The files of the document that have not been modified since they were read, for its next text.
    pub fn unchanged(&self) -> Self {
        Self {
            topographies: self.topographies.unchanged(),
            pitch_errors: self.pitch_errors.unchanged(),
            meshes: self.meshes.unchanged(),
            materials: self.materials.unchanged(),
            lubricants: self.lubricants.unchanged(),
            spectra: self.spectra.unchanged(),
        }
    }

    /// A file that has been read, found by its full path; `path` is its name in the document.
    pub fn known<T: Content>(&self, whole: &Path, path: &Path) -> Option<DataFile<T>> {
        let mut all = T::known(self).lock();
        let own = all.get_mut(whole)?;
        own.named = true;
        Some(DataFile { path: path.to_owned(), ..own.file.clone() })
    }

    /// Reads the file with the name `path` in a document at `document`.
    ///
    /// # Errors
    /// [`SceneError::DataFile`], [`SceneError::Mesh`] if it cannot be read or parsed.
    pub fn read<T: Content>(&self, origin: Origin, document: &Path, path: PathBuf) -> Result<DataFile<T>, SceneError> {
        let whole = resolved(document, &path);
        let before = match origin {
            Origin::Disk => stamp(&whole),
            Origin::Program => None,
        };
        let bytes = origin.read(document, &path, T::MOST).map_err(|source| T::unread(&whole, source))?;
        let said = DataFile { path, blake3: blake3::hash(&bytes), values: Arc::new(T::parse(&bytes, &whole)?) };
        T::known(self).lock().insert(whole, Entry { file: said.clone(), stamp: before, named: true });
        Ok(said)
    }
}

/// What a kind of file says.
pub(crate) trait Content: Sized {
    /// Largest file, bytes.
    const MOST: u64 = most::DATA;

    /// Files of this kind.
    fn known(all: &DataFiles) -> &Known<Self>;

    /// What bytes say; `path` is for messages.
    ///
    /// # Errors
    /// [`SceneError::DataFile`], [`SceneError::Mesh`].
    fn parse(bytes: &[u8], path: &Path) -> Result<Self, SceneError>;

    /// The error that a file cannot be read.
    fn unread(path: &Path, source: std::io::Error) -> SceneError {
        DataFileError::Read { path: path.to_owned(), source }.into()
    }
}

impl Content for Topography {
    fn known(all: &DataFiles) -> &Known<Self> {
        &all.topographies
    }

    fn parse(bytes: &[u8], path: &Path) -> Result<Self, SceneError> {
        Ok(Self::parse(text(bytes, path)?, path)?)
    }
}

/// Cumulative pitch deviation of each tooth, mm.
impl Content for Vec<f64> {
    fn known(all: &DataFiles) -> &Known<Self> {
        &all.pitch_errors
    }

    fn parse(bytes: &[u8], path: &Path) -> Result<Self, SceneError> {
        Ok(parse_pitch_errors(text(bytes, path)?, path)?)
    }
}

impl Content for Mesh {
    const MOST: u64 = most::MESH;

    fn known(all: &DataFiles) -> &Known<Self> {
        &all.meshes
    }

    fn parse(bytes: &[u8], path: &Path) -> Result<Self, SceneError> {
        Ok(Self::parse(bytes, path)?)
    }

    fn unread(path: &Path, source: std::io::Error) -> SceneError {
        MeshError::Read { path: path.to_owned(), source }.into()
    }
}

impl Content for Materials {
    fn known(all: &DataFiles) -> &Known<Self> {
        &all.materials
    }

    fn parse(bytes: &[u8], path: &Path) -> Result<Self, SceneError> {
        Self::parse(text(bytes, path)?).map_err(|source| damaged(path, source))
    }
}

impl Content for Lubricants {
    fn known(all: &DataFiles) -> &Known<Self> {
        &all.lubricants
    }

    fn parse(bytes: &[u8], path: &Path) -> Result<Self, SceneError> {
        Self::parse(text(bytes, path)?).map_err(|source| damaged(path, source))
    }
}

impl Content for Spectrum {
    fn known(all: &DataFiles) -> &Known<Self> {
        &all.spectra
    }

    fn parse(bytes: &[u8], path: &Path) -> Result<Self, SceneError> {
        Self::parse(text(bytes, path)?).map_err(|source| damaged(path, source))
    }
}

fn damaged(path: &Path, source: RatingError) -> SceneError {
    SceneError::RatingTable { file: path.to_owned(), source: Box::new(source) }
}

fn text<'a>(bytes: &'a [u8], path: &Path) -> Result<&'a str, DataFileError> {
    from_utf8(bytes).map_err(|_| DataFileError::Read { path: path.to_owned(), source: files::no_text() })
}

#[cfg(test)]
mod tests {
    use std::{fs, path::PathBuf};

    use crate::{Document, Scene, SceneError};

    const TEXT: &str = "[pinion]\nteeth = 21\nhelix_angle_deg = 0.0\npitch_errors_file = \"errors.txt\"\n\
                        modification.topography = \"depths.csv\"\n[wheel]\nteeth = 32\n[pair]\n\
                        normal_module_mm = 3.0\nface_width_mm = 30.0\n[operation]\ntorque_nm = 100.0\n";
    const MESHED: &str = "[pinion]\nteeth = 30\nhelix_angle_deg = 20.0\nmesh = \"p.msh\"\n[wheel]\nteeth = 30\n\
                          [pair]\nnormal_module_mm = 3.0\nface_width_mm = 20.0\n[operation]\ntorque_nm = 100.0\n";

    /// A scene holds what its files said when it was read, whatever becomes of them: values, digests, copies, scenes with
    /// another number. A scene that is read again has the new values, and without the file it is refused.
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
            let depth = |flank: &geometry::FlankModification| flank.topography.as_ref().unwrap().grids()[0].depths()[0];
            [said.pitch_errors[0], depth(&said.left), depth(&said.right)].map(|mm| (1e3 * mm).round())
        };

        write(7.0, 3.0);
        let document = Document::new(TEXT.to_owned(), &folder.path().join("a.toml"));
        let scene = document.scene(&[]).unwrap();
        let digests = scene.files();
        write(8.0, 4.0);
        assert_eq!(of(&scene), [7.0, 3.0, 3.0], "written over");
        let again = read().unwrap();
        assert_eq!(of(&again), [8.0, 4.0, 4.0], "read again");
        assert_ne!(scene, again);
        assert!(again.files().iter().zip(&digests).all(|(new, old)| new.0 == old.0 && new.1 != old.1));

        fs::remove_file(&errors).unwrap();
        fs::remove_file(&depths).unwrap();
        let alone = scene.standing_alone();
        assert_eq!((of(&scene), of(&alone)), ([7.0, 3.0, 3.0], [7.0, 3.0, 3.0]), "removed");
        assert_eq!(alone.files().len(), 2);
        assert!(matches!(read(), Err(SceneError::Conflict { .. })));
    }

    /// The mesh of a gear is read with the document: for its bore, for all cases, and for who computes with it.
    #[test]
    fn a_mesh_is_read_with_its_document() {
        let folder = tempfile::tempdir().unwrap();
        let mesh = folder.path().join("p.msh");
        let shipped = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../meshes/coarse_hex8_pinion.msh");
        fs::copy(shipped, &mesh).unwrap();
        let document = Document::new(MESHED.to_owned(), &folder.path().join("a.toml"));
        let torque = |nm: f64| crate::Setting::number("operation.torque_nm", nm).unwrap();
        let scenes = [document.scene(&[]), document.scene(&[torque(200.0)])].map(Result::unwrap);
        let held = |scene: &Scene| scene.pinion.mesh.as_ref().unwrap().values() as *const mesh::Mesh;
        assert_eq!(held(&scenes[0]), held(&scenes[1]), "one copy for all cases");
        assert_eq!(held(&scenes[0]), held(&scenes[0].with_number("operation.torque_nm", 1.0).unwrap()));
        let edited = document.edited(MESHED.replace("100.0", "50.0")).scene(&[]).unwrap();
        assert_eq!((held(&edited), edited.operation.torque_nm), (held(&scenes[0]), 50.0), "the file is the same");
        fs::write(&mesh, "no mesh").unwrap();
        assert!(matches!(document.edited(MESHED.to_owned()).scene(&[]), Err(SceneError::Mesh { .. })));
        let refused = Scene::parse(MESHED, &folder.path().join("a.toml")).unwrap_err();
        assert!(matches!(refused, SceneError::Mesh { .. }), "{refused}");
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
