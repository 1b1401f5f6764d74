//! What became of a cell.

use std::{
    collections::BTreeMap,
    path::PathBuf,
    sync::{Mutex, PoisonError},
};

use analysis::{
    AnalysisError, Blame, StaticAnalysis,
    accuracy::Bound,
    lumped::{LumpedAnalysis, LumpedResult},
    static_certificate,
};
use scene::{Quantity, Scene, SceneError, Setting};
use serde::Serialize;

/// What became of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Solved, and right.
    Solved,
    /// Solved, and something was said that a user should hear.
    Warned,
    /// No result, with a reason.
    Refused,
    /// A result that does not hold, and says so.
    Failed,
    /// There is no such pair.
    None,
    /// Wrong, though nothing was said: a defect.
    Wrong,
}

/// A cell of a map.
#[derive(Debug, Clone, Serialize)]
pub struct Cell {
    /// What became of it.
    pub outcome: Outcome,
    /// Difference from the finer answer, %.
    pub off_percent: Option<f64>,
    /// Bound of that, %, where there is one.
    pub bound_percent: Option<f64>,
    /// The first thing that was said.
    pub said: Option<String>,
    /// Keys that make the cell of the map's scene.
    pub settings: Vec<String>,
}

impl Cell {
    pub(super) fn new(outcome: Outcome, settings: &[String]) -> Self {
        Self { outcome, off_percent: None, bound_percent: None, said: None, settings: settings.to_vec() }
    }

    pub(super) fn saying(self, said: impl ToString) -> Self {
        Self { said: Some(said.to_string()), ..self }
    }
}

/// A scene of the maps with keys set otherwise.
pub(super) fn scene(file: &str, text: &str, settings: &[String]) -> Result<Scene, SceneError> {
    let settings = settings.iter().map(|s| Setting::parse(s)).collect::<Result<Vec<_>, _>>()?;
    Scene::parse_with(text, &PathBuf::from(format!("scenes/envelope/{file}.toml")), &settings)
}

/// What no bound covers, of any scene.
const ALWAYS: &str = "material data, load";

/// A mean transmission error with its bounds, and what was said.
struct Bounded {
    bound: Bound,
    remarks: Vec<String>,
}

/// References of cells that share one: by file and settings.
static REFERENCES: Mutex<BTreeMap<String, Option<[f64; 2]>>> = Mutex::new(BTreeMap::new());

/// The number that `found` gives, and its bound; from memory where it was asked for before.
pub(super) fn reference(file: &str, settings: &[String], found: impl FnOnce() -> Option<[f64; 2]>) -> Option<[f64; 2]> {
    let key = format!("{file} {}", settings.join(" "));
    let known = REFERENCES.lock().unwrap_or_else(PoisonError::into_inner).get(&key).copied();
    known.unwrap_or_else(|| {
        let new = found();
        REFERENCES.lock().unwrap_or_else(PoisonError::into_inner).insert(key, new);
        new
    })
}

fn bounded(file: &str, text: &str, settings: &[String]) -> Result<Bounded, AnalysisError> {
    let scene = scene(file, text, settings)?;
    let solved = StaticAnalysis::new(&scene).solve()?;
    analysis::certificate::verdict(&static_certificate(&solved.scene, &solved.history.positions), &solved.scene)?;
    let without = || AnalysisError::without_bound(&scene, Quantity::MeanSte);
    let accuracy = solved.facts.accuracy.as_ref().ok_or_else(without)?.clone();
    let bound = accuracy.bounds.iter().find(|b| b.quantity == Quantity::MeanSte).cloned().ok_or_else(without)?;
    let mut remarks: Vec<String> = solved.history.remarks.iter().map(ToString::to_string).collect();
    remarks.extend(
        accuracy
            .not_covered
            .iter()
            .filter(|n| !n.starts_with(ALWAYS))
            .map(|n| format!("bounds are not calibrated for this: {n}")),
    );
    let missed: Vec<String> = accuracy.missed().map(Bound::words).collect();
    remarks.extend(missed.iter().map(|words| format!("less exact than asked: {words}")));
    Ok(Bounded { bound, remarks })
}

