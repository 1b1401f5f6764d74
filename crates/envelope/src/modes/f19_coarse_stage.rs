//! F19: the coarse stage of the search.

use contact::{
    Pose, Vec3,
    flank::{Candidates, GapSource, contact_points},
    nodal::{LinePoints, Scene as Search, closest_points, contact_row},
};
use geometry::{GearPair, Side};
use mesh::{Extent, GroupNames, MeshedGear, StructuredOptions, generate};
use nalgebra::{Translation3, UnitQuaternion};
use rayon::prelude::*;

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 19,
    name: "coarse stage that discards contacts",
    file: "F19-coarse-stage",
    scene: scene_text!("F19-coarse-stage"),
    fails: "Boxes about flat faces, or without room for what teeth yield, leave out a contact; the pair is too soft and nobody hears of it.",
    does: "Boxes hold the curved flanks and are widened by the largest deflection, which is checked against the answer and grown.",
    naive: &[],
    look,
};

const POSES: u64 = 20_000;
/// As far as flanks of these poses may overlap, mm.
const REACH_MM: f64 = 0.2;

/// A number between 0 and 1 from two whole ones, the same on every machine (splitmix64).
fn random(seed: u64, k: u64) -> f64 {
    let mut z = seed.wrapping_mul(64).wrapping_add(k).wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// Both gears anywhere on the path of contact, apart, overlapping, tilted.
fn poses(pair: &GearPair, seed: u64) -> [Pose; 2] {
    let between = |k, most: f64| most * (2.0 * random(seed, k) - 1.0);
    let theta = pair.middle_angle(Side::Left) + between(0, 0.3);
    let about = |angle: f64| UnitQuaternion::from_axis_angle(&Vec3::z_axis(), angle);
    let centre = Translation3::new(pair.centre_distance() + between(1, 0.3), between(2, 0.3), between(3, 0.3));
    let tilt = UnitQuaternion::from_scaled_axis(Vec3::new(between(4, 5e-3), between(5, 5e-3), 0.0));
    [
        Pose::from_parts(Translation3::identity(), about(theta)),
        Pose::from_parts(centre, tilt * about(pair.wheel_angle(Side::Left, theta) + between(6, 2e-3))),
    ]
}

/// Contacts of all poses by brute force, those that the two stages miss with the reach, and without any.
fn missed(pair: &GearPair) -> Result<[usize; 3], EnvelopeError> {
    let piece = "flanks";
    let options = StructuredOptions {
        elements_profile: 2,
        elements_face: 2,
        elements_thickness: 2,
        elements_fillet: 2,
        elements_rim: 1,
        extent: Extent::Sector(1),
        ..StructuredOptions::default()
    };
    let mut patches = Vec::new();
    for gear in [&pair.pinion, &pair.wheel] {
        let mesh = generate(gear, &options).map_err(EnvelopeError::of(piece))?;
        let parts =
            MeshedGear::from_groups(mesh, &GroupNames::default(), gear.teeth()).map_err(EnvelopeError::of(piece))?;
        let surface = Box::new(gear.flank_of(Side::Left, 0));
        let faces = parts.flank(0, Side::Left).ok_or_else(|| EnvelopeError::piece(piece, "tooth 0 has none"))?;
        let patch = contact::flank::FlankPatch::new(0, surface, &parts.mesh().nodes, faces, Some, 1e-9);
        patches.push([patch.map_err(EnvelopeError::of(piece))?]);
    }
    let points = [contact_points(&patches[0][0], 3, GapSource::Smooth)];
    let trees = [Candidates::new(&patches[0]), Candidates::new(&patches[1])];
    let line = LinePoints::new();
    let search = Search {
        first: &patches[0],
        points: &points,
        second: &patches[1],
        first_tree: &trees[0],
        second_tree: &trees[1],
        source: GapSource::Smooth,
        line: &line,
    };
    let of_pose = |seed: u64| {
        let poses = poses(pair, seed);
        let all = points[0].iter().enumerate().filter_map(|(i, p)| contact_row(&search, &poses, (0, 0), i, p));
        let near: Vec<_> = all.filter(|row| row.gap.abs() <= REACH_MM).collect();
        let lost = |reach: f64| {
            let found = closest_points(&search, &poses, reach);
            near.iter().filter(|row| !found.contains(row)).count()
        };
        [near.len(), lost(REACH_MM), lost(0.0)]
    };
    let sum = |a: [usize; 3], b: [usize; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    Ok((0..POSES).into_par_iter().map(of_pose).reduce(|| [0; 3], sum))
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let pair = bench.scene(&AS_IT_IS)?.gear_pair()?;
    let [all, robust, naive] = missed(&pair)?;
    bench.at_rest(&AS_IT_IS)?;
    Ok(vec![
        Figure::new(
            format!(
                "contacts missed of {all} in {POSES} poses, misaligned ones among them; naive: boxes without reach"
            ),
            Shown::at_most(robust as f64, 0.0),
        )
        .beside(Shown::at_least(naive as f64, 1.0)),
        Figure::new("contacts of these poses by brute force", Shown::at_least(all as f64, 10_000.0)),
    ])
}
