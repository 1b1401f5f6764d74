//! `chart.csv`: every point of a work-precision chart, measured or not.

use analysis::accuracy_chart::{Outcome, OwnBound, OwnBounds, PointRow, WorkPrecision};

use crate::csv::always_quoted;

const HEADER: &str = "way,elements_profile,dof_before,dof_after,offline_s,cycle_s,first_cycle_s,further_cycle_s,position_s,\
                      positions_run,positions_asked,peak_memory_mb,mean_ste_um,peak_to_peak_ste_um,mean_line_length_mm,\
                      error_mean_ste,error_peak_to_peak_ste,error_mean_line_length,least_error_mean_ste,most_error_mean_ste,\
                      holds_mean_ste,least_error_peak_to_peak_ste,most_error_peak_to_peak_ste,holds_peak_to_peak_ste,\
                      no_bounds,note\n";

/// The chart as CSV; a field without a value is empty, a point that was not run has its reason in `note`.
pub fn chart_csv(chart: &WorkPrecision) -> String {
    let mut text = HEADER.to_owned();
    chart.rows.iter().for_each(|row| text.push_str(&line(row)));
    let reference = PointRow {
        way: "reference",
        density: Some(chart.reference_density),
        outcome: Outcome::Measured {
            work: chart.reference_work,
            answer: chart.reference.clone(),
            error: study::AnswerError { mean_ste: 0.0, peak_to_peak_ste: None, mean_line_length: None },
            bounds: chart.reference_bounds.clone(),
            note: format!("what the others are compared with; {}", chart.reference_note),
        },
    };
    text.push_str(&line(&reference));
    text
}

fn line(row: &PointRow) -> String {
    let profile = row.density.map_or_else(String::new, |d| d.profile.to_string());
    let way = always_quoted(row.way);
    match &row.outcome {
        Outcome::Skipped(why) => format!("{way},{profile},{}{}\n", ",".repeat(16 + BOUND_FIELDS), always_quoted(why)),
        Outcome::Measured { work, answer, error, bounds, note } => {
            let whole = work.positions_run == work.positions_asked;
            let fields = [
                work.dof_before.to_string(),
                work.dof_after.to_string(),
                work.offline_s.to_string(),
                work.cycle_s.to_string(),
                work.first_cycle_s().to_string(),
                optional(work.further_cycle_s),
                work.position_s().to_string(),
                work.positions_run.to_string(),
                work.positions_asked.to_string(),
                optional(work.peak_memory_mb),
                optional(mean(&answer.ste_um)),
                optional(swing(&answer.ste_um).filter(|_| whole)),
                optional(mean(&answer.line_length_mm)),
                error.mean_ste.to_string(),
                optional(error.peak_to_peak_ste),
                optional(error.mean_line_length),
            ];
            format!("{way},{profile},{},{},{}\n", fields.join(","), of_bounds(bounds), always_quoted(note))
        }
    }
}

/// Fields of a point's own bounds.
const BOUND_FIELDS: usize = 7;

/// Least and largest error of mean and peak to peak, whether the reference lies inside, or why there are none.
fn of_bounds(bounds: &Result<Box<OwnBounds>, String>) -> String {
    let of =
        |b: Option<&OwnBound>| b.map_or_else(|| ",,".to_owned(), |b| format!("{},{},{}", b.least, b.most, b.holds));
    match bounds.as_deref() {
        Ok(OwnBounds { mean_ste, peak_to_peak_ste }) => {
            format!("{},{},", of(Some(mean_ste)), of(peak_to_peak_ste.as_ref()))
        }
        Err(why) => format!("{},{},{}", of(None), of(None), always_quoted(why)),
    }
}

fn optional(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or_else(String::new, |v| v.to_string())
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// Largest minus smallest.
fn swing(values: &[f64]) -> Option<f64> {
    let low = values.iter().copied().reduce(f64::min)?;
    Some(values.iter().copied().reduce(f64::max)? - low)
}
