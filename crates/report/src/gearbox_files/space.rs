//! A gearbox in space, as the script of its page draws it.

use analysis::gearbox::{GearboxResult, VibrationResult};
use gearbox::WhirlMode;
use nalgebra::Complex;
use scene::gearbox::Gearbox;
use serde::Serialize;

use super::swing_words::{first_modes, holders};
use answer::Numbers;
use export::view::{Packed, Shape};

/// Positions at most.
const FRAMES: usize = 48;
/// Digits of places and forces.
const DIGITS: usize = 6;

/// All that stands still and all that moves.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct BoxInSpace {
    shafts: Vec<ShaftInSpace>,
    gears: Vec<GearInSpace>,
    bearings: Vec<BearingInSpace>,
    frames: Vec<Frame>,
    modes: Vec<ModeInSpace>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct ShaftInSpace {
    name: String,
    /// mm.
    origin: [f64; 3],
    /// From, to, outer and inner radius, mm.
    sections: Vec<[f64; 4]>,
    /// Heights of the nodes, mm.
    nodes: Numbers,
    /// Turns a turn of the input.
    ratio: f64,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct GearInSpace {
    name: String,
    shaft: usize,
    /// Mid-plane over the shaft's origin, mm.
    position: f64,
    teeth: u32,
    /// Angle of tooth 0 with the input at its start, rad.
    angle: f64,
    /// Tooth 0.
    sector: Shape,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
struct BearingInSpace {
    name: String,
    shaft: usize,
    position: f64,
    /// Radius of the shaft in it, mm.
    radius: f64,
}

/// One position.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Frame {
    /// Angle of the input, rad.
    angle: f64,
    /// Six numbers a node, a list a shaft: mm and rad.
    shafts: Packed,
    /// Forces on the shafts, N.
    bearings: Vec<Numbers>,
}

/// A mode: real parts of all shafts, then imaginary parts.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct ModeInSpace {
    name: String,
    shafts: Packed,
}

impl BoxInSpace {
    pub(super) fn new(file: &Gearbox, result: &GearboxResult) -> Self {
        let shown = result.positions.iter().step_by(result.positions.len().div_ceil(FRAMES).max(1));
        let frames = shown.map(|p| Frame {
            angle: p.input_angle,
            shafts: Packed::new(p.shafts.iter().map(|line| line.displacements.as_flattened())),
            bearings: p.bearings.iter().map(|b| Numbers(b.force.to_vec(), DIGITS)).collect(),
        });
        let bearings = file.bearings.iter().map(|b| BearingInSpace {
            name: b.name.clone(),
            shaft: b.shaft,
            position: b.position,
            radius: radius_at(file, b.shaft, b.position),
        });
        Self {
            shafts: (0..file.shafts.len()).map(|i| shaft(file, result, i)).collect(),
            gears: (0..file.gears.len()).filter_map(|i| gear(file, result, i)).collect(),
            bearings: bearings.collect(),
            frames: frames.collect(),
            modes: result.vibration.iter().flat_map(|swings| modes(file, result, swings)).collect(),
        }
    }
}

fn shaft(file: &Gearbox, result: &GearboxResult, i: usize) -> ShaftInSpace {
    let own = &file.shafts[i];
    let mut from = 0.0;
    let sections = own.sections.iter().map(|s| {
        let section = [from, from + s.length, 0.5 * s.outer, 0.5 * s.inner];
        from += s.length;
        section
    });
    let sections = sections.collect();
    let nodes = result.positions.first().map_or_else(Vec::new, |p| p.shafts[i].positions.clone());
    ShaftInSpace {
        name: own.name.clone(),
        origin: own.origin,
        sections,
        nodes: Numbers(nodes, DIGITS),
        ratio: result.ratios[i],
    }
}

/// Natural motions at the lowest speed, cut into shafts; their nodes are those that stand at rest.
fn modes(file: &Gearbox, result: &GearboxResult, swings: &VibrationResult) -> Vec<ModeInSpace> {
    let counts: Vec<usize> = match result.positions.first() {
        Some(p) => p.shafts.iter().map(|line| 6 * line.positions.len()).collect(),
        None => return Vec::new(),
    };
    let cut = |values: &[f64]| {
        let mut rest = values;
        let own = counts.iter().map(move |n| {
            let (own, others) = rest.split_at((*n).min(rest.len()));
            rest = others;
            own.to_vec()
        });
        own.collect::<Vec<_>>()
    };
    let one = |(i, mode): (usize, &WhirlMode)| {
        let parts = [|c: &Complex<f64>| c.re, |c: &Complex<f64>| c.im];
        let parts = parts.map(|of| cut(&mode.shape.iter().map(of).collect::<Vec<_>>()));
        let held = holders(file, &mode.energy.strain);
        let name = format!("mode {}: {:.1} Hz, {held}", i + 1, mode.frequency / std::f64::consts::TAU);
        ModeInSpace { name, shafts: Packed::new(parts.iter().flatten().map(Vec::as_slice)) }
    };
    let all = first_modes(swings).iter().filter(|m| m.shape.len() == counts.iter().sum::<usize>());
    all.enumerate().map(one).collect()
}

/// A gear as the first mesh that it is in knows it.
fn gear(file: &Gearbox, result: &GearboxResult, i: usize) -> Option<GearInSpace> {
    let find = |(k, m): (usize, &scene::gearbox::GearboxMesh)| Some((k, m.gears.iter().position(|&g| g == i)?));
    let (mesh, end) = file.meshes.iter().enumerate().find_map(find)?;
    let exact = [&result.pairs[mesh].pinion, &result.pairs[mesh].wheel][end];
    let own = &file.gears[i];
    Some(GearInSpace {
        name: own.name.clone(),
        shaft: own.shaft,
        position: own.position,
        teeth: exact.teeth(),
        angle: result.meshes[mesh].gear_angles[end],
        sector: Shape::of_tooth(exact),
    })
}

/// Outer radius of a shaft at a height, mm.
fn radius_at(file: &Gearbox, shaft: usize, position: f64) -> f64 {
    let mut end = 0.0;
    let sections = &file.shafts[shaft].sections;
    let there = sections.iter().find(|s| {
        end += s.length;
        position <= end
    });
    there.or(sections.last()).map_or(1.0, |s| 0.5 * s.outer)
}
