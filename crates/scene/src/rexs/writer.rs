//! Writes the tables of a gearbox file from a REXS file.

use std::{collections::BTreeMap, fmt::Write};

use super::{
    RexsError, RexsPair, RexsShaft,
    bearing::{self, BEARINGS},
    document::{Model, Part, reference},
    frame::{PlacedShaft, placed},
    pair::pair_of,
    planetary::is_coupling,
    train::{Load, Train, sides},
};
use crate::Starter;

/// Mark of the comments that say which part of the REXS file a table comes from.
pub(super) const FROM: &str = "# REXS: ";
/// Centre distance of a stage against that of its shafts, mm.
const DIGITS: f64 = 1e-2;
/// Share by which loads may leave power over, as losses do, before it is told.
const BALANCED: f64 = 0.01;

/// Tables of a gearbox file, one after the other.
pub(super) struct Writer<'m, 'a> {
    pub(super) model: &'m Model<'a>,
    pub(super) train: Train<'m, 'a>,
    pub(super) shafts: Vec<RexsShaft>,
    pub(super) places: Vec<PlacedShaft<'m, 'a>>,
    /// Name of each component in the gearbox file.
    pub(super) names: BTreeMap<&'a str, String>,
    pub(super) text: String,
}

fn quoted(name: &str) -> String {
    toml::Value::String(name.to_owned()).to_string()
}

