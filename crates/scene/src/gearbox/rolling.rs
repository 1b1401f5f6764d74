//! Rolling bearings of a gearbox file: what the catalogue or the drawing says.

use std::ops::Range;

use toml::Spanned;

use super::{
    file::{AxialPlay, GearboxRolling, RollingKind, RollingSize, ThrustSeat},
    raw::RawBearing,
    values::{Checked, missing, needed_number},
};
use crate::{Number, Source};

/// Place of a key where it is written.
type Place = fn(&RawBearing) -> Option<Range<usize>>;

/// Keys of rolling bearings alone.
pub(super) const TYPED: &[(&str, Place)] = &[
    ("bore_mm", |r| r.bore_mm.as_ref().map(Spanned::span)),
    ("outer_diameter_mm", |r| r.outer_diameter_mm.as_ref().map(Spanned::span)),
    ("static_rating_kn", |r| r.static_rating_kn.as_ref().map(Spanned::span)),
    ("elements", |r| r.elements.as_ref().map(Spanned::span)),
    ("element_diameter_mm", |r| r.element_diameter_mm.as_ref().map(Spanned::span)),
    ("element_length_mm", |r| r.element_length_mm.as_ref().map(Spanned::span)),
    ("pitch_diameter_mm", |r| r.pitch_diameter_mm.as_ref().map(Spanned::span)),
    ("contact_angle_deg", |r| r.contact_angle_deg.as_ref().map(Spanned::span)),
    ("inner_conformity", |r| r.inner_conformity.as_ref().map(Spanned::span)),
    ("outer_conformity", |r| r.outer_conformity.as_ref().map(Spanned::span)),
    ("profile", |r| r.profile.as_ref().map(Spanned::span)),
    ("radial_clearance_um", |r| r.radial_clearance_um.as_ref().map(Spanned::span)),
    ("axial_clearance_um", |r| r.axial_clearance_um.as_ref().map(Spanned::span)),
    ("preload_n", |r| r.preload_n.as_ref().map(Spanned::span)),
    ("takes_thrust", |r| r.takes_thrust.as_ref().map(Spanned::span)),
    ("rows", |r| r.rows.as_ref().map(Spanned::span)),
    ("row_distance_mm", |r| r.row_distance_mm.as_ref().map(Spanned::span)),
    ("arrangement", |r| r.arrangement.as_ref().map(Spanned::span)),
];

const KINDS: &[(&str, RollingKind)] = &[
    ("deep-groove-ball", RollingKind::DeepGrooveBall),
    ("angular-contact-ball", RollingKind::AngularContactBall),
    ("cylindrical-roller", RollingKind::CylindricalRoller),
    ("tapered-roller", RollingKind::TaperedRoller),
];

/// Kinds that users ask for and that are not here.
const OTHERS: &[&str] = &[
    "self-aligning-ball",
    "spherical-roller",
    "toroidal-roller",
    "four-point-ball",
    "thrust-ball",
    "thrust-roller",
    "needle-roller",
    "plain",
];

/// Largest dimension of a bearing, mm.
const LARGE: f64 = 1e5;

impl RollingKind {
    fn has_balls(self) -> bool {
        matches!(self, Self::DeepGrooveBall | Self::AngularContactBall)
    }

    fn has_angle(self) -> bool {
        matches!(self, Self::AngularContactBall | Self::TaperedRoller)
    }

    /// Whether it has a use for a key.
    fn takes(self, key: &str) -> bool {
        match key {
            "inner_conformity" | "outer_conformity" => self.has_balls(),
            "element_length_mm" | "profile" => !self.has_balls(),
            "contact_angle_deg" | "axial_clearance_um" | "preload_n" | "arrangement" => self.has_angle(),
            "radial_clearance_um" => !self.has_angle(),
            _ => true,
        }
    }
}

