//! Stroboscopic (Poincare) sections of a motion, and the phase portraits that they lie in.

use answer::{Column, Table, Values};
use study::{StudyError, stroboscopic_section};

use crate::charts::{Curve, dot_chart};

/// `section`: the numbers of a history once a period from its first row on, by cubic interpolation where no row is there.
/// `places`: mesh cycles of the rows, from 0 on; `period`: in them.
///
/// # Errors
/// [`StudyError`] for places that do not ascend, rows that hold what is no number, and a period that is shorter than the
/// rows are apart.
pub(crate) fn section(history: &Table, places: &[f64], period: f64) -> Result<Table, StudyError> {
    let numbers = |column: &'_ Column| matches!(column.values, Values::Numbers(_));
    let columns = || history.columns.iter().filter(|column| numbers(column));
    let values: Vec<&[f64]> = columns().filter_map(|column| history.find(&column.name)).collect();
    let points = if places.len() < 2 {
        (0..places.len()).map(|i| values.iter().map(|own| own[i]).collect()).collect()
    } else {
        stroboscopic_section(places, &values, period, 0.0)?
    };
    let mut table = Table::new("section");
    for (i, column) in columns().enumerate() {
        table.push_numbers(column.name.clone(), column.meaning.clone(), points.iter().map(|point| point[i]));
    }
    Ok(table)
}

/// Displacement (um) with its velocity (mm/s), row by row; nothing where the rows have none of that name.
fn plane(rows: &Table, name: &str) -> Vec<(f64, f64)> {
    let of = |unit: &str| rows.find(&format!("{name}_{unit}")).unwrap_or_default();
    let (x, v) = (of("um"), of("rate_um_per_s"));
    x.iter().zip(v).map(|(x, v)| (*x, 1e-3 * v)).collect()
}

/// Velocity over displacement, and the same once a period: phase portrait with its Poincare section. `once`: the period in
/// words.
pub(crate) fn portrait([rows, section]: [&Table; 2], name: &str, [whose, once]: [&str; 2]) -> Option<String> {
    let motion = Curve { label: "motion".into(), points: plane(rows, name) };
    let once = Curve { label: once.into(), points: plane(section, name) };
    let title = format!("Phase portrait of {whose}, and its Poincare section");
    dot_chart(&title, "displacement [um]", "velocity [mm/s]", &[motion, once])
}
