//! One message, one hint, one exit status.

use std::fmt::Display;
use std::path::Path;

use crate::scene::SceneError;

/// What the command says when it cannot go on.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct CommandError {
    /// 2: the input is wrong; 1: the input is fine but no result came out.
    pub status: u8,
    /// One line: what, where, what was expected.
    pub message: String,
    /// One line: what to do next.
    pub hint: Option<String>,
}

impl CommandError {
    /// The input is wrong: exit status 2.
    pub fn input(message: impl Display, hint: Option<String>) -> Self {
        Self { status: 2, message: message.to_string(), hint }
    }

    /// The input is fine, but no result came out: exit status 1.
    pub fn failed(message: impl Display, hint: Option<String>) -> Self {
        Self { status: 1, message: message.to_string(), hint }
    }

    /// A file of the result cannot be written.
    pub fn write(path: &Path, error: &std::io::Error) -> Self {
        let hint = "is the disk full, or the folder write-protected?".to_owned();
        Self::failed(format_args!("{}: cannot be written: {error}", path.display()), Some(hint))
    }

    /// The whole text for stderr, ending in a newline.
    pub fn text(&self) -> String {
        match &self.hint {
            Some(hint) => format!("ale-gear: {}\nhint: {hint}\n", self.message),
            None => format!("ale-gear: {}\n", self.message),
        }
    }
}

impl From<SceneError> for CommandError {
    fn from(error: SceneError) -> Self {
        let hint = error.hint();
        Self::input(error, hint)
    }
}
