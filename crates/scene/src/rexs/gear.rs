//! Data of a gear and its flanks in a REXS file.

use super::{
    RexsError,
    document::{Model, Part, reference},
    shaft::material,
};

/// A gear as a scene takes it.
pub(super) struct GearData<'m, 'a> {
    pub part: Part<'m, 'a>,
    /// Below zero of a ring.
    pub teeth: i32,
    /// mm.
    pub module: f64,
    /// Degrees.
    pub helix: f64,
    /// mm.
    pub width: f64,
    /// Tip diameter and bore, mm; the bore of a ring is its outside.
    pub tip: Option<f64>,
    pub bore: Option<f64>,
    /// Normal pressure angle, degrees.
    pub angle: Option<f64>,
    pub shift: f64,
    /// Thinning of each tooth in the normal section, mm.
    pub thinning: Option<f64>,
    /// Young's modulus (MPa), Poisson's ratio, density (kg/m^3).
    pub steel: [Option<f64>; 3],
    /// Component of its flanks.
    pub flank: Option<&'a str>,
}

impl<'m, 'a> GearData<'m, 'a> {
    /// Data of a cylindrical gear or a ring.
    pub(super) fn of(model: &'m Model<'a>, part: Part<'m, 'a>) -> Result<Self, RexsError> {
        let teeth = teeth(&part)?;
        let bore = if teeth < 0 { "outer_diameter" } else { "inner_diameter" };
        let module = part.needed("normal_module", "mm")?;
        let flanks = flanks(model, part.id);
        let same = |attribute, unit| alike(&part, &flanks, attribute, unit);
        let shift = match same("addendum_modification_coefficient", "")? {
            Some(x) => Some(x),
            None => same("addendum_modification", "mm")?.map(|shift| shift / module),
        };
        let (shift, angle) = (shift.unwrap_or(0.0), same("normal_pressure_angle", "deg")?);
        Ok(Self {
            teeth,
            module,
            // Spur gears may leave it out.
            helix: part.number("helix_angle_reference_diameter", "deg")?.unwrap_or(0.0),
            width: part.needed("face_width", "mm")?,
            // Programs write diameters of rings with the standard's sign or without.
            tip: part.number("tip_diameter", "mm")?.map(f64::abs),
            bore: part.number(bore, "mm")?.filter(|d| *d != 0.0).map(f64::abs),
            thinning: thinning(&part, &flanks, (module, angle, shift))?,
            angle,
            shift,
            steel: material(model, part.id)?,
            flank: flanks.first().map(|f| f.id),
            part,
        })
    }
}

/// Teeth of a cylindrical gear, below zero of a ring: a `ring_gear`, or one whose number is below zero as the standard of
/// gear geometry has it.
fn teeth(part: &Part<'_, '_>) -> Result<i32, RexsError> {
    let value = part.needed("number_of_teeth", "")?;
    let signed = match part.component() {
        "ring_gear" => -value.abs(),
        "cylindrical_gear" => value,
        other => {
            let what = format!("is a `{other}`");
            let hint = "only pairs of cylindrical gears can be run".into();
            return Err(RexsError::Unfit { part: part.named(), what, hint });
        }
    };
    let whole = signed.fract() == 0.0 && (1.0..=f64::from(i32::MAX)).contains(&signed.abs());
    if whole { Ok(signed as i32) } else { Err(RexsError::Teeth { part: part.named(), value }) }
}

/// Left and right flank of a gear, as far as the file has them.
fn flanks<'m, 'a>(model: &'m Model<'a>, gear: &str) -> Vec<Part<'m, 'a>> {
    let Some(relation) = model.relations("flank").find(|r| reference(*r, "gear") == Some(gear)) else {
        return Vec::new();
    };
    let ids = ["left", "right"].into_iter().filter_map(|role| reference(relation, role));
    ids.filter_map(|id| model.part("flank", id)).collect()
}

/// A number that both flanks have alike.
fn alike(
    gear: &Part<'_, '_>,
    flanks: &[Part<'_, '_>],
    attribute: &'static str,
    unit: &'static str,
) -> Result<Option<f64>, RexsError> {
    let values = flanks.iter().map(|f| f.number(attribute, unit)).collect::<Result<Vec<_>, _>>()?;
    let mut stated = values.into_iter().flatten();
    let first = stated.next();
    match (first, stated.next()) {
        (Some(left), Some(right)) if (left - right).abs() > 1e-9 * left.abs().max(1.0) => Err(RexsError::Unfit {
            part: gear.named(),
            what: format!("has a `{attribute}` of {left} on its left flanks and of {right} on its right ones"),
            hint: "only teeth of two like flanks can be run".into(),
        }),
        _ => Ok(first),
    }
}

/// Thinning of each tooth in the normal section, mm; the middle of a tolerance.
///
/// ```text
/// A_sn = A_W / cos alpha_n          deviations of the base tangent length
/// A_sn = 2 (x_E - x) m_n tan alpha_n     generated profile shift
/// ```
fn thinning(
    part: &Part<'_, '_>,
    flanks: &[Part<'_, '_>],
    (module, angle, shift): (f64, Option<f64>, f64),
) -> Result<Option<f64>, RexsError> {
    let angle = angle.unwrap_or(20.0).to_radians();
    let of = |attribute| part.number(attribute, "mum");
    let spans =
        [of("upper_backlash_allowance_referenced_to_span")?, of("lower_backlash_allowance_referenced_to_span")?];
    let chords = ["chordal_tooth_thickness_upper_deviation", "chordal_tooth_thickness_lower_deviation"];
    let chords = [part.number(chords[0], "mm")?, part.number(chords[1], "mm")?];
    let finished = alike(part, flanks, "addendum_modification_coefficient_after_finishing", "")?;
    Ok(match (chords, spans, finished) {
        ([Some(upper), Some(lower)], ..) => Some(-0.5 * (upper + lower)),
        (_, [Some(upper), Some(lower)], _) => Some(-0.5e-3 * (upper + lower) / angle.cos()),
        (.., Some(x)) => Some(2.0 * (shift - x) * module * angle.tan()),
        _ => None,
    })
}
