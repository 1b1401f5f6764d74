//! Two-stage search = brute force; supports carry what they must.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use contact::{
    Pose, Vec3,
    flank::{Candidates, FlankPatch, GapSource, contact_points},
    nodal::{LinePoints, Scene, closest_points, contact_row},
};
use geometry::{GearPair, Side};
use mesh::{Extent, StructuredOptions};
use nalgebra::{Translation3, UnitQuaternion};
use proptest::prelude::*;
use rayon::prelude::*;

use testing::{Random, default_pair, structured};

struct Flanks {
    pair: GearPair,
    patches: [Vec<FlankPatch>; 2],
}

fn flanks(order: u32) -> Flanks {
    flanks_of(order, [3, 5])
}

fn flanks_of(order: u32, [profile, face]: [u32; 2]) -> Flanks {
    let pair = default_pair();
    let options = StructuredOptions {
        order,
        elements_profile: profile,
        elements_face: face,
        extent: Extent::Sector(3),
        ..StructuredOptions::default()
    };
    let meshes = structured(&pair, &options);
    let patches = [(&pair.pinion, &meshes[0]), (&pair.wheel, &meshes[1])].map(|(gear, parts)| {
        let mut made = Vec::new();
        for tooth in parts.teeth() {
            let faces = parts.flank(tooth, Side::Left).unwrap();
            let surface = Box::new(gear.flank_of(Side::Left, i64::from(tooth)));
            made.push(FlankPatch::new(i64::from(tooth), surface, &parts.mesh().nodes, faces, Some, 1e-9).unwrap());
        }
        made
    });
    Flanks { pair, patches }
}

