//! A figure that shows a failure mode: what the naive way makes of it, and the robust one.

use serde::Serialize;

/// What was found: a number in the figure's unit, or what the program said.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// In the unit of the figure.
    Number(f64),
    /// A message of the program.
    Words(String),
}

/// What a value must be to show what it is meant to show.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Asked {
    /// A number not below this.
    AtLeast(f64),
    /// A number not above this; no number is above it.
    AtMost(f64),
    /// Words that hold this.
    Says(&'static str),
}

/// A value beside what is asked of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shown {
    /// What was found.
    pub value: Value,
    /// What it must be.
    pub asked: Asked,
}

impl Shown {
    /// A number that must not be above `most`.
    pub fn at_most(value: f64, most: f64) -> Self {
        Self { value: Value::Number(value), asked: Asked::AtMost(most) }
    }

    /// A number that must not be below `least`.
    pub fn at_least(value: f64, least: f64) -> Self {
        Self { value: Value::Number(value), asked: Asked::AtLeast(least) }
    }

    /// A message that must hold `words`.
    pub fn says(message: impl ToString, words: &'static str) -> Self {
        Self { value: Value::Words(message.to_string()), asked: Asked::Says(words) }
    }

    /// A refusal or a warning that must hold `words`; `Ok` is none.
    pub fn refused<T, E: ToString>(outcome: &Result<T, E>, words: &'static str) -> Self {
        match outcome {
            Ok(_) => Self::says("solved", words),
            Err(error) => Self::says(error.to_string(), words),
        }
    }

    /// The first of `warnings` that holds `words`, or that there is none.
    pub fn warned(warnings: &[String], words: &'static str) -> Self {
        let found = warnings.iter().find(|w| w.contains(words)).cloned();
        Self::says(found.unwrap_or_else(|| "no such warning".to_owned()), words)
    }

    /// Whether it is what is asked.
    pub fn holds(&self) -> bool {
        match (&self.value, self.asked) {
            (Value::Number(x), Asked::AtLeast(least)) => *x >= least,
            (Value::Number(x), Asked::AtMost(most)) => *x <= most,
            (Value::Words(said), Asked::Says(words)) => said.contains(words),
            _ => false,
        }
    }
}

/// One figure of a failure mode.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figure {
    /// What is measured, with its unit.
    pub what: String,
    /// The naive way, which has to fail; `None` where the program has no such way.
    pub naive: Option<Shown>,
    /// What the program does.
    pub robust: Shown,
}

impl Figure {
    /// Of what the program does alone.
    pub fn new(what: impl Into<String>, robust: Shown) -> Self {
        Self { what: what.into(), naive: None, robust }
    }

    /// Beside the naive way.
    #[must_use]
    pub fn beside(self, naive: Shown) -> Self {
        Self { naive: Some(naive), ..self }
    }

    /// Whether the naive way fails and the robust one does not.
    pub fn holds(&self) -> bool {
        self.robust.holds() && self.naive.as_ref().is_none_or(Shown::holds)
    }
}
