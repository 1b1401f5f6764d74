//! A complaint as the page shows it: the words of the command, and the keys that it stands beside.

use analysis::AnalysisError;
use scene::SceneError;
use serde::Serialize;
use store::MemoryDemandError;

use crate::scene_text::keys_of;

/// What is wrong.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Fault {
    /// One line: what, where, what was expected.
    pub message: String,
    /// The line of the scene that is meant, with a mark below it.
    pub excerpt: Option<String>,
    /// One line: what to do next.
    pub hint: Option<String>,
    /// Keys with dots that it is about.
    pub keys: Vec<String>,
}

impl Fault {
    /// In words of this page.
    pub fn new(message: impl Into<String>, hint: &str) -> Self {
        Self { message: message.into(), excerpt: None, hint: Some(hint.to_owned()), keys: Vec::new() }
    }

    /// Beside a key.
    pub(crate) fn about(self, key: &str) -> Self {
        Self { keys: vec![key.to_owned()], ..self }
    }

    /// Fault of the scene of a text.
    pub(crate) fn of_scene(text: &str, error: &SceneError) -> Self {
        let excerpt = error.excerpt().map(str::to_owned);
        Self { message: error.to_string(), excerpt, hint: error.hint(), keys: keys_of(text, error) }
    }

    /// Fault of the analysis of the scene of a text.
    pub(crate) fn of_analysis(text: &str, error: &AnalysisError) -> Self {
        let keys = if let AnalysisError::Scene(error) = error.what() { keys_of(text, error) } else { Vec::new() };
        let excerpt = error.excerpt().map(str::to_owned);
        Self { message: error.to_string(), excerpt, hint: error.hint(), keys }
    }

    /// Fault of a scene that asks for more than memory holds.
    pub(crate) fn of_memory(error: &MemoryDemandError) -> Self {
        let excerpt = error.excerpt.clone();
        Self { message: error.to_string(), excerpt, hint: Some(error.hint()), keys: Vec::new() }
    }
}
