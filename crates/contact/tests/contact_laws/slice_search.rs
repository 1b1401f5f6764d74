//! The least gap of a slice = the least over a fine scan of the whole profile, modified and misaligned flanks, edges
//! among them.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use contact::{
    Pose, Vec3,
    flank::FlankPatch,
    slice::{RigidFlanks, Slice, SliceFlank, SliceHint, ToothLayer, slice},
};
use geometry::modification::{ProfilePlace, Relief, ReliefShape};
use geometry::{FlankModification, Gear, GearData, GearModifications, GearPair, Side};
use mesh::{Extent, StructuredOptions};
use nalgebra::{Translation3, UnitQuaternion};
use rayon::prelude::*;

use testing::{Random, default_data, structured};

/// Poses drawn.
/// Poses of the search; so many of them at least are at an edge, and so many not.
fn poses_tried() -> (u64, usize) {
    let poses = testing::cases(12_500, 50_000);
    (poses as u64, poses / 50)
}

/// Places of the scan that the search is held against.
const SCAN: usize = 400;

struct Flanks {
    pair: GearPair,
    patches: [FlankPatch; 2],
    layers: [ToothLayer; 2],
}

/// A pinion in a ring.
fn internal() -> [GearData; 2] {
    let pinion = GearData { teeth: 22, profile_shift: 0.3, bore_diameter: 30.0, ..GearData::default() };
    let ring = GearData {
        teeth: 57,
        profile_shift: -0.1,
        bore_diameter: -220.0,
        addendum_coefficient: 0.85,
        root_radius_coefficient: 0.25,
        ..pinion.clone()
    };
    [pinion, ring.with_usual_shaper(0.0)]
}

fn flanks(modified: bool, [data, wheel]: [GearData; 2]) -> Flanks {
    let [pinion, wheel] = [data, wheel].map(|d| {
        let gear = Gear::new(d).unwrap();
        if !modified {
            return gear;
        }
        let profile = gear.profile();
        let at =
            |part: f64| ProfilePlace::Roll(profile.roll_form() + part * (profile.roll_tip() - profile.roll_form()));
        let flank = FlankModification {
            tip_relief: Some(Relief { amount: 0.03, start: at(0.7), shape: ReliefShape::Linear }),
            root_relief: Some(Relief { amount: 0.01, start: at(0.2), shape: ReliefShape::Parabolic }),
            profile_crowning: 0.004,
            lead_crowning: 0.01,
            lead_slope: 0.006,
            bias: 0.004,
            ..FlankModification::default()
        };
        gear.with_modifications(GearModifications::both(flank)).unwrap()
    });
    let pair = GearPair::new(pinion, wheel, None).unwrap();
    let options = StructuredOptions {
        elements_profile: 2,
        elements_face: 2,
        elements_thickness: 2,
        elements_fillet: 2,
        elements_rim: 1,
        extent: Extent::Sector(1),
        ..StructuredOptions::default()
    };
    let meshes = structured(&pair, &options);
    let parts = [(&pair.pinion, &meshes[0]), (&pair.wheel, &meshes[1])].map(|(gear, parts)| {
        let surface = Box::new(gear.modified_flank_at(Side::Left, 0, 0));
        let faces = parts.flank(0, Side::Left).unwrap();
        let patch = FlankPatch::new(0, surface, &parts.mesh().nodes, faces, Some, 0.05).unwrap();
        let profile = reduction::LayerProfile::new(gear, 0.3, 0.0).unwrap();
        (patch, ToothLayer::new(gear.flank_of(Side::Left, 0), 206e3, 0.3, 0.0, profile, 0.0))
    });
    let [(p1, l1), (p2, l2)] = parts;
    Flanks { pair, patches: [p1, p2], layers: [l1, l2] }
}

/// A pose anywhere in the path of contact and beyond its ends, axes apart and tilted.
fn poses(pair: &GearPair, random: &mut Random) -> [Pose; 2] {
    poses_within(pair, random, 1.0)
}

/// As [`poses`], off the nominal ones by a share of that.
fn poses_within(pair: &GearPair, random: &mut Random, share: f64) -> [Pose; 2] {
    let theta1 = pair.middle_angle(Side::Left) + random.between(-1.1, 1.1) * pair.pinion.pitch_angle();
    let lag = share * random.between(-2e-3, 2e-3);
    let about = |angle: f64| UnitQuaternion::from_axis_angle(&Vec3::z_axis(), angle);
    let tilt = share * Vec3::new(random.between(-3e-3, 3e-3), random.between(-3e-3, 3e-3), 0.0);
    let shift = [0.0; 3].map(|_: f64| share * random.between(-0.2, 0.2));
    let centre = Translation3::new(pair.centre_distance() + shift[0], shift[1], shift[2]);
    [
        Pose::from_parts(Translation3::identity(), about(theta1)),
        Pose::from_parts(
            centre,
            UnitQuaternion::from_scaled_axis(tilt) * about(pair.wheel_angle(Side::Left, theta1) + lag),
        ),
    ]
}

