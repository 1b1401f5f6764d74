//! Errors as exceptions of `ale_gear.errors`: the command's message, the place, the key and the hint in attributes.

use std::path::Path;

use ::scene::{Place, RexsError, SceneError};
use analysis::{AnalysisError, Blame};
use export::ExportError;
use pyo3::{prelude::*, types::PyDict};
use report::ReportError;
use store::StoreError;

/// Which exception a complaint becomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A scene, a plan or an optimisation says what cannot be.
    Scene,
    /// Any other input is wrong: a mesh, a folder, a file.
    Input,
    /// An argument of a function is of no use to it.
    Argument,
    /// The input is fine, but no result came out, or one that does not hold.
    NoResult,
    /// The result is there, less exact than was asked.
    Inexact,
    /// A fault of this program.
    Internal,
}

/// What Python is told.
#[derive(Debug, Clone)]
pub struct Complaint {
    /// Which exception.
    pub kind: Kind,
    /// One line: what, where, what was expected; as the command says it.
    pub message: String,
    /// Hint: what to do next.
    pub hint: Option<String>,
    /// The file that is meant.
    file: Option<String>,
    /// Line of the file, from 1.
    line: Option<usize>,
    /// The key or the argument.
    key: Option<String>,
    /// The line with a mark below what is meant.
    excerpt: Option<String>,
}

impl Complaint {
    /// Complaint of a kind, with a hint.
    pub fn new(kind: Kind, message: impl ToString, hint: Option<String>) -> Self {
        Self { kind, message: message.to_string(), hint, file: None, line: None, key: None, excerpt: None }
    }

    /// About an argument.
    pub fn argument(name: &str, what: impl std::fmt::Display, hint: &str) -> Self {
        let own = Self::new(Kind::Argument, format_args!("`{name}` {what}"), Some(hint.to_owned()));
        Self { key: Some(name.to_owned()), ..own }
    }

    /// About a file.
    pub fn about(self, file: &Path) -> Self {
        Self { file: Some(file.display().to_string()), ..self }
    }

    /// The exception.
    pub fn exception(self, py: Python<'_>) -> PyErr {
        let name = match self.kind {
            Kind::Scene => "SceneError",
            Kind::Input => "InputError",
            Kind::Argument => "ArgumentError",
            Kind::NoResult => "NoResultError",
            Kind::Inexact => "InexactError",
            Kind::Internal => "InternalError",
        };
        let made = || {
            let words = PyDict::new(py);
            words.set_item("file", self.file)?;
            words.set_item("line", self.line)?;
            words.set_item("key", self.key)?;
            words.set_item("hint", self.hint)?;
            words.set_item("excerpt", self.excerpt)?;
            py.import("ale_gear.errors")?.getattr(name)?.call((self.message,), Some(&words))
        };
        made().map_or_else(|e| e, PyErr::from_value)
    }
}

impl From<Complaint> for PyErr {
    fn from(complaint: Complaint) -> Self {
        Python::attach(|py| complaint.exception(py))
    }
}

impl From<SceneError> for Complaint {
    fn from(error: SceneError) -> Self {
        let own = Self::new(Kind::Scene, &error, error.hint());
        let (file, line) = match error.place() {
            Some(Place::Line(line)) => (Some(line.file.display().to_string()), Some(line.number)),
            _ => match &error {
                SceneError::Read { file, .. } | SceneError::Missing { file, .. } => {
                    (Some(file.display().to_string()), None)
                }
                _ => (None, None),
            },
        };
        let key = error.key().map(str::to_owned);
        Self { file, line, key, excerpt: error.excerpt().map(str::to_owned), ..own }
    }
}

impl From<AnalysisError> for Complaint {
    fn from(error: AnalysisError) -> Self {
        let error = match error {
            AnalysisError::Scene(scene) => return (*scene).into(),
            // What a sink of this package says is a message already.
            AnalysisError::Sink(inner) => match inner.downcast::<ExportError>() {
                Ok(own) => return (*own).into(),
                Err(other) => match other.downcast::<StoreError>() {
                    Ok(own) => return (*own).into(),
                    Err(other) => AnalysisError::Sink(other),
                },
            },
            other => other,
        };
        let kind = match error.blame() {
            Blame::Inexact => Kind::Inexact,
            Blame::NoResult => Kind::NoResult,
            Blame::Input => Kind::Input,
        };
        let named: Vec<&Place> = error.places().filter(|place| place.file().is_some()).collect();
        let file = named.last().and_then(|place| place.file()).map(|file| file.display().to_string());
        let line = named.last().and_then(|place| place.line());
        let excerpt = error.excerpt().map(str::to_owned);
        Self { file, line, excerpt, ..Self::new(kind, &error, error.hint()) }
    }
}

impl From<ExportError> for Complaint {
    fn from(error: ExportError) -> Self {
        match error {
            ExportError::Store(store) => store.into(),
            _ => Self::new(Kind::NoResult, &error, error.hint()),
        }
    }
}

impl From<StoreError> for Complaint {
    fn from(error: StoreError) -> Self {
        let kind = if matches!(error, StoreError::Folder { .. }) { Kind::Input } else { Kind::NoResult };
        Self::new(kind, &error, error.hint())
    }
}

impl From<ReportError> for Complaint {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Scene(scene) => scene.into(),
            ReportError::Store(store) => store.into(),
            ReportError::NoResult { .. } | ReportError::NoMarks { .. } => Self::new(Kind::Input, &error, error.hint()),
            _ => Self::new(Kind::NoResult, &error, error.hint()),
        }
    }
}

impl From<std::io::Error> for Complaint {
    fn from(error: std::io::Error) -> Self {
        Self::new(Kind::NoResult, error, Some("is the disk full, or the folder write-protected?".into()))
    }
}

impl From<::mesh::MeshError> for Complaint {
    fn from(error: ::mesh::MeshError) -> Self {
        Self::new(Kind::Input, &error, error.hint())
    }
}

impl From<RexsError> for Complaint {
    fn from(error: RexsError) -> Self {
        Self::new(Kind::Input, &error, error.hint())
    }
}
