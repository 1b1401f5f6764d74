//! `ale-gear compare`: result folders in, one table out, and charts if wanted.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde_json::json;

use report::{
    compare::{
        Axis, BESIDE, NumberRow, ResultFolder, by_shared_names, compare_answer, compare_charts, compare_page,
        headline_rows, input_rows, overlays,
    },
    page::closing_text,
    write_result,
};

use crate::{error::CommandError, output::ResultDirectory, talk};

/// Words of `ale-gear compare`.
#[derive(Debug, clap::Args)]
pub(super) struct CompareArgs {
    /// Result folders; the others are compared with the first
    #[arg(required = true, num_args = 2.., value_name = "DIR")]
    folders: Vec<PathBuf>,
    /// Folder for report.html, compare.csv, compare_curves.csv and one SVG for each quantity
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Abscissa of the curves [default: time if all runs are motions, else phase]
    #[arg(long, requires = "out")]
    over: Option<Over>,
    /// Print numbers and differences as JSON instead of the table
    #[arg(long)]
    json: bool,
}

/// What curves are drawn over, as a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Over {
    /// The last whole mesh cycle of each run
    Phase,
    /// Time since the first row
    Time,
}

impl CompareArgs {
    /// Reads all, then writes; the text is the table.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let runs = self.folders.iter().map(|f| ResultFolder::read(f)).collect::<Result<Vec<_>, _>>()?;
        let runs = by_shared_names(runs);
        let (numbers, inputs) = (headline_rows(&runs), input_rows(&runs));
        let axis = match self.over {
            Some(Over::Phase) => Axis::Phase,
            Some(Over::Time) => Axis::Time,
            None if runs.iter().all(ResultFolder::is_motion) => Axis::Time,
            None => Axis::Phase,
        };
        // Curves go into files: a table on the terminal does without, and rows of a motion are many.
        let alone = without_a_number(&runs, &numbers);
        let curves = if self.out.is_some() || !alone.is_empty() { overlays(&runs, axis) } else { Vec::new() };
        let shares = |run: &ResultFolder| curves.iter().any(|curve| curve.is_of(&run.label()));
        if let Some(alone) = alone.into_iter().find(|run| !shares(run)) {
            return Err(CommandError::input(
                format_args!(
                    "{} has neither a number of its headline nor a column of its rows in common with the others",
                    alone.label()
                ),
                Some("compare answers of which some numbers are the same".into()),
            ));
        }
        let answer = compare_answer(&runs, &numbers, &inputs, &curves);
        let charts = compare_charts(&curves);
        let page = compare_page(&answer, &runs, (&numbers, &inputs), &charts);
        let mut text = if self.json {
            let labels: Vec<String> = runs.iter().map(ResultFolder::label).collect();
            let missed: Vec<_> = runs.iter().map(ResultFolder::missed).collect();
            let all = json!({ "runs": labels, "certificate_missed": missed, "numbers": numbers, "inputs": inputs });
            format!("{all:#}\n")
        } else {
            closing_text(&page, &answer.cost)
        };
        let Some(out) = &self.out else { return Ok(text) };
        let same =
            |a: &Path, b: &Path| a == b || a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b));
        if let Some(clash) = self.folders.iter().find(|f| same(f, out)) {
            return Err(CommandError::input(
                format_args!("--out {}: is one of the folders to compare", clash.display()),
                Some("give the name of a new folder".into()),
            ));
        }
        let results = ResultDirectory::create(out)?;
        for chart in &charts {
            results.write(&format!("compare_{}.svg", chart.name), chart.svg.as_bytes())?;
        }
        write_result(answer, &page, false, &results)?;
        results.finish(talk::note)?;
        if !self.json {
            text.push_str(&format!("\nresults: {}\n", out.display()));
        }
        Ok(text)
    }
}

/// The runs that share no number of their headlines with another one.
fn without_a_number<'a>(runs: &'a [ResultFolder], numbers: &[NumberRow]) -> Vec<&'a ResultFolder> {
    let shares = |i: usize| {
        let shared = numbers.iter().filter(|row| !BESIDE.contains(&row.key.as_str()));
        shared.filter(|row| row.values[i].is_some()).any(|row| row.values.iter().flatten().count() > 1)
    };
    (0..runs.len()).filter(|&i| !shares(i)).map(|i| &runs[i]).collect()
}