pub(super) fn rolling(s: &Source<'_>, table: &Spanned<RawBearing>, word: &Spanned<String>) -> Checked<GearboxRolling> {
    let (raw, name) = (table.get_ref(), word.get_ref().as_str());
    if OTHERS.contains(&name) {
        let said = format!("there is no law of a \"{name}\" bearing here");
        let known = KINDS.iter().map(|k| format!("\"{}\"", k.0)).collect::<Vec<_>>().join(", ");
        return Err(s.conflict(&word.span(), said, format!("give its stiffness, or take one of {known}")));
    }
    let kind = s.one_of("type", word, KINDS)?;
    if let Some((span, key)) = TYPED.iter().filter(|k| !kind.takes(k.0)).find_map(|(key, of)| Some((of(raw)?, key))) {
        return Err(s.conflict(&span, format!("a \"{name}\" bearing has no `{key}`"), advice(key)));
    }
    let angle = match kind {
        RollingKind::AngularContactBall => [5.0, 75.0],
        RollingKind::TaperedRoller => [1.0, 60.0],
        _ => [0.0; 2],
    };
    let contact_angle = if kind.has_angle() {
        needed(s, table, "contact_angle_deg", &raw.contact_angle_deg, angle)?.to_radians()
    } else {
        0.0
    };
    let conformity = |key, value: &Number, usual| s.number(key, value, usual, 0.502, 0.7);
    let straight = s.choice("profile", &raw.profile, &[("logarithmic", false), ("straight", true)])?;
    Ok(GearboxRolling {
        kind,
        size: size(s, table, kind)?,
        contact_angle,
        conformity: [
            conformity("inner_conformity", &raw.inner_conformity, 0.52)?,
            conformity("outer_conformity", &raw.outer_conformity, 0.53)?,
        ],
        straight_rollers: straight,
        radial_clearance: 1e-3 * s.number("radial_clearance_um", &raw.radial_clearance_um, 0.0, -1e3, 1e4)?,
        axial: axial(s, raw)?,
        rows: rows(s, table, kind)?,
        seat: seat(s, raw, kind)?,
    })
}

/// What to do about a key that a kind does not take.
fn advice(key: &str) -> &'static str {
    match key {
        "radial_clearance_um" => {
            "rings with a contact angle are set along the axis: `axial_clearance_um` or `preload_n`"
        }
        "axial_clearance_um" | "preload_n" => "its play is `radial_clearance_um`, below 0 where it is pressed",
        "contact_angle_deg" => {
            "deep grooves get theirs from clearance and load, cylindrical rollers have none: leave it out"
        }
        "arrangement" => "rows without a contact angle have none: leave it out",
        _ => "leave it out",
    }
}

fn needed(
    s: &Source<'_>,
    table: &Spanned<RawBearing>,
    key: &str,
    value: &Number,
    [low, high]: [f64; 2],
) -> Checked<f64> {
    needed_number(s, table, "[[bearing]]", key, value, low, high)
}

/// Rolling elements, or what they are estimated from.
fn size(s: &Source<'_>, table: &Spanned<RawBearing>, kind: RollingKind) -> Checked<RollingSize> {
    let raw = table.get_ref();
    let stated = raw.elements.is_some() || raw.element_diameter_mm.is_some() || raw.element_length_mm.is_some();
    let bore = |least: f64| needed(s, table, "bore_mm", &raw.bore_mm, [least, LARGE]);
    let outer = |bore: f64| needed(s, table, "outer_diameter_mm", &raw.outer_diameter_mm, [1.001 * bore, LARGE]);
    if !stated {
        if let Some(pitch) = &raw.pitch_diameter_mm {
            let said = "a pitch diameter without rolling elements";
            return Err(s.conflict(&pitch.span(), said, "give `elements` and `element_diameter_mm` with it"));
        }
        if raw.bore_mm.is_none() && raw.static_rating_kn.is_none() {
            let what = "how many rolling elements a row has, or `bore_mm`, `outer_diameter_mm` and `static_rating_kn`";
            return Err(missing(s, table, "[[bearing]]", "elements", what));
        }
        let bore = bore(1e-2)?;
        let outer_diameter = outer(bore)?;
        let static_rating = 1e3 * needed(s, table, "static_rating_kn", &raw.static_rating_kn, [1e-6, 1e9])?;
        return Ok(RollingSize::Catalogue { bore, outer_diameter, static_rating });
    }
    if let Some(rating) = &raw.static_rating_kn {
        let said = "rolling elements and a static rating";
        return Err(s.conflict(&rating.span(), said, "elements are estimated from the rating: leave one of both out"));
    }
    let Some(count) = &raw.elements else {
        return Err(missing(s, table, "[[bearing]]", "elements", "how many rolling elements a row has"));
    };
    let elements = s.whole("elements", &Some(count.clone()), 0, 3, 500)?;
    let diameter = needed(s, table, "element_diameter_mm", &raw.element_diameter_mm, [1e-2, LARGE])?;
    let length = if kind.has_balls() {
        0.0
    } else {
        needed(s, table, "element_length_mm", &raw.element_length_mm, [1e-2, LARGE])?
    };
    let middle = raw.pitch_diameter_mm.is_none() && raw.bore_mm.is_some();
    let pitch_diameter = if middle {
        let bore = bore(1e-2)?;
        0.5 * (bore + outer(bore)?)
    } else {
        needed(s, table, "pitch_diameter_mm", &raw.pitch_diameter_mm, [1e-2, LARGE])?
    };
    Ok(RollingSize::Elements { elements, diameter, length, pitch_diameter })
}

