//! Poincare sections of a motion: once per period, or whenever a surface is crossed.

use crate::error::{StudyError, positive};

/// Points of a motion at offset, offset + period, ... by cubic interpolation between its samples.
///
/// `times` ascend; `columns[c][k]` is quantity c at `times[k]`. The result has one point per period, each with one
/// entry per column. A period should have a dozen samples or more: the interpolation (through the two samples on either
/// side) is of third order.
///
/// # Errors
/// [`StudyError`] for columns of different lengths, entries that are not finite, times that do not ascend, and a period
/// that is not positive or is shorter than the distance of the samples.
pub fn stroboscopic_section(
    times: &[f64],
    columns: &[&[f64]],
    period: f64,
    offset: f64,
) -> Result<Vec<Vec<f64>>, StudyError> {
    let at = section_times(times, period, offset)?;
    section_points(times, columns, &at)
}

/// Times of a section: offset, offset + period, ... up to the last of the samples at `times`.
///
/// # Errors
/// [`StudyError`] for times that do not ascend, and a period that is not positive or is shorter than the distance of
/// the samples.
pub fn section_times(times: &[f64], period: f64, offset: f64) -> Result<Vec<f64>, StudyError> {
    check(times, &[])?;
    positive("period", period)?;
    if !offset.is_finite() {
        return Err(StudyError::NotFinite { index: 0, value: offset });
    }
    let (first, last) = (times[0], times[times.len() - 1]);
    let periods = ((last - first) / period).ceil();
    if periods > times.len() as f64 {
        return Err(StudyError::TooFewSamples { samples: times.len(), least: periods as usize });
    }
    let slack = 1e-9 * period;
    let start = ((first - offset - slack) / period).ceil() as i64;
    let end = ((last - offset + slack) / period).floor() as i64;
    Ok((start..=end).map(|k| (offset + k as f64 * period).clamp(first, last)).collect())
}

/// Points of a motion at the times `at`, by cubic interpolation through the two samples on either side. For a long
/// motion the samples around these times are sufficient.
///
/// # Errors
/// [`StudyError`] for columns of different lengths, entries that are not finite, times that do not ascend.
pub fn section_points(times: &[f64], columns: &[&[f64]], at: &[f64]) -> Result<Vec<Vec<f64>>, StudyError> {
    check(times, columns)?;
    Ok(at.iter().map(|&t| columns.iter().map(|column| interpolated(times, column, t)).collect()).collect())
}

/// Points at which `surface` crosses zero upwards, with the columns interpolated to that time; one point per crossing,
/// time first.
///
/// # Errors
/// The errors of [`stroboscopic_section`].
pub fn crossing_section(times: &[f64], surface: &[f64], columns: &[&[f64]]) -> Result<Vec<Vec<f64>>, StudyError> {
    check(times, columns)?;
    check(times, &[surface])?;
    let mut points = Vec::new();
    for k in 1..times.len() {
        if surface[k - 1] < 0.0 && surface[k] >= 0.0 {
            let (mut low, mut high) = (times[k - 1], times[k]);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if interpolated(times, surface, middle) < 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let mut point = vec![high];
            point.extend(columns.iter().map(|column| interpolated(times, column, high)));
            points.push(point);
        }
    }
    Ok(points)
}

/// Points of a map that is applied repeatedly: `skip` times before the first point, then `keep` points.
///
/// `step` advances the state by one period and returns the resulting point.
///
/// # Errors
/// The errors of the map.
pub fn iterated_section<S, P, E>(
    state: &mut S,
    skip: usize,
    keep: usize,
    mut step: impl FnMut(&mut S) -> Result<P, E>,
) -> Result<Vec<P>, E> {
    for _ in 0..skip {
        step(state)?;
    }
    (0..keep).map(|_| step(state)).collect()
}

/// Period of a section: the smallest m for which every point repeats after m points, within `tolerance` times the
/// extent of each column over all points. `None` if no m up to a third of the points does: the motion is
/// quasi-periodic, chaotic, or not settled.
///
/// Columns that are constant count as repeating.
pub fn section_period(points: &[Vec<f64>], tolerance: f64, scale: &[f64]) -> Option<usize> {
    let comes_back = |m: usize| {
        points
            .iter()
            .zip(&points[m..])
            .all(|(a, b)| a.iter().zip(b).zip(scale).all(|((a, b), s)| (a - b).abs() <= tolerance * s))
    };
    (1..=points.len() / 3).find(|&m| comes_back(m))
}

fn check(times: &[f64], columns: &[&[f64]]) -> Result<(), StudyError> {
    if times.len() < 2 {
        return Err(StudyError::TooFewSamples { samples: times.len(), least: 2 });
    }
    for column in columns {
        if column.len() != times.len() {
            return Err(StudyError::Lengths { found: column.len(), wanted: times.len() });
        }
    }
    for list in columns.iter().copied().chain([times]) {
        if let Some(index) = list.iter().position(|x| !x.is_finite()) {
            return Err(StudyError::NotFinite { index, value: list[index] });
        }
    }
    match times.windows(2).position(|w| w[1] <= w[0]) {
        Some(index) => Err(StudyError::NotAscending { index: index + 1 }),
        None => Ok(()),
    }
}

/// Lagrange's cubic through the two samples on either side of `t` (fewer at the ends).
fn interpolated(times: &[f64], values: &[f64], t: f64) -> f64 {
    let right = times.partition_point(|&x| x < t).clamp(1, times.len() - 1);
    let range = right.saturating_sub(2)..(right + 2).min(times.len());
    range
        .clone()
        .map(|i| {
            let weight: f64 =
                range.clone().filter(|&j| j != i).map(|j| (t - times[j]) / (times[i] - times[j])).product();
            weight * values[i]
        })
        .sum()
}
