//! What must hold of a result before its numbers count.
//!
//! Every analysis measures how well it has solved its own equations. Each of these measures has a bound; one beyond it,
//! or one that is no number, makes the result a failed one: its files are
//! written all the same, so that they can be looked at, marked as failed, and the command ends with status 1.

use std::collections::BTreeMap;

use serde::{Serialize, Serializer, ser::SerializeMap};

use scene::Scene;

use crate::AnalysisError;

/// One measure with its bound.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Check {
    /// What is measured, as `docs/outputs.md` names it; the key of the check.
    #[serde(skip)]
    pub name: &'static str,
    /// What was found, never below zero; the larger, the worse.
    pub value: f64,
    /// The largest value that holds.
    pub bound: f64,
    /// What to do where it does not.
    #[serde(skip)]
    pub way_out: &'static str,
}

impl Check {
    /// Whether the value is within its bound; what is no number is not.
    pub fn holds(&self) -> bool {
        self.value <= self.bound
    }

    /// Value and bound in words.
    pub fn words(&self) -> String {
        format!("{} is {:.1e}, the bound is {:.0e}", self.name, self.value, self.bound)
    }
}

/// All that is certified of a result.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Certificate(Vec<Check>);

impl Certificate {
    /// Of these checks.
    pub fn new(checks: impl IntoIterator<Item = Check>) -> Self {
        Self(checks.into_iter().collect())
    }

    /// This one and another.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.0.extend(other.0);
        self
    }

    /// Checks that do not hold, in their order.
    pub fn missed(&self) -> impl Iterator<Item = &Check> {
        self.0.iter().filter(|check| !check.holds())
    }

    /// Whether every check holds.
    ///
    /// # Errors
    /// [`AnalysisError::Certificate`]: the first check that is missed with its value and its bound, and how many there
    /// are beside it.
    pub fn verdict(&self, scene: &Scene) -> Result<(), AnalysisError> {
        let Some(first) = self.missed().next() else { return Ok(()) };
        let others = self.missed().count() - 1;
        let more = if others > 0 { format!(" (and {others} more)") } else { String::new() };
        Err(AnalysisError::Certificate {
            file: scene.file.display().to_string(),
            missed: format!("{}{more}", first.words()),
            way_out: first.way_out,
        })
    }
}

/// `certificate` with the verdict in a word, `certificate_checks` with all checks by name, `certificate_missed` with
/// those that do not hold in words; nothing where nothing was checked.
impl Serialize for Certificate {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        if !self.0.is_empty() {
            map.serialize_entry("certificate", if self.missed().next().is_none() { "held" } else { "failed" })?;
            let by_name: BTreeMap<&str, &Check> = self.0.iter().map(|check| (check.name, check)).collect();
            map.serialize_entry("certificate_checks", &by_name)?;
            let missed: Vec<String> = self.missed().map(Check::words).collect();
            map.serialize_entry("certificate_missed", &missed)?;
        }
        map.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(value: f64) -> Check {
        Check { name: "torque_residual", value, bound: 1e-8, way_out: "" }
    }

    /// Up to its bound a check holds; beyond, and without a number, it does not.
    #[test]
    fn what_is_no_number_does_not_hold() {
        for (value, holds) in [(0.0, true), (1e-8, true), (1.1e-8, false), (7.4e296, false)] {
            assert_eq!(check(value).holds(), holds, "{value}");
        }
        for value in [f64::NAN, f64::INFINITY] {
            assert!(!check(value).holds(), "{value}");
        }
        let all = Certificate::new([check(0.0), check(f64::NAN)]);
        let json = serde_json::to_value(&all).unwrap();
        assert_eq!(json["certificate"], "failed");
        assert_eq!(json["certificate_checks"]["torque_residual"]["value"], serde_json::Value::Null);
        assert_eq!(json["certificate_missed"].as_array().map(Vec::len), Some(1));
        assert_eq!(serde_json::to_value(Certificate::default()).unwrap(), serde_json::json!({}));
    }
}
