//! Rolling bearings of a gearbox file, from catalogue or drawing data.

use std::ops::Range;

use toml::Spanned;

use super::{
    designation::{Designation, Unknown, designation},
    file::{AxialPlay, GearboxRolling, RollingSize, ThrustSeat},
    schema::{Arrangement, BEARING, RawBearing, RollerProfile, RollingKind, Thrust},
    values::{Checked, given, missing, needed_number, needed_of, row},
};
use crate::{Number, Source};

/// Place of a key where it is written.
type Place = fn(&RawBearing) -> Option<Range<usize>>;

/// Keys of rolling bearings alone.
pub(super) const TYPED: &[(&str, Place)] = &[
    ("in_bore_of", |r| r.in_bore_of.as_ref().map(Spanned::span)),
    ("bore_mm", |r| r.bore_mm.as_ref().map(Spanned::span)),
    ("outer_diameter_mm", |r| r.outer_diameter_mm.as_ref().map(Spanned::span)),
    ("static_rating_kn", |r| r.static_rating_kn.as_ref().map(Spanned::span)),
    ("dynamic_rating_kn", |r| r.dynamic_rating_kn.as_ref().map(Spanned::span)),
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
            "in_bore_of" => self == Self::CylindricalRoller,
            _ => true,
        }
    }
}

/// A bearing with rolling elements; `None` of one that says neither `type` nor `designation`.
pub(super) fn rolling(s: &Source<'_>, table: &Spanned<RawBearing>) -> Checked<Option<GearboxRolling>> {
    let raw = table.get_ref();
    let standard = raw.designation.as_ref().map(|word| of_standard(s, raw, word)).transpose()?;
    let kind = match (&standard, &raw.r#type) {
        (Some(own), _) => own.kind,
        (None, Some(word)) => kind(s, word)?,
        (None, None) => return Ok(None),
    };
    let name = word_of(kind);
    if let Some((span, key)) = TYPED.iter().filter(|k| !kind.takes(k.0)).find_map(|(key, of)| Some((of(raw)?, key))) {
        return Err(s.conflict(&span, format!("a \"{name}\" bearing has no `{key}`"), advice(key)));
    }
    let angle = match kind {
        RollingKind::AngularContactBall => [5.0, 75.0],
        RollingKind::TaperedRoller => [1.0, 60.0],
        _ => [0.0; 2],
    };
    let contact_angle_deg = match standard {
        Some(own) => own.contact_angle_deg,
        None if kind.has_angle() => needed(s, table, "contact_angle_deg", &raw.contact_angle_deg, angle)?,
        None => 0.0,
    };
    let profile: RollerProfile = s.choice_of("profile", &raw.profile)?;
    Ok(Some(GearboxRolling {
        kind,
        size: size(s, table, (kind, standard))?,
        contact_angle: contact_angle_deg.to_radians(),
        conformity: [row!(s, BEARING, raw.inner_conformity)?, row!(s, BEARING, raw.outer_conformity)?],
        straight_rollers: profile == RollerProfile::Straight,
        radial_clearance: 1e-3 * row!(s, BEARING, raw.radial_clearance_um)?,
        axial: axial(s, raw)?,
        rows: rows(s, table, kind)?,
        seat: seat(s, raw, kind)?,
        dynamic_rating: given!(s, BEARING, raw.dynamic_rating_kn)?.map(|x| 1e3 * x),
        designation: raw.designation.as_ref().map(|word| word.get_ref().clone()),
    }))
}

/// The word of a kind in the file.
fn word_of(kind: RollingKind) -> &'static str {
    let all = <RollingKind as crate::table::Choice>::CHOICES;
    all.iter().find(|(_, own)| *own == kind).map_or("rolling", |(word, _)| word)
}

