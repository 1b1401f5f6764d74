//! How many cases a law tries.

/// Names the environment variable with which every law tries all of its cases: `.ci/run nightly` sets it.
pub const ALL_CASES: &str = "ALE_GEAR_ALL_CASES";

/// How many cases a law tries: `few`, enough to see it fail, or `all` of them where [`ALL_CASES`] is set.
#[must_use]
pub fn cases(few: usize, all: usize) -> usize {
    if std::env::var_os(ALL_CASES).is_some() { all } else { few }
}
