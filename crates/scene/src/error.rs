//! Errors of a scene, with their places.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use files::Place;
use geometry::GeometryError;
use geometry::modification::DataFileError;
use mesh::MeshError;
use rating::RatingError;

use crate::DocumentKind;

/// An error in a scene file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// Path of the scene.
        file: PathBuf,
        /// Cause of the failure.
        source: std::io::Error,
    },
    /// The file is not valid TOML.
    #[error("{place}: {message}")]
    Syntax {
        /// Place at which parsing stopped.
        place: Place,
        /// What was expected.
        message: String,
        /// What was probably intended.
        advice: Option<Cow<'static, str>>,
    },
    /// A key that does not exist in its table.
    #[error("{place}: unknown key `{key}`")]
    UnknownKey {
        /// Place of the key.
        place: Place,
        /// The key as written.
        key: String,
        /// What was probably intended.
        advice: String,
    },
    /// A value of the wrong type.
    #[error("{place}: `{key}` must be {expected}, found {found}")]
    WrongType {
        /// Place of the value.
        place: Place,
        /// Name of the key.
        key: String,
        /// Type expected.
        expected: Box<str>,
        /// Value found.
        found: String,
        /// How to write it.
        advice: String,
    },
    /// A value outside its range.
    #[error("{place}: `{key}` is {value}, allowed is {allowed}")]
    OutOfRange {
        /// Place of the value.
        place: Place,
        /// Name of the key.
        key: String,
        /// The value as written.
        value: String,
        /// Permitted range or list.
        allowed: Box<str>,
        /// What was probably intended.
        advice: Option<String>,
    },
    /// A file of another kind.
    #[error("{}: this is {found}, and {wanted} is wanted", file.display())]
    AnotherKind {
        /// Path of the file.
        file: PathBuf,
        /// Kind of the file.
        found: DocumentKind,
        /// Kind that was expected.
        wanted: DocumentKind,
    },
    /// Required keys are missing.
    #[error("{}: missing {}", file.display(), keys.join(", "))]
    Missing {
        /// Path of the scene.
        file: PathBuf,
        /// The missing keys, each as `` `[table] key` ``.
        keys: Vec<String>,
    },
    /// A feature that this version does not have; it is never ignored.
    #[error("{place}: `{key}` asks for {what}, which this version cannot do")]
    NotYet {
        /// Place of the key.
        place: Place,
        /// Name of the key.
        key: String,
        /// Feature that is requested.
        what: String,
        /// What to do instead.
        instead: String,
    },
    /// A key set in addition to the file cannot be parsed.
    #[error("{label}: {what}")]
    Setting {
        /// The setting as the user wrote it.
        label: String,
        /// What is wrong with it.
        what: String,
    },
    /// The file and the additional words request something impossible together.
    #[error("{}: {what}", file.display())]
    Asked {
        /// Path of the file.
        file: PathBuf,
        /// What is impossible.
        what: String,
        /// Hint: the action that cures it.
        advice: String,
    },
    /// A scene made in code sets an unknown key.
    #[error("unknown key `{key}`")]
    NoKey {
        /// The key as the program names it.
        key: String,
    },
    /// Two keys that exclude each other, or a value that contradicts the rest of the scene.
    #[error("{place}: {what}")]
    Conflict {
        /// Place of the second key.
        place: Place,
        /// The contradiction.
        what: String,
        /// Hint: the action that cures it.
        advice: String,
    },
    /// No running pair can be made from the data.
    #[error("{}: [{table}]: {source}", at(place.as_ref(), file))]
    Geometry {
        /// Place of the wrong key, if it is in the file.
        place: Option<Place>,
        /// Path of the scene.
        file: PathBuf,
        /// Table concerned: `pinion`, `wheel` or `pair`.
        table: &'static str,
        /// Error of the geometry.
        source: Box<GeometryError>,
    },
    /// A topography or a list of pitch errors that cannot be read.
    #[error(transparent)]
    DataFile(Box<DataFileError>),
    /// A table of materials, lubricants or loads that cannot be read.
    #[error("{}: {source}", file.display())]
    RatingTable {
        /// Path of the file.
        file: PathBuf,
        /// What is wrong with it.
        source: Box<RatingError>,
    },
    /// A mesh that cannot be read.
    #[error(transparent)]
    Mesh(Box<MeshError>),
}

impl From<MeshError> for SceneError {
    fn from(error: MeshError) -> Self {
        Self::Mesh(Box::new(error))
    }
}

impl From<DataFileError> for SceneError {
    fn from(error: DataFileError) -> Self {
        Self::DataFile(Box::new(error))
    }
}

/// The place, or the file where none is known.
fn at(place: Option<&Place>, file: &Path) -> String {
    place.map_or_else(|| file.display().to_string(), ToString::to_string)
}

impl SceneError {
    /// The complaint about a document that was to be a `wanted` one: that it is another kind of file, where it is.
    pub(crate) fn unless_another_kind(self, found: Option<DocumentKind>, file: &Path, wanted: DocumentKind) -> Self {
        let of_keys = matches!(self, Self::UnknownKey { .. } | Self::WrongType { .. } | Self::Missing { .. });
        match found.filter(|found| of_keys && *found != wanted) {
            Some(found) => Self::AnotherKind { file: file.to_owned(), found, wanted },
            None => self,
        }
    }

