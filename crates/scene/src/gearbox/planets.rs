//! Planets of a gearbox file: parts of the first planet stand for all of a stage, seen from its carrier.

use std::f64::consts::{PI, TAU};

use toml::Spanned;

use super::{
    file::{GearboxBearing, GearboxGear, GearboxMesh, GearboxPlanets, GearboxShaft},
    parts::all,
    schema::{RawBearing, RawGear, RawGearbox, RawMesh, RawPlanets, RawShaft},
    values::{Checked, given, list, missing, needed_word, row},
};
use crate::{Source, Word};

/// Errors of pins at the most, um.
const ERROR: f64 = 1e4;
/// Distance from the axis below which a planet is on it, mm.
const ON_AXIS: f64 = 1e-6;
/// Share of a pitch by which teeth may miss each other: digits of stated angles.
const MISSED: f64 = 1e-4;

/// The planets of one table.
struct Group {
    /// Names of the shafts of the first planet.
    shafts: Vec<String>,
    /// Name of the shaft whose axis they stand around.
    around: String,
    /// Angle of each planet from the first, rad.
    angles: Vec<f64>,
    /// Errors of the pins along the circle and away from its centre, mm.
    errors: Vec<[f64; 2]>,
}

/// A copy: of which group, and of which of its planets.
#[derive(Clone, Copy)]
struct Planet {
    group: usize,
    planet: usize,
}

/// Where the parts of a file come from, once its planets are written out.
pub(super) struct WrittenOut {
    groups: Vec<Group>,
    shafts: Vec<Option<Planet>>,
    bearings: Vec<Option<Planet>>,
    /// With the name of the mesh in the file.
    meshes: Vec<(Option<Planet>, String)>,
}

/// The file with the parts of all planets in place of those of the first ones.
pub(super) fn written_out(s: &Source<'_>, raw: RawGearbox) -> Checked<(RawGearbox, WrittenOut)> {
    let groups = all(&raw.planets, |table| group(s, table, &raw))?;
    let of_shaft = |word: &Word| -> Option<usize> {
        let name = word.as_ref()?.get_ref();
        groups.iter().position(|g| g.shafts.contains(name))
    };
    let of_gear = |word: &Word| {
        let name = word.as_ref()?.get_ref();
        let gear = raw.gear.iter().find(|g| g.get_ref().name.as_ref().is_some_and(|n| n.get_ref() == name))?;
        of_shaft(&gear.get_ref().shaft)
    };
    let alone = |what: &str, table: Option<&Word>| match table.and_then(|word| Some((of_shaft(word)?, word.as_ref()?)))
    {
        Some((_, word)) => {
            let said = format!("{what} on \"{}\", which is a planet", word.get_ref());
            Err(s.conflict(&word.span(), said, "drive and load what is in the middle: sun, ring or carrier"))
        }
        None => Ok(()),
    };
    alone("the input", raw.input.as_ref().map(|t| &t.get_ref().shaft))?;
    raw.torque.iter().try_for_each(|t| alone("a torque", Some(&t.get_ref().shaft)))?;
    let mut out = WrittenOut { shafts: Vec::new(), bearings: Vec::new(), meshes: Vec::new(), groups: Vec::new() };
    let count = |group: Option<usize>| group.map_or(1, |g| groups[g].angles.len());
    let mut written =
        RawGearbox { shaft: Vec::new(), bearing: Vec::new(), gear: Vec::new(), mesh: Vec::new(), ..raw.clone() };
    for own in &raw.shaft {
        let group = of_shaft(&own.get_ref().name);
        for planet in 0..count(group) {
            let named = |raw: &RawShaft| RawShaft { name: numbered(&raw.name, group, planet), ..raw.clone() };
            written.shaft.push(copy(own, named));
            out.shafts.push(group.map(|group| Planet { group, planet }));
        }
    }
    for own in &raw.bearing {
        let (group, seat) = (of_shaft(&own.get_ref().shaft), of_shaft(&own.get_ref().in_shaft));
        if let (Some(_), true, Some(word)) = (seat, group != seat, &own.get_ref().in_shaft) {
            let said =
                format!("a bearing sits in \"{}\", which is a planet, and its shaft is none of it", word.get_ref());
            return Err(s.conflict(
                &word.span(),
                said,
                "name the planet's shaft with `shaft`, and the other one with `in_shaft`",
            ));
        }
        for planet in 0..count(group) {
            let named = |raw: &RawBearing| RawBearing {
                name: numbered(&raw.name, group, planet),
                shaft: numbered(&raw.shaft, group, planet),
                in_shaft: numbered(&raw.in_shaft, seat, planet),
                ..raw.clone()
            };
            written.bearing.push(copy(own, named));
            out.bearings.push(group.map(|group| Planet { group, planet }));
        }
    }
    for own in &raw.gear {
        let group = of_shaft(&own.get_ref().shaft);
        for planet in 0..count(group) {
            let named = |raw: &RawGear| RawGear {
                name: numbered(&raw.name, group, planet),
                shaft: numbered(&raw.shaft, group, planet),
                ..raw.clone()
            };
            written.gear.push(copy(own, named));
        }
    }
    for own in &raw.mesh {
        let of = [of_gear(&own.get_ref().pinion), of_gear(&own.get_ref().wheel)];
        let group = of[0].or(of[1]);
        if let [Some(a), Some(b)] = of
            && a != b
            && groups[a].angles.len() != groups[b].angles.len()
        {
            let said = "planets that mesh with planets are as many of each";
            return Err(s.conflict(&own.span(), said, "give both tables of [[planets]] the same `count`"));
        }
        for planet in 0..count(group) {
            let named = |raw: &RawMesh| RawMesh {
                name: numbered(&raw.name, group, planet),
                pinion: numbered(&raw.pinion, of[0], planet),
                wheel: numbered(&raw.wheel, of[1], planet),
                ..raw.clone()
            };
            written.mesh.push(copy(own, named));
            out.meshes.push((group.map(|group| Planet { group, planet }), super::check::mesh_name(own.get_ref())));
        }
    }
    out.groups = groups;
    Ok((written, out))
}

