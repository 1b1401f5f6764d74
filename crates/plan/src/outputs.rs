//! Whether the numbers that a plan wants can be there: told before any case is solved.

use std::path::Path;

use analysis::{gearbox::GearboxResult, headline_keys};
use described::Key;
use scene::{
    Machine, nearest,
    plan::{Plan, PlanOutput},
    study::column_advice,
};

use crate::columns_of;

/// A number that no case of a plan will have.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{plan}: {what}")]
pub struct OutputError {
    /// Plan file, or the scene of a plan of words.
    pub plan: String,
    /// What is not there.
    pub what: String,
    /// What to do next.
    pub hint: String,
}

/// Judges the wanted numbers by the scene of the first case. What only a run can tell is left to it: columns of
/// single pairs, numbers below a table of the headline.
///
/// # Errors
/// The first that is not there.
pub fn check_outputs(plan: &Plan) -> Result<(), OutputError> {
    // A case whose values are out of range takes nothing from the others.
    plan.machine(0).map_or(Ok(()), |machine| check_numbers(&machine, &plan.outputs, &plan.file))
}

/// Judges the wanted numbers of a pair or a gearbox; `file`: what says that they are wanted.
///
/// # Errors
/// The first that is not there.
pub fn check_numbers(machine: &Machine, outputs: &[PlanOutput], file: &Path) -> Result<(), OutputError> {
    let keys = keys_of(machine);
    let found = outputs.iter().try_for_each(|output| match output {
        PlanOutput::Headline(key) => of_headline(&keys, key),
        PlanOutput::Column { column, .. } => of_rows(machine, column),
    });
    found.map_err(|(what, hint)| OutputError { plan: file.display().to_string(), what, hint })
}

/// What is not there, and what to do.
type Missing = (String, String);

const SEE: &str = "docs/outputs.md lists the keys of every headline and the columns of every kind of analysis";

/// Keys of the headline, each with what stands behind it.
fn keys_of(machine: &Machine) -> Vec<(&'static str, Holds)> {
    let of_pair = |keys: &[Key]| keys.iter().map(|key| (key.name, Holds::of(key.holds))).collect();
    match machine {
        Machine::Pair(scene) => of_pair(headline_keys(scene)),
        Machine::Gearbox(file) => {
            let holds = |count: Option<usize>| count.map_or(Holds::Number, Holds::List);
            GearboxResult::headline_keys(file).into_iter().map(|(key, count)| (key, holds(count))).collect()
        }
    }
}

/// The file of the rows that a plan reads numbers off.
pub fn rows_file(machine: &Machine) -> &'static str {
    match machine {
        Machine::Pair(_) => "history.csv",
        Machine::Gearbox(file) if file.motion.is_some() => "motion.csv",
        Machine::Gearbox(_) => "positions.csv",
    }
}

fn of_rows(machine: &Machine, column: &str) -> Result<(), Missing> {
    let Some(all) = columns_of(machine).filter(|all| !all.iter().any(|name| name == column)) else { return Ok(()) };
    // Columns of single pairs go with the window, which is known when the analysis begins.
    if column.contains("_pair_") {
        return Ok(());
    }
    let names: Vec<&str> = all.iter().map(String::as_str).collect();
    let alike = alike(column, &names);
    let hint = match column_advice(column, &names) {
        Some(near) if alike.is_empty() || near.starts_with("did") => near,
        _ if alike.is_empty() => SEE.into(),
        _ => format!("it has `{}`", alike.join("`, `")),
    };
    Err((format!("{} has no column `{column}`", rows_file(machine)), hint))
}

