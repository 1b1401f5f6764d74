//! What must hold of a result before its numbers count.
//!
//! Every analysis measures how well it has solved its own equations. Each measure has a bound. One beyond it, or one that
//! is no number, makes the result a failed one: its files are written all the same, marked as failed, and the command ends
//! with status 1.

use std::borrow::Cow;
use std::collections::BTreeMap;

use described::Key;
use serde::{Serialize, Serializer, ser::SerializeMap};

use crate::digits;

described::described! {
    /// One measure with its bound.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct Check {
        /// name of the check
        #[serde(skip)]
        pub name: Cow<'static, str>,
        /// measured value, never below zero; the larger, the worse
        pub value: f64,
        /// largest value that passes
        pub bound: f64,
        /// action where the check fails
        #[serde(skip)]
        pub hint: &'static str,
    }
}

impl Check {
    /// Check of a measure against its bound.
    pub fn new(name: impl Into<Cow<'static, str>>, value: f64, bound: f64, hint: &'static str) -> Self {
        Self { name: name.into(), value, bound, hint }
    }

    /// Check of the share of cases without a result, of many cases, which is to leave one.
    pub fn cases_without_result(failed: usize, cases: usize, hint: &'static str) -> Self {
        let cases = cases.max(1) as f64;
        Self::new("cases_without_result", failed as f64 / cases, 1.0 - 1.0 / cases, hint)
    }

    /// Whether the value is within its bound; what is no number is not.
    pub fn holds(&self) -> bool {
        self.value <= self.bound
    }

    /// Value and bound in words.
    pub fn words(&self) -> String {
        format!("{} {}, limit {}", self.name, digits(self.value), digits(self.bound))
    }
}

/// A result that does not hold: the first check that it misses.
#[derive(Debug, Clone, PartialEq)]
pub struct FailedCheck {
    /// The check with value and bound, and how many are missed beside it.
    pub missed: String,
    /// What to do about it.
    pub hint: &'static str,
}

/// All checks of a result.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Checks(Vec<Check>);

impl Checks {
    /// Keys of an object that checks stand in; where nothing is checked it has none of them.
    pub const KEYS: &'static [Key] = &[
        Key::new("certificate", "String", "`held`, or `failed` where a check is missed"),
        Key::new("certificate_checks", "Checks", "checks by name, each with its `value` and `bound`"),
        Key::new("certificate_missed", "Vec<String>", "missed checks in words"),
    ];

    /// Certificate of these checks.
    pub fn new(checks: impl IntoIterator<Item = Check>) -> Self {
        Self(checks.into_iter().collect())
    }

    /// These and others.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.0.extend(other.0);
        self
    }

    /// Certificate of several results: the worst of each check, in the order in which they first come.
    pub fn worst<'a>(all: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut worst: Vec<Check> = Vec::new();
        for check in all.into_iter().flat_map(Self::iter) {
            match worst.iter_mut().find(|known| known.name == check.name) {
                // What is no number is worse than any.
                Some(known) if known.value.is_nan() || check.value <= known.value => {}
                Some(known) => *known = check.clone(),
                None => worst.push(check.clone()),
            }
        }
        Self(worst)
    }

    /// All, in their order.
    pub fn iter(&self) -> std::slice::Iter<'_, Check> {
        self.0.iter()
    }

    /// Checks that do not hold, in their order.
    pub fn missed(&self) -> impl Iterator<Item = &Check> {
        self.0.iter().filter(|check| !check.holds())
    }

    /// Whether there is something that was checked.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The verdict in a word: `held`, `failed`, or `unchecked` where nothing was.
    pub fn word(&self) -> &'static str {
        match (self.0.is_empty(), self.missed().next()) {
            (true, _) => "unchecked",
            (_, None) => "held",
            _ => "failed",
        }
    }

    /// The first check that is missed with its value and its bound, and how many there are beside it.
    pub fn failed(&self) -> Option<FailedCheck> {
        let first = self.missed().next()?;
        let others = self.missed().count() - 1;
        let more = if others > 0 { format!(" (and {others} more)") } else { String::new() };
        Some(FailedCheck { missed: format!("{}{more}", first.words()), hint: first.hint })
    }
}

/// `certificate` with the verdict in a word, `certificate_checks` with all checks by name, `certificate_missed` with
/// those that do not hold in words; nothing where nothing was checked.
impl Serialize for Checks {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        if !self.0.is_empty() {
            map.serialize_entry("certificate", self.word())?;
            let by_name: BTreeMap<&str, &Check> = self.0.iter().map(|check| (&*check.name, check)).collect();
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
        Check::new("torque_residual", value, 1e-8, "")
    }

    /// One case with a result is enough.
    #[test]
    fn many_cases_hold_with_one_result() {
        let holds = |failed, cases| Check::cases_without_result(failed, cases, "").holds();
        assert!(holds(0, 1) && holds(2, 3) && holds(9, 10) && !holds(1, 1) && !holds(10, 10));
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
        let all = Checks::new([check(0.0), check(f64::NAN)]);
        let json = serde_json::to_value(&all).unwrap();
        assert_eq!(json["certificate"], "failed");
        assert_eq!(json["certificate_checks"]["torque_residual"]["value"], serde_json::Value::Null);
        assert_eq!(json["certificate_missed"].as_array().map(Vec::len), Some(1));
        assert_eq!(serde_json::to_value(Checks::default()).unwrap(), serde_json::json!({}));
        assert_eq!(Checks::default().failed(), None);
    }

    /// Each check has its worst value, whichever result comes first; what is no number is the worst of all.
    #[test]
    fn the_worst_of_several_results_is_kept() {
        let [sound, poor, none] = [1e-9, 5e-9, f64::NAN].map(|value| Checks::new([check(value)]));
        let value = |all: &[&Checks]| Checks::worst(all.iter().copied()).iter().next().map(|check| check.value);
        assert_eq!(value(&[&sound, &poor]), Some(5e-9));
        assert_eq!(value(&[&poor, &sound]), Some(5e-9));
        assert!(value(&[&none, &poor]).is_some_and(f64::is_nan));
        assert!(value(&[&poor, &none]).is_some_and(f64::is_nan));
        assert_eq!(value(&[]), None);
    }
}
