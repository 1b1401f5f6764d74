//! Torques over time, of the drive and of the load.

use toml::Spanned;

use super::{DriveScene, TorqueScene};
use crate::schema::{DRIVE, DriveBy, RawDrive, RawLoad};
use crate::source::Source;
use crate::spanned::{Number, Rows};
use crate::table::Choice;
use crate::{Model, SceneError};

type Checked<T> = Result<T, SceneError>;
type Span = std::ops::Range<usize>;

/// What drives the driver of a model. Flanks of elastic gears turn both gears freely unless the scene holds the driver;
/// the others prescribe its speed, or know no difference.
pub(crate) fn drive(s: &Source<'_>, raw: &RawDrive, model: Model) -> Checked<DriveScene> {
    let mut words = DriveBy::CHOICES.to_vec();
    if !model.has_reduced_gears() && model != Model::Auto {
        words.reverse();
    }
    let by = s.choice("by", &raw.by, &words)?;
    let torque = torque(s, [&raw.torque_nm, &raw.amplitude_nm, &raw.frequency_hz, &raw.phase_deg], &raw.table_s_nm)?;
    let first = [&raw.torque_nm, &raw.amplitude_nm, &raw.frequency_hz, &raw.phase_deg];
    let span = first.iter().find_map(|v| v.as_ref().map(Spanned::span)).or(raw.table_s_nm.as_ref().map(Spanned::span));
    match (by, span) {
        (DriveBy::Speed, Some(span)) => {
            let what = "a driver whose speed is given takes whatever torque that needs";
            Err(s.conflict(&span, what, "say `by = \"torque\"` in [drive], or leave the torque out"))
        }
        _ => Ok(DriveScene { by, torque }),
    }
}

pub(crate) fn load(s: &Source<'_>, raw: &RawLoad) -> Checked<TorqueScene> {
    beside_mean(s, [&raw.amplitude_nm, &raw.frequency_hz, &raw.phase_deg], &raw.table_s_nm)
}

/// What a torque is beside its mean: amplitude, frequency and phase, or a table.
pub(crate) fn beside_mean(
    s: &Source<'_>,
    [amplitude, frequency, phase]: [&Number; 3],
    table: &Rows,
) -> Checked<TorqueScene> {
    torque(s, [&None, amplitude, frequency, phase], table)
}

/// The complaint about a load that is 0 where a motion begins, at the key that makes it so.
pub(crate) fn begins_unloaded(s: &Source<'_>, span: &Span, key: &str) -> SceneError {
    let what = format!(
        "`{key}` begins with a load of 0: a motion begins at rest, and teeth that nothing presses have no place to stand"
    );
    let advice = match key {
        "table_s_nm" => "let its first row have a torque that presses the flanks, a hundredth of the largest will do",
        _ => "give another `phase_deg`, or an amplitude below the mean",
    };
    s.conflict(span, what, advice)
}

fn torque(s: &Source<'_>, [mean, amplitude, frequency, phase]: [&Number; 4], table: &Rows) -> Checked<TorqueScene> {
    let all = [("torque_nm", mean), ("amplitude_nm", amplitude), ("frequency_hz", frequency), ("phase_deg", phase)];
    let said = |(key, value): &(&'static str, &Number)| value.as_ref().map(|v| (*key, v.span()));
    if let (Some(_), Some((key, span))) = (table, all.iter().find_map(said)) {
        let what = format!("`{key}` is beside a table that already gives it");
        return Err(s.conflict(&span, what, "keep one of them"));
    }
    if amplitude.is_some() != frequency.is_some() || (phase.is_some() && amplitude.is_none()) {
        let (key, span) = all[1..].iter().find_map(said).unwrap_or(("amplitude_nm", 0..0));
        let what = format!("`{key}` alone makes no harmonic torque");
        return Err(s.conflict(&span, what, "give `amplitude_nm` and `frequency_hz` (and `phase_deg`)"));
    }
    let number = |key, value: &Number| s.optional_up_to(&DRIVE, key, value, f64::INFINITY);
    Ok(TorqueScene {
        torque_nm: number("torque_nm", mean)?,
        amplitude_nm: number("amplitude_nm", amplitude)?,
        frequency_hz: number("frequency_hz", frequency)?,
        phase_deg: amplitude.as_ref().map(|_| s.number_of(&DRIVE, "phase_deg", phase)).transpose()?,
        table_s_nm: time_table(s, table)?,
    })
}

fn time_table(s: &Source<'_>, raw: &Rows) -> Checked<Option<Vec<[f64; 2]>>> {
    let Some(rows) = raw else { return Ok(None) };
    let advice = "rows of time (s, ascending) and torque (N m): table_s_nm = [[0.0, 150.0], [0.1, -20.0]]";
    let bad = |span: &Span, what: String| Err(s.conflict(span, what, advice));
    let mut all: Vec<[f64; 2]> = Vec::new();
    for row in rows.get_ref() {
        match <[f64; 2]>::try_from(row.get_ref().as_slice()) {
            Ok([time, torque]) if time.is_finite() && torque.is_finite() => {
                if all.last().is_some_and(|last| last[0] >= time) {
                    return bad(&row.span(), format!("`table_s_nm` goes back to {time} s"));
                }
                all.push([time, torque]);
            }
            _ => return bad(&row.span(), "a row of `table_s_nm` is not two numbers".into()),
        }
    }
    if all.is_empty() {
        return bad(&rows.span(), "`table_s_nm` is empty".into());
    }
    Ok(Some(all))
}
