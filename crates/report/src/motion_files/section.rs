//! Stroboscopic (Poincare) sections of a motion, and the phase portraits that they lie in.

use answer::{Column, Table};
use study::{section_points, section_times};

use crate::{
    ReportError,
    charts::{Curve, dot_chart},
};

/// Rows that are looked at together.
const ROWS: usize = 32_768;
/// Rows on either side of a point that are read for it: two are interpolated from, at an end of the history four.
const BESIDE: usize = 4;
/// Rows between those of two points that are read along: to read them costs less than to begin anew.
const BETWEEN: usize = 16;

/// `section`: the numbers of a history once a period from its first row on, by cubic interpolation where no row is there.
/// `places`: mesh cycles of the rows, from 0 on; `period`: in them.
///
/// # Errors
/// [`ReportError`] for places that do not ascend, rows that hold what is no number, and a period that is shorter than the
/// rows are apart.
pub(crate) fn section(history: &Table, places: &[f64], period: f64) -> Result<Table, ReportError> {
    let rows = places.len();
    let numbers = history.part(0..rows.min(1), |_| true)?;
    let numbers: Vec<&Column> = numbers.columns.iter().filter(|column| !column.is_of_texts()).collect();
    let wanted = |name: &str| numbers.iter().any(|column| column.name == name);
    let mut points: Vec<Vec<f64>> = vec![Vec::new(); numbers.len()];
    if rows < 2 {
        points.iter_mut().zip(&numbers).for_each(|(list, column)| list.extend(column.numbers()));
    } else {
        let at = section_times(places, period, 0.0)?;
        let mut next = &at[..];
        for first in (0..rows).step_by(ROWS) {
            // A point belongs to the row behind it.
            let behind = |t: f64| places.partition_point(|&place| place < t);
            let (own, later) = next.split_at(next.partition_point(|&t| behind(t) < first + ROWS));
            next = later;
            let around = |t: f64| behind(t).saturating_sub(BESIDE)..rows.min(behind(t) + BESIDE);
            for own in own.chunk_by(|a, b| around(*b).start <= around(*a).end + BETWEEN) {
                let [Some(from), Some(to)] = [own.first(), own.last()] else { continue };
                let around = around(*from).start..around(*to).end;
                let part = history.part(around.clone(), wanted)?;
                let values: Vec<&[f64]> = part.columns.iter().map(Column::numbers).collect();
                for point in section_points(&places[around], &values, own)? {
                    points.iter_mut().zip(point).for_each(|(list, value)| list.push(value));
                }
            }
        }
    }
    let mut table = Table::new("section");
    for (column, values) in numbers.iter().zip(points) {
        table.push_numbers(column.name.clone(), column.meaning.clone(), values);
    }
    Ok(table)
}

/// Displacement (um) with its velocity (mm/s), row by row; nothing where the rows have none of that name.
fn plane(rows: &Table, name: &str) -> Result<Vec<(f64, f64)>, ReportError> {
    let [x, v] = ["um", "rate_um_per_s"].map(|unit| format!("{name}_{unit}"));
    let part = rows.part(0..rows.rows(), |own| own == x || own == v)?;
    let [x, v] = [x, v].map(|name| part.find(&name).unwrap_or_default());
    Ok(x.iter().zip(v).map(|(x, v)| (*x, 1e-3 * v)).collect())
}

/// Velocity over displacement, and the same once a period: phase portrait with its Poincare section. `once`: the period in
/// words.
///
/// # Errors
/// [`ReportError`] where rows cannot be read back.
pub(crate) fn portrait(
    [rows, section]: [&Table; 2],
    name: &str,
    [whose, once]: [&str; 2],
) -> Result<Option<String>, ReportError> {
    let motion = Curve { label: "motion".into(), points: plane(rows, name)? };
    let once = Curve { label: once.into(), points: plane(section, name)? };
    let title = format!("Phase portrait of {whose}, and its Poincare section");
    Ok(dot_chart(&title, "displacement [um]", "velocity [mm/s]", &[motion, once]))
}
