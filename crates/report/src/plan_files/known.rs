//! The rows of a plan as columns of numbers.

use scene::plan::{Plan, PlanAxis, PlanOutput};

use super::DoneCases;

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
    /// Name, as in `cases.csv`.
    pub name: String,
    /// Case by case.
    pub values: Vec<f64>,
}

impl KnownCases {
    /// From the rows of a plan whose cases are all done.
    pub fn of(plan: &Plan, done: &DoneCases) -> Self {
        let column = |name: String| Column { name, values: Vec::new() };
        let mut axes: Vec<Column> = plan.axes.iter().map(|axis| column(PlanAxis::name(axis).to_owned())).collect();
        let mut outputs: Vec<Column> = plan.outputs.iter().map(|output| column(PlanOutput::name(output))).collect();
        let (mut reasons, mut failed, numbers) = (Vec::new(), 0, 1 + axes.len() + outputs.len());
        for line in done.text().lines() {
            let fields: Vec<&str> = line.split(',').collect();
            let reason = fields.get(numbers + 1..).unwrap_or_default().join(",");
            reasons.push(reason.trim_matches('"').replace("\"\"", "\""));
            failed += usize::from(fields.get(numbers) == Some(&"failed"));
            for (column, field) in axes.iter_mut().chain(&mut outputs).zip(&fields[1..]) {
                // Without a result there is no number.
                column.values.push(field.parse().unwrap_or(f64::NAN));
            }
        }
        Self { axes, outputs, reasons, failed }
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
    /// Its values, each once, ascending.
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
