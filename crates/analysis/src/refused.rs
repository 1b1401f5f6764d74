//! Requests to which an analysis has no result.

/// Who must act on an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Blame {
    /// The user: the input is wrong.
    Input,
    /// The input is valid, but there is no result, or one that fails its checks.
    NoResult,
    /// There is a result, but it is less accurate than requested.
    Inexact,
}

/// A request without a result, in words; its places are in the enclosing errors.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{what}")]
pub struct Refusal {
    /// What is wrong, with the values.
    pub what: String,
    /// Hint: what to do next.
    pub hint: Option<String>,
    /// Who must act on it.
    pub blame: Blame,
}

impl Refusal {
    /// The error that the input is wrong.
    pub(crate) fn input(what: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { what: what.into(), hint: Some(hint.into()), blame: Blame::Input }
    }

    /// The error that no result came out of a sound input.
    pub(crate) fn no_result(what: impl Into<String>, hint: Option<String>) -> Self {
        Self { what: what.into(), hint, blame: Blame::NoResult }
    }

    /// The error that a scene does not ask for what is wanted of it.
    pub(crate) fn unasked(wanted: &str) -> Self {
        let hint = "set `run` in [motion] to what is wanted, and `model` in [analysis] to a model that has it";
        Self::input(format!("no {wanted}"), hint)
    }

    /// The error that a scene asks for bounds of an analysis that gives none.
    pub(crate) fn with_accuracy() -> Self {
        let hint = "`analysis::solve` gives bounds; without `[accuracy]` this analysis solves it";
        Self::input("an accuracy is asked for", hint)
    }

    /// The error that an accuracy is asked of a number that has no bound.
    pub(crate) fn no_bound(quantity: scene::Quantity) -> Self {
        let key = quantity.key();
        Self::input(
            format!("there is no bound of `{key}` in this run"),
            format!(
                "leave `{key}` out of [accuracy]; harmonics need more positions a cycle, root stress a model with meshes"
            ),
        )
    }

    /// An empty sweep.
    pub fn no_values() -> Self {
        Self::input("empty sweep", "give `--points 2` or more")
    }
}