fn poses(pair: &GearPair, turn: f64, lag: f64, shift: [f64; 3], tilt: [f64; 2]) -> [Pose; 2] {
    let theta1 = pair.middle_angle(Side::Left) + turn;
    let about = |angle: f64| UnitQuaternion::from_axis_angle(&Vec3::z_axis(), angle);
    let misaligned = UnitQuaternion::from_scaled_axis(Vec3::new(tilt[0], tilt[1], 0.0));
    let centre = Translation3::new(pair.centre_distance() + shift[0], shift[1], shift[2]);
    [
        Pose::from_parts(Translation3::identity(), about(theta1)),
        Pose::from_parts(centre, misaligned * about(pair.wheel_angle(Side::Left, theta1) + lag)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]
    /// Random poses, misaligned ones among them: what the bounding volumes let through contains every point that is
    /// nearer than the reach, and the gaps are the same.
    #[test]
    fn two_stages_find_what_brute_force_finds(
        turn in -0.15..0.15f64, lag in -3e-2..3e-2f64, shift in prop::array::uniform3(-0.3..0.3f64),
        tilt in prop::array::uniform2(-5e-3..5e-3f64), reach in 0.0..1.5f64, order in 1..=2u32,
    ) {
        static SETS: std::sync::OnceLock<[Flanks; 2]> = std::sync::OnceLock::new();
        let set = &SETS.get_or_init(|| [flanks(1), flanks(2)])[order as usize - 1];
        let points: Vec<_> = set.patches[0].iter().map(|p| contact_points(p, 3, GapSource::Smooth)).collect();
        let trees = [Candidates::new(&set.patches[0]), Candidates::new(&set.patches[1])];
        let scene = Scene {
            first: &set.patches[0], points: &points, second: &set.patches[1], first_tree: &trees[0], second_tree: &trees[1],
            source: GapSource::Smooth, line: &LinePoints::new(),
        };
        let poses = poses(&set.pair, turn, lag, shift, tilt);
        let found = closest_points(&scene, &poses, reach);
        let mut all = Vec::new();
        for (first, of_patch) in points.iter().enumerate() {
            for second in 0..set.patches[1].len() {
                for (i, p) in of_patch.iter().enumerate() {
                    // Points deep inside the other tooth are another flank's business: overlap up to the reach counts.
                    all.extend(contact_row(&scene, &poses, (first, second), i, p).filter(|r| r.gap.abs() <= reach));
                }
            }
        }
        let key = |r: &contact::nodal::ContactRow| (r.patches, r.point);
        for row in &all {
            let twin = found.iter().find(|r| key(r) == key(row));
            prop_assert!(twin == Some(row), "missed {:?} with gap {}", key(row), row.gap);
        }
        for row in &found {
            prop_assert!(row.gap <= reach, "{:?} with gap {} is beyond the reach of {reach} mm", key(row), row.gap);
        }
    }
}

/// 10^5 poses, misaligned and with edges and corners at the very limit of reach among them: no contact missed.
///
/// Few points on few faces, so that brute force stays affordable; the middle tooth of the pinion against all three of
/// the wheel.
#[test]
fn a_hundred_thousand_poses() {
    const POSES: u64 = 100_000;
    for order in [1, 2] {
        let set = flanks_of(order, [2, 2]);
        let first = &set.patches[0][1..2];
        let points: Vec<_> = first.iter().map(|p| contact_points(p, 2, GapSource::Smooth)).collect();
        let trees = [Candidates::new(first), Candidates::new(&set.patches[1])];
        let line = LinePoints::new();
        let scene = Scene {
            first,
            points: &points,
            second: &set.patches[1],
            first_tree: &trees[0],
            second_tree: &trees[1],
            source: GapSource::Smooth,
            line: &line,
        };
        let check = |seed: u64| -> [usize; 2] {
            let mut random = Random::new(seed);
            // Every other pose lies wide open, or as deep.
            let (most_lag, most_reach) = if seed.is_multiple_of(2) { (2e-3, 0.2) } else { (5e-2, 2.0) };
            let (turn, lag) = (random.between(-0.3, 0.3), random.between(-1.0, 1.0) * most_lag);
            let shift = [0.0; 3].map(|_: f64| random.between(-0.3, 0.3));
            // Every other pose is misaligned, every tenth by far more than teeth bear.
            let most = [0.0, 5e-3, 0.0, 5e-3, 0.0, 5e-3, 0.0, 5e-3, 0.0, 5e-2][(seed % 10) as usize];
            let tilt = [0.0; 2].map(|_: f64| random.between(-1.0, 1.0) * most);
            let poses = poses(&set.pair, turn, lag, shift, tilt);
            let mut all = Vec::new();
            for second in 0..set.patches[1].len() {
                all.extend(
                    points[0].iter().enumerate().filter_map(|(i, p)| contact_row(&scene, &poses, (0, second), i, p)),
                );
            }
            let mut reach = random.between(0.0, most_reach);
            if seed.is_multiple_of(3) {
                // At the very distance of one of the points: a box that is a hair too small would lose it.
                let near = all.iter().map(|r| r.gap.abs()).filter(|g| *g < most_reach).fold(f64::INFINITY, f64::min);
                reach = if near.is_finite() { near } else { reach };
            }
            all.retain(|r| r.gap.abs() <= reach);
            let found = closest_points(&scene, &poses, reach);
            let missed = all.iter().filter(|row| !found.contains(row)).count();
            assert!(
                missed == 0,
                "order {order}, pose {seed}: {missed} of {} contacts missed within {reach} mm",
                all.len()
            );
            [usize::from(!all.is_empty()), all.len()]
        };
        let count = |a: [usize; 2], b: [usize; 2]| [a[0] + b[0], a[1] + b[1]];
        let [touching, contacts] = (0..POSES / 2).into_par_iter().map(check).reduce(|| [0; 2], count);
        println!("order {order}: {} poses, {touching} with contacts, {contacts} contacts, none missed", POSES / 2);
        assert!(touching > 5_000, "only {touching} poses touch");
    }
}

/// Boxes of faces that lie askew are thick, and have margins: contacts within them are found whatever the reach. On
/// small faces millimetres apart it is the reach that finds them: contacts lie where the boxes are farther apart than
/// six tenths of it.
#[test]
fn the_reach_finds_what_boxes_alone_do_not() {
    let set = flanks_of(1, [16, 32]);
    let first = &set.patches[0][1..2];
    let points: Vec<_> = first.iter().map(|p| contact_points(p, 1, GapSource::Smooth)).collect();
    let per_face = points[0].len() / first[0].face_count();
    let trees = [Candidates::new(first), Candidates::new(&set.patches[1])];
    let line = LinePoints::new();
    let scene = Scene {
        first,
        points: &points,
        second: &set.patches[1],
        first_tree: &trees[0],
        second_tree: &trees[1],
        source: GapSource::Smooth,
        line: &line,
    };
    let mut beyond = 0;
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let (turn, lag) = (random.between(-0.1, 0.1), random.between(-9e-2, 9e-2));
        let poses = poses(&set.pair, turn, lag, [0.0; 3], [0.0; 2]);
        let reach = random.between(0.5, 4.0);
        let found = closest_points(&scene, &poses, reach);
        let boxes = trees[0].pairs(&poses[0], &trees[1], &poses[1], 0.6 * reach);
        let near: std::collections::BTreeSet<_> = boxes.iter().map(|p| (p.first.1, p.second.0)).collect();
        for second in 0..set.patches[1].len() {
            for (i, p) in points[0].iter().enumerate() {
                let row = contact_row(&scene, &poses, (0, second), i, p).filter(|r| r.gap.abs() <= reach);
                let Some(row) = row else { continue };
                assert!(found.contains(&row), "pose {seed}: a contact {} mm off is missed within {reach} mm", row.gap);
                beyond += usize::from(!near.contains(&(i / per_face, second)));
            }
        }
    }
    println!("{beyond} contacts where the boxes are farther apart than 0.6 of the reach");
    assert!(beyond > 50, "only {beyond} contacts need the reach");
}

