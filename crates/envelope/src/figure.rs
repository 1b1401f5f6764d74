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
    /// A finite number not below this.
    AtLeast(f64),
    /// A finite number not above this.
    AtMost(f64),
    /// Words that hold this.
    Says(&'static str),
}

/// A value beside what is asked of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shown {
    /// What was found.
    pub value: Value,
    /// Limit of the figure.
    pub asked: Asked,
}

impl Shown {
    /// A number that must not be above `most`.
    pub(crate) fn at_most(value: f64, most: f64) -> Self {
        Self { value: Value::Number(value), asked: Asked::AtMost(most) }
    }

    /// A number that must not be below `least`.
    pub(crate) fn at_least(value: f64, least: f64) -> Self {
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

    /// The first of `remarks` that holds `words`, or that there is none.
    pub fn warned(remarks: &[impl ToString], words: &'static str) -> Self {
        let found = remarks.iter().map(ToString::to_string).find(|w| w.contains(words));
        Self::says(found.unwrap_or_else(|| "no such warning".to_owned()), words)
    }

    /// Whether some value would not be what is asked: a bound beyond all numbers and words that every message holds ask
    /// nothing.
    pub fn asks(&self) -> bool {
        match self.asked {
            Asked::AtLeast(bound) | Asked::AtMost(bound) => bound.abs() < 1e12,
            Asked::Says(words) => !words.is_empty(),
        }
    }

    /// Whether it is what is asked.
    pub fn holds(&self) -> bool {
        match (&self.value, self.asked) {
            (Value::Number(x), Asked::AtLeast(least)) => x.is_finite() && *x >= least,
            (Value::Number(x), Asked::AtMost(most)) => x.is_finite() && *x <= most,
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
    /// Figure of what the program does alone.
    pub fn new(what: impl Into<String>, robust: Shown) -> Self {
        Self { what: what.into(), naive: None, robust }
    }

    /// Beside the naive way.
    #[must_use]
    pub fn beside(self, naive: Shown) -> Self {
        Self { naive: Some(naive), ..self }
    }

    /// Whether both ways are asked for something, the naive one fails and the robust one does not.
    pub fn holds(&self) -> bool {
        std::iter::once(&self.robust).chain(&self.naive).all(|shown| shown.asks() && shown.holds())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A figure fails with either way, with what is no number, and where nothing is asked.
    #[test]
    fn a_figure_that_asks_nothing_does_not_hold() {
        let figure = |robust, naive| Figure::new("", robust).beside(naive);
        let (fine, fails) = (Shown::at_most(1.0, 1.0), Shown::at_least(2.0, 2.0));
        assert!(figure(fine.clone(), fails.clone()).holds());
        for wrong in [
            Shown::at_most(1.1, 1.0),
            Shown::at_least(0.9, 1.0),
            Shown::at_most(f64::NAN, 1.0),
            Shown::at_least(f64::NAN, 1.0),
            Shown::at_least(f64::INFINITY, 1.0),
            Shown::at_most(f64::NEG_INFINITY, 1.0),
            Shown::at_most(1.0, f64::INFINITY),
            Shown::at_most(1.0, 1e30),
            Shown::at_least(1.0, f64::NAN),
            Shown::says("anything", ""),
            Shown::says("solved", "refused"),
            Shown::refused(&Ok::<(), String>(()), "cut"),
            Shown::warned(&[""; 0], "cut"),
        ] {
            assert!(!figure(wrong.clone(), fails.clone()).holds(), "robust {wrong:?}");
            assert!(!figure(fine.clone(), wrong.clone()).holds(), "naive {wrong:?}");
        }
    }
}