fn copy<R: Clone>(own: &Spanned<R>, named: impl Fn(&R) -> R) -> Spanned<R> {
    Spanned::new(own.span(), named(own.get_ref()))
}

/// A name with the number of its planet, where it is of one.
fn numbered(word: &Word, group: Option<usize>, planet: usize) -> Word {
    let (Some(own), Some(_)) = (word, group) else { return word.clone() };
    Some(Spanned::new(own.span(), format!("{} {}", own.get_ref(), planet + 1)))
}

fn group(s: &Source<'_>, table: &Spanned<RawPlanets>, file: &RawGearbox) -> Checked<Group> {
    let raw = table.get_ref();
    let known = |word: &Spanned<String>| -> Checked<String> {
        let names: Vec<&str> =
            file.shaft.iter().filter_map(|t| Some(t.get_ref().name.as_ref()?.get_ref().as_str())).collect();
        let known: Vec<(&str, &str)> = names.into_iter().map(|name| (name, name)).collect();
        s.one_of("shaft", word, &known).map(str::to_owned)
    };
    let Some(words) = raw.shafts.as_ref().filter(|words| !words.is_empty()) else {
        return Err(missing(s, table, "[[planets]]", "shafts", "names of the shafts of the first planet"));
    };
    let shafts = words.iter().map(known).collect::<Checked<Vec<_>>>()?;
    needed_word(s, table, "[[planets]]", "around", &raw.around, "the name of the shaft they stand around")?;
    let around = raw.around.as_ref().map(known).transpose()?.unwrap_or_default();
    let taken = |name: &String| {
        let of = |t: &Spanned<RawPlanets>| t.get_ref().shafts.iter().flatten().filter(|w| w.get_ref() == name).count();
        file.planets.iter().map(of).sum::<usize>() > 1 || *name == around
    };
    if let Some(name) = shafts.iter().find(|name| taken(name)) {
        let said = format!("\"{name}\" is in [[planets]] twice");
        return Err(s.conflict(&table.span(), said, "a shaft is part of one planet, and does not stand around itself"));
    }
    let Some(count) = given!(s, PLANETS, raw.count)? else {
        return Err(missing(s, table, "[[planets]]", "count", "how many there are"));
    };
    let count = count as usize;
    let even = (0..count).map(|k| TAU * k as f64 / count as f64).collect();
    let angles: Vec<f64> = match list(s, "angles_deg", &raw.angles_deg, count, [-3600.0, 3600.0])? {
        Some(stated) => stated.into_iter().map(f64::to_radians).collect(),
        None => even,
    };
    if let (Some(first), Some(own)) = (angles.first().filter(|a| **a != 0.0), &raw.angles_deg) {
        let said = format!("the first planet is {} degrees from itself", first.to_degrees());
        return Err(s.conflict(&own.span(), said, "angles count from the first planet: begin with 0"));
    }
    let of = |key: &str, values| -> Checked<Vec<f64>> {
        Ok(list(s, key, values, count, [-ERROR, ERROR])?.unwrap_or_else(|| vec![0.0; count]))
    };
    let along = of("tangential_errors_um", &raw.tangential_errors_um)?;
    let away = of("radial_errors_um", &raw.radial_errors_um)?;
    let errors = along.into_iter().zip(away).map(|(t, r)| [1e-3 * t, 1e-3 * r]).collect();
    Ok(Group { shafts, around, angles, errors })
}

