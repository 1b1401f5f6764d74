//! Bearings of a gearbox file: with a given stiffness, or with rolling elements.

use toml::Spanned;

use super::{
    file::GearboxBearing,
    parts::{place, shaft_called},
    rolling::{TYPED, rolling},
    schema::RawBearing,
    values::{Checked, given, list, missing, numbers, row, square},
};
use crate::Source;

pub(super) fn bearing(
    s: &Source<'_>,
    table: &Spanned<RawBearing>,
    shafts: &[(String, f64)],
    gears: &[String],
) -> Checked<GearboxBearing> {
    let raw = table.get_ref();
    let (shaft, position) = place(s, table, "[[bearing]]", (&raw.shaft, &raw.position_mm), shafts)?;
    let name = s.called(&raw.name)?.unwrap_or_else(|| format!("bearing at {position} mm of {}", shafts[shaft].0));
    let damping = numbers::<3>(s, "damping_n_s_per_mm", &raw.damping_n_s_per_mm, 1e12)?.unwrap_or_default();
    let (stiffness, rolling) = match rolling(s, table)? {
        Some(own) => {
            apart(s, raw)?;
            ([[0.0; 6]; 6], Some(own))
        }
        None => {
            if let Some((span, key)) = TYPED.iter().find_map(|(key, of)| Some((of(raw)?, *key))) {
                let said = format!("`{key}` is of a rolling bearing");
                return Err(s.conflict(
                    &span,
                    said,
                    "say which with `type` or `designation`, or give its stiffness alone",
                ));
            }
            (stiffness(s, table, &name)?, None)
        }
    };
    let in_shaft = raw.in_shaft.as_ref().map(|word| shaft_called(s, "in_shaft", word, shafts)).transpose()?;
    let known: Vec<(&str, usize)> = gears.iter().enumerate().map(|(i, name)| (name.as_str(), i)).collect();
    let in_bore_of = raw.in_bore_of.as_ref().map(|word| s.one_of("in_bore_of", word, &known)).transpose()?;
    let offset = list(s, "seat_offset_um", &raw.seat_offset_um, 3, [-1e4, 1e4])?;
    let seat_offset = offset.map_or([0.0; 3], |own| [1e-3 * own[0], 1e-3 * own[1], 1e-3 * own[2]]);
    Ok(GearboxBearing { name, shaft, position, in_shaft, in_bore_of, seat_offset, stiffness, damping, rolling })
}

/// A rolling bearing has no stiffness of its own.
fn apart(s: &Source<'_>, raw: &RawBearing) -> Checked<()> {
    let stated = [
        ("stiffness_n_per_mm", raw.stiffness_n_per_mm.as_ref().map(Spanned::span)),
        ("tilt_stiffness_nm_per_rad", raw.tilt_stiffness_nm_per_rad.as_ref().map(Spanned::span)),
        ("turn_stiffness_nm_per_rad", raw.turn_stiffness_nm_per_rad.as_ref().map(Spanned::span)),
        ("matrix_n_mm_rad", raw.matrix_n_mm_rad.as_ref().map(Spanned::span)),
    ];
    match stated.into_iter().find_map(|(key, span)| Some((key, span?))) {
        Some((key, span)) => {
            let said = format!("`{key}` of a bearing with a `type` or `designation`");
            Err(s.conflict(&span, said, "its stiffness follows the load: leave one of both out"))
        }
        None => Ok(()),
    }
}

fn stiffness(s: &Source<'_>, table: &Spanned<RawBearing>, name: &str) -> Checked<[[f64; 6]; 6]> {
    let raw = table.get_ref();
    let mut stiffness = [[0.0; 6]; 6];
    match &raw.matrix_n_mm_rad {
        Some(rows) => {
            let single = [raw.stiffness_n_per_mm.is_some(), raw.tilt_stiffness_nm_per_rad.is_some()];
            let apart = single.contains(&true) || raw.turn_stiffness_nm_per_rad.is_some();
            if apart {
                let said = format!("{name} has its stiffness twice");
                return Err(s.conflict(&rows.span(), said, "give the matrix or the single values, not both"));
            }
            let size = rows.get_ref().len();
            if size != 5 && size != 6 {
                let said = format!("{name} has a matrix of {size} rows");
                let advice = "give 6 rows for x, y, z and the turns about them, or 5 without the turn about z";
                return Err(s.conflict(&rows.span(), said, advice));
            }
            for (i, row) in square(s, table, &raw.matrix_n_mm_rad, size)?.iter().enumerate() {
                stiffness[i][..size].copy_from_slice(row);
            }
        }
        None => {
            let Some(shifts) = numbers::<3>(s, "stiffness_n_per_mm", &raw.stiffness_n_per_mm, 1e15)? else {
                let what = "a list for x, y and z, a matrix, or the `type` or `designation` of a rolling bearing";
                return Err(missing(s, table, "[[bearing]]", "stiffness_n_per_mm", what));
            };
            let tilts = numbers::<2>(s, "tilt_stiffness_nm_per_rad", &raw.tilt_stiffness_nm_per_rad, 1e15)?;
            let diagonal = shifts.into_iter().chain(tilts.unwrap_or_default().map(|t| 1e3 * t));
            diagonal.enumerate().for_each(|(i, value)| stiffness[i][i] = value);
            stiffness[5][5] = 1e3 * given!(s, BEARING, raw.turn_stiffness_nm_per_rad)?.unwrap_or(0.0);
        }
    }
    Ok(stiffness)
}
