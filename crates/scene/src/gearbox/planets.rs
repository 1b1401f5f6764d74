//! Planets of a gearbox file: the parts of the first planet stand for all planets of a stage, seen from the carrier.

use std::f64::consts::TAU;

use toml::Spanned;

use super::{
    file::{GearboxBearing, GearboxGear, GearboxMesh, GearboxPlanets, GearboxShaft, PlanetMesh},
    parts::{all, mesh_name},
    schema::{RawBearing, RawGear, RawGearbox, RawMesh, RawPlanets, RawShaft},
    values::{Checked, given, list, missing, needed_word, row},
};
use crate::{Source, Word};

/// Errors of pins at the most, um.
const ERROR: f64 = 1e4;
/// Distance from the axis below which a planet is on it, mm.
pub(super) const ON_AXIS: f64 = 1e-6;

/// The planets of one table.
pub(super) struct Group {
    /// Names of the shafts of the first planet.
    shafts: Vec<String>,
    /// Name of the shaft whose axis they stand around.
    pub around: String,
    /// Angle of each planet from the first, rad.
    pub angles: Vec<f64>,
    /// Errors of the pins along the circle and away from its centre, mm.
    errors: Vec<[f64; 2]>,
}

/// A copy: of which group, and of which of its planets.
#[derive(Clone, Copy)]
pub(super) struct Planet {
    pub group: usize,
    pub planet: usize,
}

/// Where the parts of a file come from, once its planets are written out.
pub(super) struct WrittenOut {
    pub groups: Vec<Group>,
    pub shafts: Vec<Option<Planet>>,
    bearings: Vec<Option<Planet>>,
    pub meshes: Vec<MeshInFile>,
}

