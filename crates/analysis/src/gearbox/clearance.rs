//! Parts of a gearbox that overlap in space. The gearbox is solved nevertheless, with a remark.

use crate::remark;
use answer::Remark;
use gearbox::{GearMesh, Structure, planet_play};
use geometry::{Gear, GearPair};
use scene::gearbox::{Gearbox, GearboxGear, GearboxSection};

/// What stands on a shaft: from and to along z of the common axes, and its radius, mm; of a ring and of a hollow shaft also that of its hole.
struct Body<'a> {
    name: &'a str,
    from: f64,
    to: f64,
    hole: f64,
    radius: f64,
    /// Of a gear.
    gear: Option<usize>,
}

/// Warnings of where gears and shafts stand.
pub(super) fn clearance_remarks(file: &Gearbox, pairs: &[GearPair]) -> Vec<Remark> {
    let exact: Vec<Option<&Gear>> = (0..file.gears.len()).map(|i| of_pairs(file, pairs, i)).collect();
    let mut said = Vec::new();
    for (i, gear) in file.gears.iter().enumerate() {
        let Some(own) = exact[i] else { continue };
        said.extend(on_shaft(file, gear, own));
        for (k, other) in file.gears.iter().enumerate().skip(i + 1).filter(|(_, g)| g.shaft == gear.shaft) {
            let Some(wide) = exact[k] else { continue };
            if (gear.position - other.position).abs() < 0.5 * (own.face_width() + wide.face_width()) {
                let shaft = &file.shafts[gear.shaft].name;
                said.push(remark::gears_at_one_place(&*gear.name, &*other.name, &**shaft));
            }
        }
    }
    let bodies: Vec<Vec<Body<'_>>> = (0..file.shafts.len()).map(|i| bodies(file, i, &exact)).collect();
    let joined = joined(file);
    for a in 0..bodies.len() {
        for b in (a + 1..bodies.len()).filter(|b| !within(file, &joined, [a, *b])) {
            said.extend(between(file, [a, b], [&bodies[a], &bodies[b]]));
        }
    }
    said
}

/// Warnings of planets whose flanks on the other side touch by errors of their pins.
pub(super) fn play_remarks(file: &Gearbox, structure: &Structure, meshes: &[GearMesh]) -> Vec<Remark> {
    let mut said = Vec::new();
    for own in &file.planets {
        for (i, a) in own.meshes.iter().enumerate() {
            for b in &own.meshes[i + 1..] {
                let play = planet_play(structure, meshes, [&a.of_planets, &b.of_planets]);
                let [lost, room] = play.unwrap_or_default();
                if lost > room {
                    said.push(remark::planets_without_play(&*own.name, lost, &*a.name, &*b.name, room));
                }
            }
        }
    }
    said
}

/// For each shaft the first one of those that bearings join it to.
fn joined(file: &Gearbox) -> Vec<usize> {
    let mut first: Vec<usize> = (0..file.shafts.len()).collect();
    for (own, seat) in file.bearings.iter().filter_map(|b| Some((b.shaft, b.in_shaft?))) {
        let [a, b] = [first[own], first[seat]];
        first.iter_mut().filter(|shaft| **shaft == a.max(b)).for_each(|shaft| *shaft = a.min(b));
    }
    first
}

/// Whether one of two shafts is made to go around the other: bearings join them, and they have one axis, or one is a
/// carrier or a pin, whose sections as tubes and rods are not its shape.
fn within(file: &Gearbox, joined: &[usize], pair: [usize; 2]) -> bool {
    let [a, b] = pair.map(|shaft| &file.shafts[shaft]);
    joined[pair[0]] == joined[pair[1]] && (a.stands || b.stands || a.origin[..2] == b.origin[..2])
}

/// A gear as the first pair that it is in knows it.
fn of_pairs<'a>(file: &Gearbox, pairs: &'a [GearPair], gear: usize) -> Option<&'a Gear> {
    let mut all = file.meshes.iter().zip(pairs);
    all.find_map(|(mesh, pair)| {
        let end = mesh.gears.iter().position(|&g| g == gear)?;
        Some([&pair.pinion, &pair.wheel][end])
    })
}