impl<'a> Writer<'_, 'a> {
    /// The name of a component: its own, with its number where others have the same or it has none.
    fn name(&mut self, part: &Part<'_, 'a>) -> String {
        if let Some(name) = self.names.get(part.id) {
            return name.clone();
        }
        let own = part.name().map(str::to_owned).filter(|name| !self.names.values().any(|n| n == name));
        let name = own.unwrap_or_else(|| part.named());
        self.names.insert(part.id, name.clone());
        name
    }

    /// A table, with the part that it comes from above it.
    fn table(&mut self, table: &str, part: &Part<'_, 'a>) {
        self.heading(&part.named(), &format!("[[{table}]]"));
    }

    /// The name of a table below the part that it comes from, which has any characters but those that end a comment.
    fn heading(&mut self, part: &str, table: &str) {
        let part: String = part.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let _ = writeln!(self.text, "\n{FROM}{part}\n{table}");
    }

    fn line(&mut self, key: &str, value: impl std::fmt::Display) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.text, "{key} = {value}");
    }

    pub(super) fn head(&mut self) {
        let program = self.model.program().map_or_else(String::new, |p| format!(" of {p}"));
        let name = quoted(&format!("REXS model{program}"));
        self.text.push_str(
            "# Written by `ale-gear init` from a REXS file. Run it: `ale-gear run FILE --out out`. All keys: docs/scene.md.\n",
        );
        self.line("name", name);
    }

    pub(super) fn shafts(&mut self) {
        for i in 0..self.shafts.len() {
            let part = self.train.shafts[i];
            let name = self.name(&part);
            self.table("shaft", &part);
            self.line("name", quoted(&name));
            let origin = self.places[i].origin;
            self.line("origin_mm", format!("{origin:?}"));
            if let Some(planetary) = &self.train.planetary {
                let (stands, fixed) = (planetary.stands(part.id), planetary.fixed == Some(part.id));
                for (key, _) in [("stands", stands), ("fixed", fixed)].into_iter().filter(|own| own.1) {
                    self.line(key, true);
                }
            }
            let own = self.shafts[i].clone();
            let stated = [("young_mpa", own.young_mpa), ("poisson", own.poisson), ("density_kg_m3", own.density_kg_m3)];
            for (key, value) in stated.into_iter().filter_map(|(key, value)| Some((key, value?))) {
                self.line(key, format!("{value:?}"));
            }
            let mut sections = own.sections;
            if self.places[i].sign < 0.0 {
                sections.reverse();
            }
            for [length, outer, inner] in sections {
                self.text.push_str("[[shaft.section]]\n");
                self.line("length_mm", format!("{length:?}"));
                self.line("outer_diameter_mm", format!("{outer:?}"));
                if inner > 0.0 {
                    self.line("inner_diameter_mm", format!("{inner:?}"));
                }
            }
        }
    }

    pub(super) fn bearings(&mut self) -> Result<Vec<String>, RexsError> {
        let mut remarks = Vec::new();
        let model = self.model;
        let stands =
            |shaft: usize| self.train.planetary.as_ref().is_some_and(|own| own.stands(self.train.shafts[shaft].id));
        let mut all = Vec::new();
        for relation in model.relations("side") {
            let couples = self.train.planetary.is_some() && is_coupling(model, relation);
            if !couples && !BEARINGS.iter().any(|kind| model.refers(relation, "assembly", kind)) {
                continue;
            }
            let part = reference(relation, "assembly").and_then(|id| model.part("bearing", id));
            let (Some(part), on) = (part, sides(relation, &self.train)) else { continue };
            let (own, seat) = match on[..] {
                [] => continue,
                [one] => (one, None),
                // Seats that turn about a carrier are in what stands.
                [inner, outer, ..] if stands(inner.0) && !stands(outer.0) => (outer, Some(inner.0)),
                [inner, outer, ..] => (inner, Some(outer.0)),
            };
            let fixed = self.train.planetary.as_ref().and_then(|own| own.fixed);
            let still = stands(own.0) || fixed == Some(self.train.shafts[own.0].id);
            if couples && !still {
                let what = "couples shafts that turn: a gearbox file has none".into();
                let hint = "make one shaft of both, or take it out".into();
                return Err(RexsError::Unfit { part: part.named(), what, hint });
            }
            all.push((part, own, seat, couples));
        }
        for (part, (shaft, side), seat, couples) in all {
            let position = self.places[shaft].position(&part, side.coordinate(), None)?;
            let (keys, remark) = if couples {
                bearing::coupling(&part, true)?
            } else {
                bearing::keys(model, &part, self.places[shaft].sign)?
            };
            remarks.extend(remark);
            let (name, on) = (self.name(&part), self.name(&self.train.shafts[shaft].clone()));
            self.table("bearing", &part);
            self.line("name", quoted(&name));
            self.line("shaft", quoted(&on));
            if let Some(seat) = seat {
                let seat = self.name(&self.train.shafts[seat].clone());
                self.line("in_shaft", quoted(&seat));
            }
            self.line("position_mm", format!("{position:?}"));
            self.text.push_str(&keys);
        }
        Ok(remarks)
    }

    /// The other planets as copies of the first.
    pub(super) fn planets(&mut self) -> Result<(), RexsError> {
        let Some(planetary) = &self.train.planetary else { return Ok(()) };
        let shafts: Vec<Part<'_, 'a>> = [&self.train.shafts[..1], &planetary.planets].concat();
        let (model, pin, carrier) = (self.model, planetary.pin, planetary.standing.first().copied());
        let Some(carrier) = carrier else { return Ok(()) };
        let axis =
            self.train.shafts.iter().position(|own| own.id == carrier.id).map_or([0.0; 3], |i| self.places[i].origin);
        let places = placed(model, &shafts, &vec![0.0; shafts.len()])?;
        let angle =
            |place: &PlacedShaft<'_, '_>| (place.origin[1] - axis[1]).atan2(place.origin[0] - axis[0]).to_degrees();
        let first = places.get(1).map_or(0.0, angle);
        // A full turn beside the first is none.
        let from_first = |place| ((angle(place) - first).rem_euclid(360.0) * 1e9).round() / 1e9 % 360.0;
        let mut angles: Vec<f64> = places[1..].iter().map(from_first).collect();
        angles[1..].sort_by(f64::total_cmp);
        let own = [Some(planetary.planets[0]), pin.and_then(|id| model.part("shaft", id))];
        let names: Vec<String> = own.into_iter().flatten().map(|part| quoted(&self.name(&part))).collect();
        let around = self.name(&carrier);
        self.heading("planets", "[[planets]]");
        self.line("shafts", format!("[{}]", names.join(", ")));
        self.line("around", quoted(&around));
        self.line("count", angles.len());
        self.line("angles_deg", format!("{angles:?}"));
        Ok(())
    }

    pub(super) fn gears(&mut self) -> Result<(), RexsError> {
        let ids: Vec<&str> = self.train.stages.iter().flat_map(|link| link.gears).collect();
        for (i, id) in ids.iter().enumerate().filter(|(i, id)| !ids[..*i].contains(id)) {
            let stage = i / 2 + 1;
            let part = self.model.part("gear", id).ok_or(RexsError::Gear { stage, role: "gear" })?;
            let shaft = self.train.gears[part.id];
            let width = part.number("face_width", "mm")?;
            let position = self.places[shaft].position(&part, "u_coordinate_on_shaft", width)?;
            let (name, on) = (self.name(&part), self.name(&self.train.shafts[shaft].clone()));
            self.table("gear", &part);
            self.line("name", quoted(&name));
            self.line("shaft", quoted(&on));
            self.line("position_mm", format!("{position:?}"));
        }
        Ok(())
    }

    /// The meshes, and the scene of each.
    pub(super) fn meshes(&mut self, stem: &str) -> Result<Vec<(String, String, RexsPair)>, RexsError> {
        let mut scenes = Vec::new();
        for k in 0..self.train.stages.len() {
            let number = self.train.stages[k].number + 1;
            let mut pair = pair_of(self.model, &self.train, number, &Starter::default())?;
            let (shafts, gears) = (self.train.stages[k].shafts, self.train.stages[k].gears);
            let [a, b] = shafts.map(|s| self.places[s].origin);
            let distance = (b[0] - a[0]).hypot(b[1] - a[1]);
            let stage = self.train.stages[k].stage.and_then(|id| self.model.part("stage", id));
            let named = stage.map_or_else(|| format!("stage {}", k + 1), |part| part.named());
            if let Some(stated) = pair.starter.centre_distance_mm.filter(|a| (a - distance).abs() > DIGITS) {
                return Err(RexsError::Unfit {
                    part: named,
                    what: format!("has a `center_distance` of {stated} mm, and its shafts are {distance} mm apart"),
                    hint: "correct one of both in the file".into(),
                });
            }
            pair.starter.centre_distance_mm = Some(distance);
            // The shafts have the gears where they are.
            pair.starter.mid_face_offset_mm = None;
            for (i, id) in gears.into_iter().enumerate() {
                self.seat(&mut pair.starter, i, (id, shafts[i]))?;
            }
            let file = format!("{stem}_stage_{}.toml", k + 1);
            let names = gears.map(|id| self.names.get(id).cloned().unwrap_or_default());
            self.heading(&named, "[[mesh]]");
            self.line("scene", quoted(&file));
            self.line("pinion", quoted(&names[0]));
            self.line("wheel", quoted(&names[1]));
            scenes.push((file.clone(), pair.starter.text(&file), pair));
        }
        Ok(scenes)
    }

    /// The bore of a gear that states none is that of its shaft, where this leaves it a rim of one module; a ring has its own
    /// default.
    fn seat(&self, starter: &mut Starter, i: usize, (id, shaft): (&str, usize)) -> Result<(), RexsError> {
        if starter.bore_diameter_mm[i].is_some() || starter.teeth[i] < 0 {
            return Ok(());
        }
        let Some(part) = self.model.part("gear", id) else { return Ok(()) };
        let own = &self.places[shaft];
        let mut at = own.position(&part, "u_coordinate_on_shaft", part.number("face_width", "mm")?)?;
        let mut sections = self.shafts[shaft].sections.clone();
        if own.sign < 0.0 {
            sections.reverse();
        }
        let here = sections.iter().find(|[length, ..]| {
            at -= length;
            at <= 0.0
        });
        let module = starter.module_mm;
        let reference = f64::from(starter.teeth[i]) * module / starter.helix_deg.to_radians().cos();
        let dedendum = starter.dedendum_coefficient.unwrap_or(1.25) - starter.profile_shift[i];
        let room = reference - 2.0 * module * (dedendum + 1.0);
        starter.bore_diameter_mm[i] = here.map(|x| x[1]).filter(|outer| *outer <= room);
        Ok(())
    }

    /// The input and the torques.
    pub(super) fn loads(&mut self) -> Result<Vec<String>, RexsError> {
        let wrong =
            |part: String, what: &str, hint: &str| Err(RexsError::Unfit { part, what: what.into(), hint: hint.into() });
        let file = || "the file".to_owned();
        if self.train.speeds.iter().any(Option::is_none) {
            return wrong(
                file(),
                "does not say how fast all shafts turn",
                "state `rotational_speed` of one shaft, in the model or in the load case; all shafts must be in mesh",
            );
        }
        let speed = |l: &Load<'_, '_>| self.train.speeds[l.shaft].unwrap_or(0.0);
        let mut each = Vec::new();
        for load in &self.train.loads {
            let Some(torque) = load.torque else {
                return wrong(
                    load.part.named(),
                    "has no `torque_around_u_axis`, and it does not follow from the other loads",
                    "state the torque of all loads but one",
                );
            };
            each.push((load.part, load.shaft, torque, torque * speed(load)));
        }
        let drives: Vec<_> = each.iter().filter(|l| l.3 > 0.0).copied().collect();
        let [input] = drives[..] else {
            let what = format!("has {} loads that drive, torque and speed of one sign", drives.len());
            return wrong(file(), &what, "a gearbox file has one input: one `external_load` drives, all others brake");
        };
        let outputs: Vec<_> = each.iter().filter(|l| l.3 < 0.0).copied().collect();
        if outputs.is_empty() {
            return wrong(file(), "has no load that brakes", "add an `external_load` where the power goes out");
        }
        let driven: f64 = outputs.iter().map(|l| -l.3).sum();
        let over = (input.3 - driven) / input.3;
        let said = || {
            format!("the loads leave {:.1} % of the power over: the input's torque follows the outputs'", 1e2 * over)
        };
        let remark = (over.abs() > BALANCED).then(said);
        let (part, shaft, _, _) = input;
        let on = self.name(&self.train.shafts[shaft].clone());
        let at = self.places[shaft].position(&part, "u_coordinate_on_shaft", None)?;
        let turns = self.train.speeds[shaft].unwrap_or(0.0);
        self.heading(&part.named(), "[input]");
        self.line("shaft", quoted(&on));
        self.line("position_mm", format!("{at:?}"));
        self.line("rotation", quoted(if turns < 0.0 { "cw" } else { "ccw" }));
        for (part, shaft, torque, _) in outputs {
            let on = self.name(&self.train.shafts[shaft].clone());
            let at = self.places[shaft].position(&part, "u_coordinate_on_shaft", None)?;
            self.table("torque", &part);
            self.line("shaft", quoted(&on));
            self.line("position_mm", format!("{at:?}"));
            self.line("torque_nm", format!("{:?}", torque.abs()));
        }
        let _ = writeln!(
            self.text,
            "\n[analysis]\n# positions_per_cycle = 32\n\n# In time, at the speed of the file:\n# [motion]\n# speed_rpm = {:?}",
            turns.abs()
        );
        Ok(remark.into_iter().collect())
    }
}