    /// The message without the place before it.
    pub fn without_place(&self) -> String {
        let whole = self.to_string();
        let place = self.place().map(|place| format!("{place}: "));
        place.and_then(|p| whole.strip_prefix(&p).map(str::to_owned)).unwrap_or(whole)
    }

    /// The line of the error, with a mark; `None` if it concerns the whole file or no file.
    pub fn excerpt(&self) -> Option<&str> {
        self.place()?.excerpt()
    }

    /// Place of the wrong value; `None` if the error concerns the whole file or no file.
    pub fn place(&self) -> Option<&Place> {
        match self {
            Self::Read { .. }
            | Self::AnotherKind { .. }
            | Self::Asked { .. }
            | Self::Missing { .. }
            | Self::Setting { .. }
            | Self::NoKey { .. }
            | Self::Mesh(_)
            | Self::RatingTable { .. }
            | Self::DataFile(_) => None,
            Self::Geometry { place, .. } => place.as_ref(),
            Self::Syntax { place, .. }
            | Self::UnknownKey { place, .. }
            | Self::WrongType { place, .. }
            | Self::OutOfRange { place, .. }
            | Self::NotYet { place, .. }
            | Self::Conflict { place, .. } => Some(place),
        }
    }

    /// The key of the error, with its tables if it was set in addition to a file; `None` if there is none.
    pub fn key(&self) -> Option<&str> {
        if let Some(Place::Setting { label }) = self.place() {
            return Some(label);
        }
        match self {
            Self::UnknownKey { key, .. }
            | Self::WrongType { key, .. }
            | Self::OutOfRange { key, .. }
            | Self::NotYet { key, .. }
            | Self::NoKey { key } => Some(key),
            Self::Setting { label, .. } => Some(label),
            Self::Missing { keys, .. } => keys.first().map(|key| key.trim_matches('`')),
            Self::Geometry { table, .. } => Some(table),
            Self::Read { .. } | Self::AnotherKind { .. } | Self::Asked { .. } | Self::Syntax { .. } => None,
            Self::Conflict { .. } | Self::DataFile(_) | Self::RatingTable { .. } | Self::Mesh(_) => None,
        }
    }

    /// Hint for the user; the command prints it as `hint: ...`.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::Read { source, .. } if source.kind() == std::io::ErrorKind::InvalidData => {
                Some("a scene is plain text: save it as UTF-8".into())
            }
            Self::Read { .. } => Some("give the path of a scene file, as seen from this folder".into()),
            Self::Syntax { advice, .. } => {
                let plain = "a scene is a TOML file: `[table]` lines and `key = value` lines";
                Some(advice.as_deref().unwrap_or(plain).to_owned())
            }
            Self::UnknownKey { advice, .. } | Self::Conflict { advice, .. } | Self::WrongType { advice, .. } => {
                Some(advice.clone())
            }
            Self::OutOfRange { advice, key, .. } => {
                Some(advice.clone().unwrap_or_else(|| format!("give `{key}` a value that is allowed")))
            }
            Self::Asked { advice, .. } => Some(advice.clone()),
            Self::AnotherKind { file, found, .. } => {
                Some(format!("`ale-gear {} {} --out DIR` takes it", found.command(), file.display()))
            }
            Self::Missing { keys, .. } if keys.iter().all(|key| key.contains("[rating")) => {
                Some("a rating assumes nothing: state each of them, or leave [rating] out".into())
            }
            Self::RatingTable { .. } => Some("docs/scene.md says what `materials`, `lubricants` and `spectrum` hold; `crates/rating/data` has tables to begin with".into()),
            Self::Missing { .. } => Some("teeth, module, helix angle, face width and torque have no default".into()),
            Self::Setting { label, .. } => Some(example(label).into()),
            Self::NoKey { .. } => Some("tables and key with dots between them, as `operation.torque_nm`".into()),
            Self::NotYet { instead, .. } => Some(instead.clone()),
            Self::Geometry { source, .. } => source.hint(),
            Self::DataFile(error) => error.hint(),
            Self::Mesh(error) => error.hint(),
        }
    }
}

/// How the word of the command line is written that a complaint is about.
fn example(label: &str) -> &'static str {
    match label.split([' ', '=']).next().unwrap_or_default() {
        "--vary" => {
            "`ale-gear vary` takes `--vary operation.torque_nm=50:200:7`, a list `=50,100`, or `~0:40` for values that are drawn; `ale-gear optimise` takes bounds, `=0:40`"
        }
        "--design" => "latin-hypercube, sobol and random are known",
        "--samples" => "100 are usual",
        "--torques" => {
            "write torques on the driven gear of a pair, or of the first [[torque]] of a gearbox, in N m with commas between them: `--torques 75,150,225`"
        }
        "--limit" => "write `--limit max_pressure_mpa=1100`: a headline number and its largest value",
        "--measure" => "peak-to-peak, rms and harmonics are known",
        _ => "write `--set operation.torque_nm=200`: tables and key with dots between them, then the value",
    }
}
