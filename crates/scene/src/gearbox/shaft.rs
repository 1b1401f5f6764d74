//! Shafts of a gearbox file: their own sections, or those of a REXS file.

use std::path::Path;

use toml::Spanned;

use super::{
    file::{GearboxSection, GearboxShaft},
    parts::{all, few},
    schema::{RawSection, RawShaft, SECTION, SHAFT},
    values::{Checked, given, missing, needed_of, needed_word, numbers, row},
};
use crate::{RexsShaft, Source, read_rexs, read_shaft, units::shown};

/// Lengths and positions at the most, mm.
const FAR: f64 = 1e6;

pub(super) fn length(shaft: &GearboxShaft) -> f64 {
    shaft.sections.iter().map(|x| x.length).sum()
}

pub(super) fn shaft(s: &Source<'_>, table: &Spanned<RawShaft>) -> Checked<GearboxShaft> {
    let raw = table.get_ref();
    let name = needed_word(s, table, "[[shaft]]", "name", &raw.name, "a name that bearings and gears call it by")?;
    few(s, "sections of a shaft", &raw.section)?;
    let read = raw.rexs.as_ref().map(|word| rexs(s, table, word)).transpose()?;
    let sections = match (&read, raw.section.is_empty()) {
        (Some(own), true) => own
            .sections
            .iter()
            .map(|[length, outer, inner]| GearboxSection { length: *length, outer: *outer, inner: *inner })
            .collect(),
        (None, false) => all(&raw.section, |t| section(s, t))?,
        (Some(_), false) => {
            let said = format!("the shaft \"{name}\" has its sections twice");
            return Err(s.conflict(&table.span(), said, "leave `rexs` or the sections out"));
        }
        (None, true) => {
            if raw.rexs_shaft.is_some() {
                return Err(missing(s, table, "[[shaft]]", "rexs", "the path of the REXS file that the shaft is in"));
            }
            let said = format!("the shaft \"{name}\" has no sections");
            let advice = "list them from its z = 0 on, each as [[shaft.section]], or name a REXS file with `rexs`";
            return Err(s.conflict(&table.span(), said, advice));
        }
    };
    let of = |get: fn(&RexsShaft) -> Option<f64>, usual: f64| read.as_ref().and_then(get).unwrap_or(usual);
    Ok(GearboxShaft {
        origin: numbers::<3>(s, "origin_mm", &raw.origin_mm, FAR)?.unwrap_or_default(),
        sections,
        young_mpa: given!(s, SHAFT, raw.young_mpa)?.unwrap_or_else(|| of(|r| r.young_mpa, 2.06e5)),
        poisson: given!(s, SHAFT, raw.poisson)?.unwrap_or_else(|| of(|r| r.poisson, 0.3)),
        density: 1e-12 * given!(s, SHAFT, raw.density_kg_m3)?.unwrap_or_else(|| of(|r| r.density_kg_m3, 7850.0)),
        held: raw.held.as_ref().is_some_and(|h| *h.get_ref()),
        stands: raw.stands.as_ref().is_some_and(|h| *h.get_ref()),
        fixed: raw.fixed.as_ref().is_some_and(|h| *h.get_ref()),
        name,
    })
}

/// The shaft of a REXS file, in what this file may state itself.
fn rexs(s: &Source<'_>, table: &Spanned<RawShaft>, word: &Spanned<String>) -> Checked<RexsShaft> {
    let path = s.file.parent().unwrap_or(Path::new("")).join(word.get_ref());
    let at = |what: String, advice: String| s.conflict(&word.span(), format!("{} {what}", path.display()), advice);
    let text = read_rexs(&path).map_err(|e| {
        let hint = match &e {
            crate::RexsError::Read(_) => "paths are relative to the gearbox file".into(),
            other => other.hint().unwrap_or_default(),
        };
        at(e.to_string(), hint)
    })?;
    let which = table.get_ref().rexs_shaft.as_ref().map(|w| w.get_ref().as_str());
    let found = read_shaft(&text, which).map_err(|e| {
        let hint = match &e {
            crate::RexsError::Shaft { .. } => Some("say which one with `rexs_shaft`: its number or its name".into()),
            other => other.hint(),
        };
        at(e.to_string(), hint.unwrap_or_default())
    })?;
    let inside = |value: f64, [low, high]: [f64; 2]| (low..=high).contains(&value);
    let lengths = found.sections.iter().flatten().all(|x| inside(*x, [0.0, FAR]));
    let stated = [(found.young_mpa, "young_mpa"), (found.poisson, "poisson"), (found.density_kg_m3, "density_kg_m3")];
    let range = |key| [SHAFT.number(key).0, SHAFT.number(key).1];
    let material = stated.into_iter().all(|(value, key)| value.is_none_or(|x| inside(x, range(key))));
    if !lengths || !material || found.sections.len() > 1000 {
        let what = "has a shaft of more than 1000 sections, of 1e6 mm, or of a material that is none";
        return Err(at(what.into(), "is it the file that was meant?".into()));
    }
    Ok(found)
}

fn section(s: &Source<'_>, table: &Spanned<RawSection>) -> Checked<GearboxSection> {
    let raw = table.get_ref();
    let of = |key, value| needed_of(s, (table, "[[shaft.section]]"), &SECTION, key, value);
    let (length, outer) = (of("length_mm", &raw.length_mm)?, of("outer_diameter_mm", &raw.outer_diameter_mm)?);
    let inner = row!(s, SECTION, raw.inner_diameter_mm)?;
    if inner >= outer {
        let said = format!("a section {} mm wide outside and {} mm inside", shown(outer), shown(inner));
        return Err(s.conflict(&table.span(), said, "the inner diameter is the smaller one; 0 is solid"));
    }
    Ok(GearboxSection { length, outer, inner })
}
