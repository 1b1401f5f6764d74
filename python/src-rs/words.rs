//! What is varied and what is wanted, as plans and optimisations take it.

use ::scene::{
    Document, Setting,
    optimum::{NumberOptimisation, OptimisationWords},
    plan::{Plan, PlanWords},
};
use pyo3::{prelude::*, types::PyString};

use crate::{
    arguments::{Given, dict, list, numbers, text, whole},
    error::Complaint,
};

type Answer<T> = std::result::Result<T, Complaint>;

/// `KEY=...` of each entry of a dict.
pub fn words_of(
    name: &str,
    any: &Bound<'_, PyAny>,
    word: impl Fn(&str, &Bound<'_, PyAny>) -> Answer<String>,
) -> Answer<Vec<String>> {
    let all = dict(name, any, "as {\"operation.torque_nm\": [50, 100]}")?;
    all.iter().map(|(key, value)| word(&text(name, &key)?, &value)).collect()
}

/// Values of a varied key: a list of numbers, or the command's words (`"0:40:9"`, `"~0:40"`, `"~normal:0:5"`).
fn varied(key: &str, any: &Bound<'_, PyAny>) -> Answer<String> {
    if any.is_instance_of::<PyString>() {
        let words = text(key, any)?;
        return Ok(if words.starts_with('~') { format!("{key}{words}") } else { format!("{key}={words}") });
    }
    let (values, _) = numbers(key, any)?;
    let values: Vec<String> = values.iter().map(f64::to_string).collect();
    Ok(format!("{key}={}", values.join(",")))
}

/// Bounds of a parameter: `(from, to)`, or the command's words (`"0:40"`); the search begins at the scene's own value.
pub fn bounds(key: &str, any: &Bound<'_, PyAny>) -> Answer<String> {
    if any.is_instance_of::<PyString>() {
        return varied(key, any);
    }
    let (values, _) = numbers(key, any)?;
    let values: Vec<String> = values.iter().map(f64::to_string).collect();
    Ok(format!("{key}={}", values.join(":")))
}

/// A text, or several.
fn texts(name: &str, any: &Bound<'_, PyAny>) -> Answer<Vec<String>> {
    match text(name, any) {
        Ok(one) => Ok(vec![one]),
        Err(_) => list(name, any)?.iter().map(|any| text(name, any)).collect(),
    }
}

/// The plan of a document: what is varied, what is wanted, what is drawn; and the first two in words.
pub fn plan_of(
    (document, settings): (Document, Vec<Setting>),
    (vary, outputs): (&Bound<'_, PyAny>, &Bound<'_, PyAny>),
    (samples, design, seed): (Given<'_, '_>, Given<'_, '_>, Given<'_, '_>),
) -> Answer<(Plan, String)> {
    let design = design.map(|any| text("design", any)).transpose()?;
    let (vary, outputs) = (words_of("vary", vary, varied)?, texts("outputs", outputs)?);
    let words = PlanWords {
        vary: &vary,
        outputs: &outputs,
        columns: &[],
        design: design.as_deref(),
        samples: samples.map(|any| whole("samples", any, 1)).transpose()?,
        seed: seed.map(|any| whole("seed", any, 0)).transpose()?,
    };
    Ok((Plan::of_scene(document, &settings, &words)?, format!("{vary:?}, {outputs:?}")))
}

/// The optimisation of numbers of a document: what may change, what shall be small, within which limits; and all in words.
pub fn numbers_of(
    (document, settings): (Document, Vec<Setting>),
    (parameters, goals): (&Bound<'_, PyAny>, &Bound<'_, PyAny>),
    (limits, evaluations): (Given<'_, '_>, Given<'_, '_>),
) -> Answer<(NumberOptimisation, String)> {
    let (parameters, goals) = (words_of("parameters", parameters, bounds)?, texts("goals", goals)?);
    let limits = limits.map_or_else(|| Ok(Vec::new()), |any| words_of("limits", any, varied))?;
    let words = OptimisationWords {
        parameters: &parameters,
        goals: &goals,
        limits: &limits,
        evaluations: evaluations.map_or(Ok(20), |any| whole("evaluations", any, 1))?,
        ..OptimisationWords::default()
    };
    let plan = NumberOptimisation::of_scene(document, &settings, &words)?;
    Ok((plan, format!("{parameters:?}, {goals:?}, limits={limits:?}")))
}