fn axial(s: &Source<'_>, raw: &RawBearing) -> Checked<AxialPlay> {
    let Some(preload) = &raw.preload_n else {
        return Ok(AxialPlay::Clearance(
            1e-3 * s.number("axial_clearance_um", &raw.axial_clearance_um, 0.0, -1e3, 1e4)?,
        ));
    };
    if raw.axial_clearance_um.is_some() {
        return Err(s.conflict(&preload.span(), "a preload and an axial clearance", "rows are set by one of both"));
    }
    Ok(AxialPlay::Preload(s.number("preload_n", &raw.preload_n, 0.0, 0.0, 1e9)?))
}

/// Words of `takes_thrust`.
const THRUSTS: &[(&str, ThrustSeat)] = &[
    ("both", ThrustSeat::Held),
    ("none", ThrustSeat::Floating),
    ("+z", ThrustSeat::Shoulder(1.0)),
    ("-z", ThrustSeat::Shoulder(-1.0)),
];

/// Thrust that the seat of a bearing takes. Rows that take it one way alone say so with the same key, and are held.
fn seat(s: &Source<'_>, raw: &RawBearing, kind: RollingKind) -> Checked<ThrustSeat> {
    let one_way = kind.has_angle() && raw.arrangement.as_ref().is_none_or(|word| word.get_ref() == "tandem");
    let Some(word) = raw.takes_thrust.as_ref().filter(|_| !one_way) else { return Ok(ThrustSeat::Held) };
    let found = s.one_of("takes_thrust", word, THRUSTS)?;
    if kind == RollingKind::CylindricalRoller {
        if found == ThrustSeat::Floating {
            return Ok(ThrustSeat::Held);
        }
        let said = "cylindrical rollers that take thrust";
        return Err(s.conflict(&word.span(), said, "their ribs are not in it: say \"none\", or leave it out"));
    }
    Ok(found)
}

/// Place of each row beside the middle (mm), and which way it takes thrust.
fn rows(s: &Source<'_>, table: &Spanned<RawBearing>, kind: RollingKind) -> Checked<Vec<[f64; 2]>> {
    let raw = table.get_ref();
    let thrust = || match &raw.takes_thrust {
        Some(word) => s.one_of("takes_thrust", word, &[("+z", 1.0), ("-z", -1.0)]),
        None => Err(missing(s, table, "[[bearing]]", "takes_thrust", "\"+z\" or \"-z\": where the shaft may press")),
    };
    if s.whole("rows", &raw.rows, 1, 1, 2)? == 1 {
        let single = [
            ("row_distance_mm", raw.row_distance_mm.as_ref().map(Spanned::span)),
            ("arrangement", raw.arrangement.as_ref().map(Spanned::span)),
        ];
        if let Some((key, span)) = single.into_iter().find_map(|(key, span)| Some((key, span?))) {
            return Err(s.conflict(&span, format!("`{key}` of one row"), "say `rows = 2`, or leave it out"));
        }
        return Ok(vec![[0.0, if kind.has_angle() { thrust()? } else { 1.0 }]]);
    }
    let half = 0.5 * needed(s, table, "row_distance_mm", &raw.row_distance_mm, [1e-3, LARGE])?;
    let ways = match (&raw.arrangement, kind.has_angle()) {
        (_, false) => [1.0, 1.0],
        (None, true) => {
            let what = "\"back-to-back\", \"face-to-face\" or \"tandem\"";
            return Err(missing(s, table, "[[bearing]]", "arrangement", what));
        }
        (Some(word), true) => {
            let known = [("back-to-back", Some([1.0, -1.0])), ("face-to-face", Some([-1.0, 1.0])), ("tandem", None)];
            match (s.one_of("arrangement", word, &known)?, &raw.takes_thrust) {
                (Some(ways), _) => ways,
                (None, _) => [thrust()?; 2],
            }
        }
    };
    Ok(vec![[-half, ways[0]], [half, ways[1]]])
}
