//! The numbers that a plan wants of a case, read off its rows and its headline.

use analysis::{Solved, gearbox::GearboxResult};
use scene::{
    gearbox::Gearbox,
    plan::{PlanOutput, PlanTake},
    study::Take,
};
use serde_json::Value;
use study::{Columns, extent, mean, mesh_harmonics, peak_to_peak};

use columns::solved_rows;

/// Outputs of a solved pair over whole mesh cycles.
///
/// # Errors
/// Why there is none: a name that stands for no number, a headline without value.
pub fn case_values(outputs: &[PlanOutput], solved: &Solved) -> Result<Vec<f64>, String> {
    let headline = || solved.headline().map_err(|e| e.to_string());
    of_case(
        outputs,
        headline,
        || solved_rows(solved).map_err(|e| e.to_string()),
        Some(solved.scene().analysis.cycles as usize),
    )
}

/// Outputs of a solved gearbox: of its motion where it has one, else over whole cycles of its first mesh.
///
/// # Errors
/// As [`case_values`].
pub fn gearbox_values(outputs: &[PlanOutput], file: &Gearbox, result: &GearboxResult) -> Result<Vec<f64>, String> {
    let cycles = file.motion.is_none().then_some(file.cycles as usize);
    let rows = || columns::gearbox::history(file, result).map_err(|e| e.to_string());
    of_case(outputs, || Ok(result.headline()), rows, cycles)
}

/// `cycles`: whole mesh cycles of the rows, where they are.
fn of_case(
    outputs: &[PlanOutput],
    headline: impl FnOnce() -> Result<Value, String>,
    rows: impl FnOnce() -> Result<Columns, String>,
    cycles: Option<usize>,
) -> Result<Vec<f64>, String> {
    let needs = |headline: bool| outputs.iter().any(|o| matches!(o, PlanOutput::Headline(_)) == headline);
    let rows = if needs(false) { rows()? } else { Columns::default() };
    let headline = if needs(true) { headline()? } else { Value::Null };
    let one = |output: &PlanOutput| match output {
        PlanOutput::Headline(key) => of_headline(&headline, key),
        PlanOutput::Column { column, take } => {
            let series = rows.series(column).map_err(|e| e.to_string())?;
            of_column(series, *take, cycles).map_err(|what| format!("{column}: {what}"))
        }
    };
    outputs.iter().map(one).collect()
}

fn of_headline(headline: &Value, key: &str) -> Result<f64, String> {
    let mut value = headline;
    for part in key.split('.') {
        let next = match value {
            Value::Array(list) => part.parse::<usize>().ok().and_then(|i| list.get(i)),
            other => other.get(part),
        };
        value = next.ok_or_else(|| missing(headline, key))?;
    }
    value.as_f64().ok_or_else(|| format!("`{key}` of the headline is not a number"))
}

/// A key that the headline has not, with what may have been meant.
fn missing(headline: &Value, key: &str) -> String {
    let known: Vec<&str> = headline.as_object().into_iter().flatten().map(|(name, _)| name.as_str()).collect();
    let near = scene::nearest(key, &known).map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
    format!("the headline has no `{key}`{near}")
}

fn of_column(series: &[f64], take: PlanTake, cycles: Option<usize>) -> Result<f64, String> {
    let value = match take {
        PlanTake::Of(Take::Mean) => mean(series),
        PlanTake::Of(Take::PeakToPeak) => peak_to_peak(series),
        PlanTake::Of(Take::Least) => extent(series)[0],
        PlanTake::Of(Take::Largest) => extent(series)[1],
        PlanTake::Harmonic(order) => {
            let cycles = cycles.ok_or("the rows are no whole cycles of one mesh, so they have no mesh harmonics")?;
            let all = mesh_harmonics(series, cycles, order as usize).map_err(|e| e.to_string())?;
            all.last().map_or(f64::NAN, |harmonic| harmonic.amplitude)
        }
    };
    if value.is_finite() { Ok(value) } else { Err("no number comes of it".into()) }
}
