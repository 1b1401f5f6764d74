//! Raw values of shafts.

use toml::Spanned;

use super::check::list;
use crate::schema::{DiscScene, RawDisc, RawShaft, RawShaft18, RawSupport, Shaft18Scene, ShaftCoordinate, ShaftScene};
use crate::source::Source;
use crate::spanned::Rows;
use crate::{SceneError, SupportScene};

type Checked<T> = Result<T, SceneError>;

/// What a disc keeps that says nothing: of a coupled end what its mass moves most.
const ENDS: [ShaftCoordinate; 3] = [ShaftCoordinate::X, ShaftCoordinate::Y, ShaftCoordinate::Rz];

pub(crate) fn shaft18(s: &Source<'_>, raw: &RawShaft18) -> Checked<Shaft18Scene> {
    let gravity = list(s, "gravity_m_per_s2", &raw.gravity_m_per_s2)?;
    let gravity_m_per_s2 = match (<[f64; 3]>::try_from(gravity.as_slice()), &raw.gravity_m_per_s2) {
        (Ok(g), _) => g,
        (Err(_), None) => [0.0; 3],
        (Err(_), Some(at)) => {
            let what = format!("`gravity_m_per_s2` has {} numbers, not 3", gravity.len());
            return Err(s.conflict(&at.span(), what, "along x, y and z, as in [0.0, -9.81, 0.0]"));
        }
    };
    Ok(Shaft18Scene { gravity_m_per_s2, ..Shaft18Scene::read(s, raw, f64::INFINITY)? })
}

/// The shaft of a gear; `at` is the table, for what it does not say.
pub(crate) fn shaft(s: &Source<'_>, table: &Spanned<RawShaft>) -> Checked<ShaftScene> {
    let raw = table.get_ref();
    let segments_mm = segments(s, table, &raw.segments_mm)?;
    // Without the last bits of the sum: the end of the shaft is on it.
    let length = (segments_mm.iter().map(|s| s[0]).sum::<f64>() * 1e9).round() / 1e9;
    if raw.gear_at_mm.is_none() {
        return Err(s.conflict(&table.span(), "a shaft without `gear_at_mm`", "say where on the shaft its gear sits"));
    }
    let read = ShaftScene::read(s, raw, length)?;
    let nodes_mm = list(s, "nodes_mm", &raw.nodes_mm)?;
    if let (Some(at), Some(x)) = (&raw.nodes_mm, nodes_mm.iter().find(|x| !(0.0..=length).contains(*x))) {
        let what = format!("`nodes_mm` holds {x}, which is not on a shaft of {length} mm");
        return Err(s.conflict(&at.span(), what, "places count from the beginning of the first segment"));
    }
    Ok(ShaftScene {
        segments_mm,
        torque_at_mm: s.number("torque_at_mm", &raw.torque_at_mm, read.gear_at_mm, 0.0, length)?,
        nodes_mm,
        discs: raw.discs.iter().map(|d| disc(s, d, length)).collect::<Checked<_>>()?,
        supports: raw.supports.iter().map(|b| support(s, b, length)).collect::<Checked<_>>()?,
        ..read
    })
}

fn segments(s: &Source<'_>, table: &Spanned<RawShaft>, raw: &Rows) -> Checked<Vec<[f64; 3]>> {
    let advice = "rows of length, outer and inner diameter, as in [[113.8, 38.5, 0.0], [96.6, 25.77, 0.0]]";
    let Some(rows) = raw.as_ref().filter(|rows| !rows.get_ref().is_empty()) else {
        return Err(s.conflict(&table.span(), "a shaft without `segments_mm`", advice));
    };
    let mut all = Vec::new();
    for row in rows.get_ref() {
        match <[f64; 3]>::try_from(row.get_ref().as_slice()) {
            Ok([length, outer, inner])
                if length > 0.0 && outer > inner && inner >= 0.0 && length < 1e6 && outer < 1e6 =>
            {
                all.push([length, outer, inner]);
            }
            _ => return Err(s.conflict(&row.span(), "a row of `segments_mm` is no length of shaft", advice)),
        }
    }
    Ok(all)
}

fn disc(s: &Source<'_>, table: &Spanned<RawDisc>, length: f64) -> Checked<DiscScene> {
    let raw = table.get_ref();
    if raw.at_mm.is_none() {
        return Err(s.conflict(&table.span(), "a disc without `at_mm`", "say where on the shaft it sits"));
    }
    let read = DiscScene::read(s, raw, length)?;
    Ok(if raw.keeps.is_some() { read } else { DiscScene { keeps: ENDS.to_vec(), ..read } })
}

fn support(s: &Source<'_>, table: &Spanned<RawSupport>, length: f64) -> Checked<SupportScene> {
    let raw = table.get_ref();
    if raw.at_mm.is_none() {
        return Err(s.conflict(&table.span(), "a support without `at_mm`", "say where on the shaft it is"));
    }
    SupportScene::read(s, raw, length)
}