/// Least gap from `first`'s profile at height z to `second`: a fine scan, then golden sections about every dip of it.
fn brute_force(first: &FlankPatch, second: &FlankPatch, poses: [&Pose; 2], z: f64) -> Option<f64> {
    let [[low, _], [high, _]] = first.range();
    let [[other_low, _], [other_high, _]] = second.range();
    let gap = |u: f64| {
        let point = poses[0].transform_point(&first.surface().point([u, z]).into());
        let foot = second.surface().locate(&poses[1].inverse_transform_point(&point).coords)?;
        (foot.at[0] >= other_low && foot.at[0] <= other_high).then_some(foot.distance)
    };
    let at = |i: usize| if i == SCAN { high } else { low + (high - low) * i as f64 / SCAN as f64 };
    let of = |u: f64| gap(u).unwrap_or(f64::INFINITY);
    let all: Vec<f64> = (0..=SCAN).map(|i| of(at(i))).collect();
    let mut least = (f64::INFINITY, low);
    let nearer = |least: (f64, f64), u: f64| if of(u) < least.0 { (of(u), u) } else { least };
    for i in 0..=SCAN {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(SCAN));
        if all[i].is_infinite() || all[before] < all[i] || all[after] < all[i] {
            continue;
        }
        let (mut a, mut b) = (at(before), at(after));
        // Where the other flank ends inside the bracket, pull the bracket in to it.
        for (end, known) in [(&mut a, all[before]), (&mut b, all[after])] {
            if known.is_infinite() {
                let (mut inside, mut outside) = (at(i), *end);
                for _ in 0..60 {
                    let middle = 0.5 * (inside + outside);
                    if of(middle).is_finite() { inside = middle } else { outside = middle }
                }
                *end = inside;
            }
        }
        least = [a, b, at(i)].into_iter().fold(least, nearer);
        const GOLDEN: f64 = 0.381_966_011_250_105;
        for _ in 0..60 {
            let (x, y) = (a + GOLDEN * (b - a), b - GOLDEN * (b - a));
            let (f, g) = (of(x), of(y));
            least = nearer(nearer(least, x), y);
            if f < g { b = y } else { a = x }
        }
    }
    // On the width of the second flank, or as near to it as the search lets feet wander.
    let point = poses[0].transform_point(&first.surface().point([least.1, z]).into());
    let foot = second.surface().locate(&poses[1].inverse_transform_point(&point).coords)?;
    let [[_, below], [_, above]] = second.range();
    let slack = 1e-3 * (above - below);
    let faces = foot.at[1] >= below - slack && foot.at[1] <= above + slack;
    (least.0.is_finite() && faces).then_some(least.0)
}

/// 0: missed, 1: found with another gap, else fine; and what the two say.
fn compare(set: &Flanks, seed: u64, share: f64) -> (Option<String>, bool, bool) {
    let mut random = Random::new(seed);
    let poses = poses(&set.pair, &mut random);
    let z = random.between(-10.0, 10.0);
    let [a, b] = [&set.patches[0], &set.patches[1]];
    let flanks = [0, 1].map(|i| SliceFlank { patch: &set.patches[i], layer: &set.layers[i] });
    let found = slice(flanks, &poses, (0, 0), 0, z, 1.0);
    let direct = brute_force(a, b, [&poses[0], &poses[1]], z);
    // The tip edge of a ring's flank is at the lower end of its roll angles.
    let tip = usize::from(!set.pair.is_internal());
    let edge_of_second = |s: &Slice| s.at[1][0] == b.range()[tip][0];
    let wanted = match &found {
        // The edge of body 2 on body 1: the same question asked of body 2.
        Some((_, s)) if edge_of_second(s) => brute_force(b, a, [&poses[1], &poses[0]], s.at[1][1]),
        _ => direct,
    };
    let edge = found.as_ref().is_some_and(|(_, s)| s.local.off_line > 0.0);
    let complaint = match (&found, wanted) {
        (Some((row, _)), Some(gap)) => ((row.gap - gap).abs() > 1e-9 + share * gap.abs())
            .then(|| format!("pose {seed}, z {z}: gap {} mm, {gap} by brute force", row.gap)),
        (None, Some(gap)) => Some(format!("pose {seed}, z {z}: missed a gap of {gap} mm")),
        (Some((row, _)), None) => {
            Some(format!("pose {seed}, z {z}: gap {} mm where the flanks do not face each other", row.gap))
        }
        (None, None) => None,
    };
    (complaint, found.is_some(), edge)
}

