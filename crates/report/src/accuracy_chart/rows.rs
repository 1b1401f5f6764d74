//! Rows of a work-precision chart: every point, measured or not.

use analysis::accuracy_chart::{Outcome, OwnBound, OwnBounds, PointRow, WorkPrecision};
use answer::Table;
use study::{Answer, AnswerError, Work, mean, peak_to_peak};

/// A point that was run.
struct Measured<'a> {
    work: &'a Work,
    answer: &'a Answer,
    error: &'a AnswerError,
    bounds: Option<&'a OwnBounds>,
}

impl<'a> Measured<'a> {
    fn of(row: &'a PointRow) -> Option<Self> {
        match &row.outcome {
            Outcome::Skipped(_) => None,
            Outcome::Measured { work, answer, error, bounds, .. } => {
                Some(Self { work, answer, error, bounds: bounds.as_deref().ok() })
            }
        }
    }

    /// Peak to peak, where the whole cycle was run.
    fn swing(&self) -> Option<f64> {
        let whole = self.work.positions_run == self.work.positions_asked;
        (whole && !self.answer.ste_um.is_empty()).then(|| peak_to_peak(&self.answer.ste_um))
    }

    fn own_mean(&self) -> Option<&OwnBound> {
        self.bounds.map(|own| &own.mean_ste)
    }

    fn own_swing(&self) -> Option<&OwnBound> {
        self.bounds.and_then(|own| own.peak_to_peak_ste.as_ref())
    }
}

/// A number of a point that was run.
type Of = fn(&Measured<'_>) -> Option<f64>;

const NUMBERS: [(&str, &str, Of); 15] = [
    ("dof_before", "degrees of freedom of both gears as meshed", |m| Some(m.work.dof_before as f64)),
    ("dof_after", "degrees of freedom of both gears that every position carries", |m| Some(m.work.dof_after as f64)),
    ("offline_s", "wall time of everything before the first position: meshes, matrices, factors, condensation", |m| {
        Some(m.work.offline_s)
    }),
    ("cycle_s", "wall time of all positions of the first mesh cycle", |m| Some(m.work.cycle_s)),
    ("first_cycle_s", "wall time of `offline_s` and `cycle_s`", |m| Some(m.work.first_cycle_s())),
    ("further_cycle_s", "wall time of all positions of a further cycle on the same gears", |m| m.work.further_cycle_s),
    ("position_s", "wall time of one position of a further cycle", |m| Some(m.work.position_s())),
    (
        "positions_run",
        "positions of the cycle that were run; times of a cycle are scaled where they are fewer than all",
        |m| Some(m.work.positions_run as f64),
    ),
    ("positions_asked", "positions of the cycle", |m| Some(m.work.positions_asked as f64)),
    ("peak_memory_mb", "largest resident set during the point", |m| m.work.peak_memory_mb),
    ("mean_ste_um", "mean static transmission error", |m| {
        (!m.answer.ste_um.is_empty()).then(|| mean(&m.answer.ste_um))
    }),
    (
        "peak_to_peak_ste_um",
        "peak to peak of the static transmission error; `NaN` where a part of the cycle was run",
        |m| m.swing(),
    ),
    ("mean_line_length_mm", "mean total contact-line length", |m| {
        (!m.answer.line_length_mm.is_empty()).then(|| mean(&m.answer.line_length_mm))
    }),
    ("error_mean_ste", "relative error of the mean STE against the reference", |m| Some(m.error.mean_ste)),
    ("error_peak_to_peak_ste", "relative error of the peak-to-peak STE against the reference", |m| {
        m.error.peak_to_peak_ste
    }),
];

/// The table `chart`; NaN without a value, the reason of a point that was not run in `note`.
pub(super) fn rows(chart: &WorkPrecision) -> Table {
    let reference = PointRow {
        way: "reference",
        density: Some(chart.reference_density),
        outcome: Outcome::Measured {
            work: chart.reference_work,
            answer: chart.reference.clone(),
            error: AnswerError { mean_ste: 0.0, peak_to_peak_ste: None, mean_line_length: None },
            bounds: chart.reference_bounds.clone(),
            note: format!("what the others are compared with; {}", chart.reference_note),
        },
    };
    let rows: Vec<&PointRow> = chart.rows.iter().chain([&reference]).collect();
    let measured: Vec<Option<Measured<'_>>> = rows.iter().map(|row| Measured::of(row)).collect();
    let column = |of: Of| measured.iter().map(move |m| m.as_ref().and_then(of).unwrap_or(f64::NAN));
    let mut table = Table::new("chart")
        .texts("way", "model of the point; the last row is the reference", rows.iter().map(|row| row.way))
        .numbers(
            "elements_profile",
            "elements along the profile; NaN without a mesh",
            rows.iter().map(|row| row.density.map_or(f64::NAN, |d| f64::from(d.profile))),
        );
    for (name, meaning, of) in NUMBERS {
        table.push_numbers(name, meaning, column(of));
    }
    table.push_numbers(
        "error_mean_line_length",
        "relative error of the mean contact-line length against the reference",
        column(|m| m.error.mean_line_length),
    );
    let own = |of: fn(&Measured<'_>) -> Option<OwnBound>| -> Vec<Option<OwnBound>> {
        measured.iter().map(|m| m.as_ref().and_then(of)).collect()
    };
    let bounds = [("mean_ste", own(|m| m.own_mean().copied())), ("peak_to_peak_ste", own(|m| m.own_swing().copied()))];
    for (quantity, own) in bounds {
        let number = |of: fn(OwnBound) -> f64| own.iter().map(move |b| b.map_or(f64::NAN, of));
        let holds = own.iter().map(|b| b.map_or_else(String::new, |b| b.holds.to_string()));
        table = table
            .numbers(format!("least_error_{quantity}"), "smallest error by the point's own bounds", number(|b| b.least))
            .numbers(format!("most_error_{quantity}"), "largest error by the point's own bounds", number(|b| b.most))
            .texts(format!("holds_{quantity}"), "`true` where the error lies within the point's own bounds", holds);
    }
    let no_bounds = rows.iter().map(|row| match &row.outcome {
        Outcome::Measured { bounds: Err(why), .. } => why.as_str(),
        _ => "",
    });
    let notes = rows.iter().map(|row| match &row.outcome {
        Outcome::Measured { note, .. } | Outcome::Skipped(note) => note.as_str(),
    });
    table.texts("no_bounds", "reason why the point has no bounds: rigid gears, another program", no_bounds).texts(
        "note",
        "note on the point, or reason why it was not run",
        notes,
    )
}
