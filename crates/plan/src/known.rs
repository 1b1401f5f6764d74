//! The rows of a plan as columns of numbers.

use scene::plan::{Plan, PlanAxis, PlanOutput};

use crate::CaseRow;

/// All cases of a plan, column by column.
#[derive(Debug)]
pub struct KnownCases {
    /// Values of each axis.
    pub axes: Vec<Column>,
    /// Each number wanted; NaN of a case without a result.
    pub outputs: Vec<Column>,
    /// Why a case has no result; empty where it has one.
    pub reasons: Vec<String>,
    /// How many have none.
    pub failed: usize,
}

/// A number of every case.
#[derive(Debug)]
pub struct Column {
    /// Name, as in the table `cases`.
    pub name: String,
    /// Case by case.
    pub values: Vec<f64>,
}

impl KnownCases {
    /// From the rows of a plan whose cases are all done.
    pub fn of(plan: &Plan, rows: &[CaseRow]) -> Self {
        let axis = |(k, axis): (usize, &PlanAxis)| Column {
            name: axis.name().to_owned(),
            values: rows.iter().map(|row| row.values[k]).collect(),
        };
        // Without a result there is no number.
        let number = |row: &CaseRow, k: usize| row.outcome.as_ref().map_or(f64::NAN, |numbers| numbers[k]);
        let output = |(k, output): (usize, &PlanOutput)| Column {
            name: output.name(),
            values: rows.iter().map(|row| number(row, k)).collect(),
        };
        Self {
            axes: plan.axes.iter().enumerate().map(axis).collect(),
            outputs: plan.outputs.iter().enumerate().map(output).collect(),
            reasons: rows.iter().map(|row| row.outcome.clone().err().unwrap_or_default()).collect(),
            failed: rows.iter().filter(|row| row.outcome.is_err()).count(),
        }
    }

    /// How many cases there are.
    pub fn count(&self) -> usize {
        self.reasons.len()
    }

    /// Cases by the first number wanted, the least first; those without it are left out.
    pub fn best(&self) -> Vec<usize> {
        self.outputs.first().map(Column::ascending).unwrap_or_default()
    }
}

impl Column {
    /// Values of the column, each once, ascending.
    pub fn distinct(&self) -> Vec<f64> {
        let mut all: Vec<f64> = self.values.iter().copied().filter(|v| v.is_finite()).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }

    /// Whether it has more than one value.
    pub fn varies(&self) -> bool {
        self.values.iter().any(|v| *v != self.values[0])
    }

    /// Cases that have a number, the least first; of equal ones the earlier.
    pub fn ascending(&self) -> Vec<usize> {
        let mut cases: Vec<usize> = (0..self.values.len()).filter(|&i| self.values[i].is_finite()).collect();
        cases.sort_by(|&a, &b| self.values[a].total_cmp(&self.values[b]));
        cases
    }
}
