//! Evaluates the rows of a study's cases.

use scene::{
    Scene,
    study::{Study, StudyQuantity, Take, column_advice},
};
use study::{Columns, correlation as study_correlation};

use crate::{
    facts::GeometryFacts,
    remark::{self, Remark},
};

/// Stored results of a case.
#[derive(Debug, Clone)]
pub struct CaseRecord {
    /// Rows of the case as named columns.
    pub rows: Columns,
    /// Geometry of the pair.
    pub geometry: GeometryFacts,
}

/// Reason why a case has no result.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct CaseFailure {
    /// One line: the error, its place, and what was expected.
    pub message: String,
    /// The line of a file that is meant, with a mark below it.
    pub excerpt: Option<String>,
    /// Hint: what to do next.
    pub hint: Option<String>,
    /// Whether the input is valid but no result was found.
    pub is_without_result: bool,
}

/// The stored results of a case, or the reason why there are none.
pub type CaseOutcome<'a> = Result<&'a CaseRecord, &'a CaseFailure>;

/// All data for tables and figures of a study, except the rows themselves.
#[derive(Debug, Clone, PartialEq)]
pub struct Findings {
    /// Values of each case in the order of the file, or the reason why it has none.
    pub cases: Vec<Result<CaseFindings, CaseFailure>>,
    /// Pairs of columns whose correlation is given.
    pub followers: Vec<Follower>,
    /// Remarks about values that could not be computed from existing rows.
    pub remarks: Vec<Remark>,
}

/// Values of one case.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseFindings {
    /// Contact ratios: transverse, overlap, total.
    pub contact_ratios: [f64; 3],
    /// The quantities of the study, in its order.
    pub quantities: Vec<f64>,
}

/// Correlation of two columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Follower {
    /// Name of the first column.
    pub column: String,
    /// Name of the second column.
    pub beside: String,
    /// Pearson's coefficient over all rows, case by case; `None` if a column does not vary, and for a case without a
    /// result.
    pub correlation: Vec<Option<f64>>,
}

impl Follower {
    /// Name of its column in `study.csv`.
    pub fn name(&self) -> String {
        format!("correlation_{}_{}", self.column, self.beside)
    }
}

impl Findings {
    /// Reason why a case has no result; `None` if it has one.
    pub fn reason(&self, case: usize) -> Option<&str> {
        self.cases[case].as_ref().err().map(|e| e.message.as_str())
    }

    /// Labels of the cases without a result.
    pub fn without_result<'a>(&'a self, study: &'a Study) -> Vec<&'a str> {
        let failed = study.cases.iter().zip(&self.cases).filter(|(_, found)| found.is_err());
        failed.map(|(case, _)| case.label.as_str()).collect()
    }
}

/// Computes all values of a study from the rows of its cases. A case without a result, or without the columns, is
/// listed with the reason.
///
/// # Errors
/// The first error, if no case has a result.
pub fn findings(study: &Study, runs: &[CaseOutcome<'_>]) -> Result<Findings, CaseFailure> {
    let cases: Vec<_> = runs
        .iter()
        .enumerate()
        .map(|(i, run)| run.map_err(CaseFailure::clone).and_then(|run| of_case(study, i, run)))
        .collect();
    if let (true, Some(Err(first))) = (cases.iter().all(Result::is_err), cases.first()) {
        let (label, message) = (&study.cases[0].label, &first.message);
        let message = match cases.len() {
            1 => message.clone(),
            n => format!("{}: none of {n} cases has a result; {label}: {message}", study.file.display()),
        };
        return Err(CaseFailure { message, ..first.clone() });
    }
    let mut all = Findings { cases, followers: Vec::new(), remarks: Vec::new() };
    for follow in &study.follow {
        for beside in &follow.beside {
            if all.followers.iter().any(|f| f.column == follow.column && f.beside == *beside) {
                continue;
            }
            let mut correlation = Vec::with_capacity(runs.len());
            for (i, run) in runs.iter().enumerate() {
                let run = run.ok().filter(|_| all.cases[i].is_ok());
                let found =
                    run.map(|run| study_correlation(run.rows.series(&follow.column)?, run.rows.series(beside)?));
                if let Some(Err(e)) = &found {
                    let said = remark::no_correlation(follow.column.as_str(), beside.as_str(), e.to_string());
                    all.remarks.push(said.about(&study.cases[i].label));
                }
                correlation.push(found.and_then(Result::ok).flatten());
            }
            all.followers.push(Follower { column: follow.column.clone(), beside: beside.clone(), correlation });
        }
    }
    Ok(all)
}

/// Numbers of one case, which must have every column that is asked for.
fn of_case(study: &Study, i: usize, run: &CaseRecord) -> Result<CaseFindings, CaseFailure> {
    let quantities = study.quantities.iter().map(|q| Ok(taken(q, column(study, i, run, &q.column)?)));
    let quantities = quantities.collect::<Result<_, CaseFailure>>()?;
    let followed = study.follow.iter().flat_map(|f| std::iter::once(&f.column).chain(&f.beside));
    for name in followed.chain(study.over_time.iter().map(|o| &o.column)) {
        column(study, i, run, name)?;
    }
    let g = &run.geometry;
    Ok(CaseFindings { contact_ratios: [g.eps_alpha, g.eps_beta, g.eps_gamma], quantities })
}

/// A column of a case; some models tell only by their rows which they have.
fn column<'a>(study: &Study, i: usize, run: &'a CaseRecord, name: &str) -> Result<&'a [f64], CaseFailure> {
    if let Some(found) = run.rows.find(name).filter(|all| !all.is_empty()) {
        return Ok(found);
    }
    let advice = column_advice(name, &run.rows.names_from(""));
    let label = &study.cases[i].label;
    Err(CaseFailure {
        message: format!("{}: the case \"{label}\" has no column {name}", study.file.display()),
        excerpt: None,
        hint: advice,
        is_without_result: false,
    })
}

fn taken(quantity: &StudyQuantity, column: &[f64]) -> f64 {
    let least = column.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = column.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    match quantity.take {
        Take::Mean => column.iter().sum::<f64>() / column.len() as f64,
        Take::PeakToPeak => largest - least,
        Take::Least => least,
        Take::Largest => largest,
    }
}

/// Rows in a mesh cycle of a scene.
fn rows_per_cycle(scene: &Scene) -> usize {
    scene.motion.as_ref().map_or(scene.analysis.positions_per_cycle, |m| m.steps_per_mesh_cycle) as usize
}

/// The last mesh cycles of a case's rows; all of them if no number is given.
pub fn last_cycles(scene: &Scene, rows: &Columns, cycles: Option<u32>) -> Columns {
    let all = rows.len();
    rows.last(cycles.map_or(all, |n| (n as usize).saturating_mul(rows_per_cycle(scene)).min(all)))
}
