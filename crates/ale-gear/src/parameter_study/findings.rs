//! What is read off the rows of the cases.

use study::correlation;

use super::{CaseRun, Quantity, Study, Take, columns};
use crate::{error::CommandError, motion::Columns, scene::Scene};

/// Everything that tables and figures of a study are made of, but for the rows themselves.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Findings {
    /// Case by case, in the order of the file.
    pub cases: Vec<CaseFindings>,
    /// Pairs of columns of which one may follow the other.
    pub followers: Vec<Follower>,
}

/// Numbers of one case.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CaseFindings {
    /// Contact ratios: transverse, overlap, total.
    pub contact_ratios: [f64; 3],
    /// The quantities of the study, in its order.
    pub quantities: Vec<f64>,
}

/// How nearly one column follows another.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Follower {
    /// The one.
    pub column: String,
    /// The other.
    pub beside: String,
    /// Pearson's coefficient over all rows, case by case; `None` where a column does not vary.
    pub correlation: Vec<Option<f64>>,
}

impl Follower {
    /// Name of its column in `study.csv`.
    pub fn name(&self) -> String {
        format!("correlation_{}_{}", self.column, self.beside)
    }
}

/// Reads all numbers of a study off the rows of its cases.
///
/// # Errors
/// Exit status 2 when a case has no such column, 1 when what shall be compared is no number.
pub(crate) fn findings(study: &Study, runs: &[CaseRun]) -> Result<Findings, CommandError> {
    let cases = runs.iter().enumerate().map(|(i, run)| {
        let quantities = study.quantities.iter().map(|q| Ok(taken(q, column(study, i, run, &q.column)?)));
        let g = &run.geometry;
        Ok(CaseFindings {
            contact_ratios: [g.eps_alpha, g.eps_beta, g.eps_gamma],
            quantities: quantities.collect::<Result<_, CommandError>>()?,
        })
    });
    let cases = cases.collect::<Result<_, CommandError>>()?;
    let mut followers: Vec<Follower> = Vec::new();
    for follow in &study.follow {
        for beside in &follow.beside {
            if followers.iter().any(|f| f.column == follow.column && f.beside == *beside) {
                continue;
            }
            let of = |(i, run): (usize, &CaseRun)| {
                let (own, other) = (column(study, i, run, &follow.column)?, column(study, i, run, beside)?);
                correlation(own, other).map_err(|e| CommandError::failed(&e, e.hint()))
            };
            let correlation = runs.iter().enumerate().map(of).collect::<Result<_, _>>()?;
            followers.push(Follower { column: follow.column.clone(), beside: beside.clone(), correlation });
        }
    }
    for over in &study.over_time {
        for (i, run) in runs.iter().enumerate() {
            column(study, i, run, &over.column)?;
        }
    }
    Ok(Findings { cases, followers })
}

/// A column of a case; some models tell only by their rows which they have.
fn column<'a>(study: &Study, i: usize, run: &'a CaseRun, name: &str) -> Result<&'a [f64], CommandError> {
    let found = run.rows.get(name);
    if !found.is_empty() {
        return Ok(found);
    }
    let advice = columns::advice(name, &run.rows.names_from(""));
    let label = &study.cases[i].label;
    Err(CommandError::input(
        format_args!("{}: the case \"{label}\" has no column {name}", study.file.display()),
        advice,
    ))
}

fn taken(quantity: &Quantity, column: &[f64]) -> f64 {
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

/// The last mesh cycles of a case's rows; all of them where none are given.
pub(crate) fn last_cycles(scene: &Scene, rows: &Columns, cycles: Option<u32>) -> Columns {
    let all = rows.len();
    rows.last(cycles.map_or(all, |n| (n as usize).saturating_mul(rows_per_cycle(scene)).min(all)))
}