/// Turned about z.
fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

impl WrittenOut {
    /// What a mesh is called in the file; one that is written out has a number behind it.
    pub fn mesh_in_file(&self, mesh: usize) -> &str {
        &self.meshes[mesh].1
    }

    /// Puts shafts and bearings of all planets in their places.
    pub fn place(
        &self,
        s: &Source<'_>,
        tables: &[Spanned<RawPlanets>],
        shafts: &mut [GearboxShaft],
        bearings: &mut [GearboxBearing],
    ) -> Checked<()> {
        let middle = |group: &Group| {
            let around = shafts.iter().find(|own| own.name == group.around);
            around.map_or([0.0; 2], |own| [own.origin[0], own.origin[1]])
        };
        let middles: Vec<[f64; 2]> = self.groups.iter().map(middle).collect();
        for (own, shaft) in self.shafts.iter().zip(shafts.iter_mut()) {
            let Some(Planet { group, planet }) = *own else { continue };
            let [x, y] = middles[group];
            let arm = [shaft.origin[0] - x, shaft.origin[1] - y];
            if arm[0].hypot(arm[1]) < ON_AXIS {
                let said = format!("\"{}\" stands on the axis of \"{}\"", shaft.name, self.groups[group].around);
                return Err(s.conflict(&tables[group].span(), said, "say with `origin_mm` where the first planet is"));
            }
            if planet > 0 {
                let [dx, dy] = turned(arm, self.groups[group].angles[planet]);
                (shaft.origin[0], shaft.origin[1]) = (x + dx, y + dy);
            }
        }
        for (own, bearing) in self.bearings.iter().zip(bearings.iter_mut()) {
            let Some(Planet { group, planet }) = *own else { continue };
            let angle = self.groups[group].angles[planet];
            bearing.turn_about(angle);
            // A seat in the planet itself stands where that does.
            if bearing.in_shaft.is_some_and(|seat| self.shafts[seat].is_some()) {
                continue;
            }
            let place = shafts[bearing.shaft].origin;
            let arm = [place[0] - middles[group][0], place[1] - middles[group][1]];
            let length = arm[0].hypot(arm[1]);
            let [along, away] = self.groups[group].errors[planet];
            let [cos, sin] = arm.map(|x| x / length);
            bearing.seat_offset[0] += away * cos - along * sin;
            bearing.seat_offset[1] += away * sin + along * cos;
        }
        Ok(())
    }

    /// The planets of all tables, whose teeth go in and do not touch those of the next one.
    pub fn planets(
        &self,
        s: &Source<'_>,
        tables: &[Spanned<RawPlanets>],
        (shafts, gears, meshes): (&[GearboxShaft], &[GearboxGear], &[GearboxMesh]),
    ) -> Checked<Vec<GearboxPlanets>> {
        let mut found = Vec::new();
        for (g, group) in self.groups.iter().enumerate() {
            let of_planet =
                |own: &Option<Planet>, planet: usize| own.is_some_and(|p| p.group == g && p.planet == planet);
            let first = |mesh: &usize| of_planet(&self.meshes[*mesh].0, 0);
            let count = group.angles.len();
            // Copies of a mesh stand one after the other.
            let of_meshes: Vec<Vec<usize>> =
                (0..meshes.len()).filter(first).map(|mesh| (mesh..mesh + count).collect()).collect();
            self.apart(s, &tables[g], g, (shafts, gears, meshes))?;
            self.go_in(s, &tables[g], g, (shafts, gears, meshes))?;
            let names = of_meshes.iter().map(|own| self.meshes[own[0]].1.clone()).collect();
            found.push(GearboxPlanets {
                name: group.shafts[0].clone(),
                names,
                meshes: of_meshes,
                angles: group.angles.clone(),
            });
        }
        Ok(found)
    }

