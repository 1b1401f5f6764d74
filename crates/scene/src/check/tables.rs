//! Checks of tables that do not depend on others: load, contact, analysis, output.

use std::collections::HashSet;

use super::Checked;
use crate::{
    AccuracyScene, Analysis, ContactScene, FieldName, Flanks, Kind, Method, Model, Operation, OutputScene, models,
    schema::{ANALYSIS, CONTACT, LEAST_SLICES, RawAnalysis, RawContact, RawOperation, RawOutput, RawScene, Turn},
    source::Source,
    table::Choice,
};

pub(super) fn operation(s: &Source<'_>, raw: &RawOperation) -> Checked<Operation> {
    Operation::read(s, raw, f64::INFINITY)
}

pub(super) fn contact(s: &Source<'_>, raw: &RawContact, kind: Kind) -> Checked<ContactScene> {
    let method: Method = choice!(s, raw.method)?;
    let (sliced, nodal) = (method == Method::Slice, method == Method::Nodal);
    let (least, most, _) = CONTACT.whole("slices");
    // Where none are said and the pair is to be cut, its own number follows once the scene is checked.
    let slices = s.whole("slices", &raw.slices, LEAST_SLICES, least, most)?;
    let read = ContactScene::read(s, raw, f64::INFINITY)?;
    Ok(ContactScene {
        slices: sliced.then_some(slices),
        corner_contact: read.corner_contact.filter(|_| sliced),
        gap: read.gap.filter(|_| nodal),
        points_per_face_edge: read.points_per_face_edge.filter(|_| nodal),
        // What moves may part and come back on the other side.
        flanks: if kind == Kind::Dynamic && raw.flanks.is_none() { Flanks::Both } else { read.flanks },
        ..read
    })
}

pub(super) fn accuracy(s: &Source<'_>, raw: &RawScene) -> Checked<AccuracyScene> {
    raw.accuracy.as_ref().map_or_else(|| Ok(AccuracyScene::default()), |table| AccuracyScene::read(s, table.get_ref()))
}

/// `accuracy` tells whether the scene asks for one.
pub(super) fn analysis(s: &Source<'_>, raw: &RawAnalysis, accuracy: bool) -> Checked<Analysis> {
    let model: Model = match &raw.model {
        None if accuracy => Model::Auto,
        _ => choice!(s, raw.model)?,
    };
    if let (Some(word), Model::Auto, false) = (&raw.model, model, accuracy) {
        return Err(s.conflict(
            &word.span(),
            "`model = \"auto\"` takes the cheapest model that is exact enough, and no accuracy is asked for",
            "say how exact in [accuracy] (`mean_ste = \"1 %\"`), or by `--accuracy 1%`",
        ));
    }
    if let Some(word) = raw.reduction.as_ref().filter(|_| !model.has_reduced_gears() && model != Model::Auto) {
        return Err(s.conflict(
            &word.span(),
            "`reduction` belongs to `model = \"reduced\"`",
            "leave it out: this model reduces nothing",
        ));
    }
    let rung = models::Rung::of(model);
    let kind = match (&raw.kind, rung) {
        (None, Some(_)) => Kind::Dynamic,
        _ => choice!(s, raw.kind)?,
    };
    if let (Kind::Static, Some(word), Some(rung)) = (kind, &raw.kind, rung) {
        return Err(s.conflict(
            &word.span(),
            format!("the model \"{}\" is one of motion", rung.name),
            "leave `kind` out, or use `model = \"reduced\"`, \"full\" or \"iso\"",
        ));
    }
    if let (Some(word), Model::ReducedModes, Kind::Static) = (&raw.model, model, kind) {
        return Err(s.conflict(
            &word.span(),
            "`model = \"reduced+modes\"` needs `kind = \"dynamic\"`: modes are motion, and nothing moves here",
            "say `kind = \"dynamic\"` in [analysis], or use `model = \"reduced\"`: at rest both are the same",
        ));
    }
    let read = Analysis::read(s, raw, f64::INFINITY)?;
    let (low, high, _) = ANALYSIS.whole("cycles");
    Ok(Analysis {
        kind,
        model,
        reduction: read.reduction.filter(|_| model.has_reduced_gears() || model == Model::Auto),
        cycles: s.whole("cycles", &raw.cycles, if kind == Kind::Dynamic { 8 } else { 1 }, low, high)?,
        ..read
    })
}

/// Cycles of the turn that is asked for: z_1, z_2, or z_1 z_2/gcd(z_1, z_2).
pub(super) fn of_turn(
    s: &Source<'_>,
    raw: &RawAnalysis,
    analysis: Analysis,
    [pinion, wheel]: [u32; 2],
) -> Checked<Analysis> {
    let own = analysis.turn.zip(raw.turn.as_ref());
    let Some((turn, word)) = own else { return Ok(Analysis { turn: None, ..analysis }) };
    if raw.cycles.is_some() {
        let what = "`turn` and `cycles` both say how many mesh cycles are solved";
        return Err(s.conflict(&word.span(), what, "keep one of them"));
    }
    let (mut common, mut rest) = (pinion, wheel);
    while rest > 0 {
        (common, rest) = (rest, common % rest);
    }
    let cycles = match turn {
        Turn::Pinion => pinion,
        Turn::Wheel => wheel,
        Turn::Hunting => pinion / common.max(1) * wheel,
    };
    Ok(Analysis { cycles, turn: None, ..analysis })
}

pub(super) fn output(s: &Source<'_>, raw: &RawOutput) -> Checked<OutputScene> {
    let mut read = OutputScene::read(s, raw, f64::INFINITY)?;
    if raw.fields.is_none() {
        read.fields = FieldName::CHOICES.iter().map(|(_, field)| *field).collect();
    }
    let mut seen = HashSet::new();
    read.derivatives.retain(|key| seen.insert(key.clone()));
    Ok(read)
}
