//! How a bore is held.

use std::ops::Range;

use toml::Spanned;

use super::Checked;
use crate::{
    BoltsScene, BoreScene, Coupling,
    schema::{RawBolts, RawBore},
    source::Source,
    spanned::Numbers,
};

/// How the bore is held; on which part of it, the mesh says whether it has that.
pub(super) fn bore(s: &Source<'_>, table: &Spanned<RawBore>) -> Checked<BoreScene> {
    let raw = table.get_ref();
    let held_mm = heights(s, "held_mm", &raw.held_mm)?;
    let bolts = raw.bolts.as_ref().map(|bolts| of_bolts(s, bolts)).transpose()?;
    let bore = BoreScene { held_mm, bolts, ..BoreScene::read(s, raw, f64::INFINITY)? };
    let springs: [(&str, Option<Range<usize>>); 4] = [
        ("radial_n_per_mm3", raw.radial_n_per_mm3.as_ref().map(Spanned::span)),
        ("tangential_n_per_mm3", raw.tangential_n_per_mm3.as_ref().map(Spanned::span)),
        ("axial_n_per_mm3", raw.axial_n_per_mm3.as_ref().map(Spanned::span)),
        ("bolts", raw.bolts.as_ref().map(Spanned::span)),
    ];
    let stated = springs.into_iter().find_map(|(key, span)| Some((key, span?)));
    match (bore.coupling, stated) {
        (Coupling::Elastic, _) => {
            let held = bore.foundation().map(|_| bore);
            held.map_err(|e| s.conflict(&table.span(), e.to_string(), e.hint().unwrap_or_default()))
        }
        (_, None) => Ok(bore),
        (other, Some((key, span))) => Err(s.conflict(
            &span,
            format!("`{key}` is of springs under the bore, and the coupling \"{}\" has none", other.word()),
            "write `coupling = \"elastic\"`, or leave it out",
        )),
    }
}

fn of_bolts(s: &Source<'_>, table: &Spanned<RawBolts>) -> Checked<BoltsScene> {
    let raw = table.get_ref();
    if raw.count.is_none() || raw.width_mm.is_none() {
        let what = "bolts have a number and an arc of the bore that each holds";
        return Err(s.conflict(&table.span(), what, "state `count` and `width_mm`"));
    }
    if let Some(preload) = raw.preload_n.as_ref().filter(|_| !raw.opens.as_ref().is_some_and(|own| *own.get_ref())) {
        let what = "`preload_n` is of bolts that open, and these do not";
        return Err(s.conflict(&preload.span(), what, "write `opens = true`, or leave it out"));
    }
    let over_mm = heights(s, "over_mm", &raw.over_mm)?;
    let (count, width_mm) = (value!(s, BOLTS, raw.count)?, value!(s, BOLTS, raw.width_mm)?);
    Ok(BoltsScene { count, width_mm, over_mm, ..BoltsScene::read(s, raw, f64::INFINITY)? })
}

/// Two heights, the lower one first.
fn heights(s: &Source<'_>, key: &'static str, list: &Numbers) -> Checked<Option<[f64; 2]>> {
    let Some(list) = list else { return Ok(None) };
    let values = list.get_ref().iter().map(|v| s.number(key, &Some(v.clone()), 0.0, -1e6, 1e6));
    match values.collect::<Checked<Vec<_>>>()?[..] {
        [from, to] if from < to => Ok(Some([from, to])),
        _ => {
            let what = format!("`{key}` is not two heights, the lower one first");
            Err(s.conflict(&list.span(), what, format!("for example {key} = [-10.0, 4.0], mm from mid-face")))
        }
    }
}
