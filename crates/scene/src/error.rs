//! What can be wrong with a scene, and where.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use files::Place;
use geometry::GeometryError;
use geometry::modification::DataFileError;
use mesh::MeshError;
use rating::RatingError;

use crate::DocumentKind;

/// A complaint about a scene file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The scene.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// It is no TOML.
    #[error("{place}: {message}")]
    Syntax {
        /// Where reading stopped.
        place: Place,
        /// What was expected.
        message: String,
        /// What may have been meant.
        advice: Option<Cow<'static, str>>,
    },
    /// A key that no table of this name has.
    #[error("{place}: unknown key `{key}`")]
    UnknownKey {
        /// Where it stands.
        place: Place,
        /// As written.
        key: String,
        /// What may have been meant.
        advice: String,
    },
    /// A value of another type.
    #[error("{place}: `{key}` must be {expected}, found {found}")]
    WrongType {
        /// Where it stands.
        place: Place,
        /// The key.
        key: String,
        /// The type wanted.
        expected: Box<str>,
        /// What stands there.
        found: String,
        /// How to write it.
        advice: String,
    },
    /// A value that makes no sense.
    #[error("{place}: `{key}` is {value}, allowed is {allowed}")]
    OutOfRange {
        /// Where it stands.
        place: Place,
        /// The key.
        key: String,
        /// As written.
        value: String,
        /// Range or list.
        allowed: Box<str>,
        /// What may have been meant.
        advice: Option<String>,
    },
    /// A file of another kind.
    #[error("{}: this is {found}, and {wanted} is wanted", file.display())]
    AnotherKind {
        /// The file.
        file: PathBuf,
        /// What it is.
        found: DocumentKind,
        /// What was to be read.
        wanted: DocumentKind,
    },
    /// Keys without a default that are not there.
    #[error("{}: missing {}", file.display(), keys.join(", "))]
    Missing {
        /// The scene.
        file: PathBuf,
        /// Each as `` `[table] key` ``.
        keys: Vec<String>,
    },
    /// Something this version cannot do; never ignored.
    #[error("{place}: `{key}` asks for {what}, which this version cannot do")]
    NotYet {
        /// Where it stands.
        place: Place,
        /// The key.
        key: String,
        /// What it asks for.
        what: String,
        /// What to do instead.
        instead: String,
    },
    /// A key set beside the file that cannot be read.
    #[error("{label}: {what}")]
    Setting {
        /// As the user wrote it.
        label: String,
        /// What is wrong with it.
        what: String,
    },
    /// What a file and the words beside it ask for together, and what cannot be.
    #[error("{}: {what}", file.display())]
    Asked {
        /// The file.
        file: PathBuf,
        /// What cannot be.
        what: String,
        /// Hint: the action that cures it.
        advice: String,
    },
    /// A scene made in code sets an unknown key.
    #[error("unknown key `{key}`")]
    NoKey {
        /// As the program says it.
        key: String,
    },
    /// Two keys that do not go together, or a value against the rest of the scene.
    #[error("{place}: {what}")]
    Conflict {
        /// Where the second of them stands.
        place: Place,
        /// The contradiction.
        what: String,
        /// Hint: the action that cures it.
        advice: String,
    },
    /// No running pair can be made of the data.
    #[error("{}: [{table}]: {source}", at(place.as_ref(), file))]
    Geometry {
        /// The key at fault, where it is written.
        place: Option<Place>,
        /// The scene.
        file: PathBuf,
        /// `pinion`, `wheel` or `pair`.
        table: &'static str,
        /// What the geometry says.
        source: Box<GeometryError>,
    },
    /// A topography or a list of pitch errors that cannot be read.
    #[error(transparent)]
    DataFile(Box<DataFileError>),
    /// A table of materials, lubricants or loads that cannot be read.
    #[error("{}: {source}", file.display())]
    RatingTable {
        /// The file.
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

    /// The complaint alone, without the place that stands before it.
    pub fn without_place(&self) -> String {
        let whole = self.to_string();
        let place = self.place().map(|place| format!("{place}: "));
        place.and_then(|p| whole.strip_prefix(&p).map(str::to_owned)).unwrap_or(whole)
    }

    /// The line that is complained of, with a mark; `None` where it is about the whole file or about no file.
    pub fn excerpt(&self) -> Option<&str> {
        self.place()?.excerpt()
    }

    /// Where the value stands that is complained of; `None` where it is about the whole file or about no file.
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

    /// The key that is complained of, with its tables where it was set beside a file; `None` where there is none.
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

    /// What the user can do next; the command prints it as `hint: ...`.
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