    /// That gears of two planets of a group do not touch.
    fn apart(
        &self,
        s: &Source<'_>,
        table: &Spanned<RawPlanets>,
        group: usize,
        (shafts, gears, meshes): (&[GearboxShaft], &[GearboxGear], &[GearboxMesh]),
    ) -> Checked<()> {
        let own = |shaft: usize| self.shafts[shaft].filter(|p| p.group == group);
        for (i, mesh) in meshes.iter().enumerate() {
            if self.meshes[i].0.is_none_or(|p| p.group != group || p.planet != 0) {
                continue;
            }
            let pair = mesh.scene.gear_pair()?;
            for (gear, shape) in mesh.gears.into_iter().zip([&pair.pinion, &pair.wheel]) {
                let Some(Planet { .. }) = own(gears[gear].shaft) else { continue };
                // The same gear of the other planets.
                let same = (0..gears.len()).filter(|g| {
                    own(gears[*g].shaft).is_some() && gears[*g].position == gears[gear].position && *g != gear
                });
                let place = |g: usize| shafts[gears[g].shaft].origin;
                for other in same {
                    let [a, b] = [place(gear), place(other)];
                    let apart = (b[0] - a[0]).hypot(b[1] - a[1]);
                    let tip = 2.0 * shape.tip_radius();
                    if apart <= tip && apart > ON_AXIS {
                        let said = format!(
                            "\"{}\" and \"{}\" run into each other: their axes are {apart:.3} mm apart, the tip diameter is {tip:.3} mm",
                            gears[gear].name, gears[other].name
                        );
                        return Err(s.conflict(
                            &table.span(),
                            said,
                            "fewer planets, other `angles_deg`, or smaller gears",
                        ));
                    }
                }
            }
        }
        Ok(())
    }

    /// That teeth of every planet meet gaps of all gears in the middle.
    ///
    /// ```text
    /// psi (z_a z_pb - z_b z_pa)/(2 pi gcd(z_pa, z_pb)) whole        z_b < 0 of a ring; z_p: teeth of the planet in mesh a and b
    /// ```
    fn go_in(
        &self,
        s: &Source<'_>,
        table: &Spanned<RawPlanets>,
        group: usize,
        (shafts, gears, meshes): (&[GearboxShaft], &[GearboxGear], &[GearboxMesh]),
    ) -> Checked<()> {
        let Group { around, angles, .. } = &self.groups[group];
        let Some(middle) = shafts.iter().find(|own| own.name == *around) else { return Ok(()) };
        let is_planet = |gear: usize| self.shafts[gears[gear].shaft].is_some_and(|p| p.group == group);
        let is_central = |gear: usize| {
            let at = shafts[gears[gear].shaft].origin;
            (at[0] - middle.origin[0]).hypot(at[1] - middle.origin[1]) < ON_AXIS
        };
        // Teeth of the central gear, signed, of the planet, and the name of the central gear.
        let central = |(i, mesh): (usize, &GearboxMesh)| {
            self.meshes[i].0.filter(|p| p.group == group && p.planet == 0)?;
            let planet = mesh.gears.iter().position(|g| is_planet(*g))?;
            let other = 1 - planet;
            let teeth = |k: usize| {
                let own = [&mesh.scene.pinion, &mesh.scene.wheel][k];
                let teeth = i64::from(own.teeth);
                if own.is_internal() { -teeth } else { teeth }
            };
            is_central(mesh.gears[other]).then(|| (teeth(other), teeth(planet), gears[mesh.gears[other]].name.as_str()))
        };
        let all: Vec<(i64, i64, &str)> = meshes.iter().enumerate().filter_map(central).collect();
        for (i, a) in all.iter().enumerate() {
            for b in &all[i + 1..] {
                let steps = (a.0 * b.1 - b.0 * a.1) as f64 / gcd(a.1, b.1) as f64;
                for (planet, angle) in angles.iter().enumerate() {
                    let turns = angle * steps / TAU;
                    let missed = turns - turns.round();
                    if missed.abs() > MISSED {
                        let said = format!(
                            "planet {} at {:.4} degrees does not go in: with its teeth in \"{}\" it misses those of \"{}\" by {:.2} pitches",
                            planet + 1,
                            angle.to_degrees(),
                            a.2,
                            b.2,
                            missed.abs()
                        );
                        let step = 360.0 / steps.abs();
                        let nearest = (2.0 * PI * turns.round() / steps).to_degrees();
                        let advice = format!(
                            "angles are multiples of {step:.6} degrees, the nearest is {nearest:.6} (`angles_deg`); or take other teeth"
                        );
                        return Err(s.conflict(&table.span(), said, advice));
                    }
                }
            }
        }
        Ok(())
    }
}

fn gcd(a: i64, b: i64) -> i64 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}