/// A row's weights sum to one on both bodies, its forces are opposite, and the weights interpolate the point: a uniform
/// field opens no gap, a rigid turn opens it by lever times angle.
#[test]
fn supports_carry_rigid_motions() {
    let set = flanks(2);
    let points: Vec<_> = set.patches[0].iter().map(|p| contact_points(p, 4, GapSource::Smooth)).collect();
    let trees = [Candidates::new(&set.patches[0]), Candidates::new(&set.patches[1])];
    let line = LinePoints::new();
    let scene = Scene {
        first: &set.patches[0],
        points: &points,
        second: &set.patches[1],
        first_tree: &trees[0],
        second_tree: &trees[1],
        source: GapSource::Smooth,
        line: &line,
    };
    let at = |lag: f64| poses(&set.pair, 0.02, lag, [0.0; 3], [0.0; 2]);
    let rows = closest_points(&scene, &at(0.0), 0.05);
    assert!(rows.len() > 100, "{} rows", rows.len());
    let h = 1e-5;
    for row in &rows {
        for support in &row.supports {
            let sum: f64 = support.weights[..support.count].iter().sum();
            assert!((sum - 1.0).abs() < 1e-12, "weights sum to {sum}");
            assert!((support.direction.norm() - 1.0).abs() < 1e-12);
        }
        // Lever = d gap / d angle, against central differences of the gap itself.
        let gap = |lag: f64| {
            let p = &points[row.patches.0][row.point];
            contact_row(&scene, &at(lag), row.patches, row.point, p).map(|r| r.gap)
        };
        if let (Some(a), Some(b)) = (gap(h), gap(-h)) {
            let slope = (a - b) / (2.0 * h);
            assert!((slope - row.levers[1]).abs() < 1e-6 * slope.abs(), "{slope} and {}", row.levers[1]);
        }
    }
}
