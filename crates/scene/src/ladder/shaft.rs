//! Words on shafts.

use toml::Spanned;

use super::check::list;
use super::{DiscScene, Shaft18Scene, ShaftScene};
use crate::schema::{RawDisc, RawShaft, RawShaft18, RawSupport, ShaftCoordinate};
use crate::source::Source;
use crate::spanned::{Number, Rows};
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
    Ok(Shaft18Scene {
        mass_damping_per_s: value!(s, SHAFT18, raw.mass_damping_per_s)?,
        stiffness_damping_s: value!(s, SHAFT18, raw.stiffness_damping_s)?,
        gravity_m_per_s2,
    })
}

/// The shaft of a gear; `at` is the table, for what it does not say.
pub(crate) fn shaft(s: &Source<'_>, table: &Spanned<RawShaft>) -> Checked<ShaftScene> {
    let raw = table.get_ref();
    let segments_mm = segments(s, table, &raw.segments_mm)?;
    // Without the last bits of the sum: the end of the shaft is on it.
    let length = (segments_mm.iter().map(|s| s[0]).sum::<f64>() * 1e9).round() / 1e9;
    let place = |key: &str, value: &Number| s.number(key, value, 0.0, 0.0, length);
    if raw.gear_at_mm.is_none() {
        return Err(s.conflict(&table.span(), "a shaft without `gear_at_mm`", "say where on the shaft its gear sits"));
    }
    let gear_at_mm = place("gear_at_mm", &raw.gear_at_mm)?;
    let nodes_mm = list(s, "nodes_mm", &raw.nodes_mm)?;
    if let (Some(at), Some(x)) = (&raw.nodes_mm, nodes_mm.iter().find(|x| !(0.0..=length).contains(*x))) {
        let what = format!("`nodes_mm` holds {x}, which is not on a shaft of {length} mm");
        return Err(s.conflict(&at.span(), what, "places count from the beginning of the first segment"));
    }
    Ok(ShaftScene {
        segments_mm,
        gear_at_mm,
        torque_at_mm: s.number("torque_at_mm", &raw.torque_at_mm, gear_at_mm, 0.0, length)?,
        nodes_mm,
        run_out_um: value!(s, SHAFT, raw.run_out_um)?,
        run_out_phase_deg: value!(s, SHAFT, raw.run_out_phase_deg)?,
        discs: raw.discs.iter().map(|d| disc(s, d, length)).collect::<Checked<_>>()?,
        supports: raw.supports.iter().map(|b| support(s, b, length)).collect::<Checked<_>>()?,
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
    Ok(DiscScene {
        at_mm: s.number("at_mm", &raw.at_mm, 0.0, 0.0, length)?,
        mass_kg: value!(s, DISC, raw.mass_kg)?,
        polar_inertia_kg_m2: value!(s, DISC, raw.polar_inertia_kg_m2)?,
        transverse_inertia_kg_m2: value!(s, DISC, raw.transverse_inertia_kg_m2)?,
        keeps: if raw.keeps.is_some() { s.choices_of("keeps", &raw.keeps)? } else { ENDS.to_vec() },
    })
}

fn support(s: &Source<'_>, table: &Spanned<RawSupport>, length: f64) -> Checked<SupportScene> {
    let raw = table.get_ref();
    if raw.at_mm.is_none() {
        return Err(s.conflict(&table.span(), "a support without `at_mm`", "say where on the shaft it is"));
    }
    SupportScene::read(s, raw, length)
}