/// Where a mesh comes from: its number and its name in the file.
pub(super) struct MeshInFile {
    pub planet: Option<Planet>,
    place: usize,
    name: String,
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
        if !groups.is_empty() {
            for (key, word) in [("shaft", &own.get_ref().shaft), ("in_shaft", &own.get_ref().in_shaft)] {
                word.as_ref().map(|word| known_shaft(s, &raw, key, word)).transpose()?;
            }
        }
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
                in_bore_of: numbered(&raw.in_bore_of, of_gear(&raw.in_bore_of), planet),
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
    for (place, own) in raw.mesh.iter().enumerate() {
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
            let name = mesh_name(own.get_ref());
            out.meshes.push(MeshInFile { planet: group.map(|group| Planet { group, planet }), place, name });
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

/// The name of a shaft of the file, as it is written there: copies have names that nobody wrote.
fn known_shaft(s: &Source<'_>, file: &RawGearbox, key: &str, word: &Spanned<String>) -> Checked<String> {
    let names = file.shaft.iter().filter_map(|t| Some(t.get_ref().name.as_ref()?.get_ref().as_str()));
    let known: Vec<(&str, &str)> = names.map(|name| (name, name)).collect();
    s.one_of(key, word, &known).map(str::to_owned)
}

fn group(s: &Source<'_>, table: &Spanned<RawPlanets>, file: &RawGearbox) -> Checked<Group> {
    let raw = table.get_ref();
    let known = |key: &str, word: &Spanned<String>| known_shaft(s, file, key, word);
    let Some(words) = raw.shafts.as_ref().filter(|words| !words.is_empty()) else {
        return Err(missing(s, table, "[[planets]]", "shafts", "names of the shafts of the first planet"));
    };
    let shafts = words.iter().map(|word| known("shafts", word)).collect::<Checked<Vec<_>>>()?;
    needed_word(s, table, "[[planets]]", "around", &raw.around, "the name of the shaft they stand around")?;
    let around = raw.around.as_ref().map(|word| known("around", word)).transpose()?.unwrap_or_default();
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
    let stated = list(s, "angles_deg", &raw.angles_deg, count, [-3600.0, 3600.0])?;
    if let (Some(first), Some(own)) = (stated.as_ref().map(|all| all[0]).filter(|a| *a != 0.0), &raw.angles_deg) {
        let said = format!("the first planet is {first} degrees from itself");
        return Err(s.conflict(&own.span(), said, "angles count from the first planet: begin with 0"));
    }
    let in_rad = |all: Vec<f64>| all.into_iter().map(f64::to_radians).collect();
    let angles: Vec<f64> = stated.map_or(even, in_rad);
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
    /// Whether a part of a key refers to a mesh with a given name: by its index in the file from 0, by its name, or by
    /// the name that all planets have in common.
    pub fn means(&self, which: &str, mesh: usize, name: &str) -> bool {
        let own = &self.meshes[mesh];
        let number = which.parse().ok().filter(|n| self.meshes.iter().any(|own| own.place == *n));
        number.map_or_else(|| which == name || which == own.name, |n: usize| n == own.place)
    }

    /// Numbers and names of the meshes in the file.
    pub fn mesh_names(&self) -> String {
        let first = |own: &&MeshInFile| own.planet.is_none_or(|p| p.planet == 0);
        let named = |own: &MeshInFile| format!("{} (\"{}\")", own.place, own.name);
        self.meshes.iter().filter(first).map(named).collect::<Vec<_>>().join(", ")
    }

    /// Positions the shafts and bearings of all planets.
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
            if bearing.damping[0] != bearing.damping[1] {
                let said = format!("\"{}\" is of a planet, and its damping along x and y differs", bearing.name);
                let advice = "planets stand all round: give the first two numbers of `damping_n_s_per_mm` one value";
                return Err(s.conflict(&tables[group].span(), said, advice));
            }
            bearing.turn_about(angle);
            let place = shafts[bearing.shaft].origin;
            let beside = |seat: usize, [x, y]: [f64; 2]| {
                let at = shafts[seat].origin;
                (at[0] - x).hypot(at[1] - y)
            };
            let refused = |said: String, advice: &str| Err(s.conflict(&tables[group].span(), said, advice));
            if let Some(seat) = bearing.in_shaft {
                let [own, of] = [&shafts[bearing.shaft].name, &shafts[seat].name];
                // A seat in the planet itself stands where that does.
                if self.shafts[seat].is_some() {
                    let off = beside(seat, [place[0], place[1]]);
                    if off > ON_AXIS {
                        let said = format!("\"{own}\" turns on \"{of}\", whose axis is {off:.3} mm beside its own");
                        return refused(said, "give both shafts of the planet one place across the axis (`origin_mm`)");
                    }
                    continue;
                }
                let off = beside(seat, middles[group]);
                if off > ON_AXIS {
                    let said = format!(
                        "\"{own}\" turns on \"{of}\", which is no part of the planet and {off:.3} mm beside the axis of \"{}\"",
                        self.groups[group].around
                    );
                    return refused(said, "each planet has its own pin: name it in `shafts` too");
                }
            }
            let arm = [place[0] - middles[group][0], place[1] - middles[group][1]];
            let length = arm[0].hypot(arm[1]);
            let [along, away] = self.groups[group].errors[planet];
            let [cos, sin] = arm.map(|x| x / length);
            bearing.seat_offset[0] += away * cos - along * sin;
            bearing.seat_offset[1] += away * sin + along * cos;
        }
        Ok(())
    }

    /// The planets of all tables; checks that their teeth mesh and that neighbouring planets do not touch.
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
            let first = |mesh: &usize| of_planet(&self.meshes[*mesh].planet, 0);
            let count = group.angles.len();
            // Copies of a mesh stand one after the other.
            let mesh = |mesh: usize| PlanetMesh {
                name: self.meshes[mesh].name.clone(),
                of_planets: (mesh..mesh + count).collect(),
                planet: usize::from(!of_planet(&self.shafts[gears[meshes[mesh].gears[0]].shaft], 0)),
            };
            let of_meshes = (0..meshes.len()).filter(first).map(mesh).collect();
            self.apart(s, &tables[g], g, (shafts, gears, meshes))?;
            self.go_in(s, &tables[g], g, (shafts, gears, meshes))?;
            found.push(GearboxPlanets {
                name: group.shafts[0].clone(),
                meshes: of_meshes,
                angles: group.angles.clone(),
            });
        }
        Ok(found)
    }
}
