//! One message, one hint, one exit status.

use std::{fmt::Display, path::Path};

use std::error::Error;

use analysis::{AnalysisError, Blame, parameter_study::CaseFailure};
use export::ExportError;
use store::StoreError;
use study::StudyError;

use crate::{printed, scene::SceneError};

/// What the command says when it cannot go on.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct CommandError {
    /// 2: the input is wrong; 1: the input is fine but no result came out; 3: the result is there, less exact than asked.
    pub status: u8,
    /// One line: what, where, what was expected.
    pub message: String,
    /// The line of a file that is meant, with a mark below it.
    pub excerpt: Option<String>,
    /// One line: what to do next.
    pub hint: Option<String>,
}

impl CommandError {
    /// The input is wrong: exit status 2.
    pub fn input(message: impl Display, hint: Option<String>) -> Self {
        Self { status: 2, message: message.to_string(), excerpt: None, hint }
    }

    /// The input is fine, but no result came out: exit status 1.
    pub fn failed(message: impl Display, hint: Option<String>) -> Self {
        Self { status: 1, message: message.to_string(), excerpt: None, hint }
    }

    /// A file of the result cannot be written.
    pub fn write(path: &Path, error: &std::io::Error) -> Self {
        let hint = "is the disk full, or the folder write-protected?".to_owned();
        Self::failed(format_args!("{}: cannot be written: {error}", path.display()), Some(hint))
    }

    /// The whole text for stderr, ending in a newline; `coloured` for a terminal. Nothing else in it is a command of a
    /// terminal.
    pub fn text(&self, coloured: bool) -> String {
        let (red, blue, cyan, plain) =
            if coloured { ("\x1b[1;31m", "\x1b[34m", "\x1b[36m", "\x1b[0m") } else { ("", "", "", "") };
        let excerpt = self.excerpt.iter().map(|e| format!("{blue}{}{plain}\n", printed::plain(e)));
        let hint = self.hint.iter().map(|h| format!("{cyan}hint:{plain} {}\n", printed::message(&printed::units(h))));
        format!("{red}ale-gear:{plain} {}\n", printed::message(&printed::units(&self.message)))
            + &excerpt.chain(hint).collect::<String>()
    }

    /// This error with the place in a file that it is about, if that is known.
    #[must_use]
    pub fn about(self, excerpt: Option<&str>) -> Self {
        Self { excerpt: excerpt.map(str::to_owned), ..self }
    }
}

/// What a sink of this program says, as the command does; what another says comes back.
fn told(said: Box<dyn Error + Send + Sync>) -> Result<CommandError, Box<dyn Error + Send + Sync>> {
    let said = match said.downcast::<ExportError>() {
        Ok(own) => return Ok((*own).into()),
        Err(other) => other,
    };
    let said = match said.downcast::<StoreError>() {
        Ok(own) => return Ok((*own).into()),
        Err(other) => other,
    };
    said.downcast::<AnalysisError>().map(|own| (*own).into())
}

impl From<AnalysisError> for CommandError {
    fn from(error: AnalysisError) -> Self {
        let error = match error {
            // What a sink of this program says is a message already.
            AnalysisError::Sink(inner) => match told(inner) {
                Ok(own) => return own,
                Err(other) => AnalysisError::Sink(other),
            },
            other => other,
        };
        let hint = error.hint();
        let status = match error.blame() {
            Blame::Input => 2,
            Blame::NoResult => 1,
            Blame::Inexact => 3,
        };
        Self { status, message: error.to_string(), excerpt: error.excerpt().map(str::to_owned), hint }
    }
}

impl From<CaseFailure> for CommandError {
    fn from(failure: CaseFailure) -> Self {
        let CaseFailure { message, excerpt, hint, is_without_result } = failure;
        Self { status: if is_without_result { 1 } else { 2 }, message, excerpt, hint }
    }
}

impl From<StudyError> for CommandError {
    fn from(error: StudyError) -> Self {
        let hint = error.hint();
        Self::failed(&error, hint)
    }
}

impl From<SceneError> for CommandError {
    fn from(error: SceneError) -> Self {
        let hint = error.hint();
        Self::input(&error, hint).about(error.excerpt())
    }
}
