//! Load, contact, analysis and output: tables that stand for themselves.

use super::Checked;
use crate::{
    Analysis, ContactScene, Driver, FieldName, Flanks, Gap, Kind, Method, Model, Operation, OutputScene, Reduction,
    Rotation, ladder,
    raw::{RawAnalysis, RawContact, RawOperation, RawOutput},
    schema,
    source::Source,
};

/// Slices of a pair that asks for no more, and of models that do not ask.
const LEAST_SLICES: u32 = 32;

pub(super) fn operation(s: &Source<'_>, raw: &RawOperation) -> Checked<Operation> {
    Ok(Operation {
        driver: s.choice("driver", &raw.driver, &[("pinion", Driver::Pinion), ("wheel", Driver::Wheel)])?,
        rotation: s.choice("rotation", &raw.rotation, &[("ccw", Rotation::Ccw), ("cw", Rotation::Cw)])?,
        torque_nm: s.number_of(&schema::OPERATION, "torque_nm", &raw.torque_nm)?,
        speed_rpm: s.number_of(&schema::OPERATION, "speed_rpm", &raw.speed_rpm)?,
    })
}

pub(super) fn contact(s: &Source<'_>, raw: &RawContact, kind: Kind) -> Checked<ContactScene> {
    let method = s.choice("method", &raw.method, &[("slice", Method::Slice), ("nodal", Method::Nodal)])?;
    let (sliced, nodal) = (method == Method::Slice, method == Method::Nodal);
    let (least, most, _) = schema::CONTACT.whole("slices");
    // Where none are said and the pair is to be cut, its own number follows once the scene is checked.
    let slices = s.whole("slices", &raw.slices, LEAST_SLICES, least, most)?;
    let gap = s.choice("gap", &raw.gap, &[("smooth", Gap::Smooth), ("facet", Gap::Facet)])?;
    let points = s.whole_of(&schema::CONTACT, "points_per_face_edge", &raw.points_per_face_edge)?;
    Ok(ContactScene {
        method,
        slices: sliced.then_some(slices),
        corner_contact: sliced.then_some(raw.corner_contact.as_ref().is_none_or(|c| *c.get_ref())),
        friction: s.number_of(&schema::CONTACT, "friction", &raw.friction)?,
        penalty_mpa_per_mm: s.optional_of(&schema::CONTACT, "penalty_mpa_per_mm", &raw.penalty_mpa_per_mm)?,
        gap: nodal.then_some(gap),
        points_per_face_edge: nodal.then_some(points),
        // What moves may part and come back on the other side.
        flanks: match (kind, &raw.flanks) {
            (Kind::Dynamic, None) => Flanks::Both,
            _ => s.choice("flanks", &raw.flanks, &[("driving", Flanks::Driving), ("both", Flanks::Both)])?,
        },
    })
}

pub(super) fn analysis(s: &Source<'_>, raw: &RawAnalysis) -> Checked<Analysis> {
    let models = [
        ("reduced", Model::Reduced),
        ("reduced+modes", Model::ReducedModes),
        ("full", Model::Full),
        ("iso", Model::Iso),
        ("lumped8", Model::Lumped8),
        ("lumped12", Model::Lumped12),
        ("shaft18", Model::Shaft18),
        ("impact", Model::Impact),
    ];
    let model = s.choice("model", &raw.model, &models)?;
    if let Some(word) = raw.reduction.as_ref().filter(|_| !model.is_reduced()) {
        return Err(s.conflict(
            &word.span(),
            "`reduction` belongs to `model = \"reduced\"`",
            "leave it out: this model reduces nothing",
        ));
    }
    let rung = ladder::Rung::of(model);
    let kind = match (&raw.kind, rung) {
        (None, Some(_)) => Kind::Dynamic,
        (word, _) => s.choice("kind", word, &[("static", Kind::Static), ("dynamic", Kind::Dynamic)])?,
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
    let ways = [("auto", Reduction::Auto), ("general", Reduction::General)];
    let reduction = s.choice("reduction", &raw.reduction, &ways)?;
    Ok(Analysis {
        kind,
        model,
        reduction: model.is_reduced().then_some(reduction),
        positions_per_cycle: s.whole_of(&schema::ANALYSIS, "positions_per_cycle", &raw.positions_per_cycle)?,
        cycles: {
            let (low, high, _) = schema::ANALYSIS.whole("cycles");
            s.whole("cycles", &raw.cycles, if kind == Kind::Dynamic { 8 } else { 1 }, low, high)?
        },
        window_teeth: match raw.window_teeth {
            None => None,
            Some(_) => Some(s.whole_of(&schema::ANALYSIS, "window_teeth", &raw.window_teeth)?),
        },
    })
}

pub(super) fn output(s: &Source<'_>, raw: &RawOutput) -> Checked<OutputScene> {
    const FIELDS: [(&str, FieldName); 3] =
        [("displacement", FieldName::Displacement), ("pressure", FieldName::Pressure), ("stress", FieldName::Stress)];
    let mut fields = Vec::new();
    match &raw.fields {
        None => fields.extend(FIELDS.map(|(_, field)| field)),
        Some(words) => {
            for word in words {
                let field = s.one_of("fields", word, &FIELDS)?;
                if !fields.contains(&field) {
                    fields.push(field);
                }
            }
        }
    }
    Ok(OutputScene {
        root_stress: raw.root_stress.as_ref().is_some_and(|on| *on.get_ref()),
        contact_lines: raw.contact_lines.as_ref().is_some_and(|w| *w.get_ref()),
        parquet: raw.parquet.as_ref().is_some_and(|on| *on.get_ref()),
        vtu: raw.vtu.as_ref().is_some_and(|on| *on.get_ref()),
        fields,
        vtu_every: s.whole_of(&schema::OUTPUT, "vtu_every", &raw.vtu_every)?,
    })
}
