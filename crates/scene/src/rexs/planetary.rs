//! A planetary stage of a REXS file: which shafts are sun, ring, planets, pins and carrier, and what the casing holds.
//!
//! | relation | role |
//! |---|---|
//! | `planet_shaft`, `planet_pin` | the shaft of each planet, and its pin |
//! | `central_shaft`, `planet_carrier_shaft` | shafts of sun and ring, and of the carrier |
//! | `assembly` | side plates of the carrier |
//! | `side` of a `coupling` | what turns with the carrier; a central shaft or carrier on the casing is held |
//!
//! A gearbox file writes the first planet, and the others as its copies. All is seen from the carrier.

use std::collections::BTreeSet;

use roxmltree::Node;

use super::{
    RexsError, RexsShaft,
    document::{Model, Part, reference},
    shaft::shaft_of,
};

/// The planetary stage of a file.
pub(super) struct Planetary<'m, 'a> {
    /// Shaft of each planet in the order of the file.
    pub planets: Vec<Part<'m, 'a>>,
    /// Pin of the first planet, shafts and side plates of the carrier, and all that couplings join to them.
    pub standing: Vec<Part<'m, 'a>>,
    /// Pin of the first planet.
    pub pin: Option<&'a str>,
    /// Central shaft that the casing holds; `None`: it holds the carrier.
    pub fixed: Option<&'a str>,
    /// Shafts and pins of the other planets.
    copies: BTreeSet<&'a str>,
}

/// Distance of axes that is the digits of a file, mm.
const DIGITS: f64 = 1e-2;

const COUPLINGS: [&str; 2] = ["coupling", "switchable_coupling"];

/// Whether a relation is a coupling that is engaged.
pub(super) fn is_coupling(model: &Model<'_>, relation: Node<'_, '_>) -> bool {
    let kind = COUPLINGS.iter().any(|kind| model.refers(relation, "assembly", kind));
    let part = reference(relation, "assembly").and_then(|id| model.part("coupling", id));
    kind && part.is_none_or(|part| !part.is_off("is_engaged"))
}

/// Both sides of a relation.
fn sides<'a>(relation: Node<'a, 'a>) -> [Option<&'a str>; 2] {
    [["inner_part", "side_1"], ["outer_part", "side_2"]].map(|roles| roles.iter().find_map(|r| reference(relation, r)))
}

