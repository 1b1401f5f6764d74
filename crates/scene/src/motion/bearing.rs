//! Bodies of the gears, and their bearings.

use crate::SceneError;
use crate::schema::{Axis, BearingScene, BodyScene, RawBearing, RawBody};
use crate::source::Source;
use crate::spanned::{Number, Rows};

type Checked<T> = Result<T, SceneError>;
type Span = std::ops::Range<usize>;

pub(crate) fn body(s: &Source<'_>, raw: &RawBody) -> Checked<BodyScene> {
    for word in raw.free.iter().flatten() {
        if word.get_ref() == "turn" {
            let what = "`free` lists \"turn\", which is not a choice";
            let advice = "leave it out: the driven gear's turn is always free, the driver's when a torque drives it";
            return Err(s.conflict(&word.span(), what, advice));
        }
        s.meaning_of::<Axis>("free", word)?;
    }
    let mut free: Vec<Axis> = s.choices_of("free", &raw.free)?;
    free.sort_by_key(|a| a.number());
    Ok(BodyScene { free, ..BodyScene::read(s, raw, f64::INFINITY)? })
}

/// A bearing of a gear whose coordinates `free` are free: each of them is held, and nothing else is said.
pub(crate) fn bearing(
    s: &Source<'_>,
    raw: Option<&RawBearing>,
    free: &[Axis],
    free_at: Option<Span>,
    whose: &str,
) -> Checked<BearingScene> {
    let none = RawBearing::default();
    let raw = raw.unwrap_or(&none);
    let stiffness = [
        ("stiffness_x_n_per_mm", &raw.stiffness_x_n_per_mm),
        ("stiffness_y_n_per_mm", &raw.stiffness_y_n_per_mm),
        ("stiffness_z_n_per_mm", &raw.stiffness_z_n_per_mm),
        ("stiffness_rx_nmm_per_rad", &raw.stiffness_rx_nmm_per_rad),
        ("stiffness_ry_nmm_per_rad", &raw.stiffness_ry_nmm_per_rad),
    ];
    let damping = [
        ("damping_x_ns_per_mm", &raw.damping_x_ns_per_mm),
        ("damping_y_ns_per_mm", &raw.damping_y_ns_per_mm),
        ("damping_z_ns_per_mm", &raw.damping_z_ns_per_mm),
        ("damping_rx_nmms_per_rad", &raw.damping_rx_nmms_per_rad),
        ("damping_ry_nmms_per_rad", &raw.damping_ry_nmms_per_rad),
    ];
    one_way(s, "stiffness_matrix_n_mm_rad", &raw.stiffness_matrix_n_mm_rad, &stiffness)?;
    one_way(s, "damping_matrix_ns_mm_rad", &raw.damping_matrix_ns_mm_rad, &damping)?;
    held(s, raw, [&stiffness, &damping], (free, free_at), whose)?;
    if let (true, Some(value)) = (free.is_empty(), &raw.damping_ratio) {
        let what = format!("`damping_ratio` has nothing to damp: no coordinate of the {whose} is free");
        let advice = format!("add `free` to [{whose}.body], or leave it out");
        return Err(s.conflict(&value.span(), what, advice));
    }
    let read = BearingScene::read(s, raw, f64::INFINITY)?;
    Ok(BearingScene {
        damping_ratio: read.damping_ratio.filter(|_| !free.is_empty()),
        stiffness_matrix_n_mm_rad: matrix(s, "stiffness_matrix_n_mm_rad", &raw.stiffness_matrix_n_mm_rad)?,
        damping_matrix_ns_mm_rad: matrix(s, "damping_matrix_ns_mm_rad", &raw.damping_matrix_ns_mm_rad)?,
        ..read
    })
}

/// Every free coordinate is held, and none but these.
fn held(
    s: &Source<'_>,
    raw: &RawBearing,
    [stiffness, damping]: [&[(&str, &Number); 5]; 2],
    (free, free_at): (&[Axis], Option<Span>),
    whose: &str,
) -> Checked<()> {
    let matrices = [
        ("stiffness_matrix_n_mm_rad", &raw.stiffness_matrix_n_mm_rad),
        ("damping_matrix_ns_mm_rad", &raw.damping_matrix_ns_mm_rad),
    ];
    if let Some((key, Some(matrix))) = matrices.into_iter().find(|(_, m)| m.is_some() && free.is_empty()) {
        let what = format!("`{key}` holds nothing: no coordinate of the {whose} is free");
        let advice = format!("add `free` to [{whose}.body], or leave it out");
        return Err(s.conflict(&matrix.span(), what, advice));
    }
    for (i, axis) in Axis::ALL.into_iter().enumerate() {
        let is_free = free.contains(&axis);
        for (key, value) in [stiffness[i], damping[i]] {
            if let Some(value) = value.as_ref().filter(|_| !is_free) {
                let what = format!("`{key}` holds a coordinate of the {whose} that is not free");
                let advice = format!(
                    "add \"{}\" to `free` in [{whose}.body], or leave it out",
                    <Axis as crate::table::Choice>::WORDS[i]
                );
                return Err(s.conflict(&value.span(), what, advice));
            }
        }
        if let (true, None, None, Some(span)) =
            (is_free, stiffness[i].1, &raw.stiffness_matrix_n_mm_rad, free_at.as_ref())
        {
            let what = format!(
                "\"{}\" of the {whose} is free, but no bearing holds it",
                <Axis as crate::table::Choice>::WORDS[i]
            );
            return Err(s.conflict(span, what, format!("give `{}` in [{whose}.bearing]", stiffness[i].0)));
        }
    }
    Ok(())
}

/// A matrix says it all, or single values do.
fn one_way(s: &Source<'_>, key: &str, matrix: &Rows, single: &[(&str, &Number); 5]) -> Checked<()> {
    let Some(matrix) = matrix else { return Ok(()) };
    match single.iter().find(|(_, value)| value.is_some()) {
        None => Ok(()),
        Some((other, _)) => Err(s.conflict(
            &matrix.span(),
            format!("`{key}` and `{other}` say the same thing twice"),
            "keep the matrix, or the values of the directions",
        )),
    }
}

/// Five rows of five finite numbers, symmetric, with no negative value on the diagonal.
fn matrix(s: &Source<'_>, key: &str, raw: &Rows) -> Checked<Option<[[f64; 5]; 5]>> {
    let Some(rows) = raw else { return Ok(None) };
    let bad = |span: &Span, what: &str| {
        let advice = "five rows of five numbers, in the order x, y, z, rx, ry";
        Err(s.conflict(span, format!("`{key}` {what}"), advice))
    };
    let mut all = [[0.0; 5]; 5];
    if rows.get_ref().len() != 5 {
        return bad(&rows.span(), &format!("has {} rows, not 5", rows.get_ref().len()));
    }
    for (to, row) in all.iter_mut().zip(rows.get_ref()) {
        match <[f64; 5]>::try_from(row.get_ref().as_slice()) {
            Ok(values) if values.iter().all(|v| v.is_finite()) => *to = values,
            Ok(_) => return bad(&row.span(), "contains a value that is not a number"),
            Err(_) => return bad(&row.span(), &format!("has a row of {} numbers", row.get_ref().len())),
        }
    }
    let largest = all.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
    let symmetric = (0..5).all(|i| (0..i).all(|j| (all[i][j] - all[j][i]).abs() <= 1e-9 * largest));
    if !symmetric {
        return bad(&rows.span(), "is not symmetric");
    }
    if (0..5).any(|i| all[i][i] < 0.0) {
        return bad(&rows.span(), "has a negative value on its diagonal");
    }
    Ok(Some(all))
}