#[test]
fn slices_find_what_brute_force_finds() {
    let (tried, of_a_kind) = poses_tried();
    for (modified, data) in
        [(false, default_data(20.0)), (true, default_data(20.0)), (false, internal()), (true, internal())]
    {
        let set = flanks(modified, data);
        // Distances from a modified flank are taken along its nominal normal:
        // the place of the least is off by the product of gap and slope.
        // A hollow flank, whose foot points run further than what they belong to, makes ten times as much of it.
        let share = if modified { 4e-6 } else { 0.0 } * if set.pair.is_internal() { 10.0 } else { 1.0 };
        let all: Vec<_> = (0..tried).into_par_iter().map(|seed| compare(&set, seed, share)).collect();
        let complaints: Vec<&String> = all.iter().filter_map(|c| c.0.as_ref()).collect();
        let (faced, edges) = (all.iter().filter(|c| c.1).count(), all.iter().filter(|c| c.2).count());
        println!(
            "modified {modified}, ring {}: {tried} poses, {faced} facing, {edges} of them at an edge; {} differ",
            set.pair.is_internal(),
            complaints.len()
        );
        complaints.iter().take(10).for_each(|c| println!("   {c}"));
        assert!(edges > of_a_kind && faced - edges > of_a_kind, "too few of a kind: {faced} facing, {edges} edges");
        assert!(
            complaints.is_empty(),
            "modified {modified}: {} of {tried}, first: {}",
            complaints.len(),
            complaints[0]
        );
    }
}

/// Rigid flanks have the gaps, places and normals of slices, edges among them, without a mesh.
#[test]
fn rigid_flanks_are_slices_without_a_mesh() {
    for (modified, data) in
        [(false, default_data(20.0)), (true, default_data(20.0)), (false, internal()), (true, internal())]
    {
        let set = flanks(modified, data);
        let gears = [&set.pair.pinion, &set.pair.wheel];
        let bare = [0, 1].map(|i| {
            let surface = Box::new(gears[i].modified_flank(Side::Left, 0));
            FlankPatch::rigid(0, surface, set.patches[i].range())
        });
        let (mut faced, mut edges) = (0, 0);
        for seed in 0..5000 {
            let mut random = Random::new(seed);
            let poses = poses(&set.pair, &mut random);
            let z = random.between(-10.0, 10.0);
            let with_mesh = [0, 1].map(|i| SliceFlank { patch: &set.patches[i], layer: &set.layers[i] });
            let wanted = slice(with_mesh, &poses, (0, 0), 0, z, 1.0);
            let found = RigidFlanks::new([&bare[0], &bare[1]], &poses).nearest(z, &mut SliceHint::default());
            assert_eq!(found.is_some(), wanted.is_some(), "pose {seed}, z {z}");
            let (Some(found), Some((row, slice))) = (found, wanted) else { continue };
            (faced, edges) = (faced + 1, edges + usize::from(slice.local.off_line > 0.0));
            assert_eq!((found.gap, found.at), (row.gap, slice.at), "pose {seed}, z {z}");
            assert!((found.normal - row.normal).norm() < 1e-12, "pose {seed}: {} and {}", found.normal, row.normal);
            assert!((found.position - row.position).norm() < 1e-9, "pose {seed}: {}, {}", found.position, row.position);
        }
        assert!(edges > 100 && faced - edges > 100, "{faced} facing, {edges} edges");
    }
}

/// The least gap of a height is what was foretold of it: not less, not more.
#[test]
fn gaps_are_as_foretold() {
    for data in [default_data(20.0), default_data(35.0), internal()] {
        let set = flanks(true, data);
        let mut held = 0;
        for seed in 0..20_000 {
            let mut random = Random::new(seed);
            let share = 10f64.powf(random.between(-3.0, 0.0));
            let poses = poses_within(&set.pair, &mut random, share);
            let z = random.between(-10.0, 10.0);
            let flanks = RigidFlanks::new([&set.patches[0], &set.patches[1]], &poses);
            let seen = flanks.least_gap(z, &mut SliceHint::default()).map(|(_, gap, _)| gap);
            let (Some([low, high]), Some(gap)) = (flanks.foretold(z), seen) else { continue };
            held += usize::from(low.is_finite());
            assert!(low <= gap && gap <= high, "pose {seed}, z {z}: {gap} mm, foretold {low} to {high} mm");
        }
        println!("ring {}: {held} gaps foretold", set.pair.is_internal());
        assert!(held > 10_000, "{held} gaps foretold");
    }
}