impl<'m, 'a> Planetary<'m, 'a> {
    /// The planetary stage; `None` of a file without one.
    pub(super) fn of(model: &'m Model<'a>) -> Result<Option<Self>, RexsError> {
        let stages: Vec<Part<'m, 'a>> = model.parts("planetary_stage", "planetary stage").collect();
        let Some(stage) = stages.first() else { return Ok(None) };
        let wrong = |what: &str, hint: &str| {
            Err(RexsError::Unfit { part: stage.named(), what: what.into(), hint: hint.into() })
        };
        if stages.len() > 1 {
            return wrong(
                "is one of several: a gearbox file has one carrier",
                "export each stage in a file of its own",
            );
        }
        let shafts = |kind: &'static str| -> Vec<Part<'m, 'a>> {
            let own = model.relations(kind).filter(|r| reference(*r, "planetary_stage") == Some(stage.id));
            own.filter_map(|r| model.part("shaft", reference(r, "shaft")?)).collect()
        };
        let (planets, pins, central) = (shafts("planet_shaft"), shafts("planet_pin"), shafts("central_shaft"));
        let mut standing = shafts("planet_carrier_shaft");
        if planets.len() < 2 || standing.is_empty() {
            return wrong(
                "has no two planets, or no carrier",
                "each planet has a relation `planet_shaft`, the carrier one of `planet_carrier_shaft`",
            );
        }
        let plates = model.assemblies().filter(|r| model.refers(*r, "part", "side_plate"));
        standing.extend(plates.filter_map(|r| model.part("side plate", reference(r, "part")?)));
        let mut pin = None;
        let mut copies: BTreeSet<&str> = planets[1..].iter().map(|part| part.id).collect();
        for own in pins {
            if pin.is_none() && on_one_axis(&own, &planets[0])? {
                pin = Some(own.id);
                standing.push(own);
            } else {
                copies.insert(own.id);
            }
        }
        let turns = |id: &str| planets.iter().chain(&central).any(|own| own.id == id) || copies.contains(id);
        let joined: Vec<[Option<&str>; 2]> =
            model.relations("side").filter(|r| is_coupling(model, *r)).map(sides).collect();
        let mut at = 0;
        while let Some(own) = standing.get(at).map(|own| own.id) {
            for [a, b] in &joined {
                let other = if *a == Some(own) { *b } else { a.filter(|_| *b == Some(own)) };
                let Some(other) = other.filter(|id| !turns(id)) else { continue };
                let part = model.part("shaft", other).filter(|part| part.component() == "shaft");
                if let Some(part) = part.filter(|part| standing.iter().all(|known| known.id != part.id)) {
                    standing.push(part);
                }
            }
            at += 1;
        }
        let is_casing = |id: &str| model.part("casing", id).is_some_and(|part| part.component() == "gear_casing");
        let held = |id: &str| {
            let by_casing = |[a, b]: &[Option<&str>; 2]| {
                (*a == Some(id) && b.is_some_and(is_casing)) || (*b == Some(id) && a.is_some_and(is_casing))
            };
            joined.iter().any(by_casing)
        };
        let fixed: Vec<&str> = central.iter().map(|own| own.id).filter(|id| held(id)).collect();
        let carrier_is_held = standing.iter().any(|own| held(own.id));
        match (&fixed[..], carrier_is_held) {
            ([], true) | ([_], false) => {
                let fixed = fixed.first().copied();
                Ok(Some(Self { planets, standing, pin, fixed, copies }))
            }
            ([], false) => wrong(
                "has no member that a coupling holds in the casing: differentials are not solved",
                "join sun, ring or carrier to the `gear_casing` by a `coupling`",
            ),
            _ => wrong("has several members that the casing holds", "it is locked: leave one of them"),
        }
    }

    /// Whether a shaft is a planet or a pin beyond the first.
    pub(super) fn is_copy(&self, id: &str) -> bool {
        self.copies.contains(id)
    }

    /// Gears of the other planets, and all that is theirs alone, is told by the first one.
    pub(super) fn pass_over_copies(&self, model: &Model<'a>) -> BTreeSet<&'a str> {
        let of_copy = |r: &Node<'_, '_>| reference(*r, "assembly").is_some_and(|id| self.is_copy(id));
        let parts: BTreeSet<&str> = model.assemblies().filter(of_copy).filter_map(|r| reference(r, "part")).collect();
        let is_theirs = |r: &Node<'_, '_>| {
            let ids = ["inner_part", "outer_part", "side_1", "side_2", "gear_1", "gear_2", "gear"];
            ids.iter().filter_map(|role| reference(*r, role)).any(|id| self.is_copy(id) || parts.contains(id))
        };
        let of = |kind: &'static str, roles: &'static [&'static str]| {
            let own: Vec<_> = model.relations(kind).filter(is_theirs).collect();
            own.into_iter().flat_map(move |r| roles.iter().filter_map(move |role| reference(r, role)))
        };
        let joined = of("side", &["assembly"]).chain(of("stage", &["stage"])).chain(of("flank", &["left", "right"]));
        let all: Vec<&str> = joined.chain(of("stage_gear_data", &["stage_gear_data"])).collect();
        all.into_iter()
            .chain(parts.iter().copied())
            .chain(self.copies.iter().copied())
            .for_each(|id| model.pass_over(id));
        parts
    }

    /// Whether a part stands in the frame of the carrier.
    pub(super) fn stands(&self, id: &str) -> bool {
        self.standing.iter().any(|own| own.id == id)
    }
}

/// Whether two parts have one axis.
fn on_one_axis(a: &Part<'_, '_>, b: &Part<'_, '_>) -> Result<bool, RexsError> {
    let missing = |part: &Part<'_, '_>, attribute| RexsError::Missing { part: part.named(), attribute };
    let place = |part: &Part<'_, '_>| part.vector("support_vector")?.ok_or_else(|| missing(part, "support_vector"));
    let axis = a.vector("u_axis_vector")?.ok_or_else(|| missing(a, "u_axis_vector"))?;
    let [p, q] = [place(a)?, place(b)?];
    let apart = [0, 1, 2].map(|k| q[k] - p[k]);
    let along: f64 = (0..3).map(|k| apart[k] * axis[k]).sum::<f64>() / axis.iter().map(|x| x * x).sum::<f64>();
    Ok((0..3).all(|k| (apart[k] - along * axis[k]).abs() < DIGITS))
}

/// Sections and steel of a shaft, or of a side plate.
pub(super) fn body_of(model: &Model<'_>, part: &Part<'_, '_>) -> Result<RexsShaft, RexsError> {
    if part.component() != "side_plate" {
        return shaft_of(model, part.id);
    }
    let inner = part.number("inner_diameter", "mm")?.unwrap_or(0.0);
    let section = [part.needed("length", "mm")?, part.needed("outer_diameter", "mm")?, inner];
    let [young_mpa, poisson, density_kg_m3] = super::shaft::material(model, part.id)?;
    Ok(RexsShaft { sections: vec![section], young_mpa, poisson, density_kg_m3 })
}
