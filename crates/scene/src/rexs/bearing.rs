//! Bearings of a REXS file as tables of a gearbox file.
//!
//! | `bearing_type` | `type` |
//! |---|---|
//! | `radial_grooved_ball_bearing` | `deep-groove-ball` |
//! | `angular_contact_ball_bearing` | `angular-contact-ball` |
//! | `radial_roller_bearing`, `radial_needle_roller_bearing` | `cylindrical-roller` |
//! | `radial_tapered_roller_bearing` | `tapered-roller` |
//!
//! The axial directions that they support are in `axial_force_absorption`; a `concept_bearing` is given by its
//! stiffness.

use std::fmt::Write;

use super::{
    RexsError,
    document::{Model, Part, reference},
};

/// Components that are bearings.
pub(super) const BEARINGS: &[&str] = &[
    "rolling_bearing_with_catalog_geometry",
    "rolling_bearing_with_detailed_geometry",
    "concept_bearing",
    "slide_bearing",
];

const TYPES: &[(&str, &str)] = &[
    ("radial_grooved_ball_bearing", "deep-groove-ball"),
    ("angular_contact_ball_bearing", "angular-contact-ball"),
    ("radial_roller_bearing", "cylindrical-roller"),
    ("radial_needle_roller_bearing", "cylindrical-roller"),
    ("radial_tapered_roller_bearing", "tapered-roller"),
];

/// The keys of a bearing behind its place; `sign` is -1 where the shaft's u axis is against z.
pub(super) fn keys<'a>(
    model: &Model<'a>,
    part: &Part<'_, 'a>,
    sign: f64,
) -> Result<(String, Option<String>), RexsError> {
    match part.component() {
        "concept_bearing" | "slide_bearing" => springs(part),
        _ => rolling(model, part, sign),
    }
}

fn unfit<T>(part: &Part<'_, '_>, what: String, hint: &str) -> Result<T, RexsError> {
    Err(RexsError::Unfit { part: part.named(), what, hint: hint.into() })
}

/// Whether a bearing takes the shaft's thrust along and against z; `None` where the file does not say.
fn thrust(part: &Part<'_, '_>, attribute: &'static str, sign: f64) -> Result<Option<[bool; 2]>, RexsError> {
    let turned = |ways: [bool; 2]| if sign < 0.0 { [ways[1], ways[0]] } else { ways };
    Ok(match part.text(attribute) {
        None => None,
        Some("both_directions") => Some([true, true]),
        Some("no_direction") => Some([false, false]),
        Some("positive") => Some(turned([true, false])),
        Some("negative") => Some(turned([false, true])),
        Some(other) => {
            return unfit(
                part,
                format!("has an `{attribute}` of \"{other}\""),
                "the standard has both_directions, no_direction, positive and negative",
            );
        }
    })
}

/// A coupling as a bearing of its stiffness; `turns`: whether it holds the turn as well.
pub(super) fn coupling(part: &Part<'_, '_>, turns: bool) -> Result<(String, Option<String>), RexsError> {
    let (mut t, remark) = springs(part)?;
    let turn = part.number("rotational_stiffness", "N mm / rad")?.unwrap_or(0.0);
    if turns && turn > 0.0 {
        let _ = writeln!(t, "turn_stiffness_nm_per_rad = {:?}", (1e-3 * turn).min(RIGID_TURN));
    }
    Ok((t, remark))
}

/// Stiffness (N/mm, N m/rad) beyond which a spring is rigid: round-off of what programs write for that, 1e20, is no small part
/// of shafts and teeth.
const RIGID: f64 = 1e8;
const RIGID_TURN: f64 = 1e9;

/// A bearing of a stiffness.
fn springs(part: &Part<'_, '_>) -> Result<(String, Option<String>), RexsError> {
    let radial = part.needed("radial_stiffness", "N / m")?;
    let axial = part.number("axial_stiffness", "N / m")?.unwrap_or(0.0);
    let tilt = part.number("bending_stiffness", "N mm / rad")?.unwrap_or(0.0);
    let ways = thrust(part, "axial_force_absorption", 1.0)?;
    let axial = if ways == Some([false, false]) { 0.0 } else { axial };
    let [radial, axial] = [radial, axial].map(|k| (1e-3 * k).min(RIGID));
    let mut t = format!("stiffness_n_per_mm = [{radial:?}, {radial:?}, {axial:?}]\n");
    if tilt > 0.0 {
        let tilt = (1e-3 * tilt).min(RIGID_TURN);
        let _ = writeln!(t, "tilt_stiffness_nm_per_rad = [{tilt:?}, {tilt:?}]");
    }
    let one_way = matches!(ways, Some([true, false] | [false, true])) && axial > 0.0;
    let remark = one_way.then(|| format!("{}: its axial spring holds both ways, the file has one", part.named()));
    Ok((t, remark))
}

