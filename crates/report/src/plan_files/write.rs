//! `cases.csv`, `cases.parquet`, `summary.json` and the closing table of a plan.

use std::fmt::Write;

use scene::plan::{Plan, PlanAxis, PlanOutput};
use serde_json::json;
use study::{extent, mean, root_mean_square};

use super::{CaseTable, DoneCases, page};
use crate::{Cost, ReportError, ResultFiles, checkpoint::InputDigests, columnar};

/// Quantiles that are told of every number.
const QUANTILES: [f64; 3] = [0.1, 0.5, 0.9];
/// Standard deviations either way of a mean that hold 95 % of a normal distribution.
const NORMAL_95: f64 = 1.959_963_984_540_054;

/// What says that two plans have the same cases: scene, files that it names, axes, samples, outputs, program.
///
/// # Errors
/// When a file that the scene names cannot be read.
pub fn plan_digest(plan: &Plan) -> Result<String, ReportError> {
    let mut hasher = blake3::Hasher::new();
    let mut take = |text: &str| {
        hasher.update(text.as_bytes());
        hasher.update(&[0]);
    };
    take(env!("CARGO_PKG_VERSION"));
    take(&plan.scene_text);
    plan.settings.iter().for_each(|setting| take(&setting.word()));
    take(&format!("{:?} {:?} {:?} {:?}", plan.axes, plan.cases.axes(), plan.sampling, plan.outputs));
    // Files of a case may be varied as little as their names: those of the first stand for all.
    if let Ok(scene) = plan.scene(0) {
        take(&format!(
            "{:?}",
            InputDigests::of(&scene).map_err(|e| ReportError::NoResult {
                file: plan.scene_file.clone(),
                what: e.to_string(),
                hint: "is a file that the scene names still there?"
            })?
        ));
    }
    Ok(hasher.finalize().to_hex().to_string())
}

/// Writes the files of a plan whose cases are done; what comes back is the closing table.
///
/// # Errors
/// When the system refuses.
pub fn write_cases(
    plan: &Plan,
    done: &DoneCases,
    cost: &Cost,
    results: &dyn ResultFiles,
) -> Result<String, ReportError> {
    let (header, lines) = (CaseTable::of(plan).header().to_owned(), done.text());
    results.write("cases.csv", (header.clone() + &lines).as_bytes())?;
    let numbers = 1 + plan.axes.len() + plan.outputs.len();
    let names: Vec<&str> = header.split(',').take(numbers).collect();
    let mut columns = vec![Vec::new(); numbers];
    let (mut failed, mut reasons) = (0, Vec::new());
    for line in lines.lines() {
        let fields: Vec<&str> = line.split(',').collect();
        reasons.push(fields.get(numbers + 1..).unwrap_or_default().join(",").trim_matches('"').replace("\"\"", "\""));
        failed += usize::from(fields.get(numbers) == Some(&"failed"));
        for (column, field) in columns.iter_mut().zip(&fields) {
            // Without a result there is no number.
            column.push(field.parse().unwrap_or(f64::NAN));
        }
    }
    results.write("cases.parquet", &columnar::parquet_of("cases", &names, &columns)?)?;
    let outputs: Vec<Spread> = plan.outputs.iter().zip(&columns[1 + plan.axes.len()..]).map(Spread::of).collect();
    let summary = json!({
        "name": plan.name,
        "program": { "version": env!("CARGO_PKG_VERSION") },
        "plan": {
            "scene": plan.scene_file,
            "axes": plan.axes.iter().map(|axis| &axis.keys).collect::<Vec<_>>(),
            "values": plan.cases.axes(),
            "sampling": plan.sampling,
        },
        "headline": {
            "cases": plan.cases.count(),
            "failed": failed,
            "outputs": outputs.iter().map(Spread::json).collect::<Vec<_>>(),
        },
        "wall_time_s": cost.wall_s,
    });
    let text = serde_json::to_string_pretty(&summary).unwrap_or_default() + "\n";
    results.write("summary.json", text.as_bytes())?;
    let table = table(plan, failed, &outputs, cost);
    page::page(plan, &columns, &reasons, &table)?.write(results)?;
    Ok(table)
}

/// How a number is spread over the cases that have it.
struct Spread {
    name: String,
    values: Vec<f64>,
}

impl Spread {
    fn of((output, column): (&PlanOutput, &Vec<f64>)) -> Self {
        let mut values: Vec<f64> = column.iter().copied().filter(|x| x.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        Self { name: output.name(), values }
    }

    /// Between neighbours in proportion (type 7 of R. Hyndman, Y. Fan, Am. Stat. 50 (1996) 361).
    fn quantile(&self, share: f64) -> Option<f64> {
        let at = share * self.values.len().checked_sub(1)? as f64;
        let (low, high) = (at.floor() as usize, at.ceil() as usize);
        Some(self.values[low] + (at - low as f64) * (self.values[high] - self.values[low]))
    }

    /// Values between which a quantile lies in 95 % of random samples: order statistics by the binomial distribution,
    /// normal in the limit; `None` where there are too few.
    fn interval(&self, share: f64) -> Option<[f64; 2]> {
        let n = self.values.len() as f64;
        let (middle, half) = (share * n, NORMAL_95 * (share * (1.0 - share) * n).sqrt());
        let (low, high) = ((middle - half).floor(), (middle + half).ceil());
        // Rank r counts from 1; the r-th value is at least as large as the quantile's lower end.
        (low >= 1.0 && high <= n).then(|| [self.values[low as usize - 1], self.values[high as usize - 1]])
    }

    fn json(&self) -> serde_json::Value {
        let known = |x: f64| Some(x).filter(|x| x.is_finite());
        let [least, largest] = extent(&self.values).map(known);
        json!({
            "name": self.name,
            "mean": known(mean(&self.values)),
            "mean_within_95": known(NORMAL_95 * root_mean_square(&self.values) / (self.values.len() as f64).sqrt()),
            "standard_deviation": known(root_mean_square(&self.values)),
            "least": least,
            "largest": largest,
            "quantile_10": self.quantile(QUANTILES[0]),
            "median": self.quantile(QUANTILES[1]),
            "quantile_90": self.quantile(QUANTILES[2]),
            "quantile_10_95": self.interval(QUANTILES[0]),
            "median_95": self.interval(QUANTILES[1]),
            "quantile_90_95": self.interval(QUANTILES[2]),
        })
    }
}

fn table(plan: &Plan, failed: usize, outputs: &[Spread], cost: &Cost) -> String {
    let axes: Vec<&str> = plan.axes.iter().map(PlanAxis::name).collect();
    let mut t = format!("{} ({} cases over {})\n\n", plan.name, plan.cases.count(), axes.join(", "));
    // Writing to a String cannot fail.
    let _ = writeln!(t, "  {:<36} {:>12} {:>12} {:>12} {:>12}", "", "least", "median", "90 %", "largest");
    for output in outputs {
        let at = |share: f64| output.quantile(share).map_or_else(|| "-".to_owned(), |x| format!("{x:.4}"));
        let [least, median, ninety, largest] = [0.0, 0.5, 0.9, 1.0].map(at);
        let _ = writeln!(t, "  {:<36} {least:>12} {median:>12} {ninety:>12} {largest:>12}", output.name);
    }
    if failed > 0 {
        let _ = writeln!(t, "\n  cases without a result: {failed}; `reason` in cases.csv says why");
    }
    let _ = writeln!(t, "\n  wall time {:.2} s", cost.wall_s);
    t
}