/// A gear against the ends and the diameter of its own shaft.
fn on_shaft(file: &Gearbox, gear: &GearboxGear, exact: &Gear) -> Vec<Remark> {
    let shaft = &file.shafts[gear.shaft];
    let length: f64 = shaft.sections.iter().map(|s| s.length).sum();
    let (from, to) = (gear.position - 0.5 * exact.face_width(), gear.position + 0.5 * exact.face_width());
    let mut said = Vec::new();
    let beyond = (-from).max(to - length);
    // One that is meshed in one with its part of the shaft is no part of it.
    if beyond > 0.0 && gear.seat == gear.position {
        said.push(remark::gear_beyond_shaft(&*gear.name, beyond, &*shaft.name));
    }
    let mut end = 0.0;
    let inside = shaft.sections.iter().filter(|s| {
        let begin = end;
        end += s.length;
        begin < to && from < end
    });
    let room = if exact.is_internal() { exact.tip_radius().abs() } else { exact.root_radius() };
    // A ring may sit within a hollow part.
    let around = |s: &&GearboxSection| exact.is_internal() && 0.5 * s.inner >= room;
    let thick = inside.filter(|s| !around(s)).map(|s| 0.5 * s.outer).fold(0.0, f64::max);
    if thick > room {
        said.push(remark::shaft_thicker_than_root(&*shaft.name, 2.0 * thick, &*gear.name, 2.0 * room));
    }
    said
}

fn bodies<'a>(file: &'a Gearbox, shaft: usize, exact: &[Option<&Gear>]) -> Vec<Body<'a>> {
    let own = &file.shafts[shaft];
    let mut at = own.origin[2];
    let sections = own.sections.iter().map(|s| {
        let from = at;
        at += s.length;
        Body { name: &own.name, from, to: at, hole: 0.5 * s.inner, radius: 0.5 * s.outer, gear: None }
    });
    let mut all: Vec<Body<'a>> = sections.collect();
    for (i, gear) in file.gears.iter().enumerate().filter(|(_, g)| g.shaft == shaft) {
        if let Some(exact) = exact[i] {
            let (middle, half) = (own.origin[2] + gear.position, 0.5 * exact.face_width());
            let (from, to) = (middle - half, middle + half);
            let tip = exact.tip_radius().abs();
            let [hole, radius] =
                if exact.is_internal() { [tip, 0.5 * exact.data().bore_diameter.abs()] } else { [0.0, tip] };
            all.push(Body { name: &gear.name, from, to, hole, radius, gear: Some(i) });
        }
    }
    all
}

/// The first two bodies of two shafts that reach into each other and do not mesh.
fn between(file: &Gearbox, [a, b]: [usize; 2], [of_a, of_b]: [&[Body<'_>]; 2]) -> Option<Remark> {
    let [p, q] = [a, b].map(|i| file.shafts[i].origin);
    let distance = (q[0] - p[0]).hypot(q[1] - p[1]);
    let mesh = |x: usize, y: usize| file.meshes.iter().any(|m| m.gears == [x, y] || m.gears == [y, x]);
    for one in of_a {
        for other in of_b {
            let meet = matches!((one.gear, other.gear), (Some(x), Some(y)) if mesh(x, y));
            let beside = one.from < other.to && other.from < one.to;
            // By how much they reach into each other; what stands in the hole of a ring reaches through its rim.
            let through = |ring: &Body<'_>, inner: &Body<'_>| distance + inner.radius - ring.hole;
            let rings = [through(one, other), through(other, one)];
            let reach = rings.into_iter().fold(one.radius + other.radius - distance, f64::min);
            if beside && !meet && reach > 0.0 {
                let kind = |body: &Body<'_>| if body.gear.is_some() { "gear" } else { "shaft" };
                return Some(remark::parts_collide(kind(one), one.name, kind(other), other.name, reach));
            }
        }
    }
    None
}