fn of_headline(keys: &[(&'static str, Holds)], wanted: &str) -> Result<(), Missing> {
    let (name, below) = wanted.split_once('.').map_or((wanted, None), |(name, below)| (name, Some(below)));
    let Some((_, holds)) = keys.iter().find(|(key, _)| *key == name) else {
        let names: Vec<&str> = keys.iter().map(|(key, _)| *key).collect();
        let hint = match (nearest(name, &names), alike(name, &names)) {
            (Some(near), _) => format!("did you mean `{near}`?"),
            (None, some) if some.is_empty() => SEE.into(),
            (None, some) => format!("it has `{}`", some.join("`, `")),
        };
        return Err((format!("the headline has no `{wanted}`"), hint));
    };
    let of_list = |count: usize| match count {
        0 => "it is an empty list here".to_owned(),
        1 => format!("it is a list of one: write `{name}.0`"),
        _ => format!("it is a list: write `{name}.0` .. `{name}.{}`", count - 1),
    };
    let advice = match (*holds, below) {
        (Holds::Number, None) | (Holds::Table, Some(_)) => return Ok(()),
        (Holds::List(count), Some(at)) if at.parse::<usize>().is_ok_and(|at| at < count) => return Ok(()),
        (Holds::Number, Some(_)) => format!("`{name}` is a number by itself"),
        (Holds::List(count), _) => of_list(count),
        (Holds::Table, None) => format!("`{name}` is a table: write `{name}.KEY` with a key of it"),
        (Holds::Words, _) => "numbers alone can be wanted".into(),
    };
    Err((format!("`{wanted}` of the headline is not a number"), advice))
}

/// Names that have a word among their parts, the first ones.
fn alike<'a>(word: &str, names: &[&'a str]) -> Vec<&'a str> {
    let framed = format!("_{word}_");
    names.iter().filter(|name| format!("_{name}_").contains(&framed)).take(6).copied().collect()
}

/// What stands behind a key of a headline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Holds {
    Number,
    /// A list of so many numbers.
    List(usize),
    Table,
    Words,
}

/// Mesh harmonics that headlines list.
const HARMONICS: usize = 8;

impl Holds {
    /// From the type as the code writes it.
    fn of(code: &str) -> Self {
        let code: String = code.chars().filter(|c| !c.is_whitespace()).collect();
        let inner = code.strip_prefix("Option<").and_then(|rest| rest.strip_suffix('>')).unwrap_or(&code);
        let fixed = inner.strip_prefix("[f64;").and_then(|rest| rest.strip_suffix(']')?.parse().ok());
        match (inner, fixed) {
            (_, Some(count)) => Self::List(count),
            ("f64" | "usize" | "u64" | "u32", _) => Self::Number,
            ("Vec<f64>", _) => Self::List(HARMONICS),
            ("Run" | "Vec<String>", _) => Self::Words,
            _ => Self::Table,
        }
    }
}

#[cfg(test)]
mod tests {
    use analysis::{lumped::LumpedHeadline, motion::MotionHeadline, results::StaticHeadline};

    use super::*;

    fn says(keys: &[Key], wanted: &str) -> String {
        let keys: Vec<_> = keys.iter().map(|key| (key.name, Holds::of(key.holds))).collect();
        of_headline(&keys, wanted).map_or_else(|(what, hint)| format!("{what}; {hint}"), |()| "there".into())
    }

    #[test]
    fn a_wanted_number_is_judged_by_what_headlines_hold() {
        for (wanted, said) in [
            ("mean_ste_um", "there"),
            ("mean_ste_u", "the headline has no `mean_ste_u`; did you mean `mean_ste_um`?"),
            ("ste_harmonics_um.7", "there"),
            ("mean_wheel_force_n.2", "there"),
            ("max_pressure_at.z_mm", "there"),
            (
                "root_stress",
                "`root_stress` of the headline is not a number; `root_stress` is a table: write `root_stress.KEY` with a key of it",
            ),
            ("mean_ste_um.0", "`mean_ste_um.0` of the headline is not a number; `mean_ste_um` is a number by itself"),
        ] {
            assert_eq!(says(StaticHeadline::KEYS, wanted), said);
        }
        for beyond in ["ste_harmonics_um", "ste_harmonics_um.8", "ste_harmonics_um.x", "ste_harmonics_um.-1"] {
            assert!(says(StaticHeadline::KEYS, beyond).contains("write `ste_harmonics_um.0` .. `ste_harmonics_um.7`"));
        }
        assert!(says(StaticHeadline::KEYS, "mean_wheel_force_n.3").contains("`mean_wheel_force_n.2`"));
        for keys in [MotionHeadline::KEYS, LumpedHeadline::KEYS] {
            assert_eq!(says(keys, "dynamic_factor"), "there");
            assert_eq!(says(keys, "run"), "`run` of the headline is not a number; numbers alone can be wanted");
            assert!(says(keys, "efficiency").starts_with("the headline has no `efficiency`"));
        }
    }
}
