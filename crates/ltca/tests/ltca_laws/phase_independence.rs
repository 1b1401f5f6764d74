//! Transmission error does not know where the nodes are: every row of flank nodes moved by half an element.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]
//!
//! The structured mesh is remapped node by node: along the profile so that the first element grows to 3/2, the last
//! shrinks to 1/2 and all nodes between stand half an element lower; along the face likewise, twisted with the helix.
//! Flank nodes stay on the involute. Tolerance: 0.2 % of STE at every position.

use geometry::{Gear, Side};
use ltca::StaticOptions;
use mesh::{Extent, GroupNames, MeshedGear};
use testing::{Case, default_data, quadratic};

const PROFILE: u32 = 6;
const FACE: u32 = 6;
const POSITIONS: usize = 16;

/// 0..1 to 0..1: the knots i/n inside move by half of 1/n, mid-points between knots stay mid-points.
fn moved(part: f64, n: u32) -> f64 {
    let h = 1.0 / f64::from(n);
    if part <= h {
        1.5 * part
    } else if part >= 1.0 - h {
        1.0 - 0.5 * (1.0 - part)
    } else {
        part + 0.5 * h
    }
}

/// A point of tooth 0's section, x along its centre line, moved along the profile: a line across the tooth stays one.
fn down_the_profile(gear: &Gear, [x, y]: [f64; 2]) -> [f64; 2] {
    let p = gear.profile();
    let (form, tip) = (p.roll_form(), p.roll_tip());
    let on_flank = |u: f64| [p.radius(u) * p.half_angle(u).cos(), p.radius(u) * p.half_angle(u).sin()];
    // On the tip land and below the root form circle nothing moves.
    if x >= on_flank(tip)[0] - 1e-9 || x <= on_flank(form)[0] + 1e-9 {
        return [x, y];
    }
    let (mut low, mut high) = (form, tip);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if on_flank(middle)[0] < x { low = middle } else { high = middle }
    }
    let u = 0.5 * (low + high);
    // Arc length of an involute goes with u^2.
    let part = (tip * tip - u * u) / (tip * tip - form * form);
    let to = (tip * tip - moved(part, PROFILE) * (tip * tip - form * form)).sqrt();
    let [from, to] = [on_flank(u), on_flank(to)];
    [to[0], y * to[1] / from[1]]
}

fn shifted(gear: &Gear, old: &MeshedGear, along_profile: bool, along_face: bool) -> MeshedGear {
    let mut mesh = old.mesh().clone();
    let width = gear.face_width();
    for node in &mut mesh.nodes {
        let [x, y, z] = *node;
        let (radius, angle) = (x.hypot(y), y.atan2(x) - gear.twist() * z);
        let tooth = (angle / gear.pitch_angle()).round() * gear.pitch_angle();
        let mut own = [radius * (angle - tooth).cos(), radius * (angle - tooth).sin()];
        if along_profile {
            own = down_the_profile(gear, own);
        }
        let height = if along_face { width * (moved(z / width + 0.5, FACE) - 0.5) } else { z };
        let (sin, cos) = (tooth + gear.twist() * height).sin_cos();
        *node = [own[0] * cos - own[1] * sin, own[0] * sin + own[1] * cos, height];
    }
    MeshedGear::from_groups(mesh, &GroupNames::default(), gear.teeth()).unwrap()
}

fn ste_um(case: &Case, options: StaticOptions) -> Vec<f64> {
    let history = case.reduced(options).run(POSITIONS, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}"));
    history.positions.iter().map(|p| 1e3 * p.transmission_error).collect()
}

#[test]
fn half_an_element_changes_nothing() {
    let case = quadratic(default_data(20.0), None, 150e3, [PROFILE, 2, 4, FACE, 2], Extent::Sector(5));
    let gears = [&case.pair.pinion, &case.pair.wheel];
    // Flank nodes stay where flank nodes belong, and do move.
    let off = {
        let mesh = shifted(gears[0], &case.meshes[0], true, false);
        let flank = gears[0].flank_of(Side::Left, 0);
        let faces = mesh.flank(0, Side::Left).unwrap();
        let nodes = faces.iter().flat_map(|f| f.nodes().to_vec());
        nodes.map(|n| flank.locate(&mesh.mesh().nodes[n as usize].into()).unwrap().distance.abs()).fold(0.0, f64::max)
    };
    assert!(off < 1e-9, "a remapped flank node lies {off:e} mm off the involute");
    let before = ste_um(&case, case.slice_options());
    for (name, profile, face) in [("profile", true, false), ("face", false, true), ("both", true, true)] {
        let meshes = [0, 1].map(|i| shifted(gears[i], &case.meshes[i], profile, face));
        let other = Case { pair: case.pair.clone(), meshes, elements: case.elements, torque: case.torque };
        let after = ste_um(&other, other.slice_options());
        let changes: Vec<f64> = before.iter().zip(&after).map(|(a, b)| 100.0 * (b / a - 1.0)).collect();
        let worst = changes.iter().fold(0.0f64, |m, c| m.max(c.abs()));
        println!("moved along the {name}: {worst:.3} %; by position, %: {changes:.3?}");
        assert!(worst < 0.2, "moved along the {name}: STE changes by {worst:.3} %");
    }
}