/// The bearing of a designation, which stands for the keys of type and boundary dimensions.
fn of_standard(s: &Source<'_>, raw: &RawBearing, word: &Spanned<String>) -> Checked<Designation> {
    let stands_for = [
        ("type", raw.r#type.as_ref().map(Spanned::span)),
        ("bore_mm", raw.bore_mm.as_ref().map(Spanned::span)),
        ("outer_diameter_mm", raw.outer_diameter_mm.as_ref().map(Spanned::span)),
        ("contact_angle_deg", raw.contact_angle_deg.as_ref().map(Spanned::span)),
        ("rows", raw.rows.as_ref().map(Spanned::span)),
    ];
    if let Some((key, span)) = stands_for.into_iter().find_map(|(key, span)| Some((key, span?))) {
        let said = format!("`{key}` beside a designation, which says it");
        return Err(s.conflict(&span, said, "leave one of both out"));
    }
    designation(word.get_ref()).map_err(|unknown| {
        let name = word.get_ref();
        let (said, hint) = match unknown {
            Unknown::Series => (
                format!("no series of the designation \"{name}\" is known"),
                "deep groove balls 618, 619, 60, 62, 63, 64; angular contact balls 70, 72, 73; cylindrical rollers NU, NJ, \
                 NUP or N with 10, 2, 22, 3, 23, 4; tapered rollers 302, 303, 313, 320, 322, 323. For others give `type`, \
                 `bore_mm`, `outer_diameter_mm` and `static_rating_kn`"
                    .to_owned(),
            ),
            Unknown::Suffix(suffix) => (
                format!("\"{suffix}\" is no part of the basic designation in \"{name}\""),
                "leave seals, cage and clearance out; the clearance in operation is `radial_clearance_um` or \
                 `axial_clearance_um`"
                    .to_owned(),
            ),
            Unknown::Size([least, most]) => {
                (format!("no bearing \"{name}\" is known"), format!("the series goes from {least} to {most}"))
            }
            Unknown::Angle => (
                format!("\"{name}\" has no letter for its contact angle"),
                format!("write \"{name}C\" (15 degrees), \"{name}AC\" (25), \"{name}A\" (30) or \"{name}B\" (40)"),
            ),
        };
        s.conflict(&word.span(), said, hint)
    })
}

/// The kind that a word says.
fn kind(s: &Source<'_>, word: &Spanned<String>) -> Checked<RollingKind> {
    let name = word.get_ref().as_str();
    if OTHERS.contains(&name) {
        let said = format!("there is no law of a \"{name}\" bearing here");
        let known = <RollingKind as crate::table::Choice>::WORDS
            .iter()
            .map(|word| format!("\"{word}\""))
            .collect::<Vec<_>>()
            .join(", ");
        return Err(s.conflict(&word.span(), said, format!("give its stiffness, or take one of {known}")));
    }
    s.meaning_of("type", word)
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
fn size(
    s: &Source<'_>,
    table: &Spanned<RawBearing>,
    (kind, standard): (RollingKind, Option<Designation>),
) -> Checked<RollingSize> {
    let raw = table.get_ref();
    let stated = raw.elements.is_some() || raw.element_diameter_mm.is_some() || raw.element_length_mm.is_some();
    let of_row = |key, value| needed_of(s, (table, "[[bearing]]"), &BEARING, key, value);
    let bore = |least: f64| needed(s, table, "bore_mm", &raw.bore_mm, [least, LARGE]);
    let outer = |bore: f64| needed(s, table, "outer_diameter_mm", &raw.outer_diameter_mm, [1.001 * bore, LARGE]);
    if !stated {
        if let Some(pitch) = &raw.pitch_diameter_mm {
            let said = "a pitch diameter without rolling elements";
            return Err(s.conflict(&pitch.span(), said, "give `elements` and `element_diameter_mm` with it"));
        }
        if let Some(Designation { bore, outer_diameter, width, .. }) = standard {
            return Ok(match given!(s, BEARING, raw.static_rating_kn)? {
                Some(rating) => RollingSize::Catalogue { bore, outer_diameter, static_rating: 1e3 * rating },
                None => RollingSize::Dimensions { bore, outer_diameter, width },
            });
        }
        if raw.bore_mm.is_none() && raw.static_rating_kn.is_none() {
            let what = "how many rolling elements a row has, or `bore_mm`, `outer_diameter_mm` and `static_rating_kn`";
            return Err(missing(s, table, "[[bearing]]", "elements", what));
        }
        let bore = bore(1e-2)?;
        let outer_diameter = outer(bore)?;
        let static_rating = 1e3 * of_row("static_rating_kn", &raw.static_rating_kn)?;
        return Ok(RollingSize::Catalogue { bore, outer_diameter, static_rating });
    }
    if let Some(rating) = &raw.static_rating_kn {
        let said = "rolling elements and a static rating";
        return Err(s.conflict(&rating.span(), said, "elements are estimated from the rating: leave one of both out"));
    }
    let Some(count) = &raw.elements else {
        return Err(missing(s, table, "[[bearing]]", "elements", "how many rolling elements a row has"));
    };
    let elements = s.whole_of(&BEARING, "elements", &Some(count.clone()))?;
    let diameter = of_row("element_diameter_mm", &raw.element_diameter_mm)?;
    let length = if kind.has_balls() { 0.0 } else { of_row("element_length_mm", &raw.element_length_mm)? };
    let pitch_diameter = match standard.filter(|_| raw.pitch_diameter_mm.is_none()) {
        Some(own) => 0.5 * (own.bore + own.outer_diameter),
        None if raw.pitch_diameter_mm.is_none() && raw.bore_mm.is_some() => {
            let bore = bore(1e-2)?;
            0.5 * (bore + outer(bore)?)
        }
        None => of_row("pitch_diameter_mm", &raw.pitch_diameter_mm)?,
    };
    Ok(RollingSize::Elements { elements, diameter, length, pitch_diameter })
}

fn axial(s: &Source<'_>, raw: &RawBearing) -> Checked<AxialPlay> {
    let Some(preload) = &raw.preload_n else {
        return Ok(AxialPlay::Clearance(1e-3 * row!(s, BEARING, raw.axial_clearance_um)?));
    };
    if raw.axial_clearance_um.is_some() {
        return Err(s.conflict(&preload.span(), "a preload and an axial clearance", "rows are set by one of both"));
    }
    Ok(AxialPlay::Preload(row!(s, BEARING, raw.preload_n)?))
}

/// Thrust that the seat of a bearing takes. Rows that take it one way alone say so with the same key, and are held.
fn seat(s: &Source<'_>, raw: &RawBearing, kind: RollingKind) -> Checked<ThrustSeat> {
    let one_way = kind.has_angle() && raw.arrangement.as_ref().is_none_or(|word| word.get_ref() == "tandem");
    let Some(word) = raw.takes_thrust.as_ref().filter(|_| !one_way) else { return Ok(ThrustSeat::Held) };
    let found = match s.meaning_of("takes_thrust", word)? {
        Thrust::Both => ThrustSeat::Held,
        Thrust::None => ThrustSeat::Floating,
        Thrust::Up => ThrustSeat::Shoulder(1.0),
        Thrust::Down => ThrustSeat::Shoulder(-1.0),
    };
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
    if row!(s, BEARING, raw.rows)? == 1 {
        let single = [
            ("row_distance_mm", raw.row_distance_mm.as_ref().map(Spanned::span)),
            ("arrangement", raw.arrangement.as_ref().map(Spanned::span)),
        ];
        if let Some((key, span)) = single.into_iter().find_map(|(key, span)| Some((key, span?))) {
            return Err(s.conflict(&span, format!("`{key}` of one row"), "say `rows = 2`, or leave it out"));
        }
        return Ok(vec![[0.0, if kind.has_angle() { thrust()? } else { 1.0 }]]);
    }
    let half = 0.5 * needed_of(s, (table, "[[bearing]]"), &BEARING, "row_distance_mm", &raw.row_distance_mm)?;
    let ways = match (&raw.arrangement, kind.has_angle()) {
        (_, false) => [1.0, 1.0],
        (None, true) => {
            let what = "\"back-to-back\", \"face-to-face\" or \"tandem\"";
            return Err(missing(s, table, "[[bearing]]", "arrangement", what));
        }
        (Some(word), true) => match s.meaning_of("arrangement", word)? {
            Arrangement::BackToBack => [1.0, -1.0],
            Arrangement::FaceToFace => [-1.0, 1.0],
            Arrangement::Tandem => [thrust()?; 2],
        },
    };
    Ok(vec![[-half, ways[0]], [half, ways[1]]])
}
