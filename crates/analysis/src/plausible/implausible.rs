//! What is said of a scene that cannot be meant.

/// A scene that cannot be meant.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{at}: {said}")]
pub struct Implausible {
    /// The scene, with the line of the key that is likely wrong.
    pub at: String,
    /// That line, with a mark below it.
    pub excerpt: Option<String>,
    /// What it would mean.
    pub said: String,
    /// What to write.
    pub hint: String,
}