/// A pair at rest against the same with `finer` settings beside its own: right where both bounds meet.
pub(super) fn at_rest(file: &str, text: &str, settings: &[String], finer: &[&str]) -> Cell {
    let mut better: Vec<String> = settings.to_vec();
    better.extend(finer.iter().map(|s| (*s).to_owned()));
    against(file, text, settings, &better)
}

/// A pair at rest against the scene with other settings: right where both bounds meet.
pub(super) fn against(file: &str, text: &str, settings: &[String], better: &[String]) -> Cell {
    let cell = Cell::new(Outcome::Solved, settings);
    let found = match bounded(file, text, settings) {
        Ok(found) => found,
        Err(error) => return Cell { outcome: refusal(&error), ..cell }.saying(error),
    };
    let said = found.remarks.first().cloned();
    let finer = || bounded(file, text, better).ok().map(|b| [b.bound.corrected, b.bound.corrected_within]);
    let Some([exact, within]) = reference(file, better, finer) else {
        return Cell { outcome: Outcome::Warned, ..cell }.saying("there is no finer answer to hold it against");
    };
    let off = found.bound.value - exact;
    // The finer answer has a bound of its own.
    let most = if off > 0.0 { found.bound.below } else { found.bound.above } + within;
    let share = |x: f64| Some(100.0 * x / exact);
    let outcome = match (off.abs() <= most, &said) {
        (true, None) => Outcome::Solved,
        (_, Some(_)) => Outcome::Warned,
        (false, None) => Outcome::Wrong,
    };
    Cell { outcome, off_percent: share(off), bound_percent: share(most), said, ..cell }
}

/// Settings without those that a later one of the same key replaces, in the order of their keys.
fn last_of_each(settings: &[String]) -> Vec<String> {
    let by_key: BTreeMap<&str, &String> = settings.iter().map(|s| (s.split('=').next().unwrap_or(s), s)).collect();
    by_key.into_values().cloned().collect()
}

fn refusal(error: &AnalysisError) -> Outcome {
    let fails = matches!(error.what(), AnalysisError::Certificate(_)) || error.blame() == Blame::Inexact;
    if fails { Outcome::Failed } else { Outcome::Refused }
}

fn moved(file: &str, text: &str, settings: &[String]) -> Result<LumpedResult, AnalysisError> {
    let scene = scene(file, text, settings)?;
    let result = LumpedAnalysis::new(&scene).solve()?;
    analysis::certificate::verdict(result.certificate(), &scene)?;
    Ok(result)
}

/// A motion of few coordinates against the same with `finer` settings: right where the peak to peak of its transmission
/// error is within `tolerance` percent of it.
pub(super) fn in_motion(file: &str, text: &str, settings: &[String], finer: &[&str], tolerance: f64) -> Cell {
    let cell = Cell::new(Outcome::Solved, settings);
    let found = match moved(file, text, settings) {
        Ok(found) => found,
        Err(error) => return Cell { outcome: refusal(&error), ..cell }.saying(error),
    };
    let said = found.remarks.first().map(ToString::to_string);
    let mut better: Vec<String> = settings.to_vec();
    better.extend(finer.iter().map(|s| (*s).to_owned()));
    let exact = reference(file, &last_of_each(&better), || {
        moved(file, text, &better).ok().map(|r| [r.headline.peak_to_peak_dte_um, 0.0])
    });
    let Some([exact, _]) = exact else {
        return Cell { outcome: Outcome::Warned, ..cell }.saying("there is no finer answer to hold it against");
    };
    let off = 100.0 * (found.headline.peak_to_peak_dte_um / exact - 1.0);
    let outcome = match (off.abs() <= tolerance, &said) {
        (_, Some(_)) => Outcome::Warned,
        (true, None) => Outcome::Solved,
        (false, None) => Outcome::Wrong,
    };
    Cell { outcome, off_percent: Some(off), bound_percent: Some(tolerance), said, ..cell }
}