/// A rolling bearing by bore, outer diameter and static rating.
fn rolling<'a>(model: &Model<'a>, part: &Part<'_, 'a>, sign: f64) -> Result<(String, Option<String>), RexsError> {
    let missing = |attribute| RexsError::Missing { part: part.named(), attribute };
    let word = part.text("bearing_type").ok_or_else(|| missing("bearing_type"))?;
    let Some((_, kind)) = TYPES.iter().find(|(own, _)| *own == word) else {
        let known = TYPES.iter().map(|t| t.0).collect::<Vec<_>>().join(", ");
        let hint = format!("make it a `concept_bearing` with its stiffness; there are laws of {known}");
        return unfit(part, format!("is a `{word}`, of which there is no law"), &hint);
    };
    if part.text("radial_force_absorption") == Some("false") {
        return unfit(
            part,
            "takes no radial force (`radial_force_absorption`)".into(),
            "make it a `concept_bearing` with an axial stiffness and a radial one of 0",
        );
    }
    let (bore, outer) = (part.needed("inner_diameter", "mm")?, part.needed("outer_diameter", "mm")?);
    let rating = part.first(&["radial_static_load_rating", "static_capacity"], "kN")?;
    let rating = rating.ok_or_else(|| missing("radial_static_load_rating"))?;
    let mut t = String::new();
    // Writing to a String cannot fail.
    let _ = writeln!(t, "type = \"{kind}\"");
    let _ = writeln!(t, "bore_mm = {bore:?}\nouter_diameter_mm = {outer:?}\nstatic_rating_kn = {rating:?}");
    let rows = rows(model, part);
    let two = part.number("number_of_bearing_rows", "")?.map_or(rows.len() == 2, |n| n == 2.0);
    let has_angle = matches!(*kind, "angular-contact-ball" | "tapered-roller");
    if has_angle {
        let angle = match rows.first() {
            Some(row) => row.needed("pressure_angle", "deg")?,
            None => part.needed("pressure_angle", "deg")?,
        };
        let _ = writeln!(t, "contact_angle_deg = {angle:?}");
    }
    if two {
        let apart = part.needed("distance_between_bearing_rows", "mm")?;
        let _ = writeln!(t, "rows = 2\nrow_distance_mm = {apart:?}");
    }
    clearance(&mut t, part, has_angle)?;
    let remark = axial(&mut t, part, (&rows, sign), (two, has_angle, kind))?;
    Ok((t, remark))
}

fn rows<'m, 'a>(model: &'m Model<'a>, bearing: &Part<'_, '_>) -> Vec<Part<'m, 'a>> {
    let own = |r: &roxmltree::Node<'_, '_>| {
        reference(*r, "assembly") == Some(bearing.id) && model.refers(*r, "part", "rolling_bearing_row")
    };
    let mut all: Vec<_> = model.assemblies().filter(own).collect();
    let order = |r: &roxmltree::Node<'_, '_>| r.attribute("order").and_then(|o| o.parse().ok()).unwrap_or(0.0);
    all.sort_by(|a, b| f64::total_cmp(&order(a), &order(b)));
    all.into_iter().filter_map(|r| model.part("bearing row", reference(r, "part")?)).collect()
}

/// Clearance or preload: that in operation before that after and before mounting.
fn clearance(t: &mut String, part: &Part<'_, '_>, has_angle: bool) -> Result<(), RexsError> {
    if !has_angle {
        let names = [
            "operating_radial_bearing_clearance",
            "mounted_radial_bearing_clearance",
            "radial_bearing_clearance",
            "radial_backlash",
        ];
        if let Some(play) = part.first(&names, "mum")?.filter(|x| *x != 0.0) {
            let _ = writeln!(t, "radial_clearance_um = {play:?}");
        }
        return Ok(());
    }
    let names = ["operating_axial_bearing_clearance", "mounted_axial_bearing_clearance", "axial_bearing_clearance"];
    let play = part.first(&names, "mum")?.filter(|x| *x != 0.0);
    match part.number("preload_force", "N")?.filter(|f| *f != 0.0) {
        Some(force) => {
            let _ = writeln!(t, "preload_n = {force:?}");
        }
        None => {
            let _ = play.map(|play| writeln!(t, "axial_clearance_um = {play:?}"));
        }
    }
    Ok(())
}

/// Directions in which a bearing takes thrust.
fn axial(
    t: &mut String,
    part: &Part<'_, '_>,
    (rows, sign): (&[Part<'_, '_>], f64),
    (two, has_angle, kind): (bool, bool, &str),
) -> Result<Option<String>, RexsError> {
    let ways = thrust(part, "axial_force_absorption", sign)?;
    if kind == "cylindrical-roller" {
        let has_ribs = ways.is_some_and(|w| w != [false, false]);
        let said = || format!("{}: its ribs take no thrust here (`axial_force_absorption`)", part.named());
        return Ok(has_ribs.then(said));
    }
    if two && has_angle {
        let of_rows =
            rows.iter().map(|r| thrust(r, "axial_force_absorption_of_row", sign)).collect::<Result<Vec<_>, _>>()?;
        let in_order = if sign < 0.0 { [1, 0] } else { [0, 1] };
        let of = |k: usize| of_rows.get(in_order[k]).copied().flatten();
        match [of(0), of(1)] {
            [Some([true, false]), Some([false, true])] => t.push_str("arrangement = \"back-to-back\"\n"),
            [Some([false, true]), Some([true, false])] => t.push_str("arrangement = \"face-to-face\"\n"),
            [Some([true, false]), Some([true, false])] => {
                t.push_str("arrangement = \"tandem\"\ntakes_thrust = \"+z\"\n")
            }
            [Some([false, true]), Some([false, true])] => {
                t.push_str("arrangement = \"tandem\"\ntakes_thrust = \"-z\"\n")
            }
            _ => {
                let what = "has two rows that do not say which way each takes thrust (`axial_force_absorption_of_row`)";
                return unfit(part, what.into(), "state positive or negative for each row");
            }
        }
        return Ok(None);
    }
    match ways {
        Some([true, false]) => t.push_str("takes_thrust = \"+z\"\n"),
        Some([false, true]) => t.push_str("takes_thrust = \"-z\"\n"),
        _ if has_angle => {
            let what = "is a single row with a contact angle that takes no thrust one way (`axial_force_absorption`)";
            return unfit(part, what.into(), "state positive or negative: the way in which the shaft may press");
        }
        Some([false, false]) => t.push_str("takes_thrust = \"none\"\n"),
        _ => {}
    }
    Ok(None)
}
