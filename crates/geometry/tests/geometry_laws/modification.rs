//! Micro-geometry: depths, their derivatives, the surface they make, and the files they come from.

use std::path::Path;

use geometry::modification::{
    DepthRate, EndRelief, ProfileAxis, ProfilePlace, Relief, ReliefShape, Topography, TopographyGrid,
    parse_pitch_errors,
};
use geometry::{FlankModification, Gear, GearData, GearModifications, GeometryError, ModifiedFlank, Side};
use nalgebra::Rotation3;

const GRID: &str =
    "# um\ndiameter_mm; -9 0 4 10\n 91, 3.0 1.0 2.0 3.5\n94, 1 -0.5, 0 1.5\n97 2 0 1 2 # row\n\n101,6 4 5 9\n";

fn nominal(beta_deg: f64) -> Gear {
    Gear::new(GearData { helix_angle: beta_deg.to_radians(), ..GearData::default() }).unwrap()
}

/// Everything at once, in mm.
fn all(shape: ReliefShape) -> FlankModification {
    let end = |amount: f64, length: f64| Some(EndRelief { amount, length, shape });
    FlankModification {
        tip_relief: Some(Relief { amount: 0.02, start: ProfilePlace::Diameter(98.0), shape }),
        root_relief: Some(Relief { amount: 0.015, start: ProfilePlace::Roll(0.28), shape }),
        profile_crowning: 0.008,
        profile_slope: -0.005,
        lead_crowning: 0.012,
        lead_slope: 0.006,
        end_relief: [end(0.01, 3.0), end(0.014, 2.0)],
        bias: 0.007,
        topography: Some(Topography::parse(GRID, Path::new("grid.csv")).unwrap()),
        evaluation_start: None,
    }
}

/// Each modification alone, so that a sum cannot hide a wrong term.
fn each(shape: ReliefShape) -> Vec<FlankModification> {
    let (all, none) = (all(shape), FlankModification::default());
    vec![
        FlankModification { tip_relief: all.tip_relief, ..none.clone() },
        FlankModification { root_relief: all.root_relief, ..none.clone() },
        FlankModification { profile_crowning: all.profile_crowning, ..none.clone() },
        FlankModification { profile_slope: all.profile_slope, ..none.clone() },
        FlankModification { lead_crowning: all.lead_crowning, ..none.clone() },
        FlankModification { lead_slope: all.lead_slope, ..none.clone() },
        FlankModification { end_relief: all.end_relief, ..none.clone() },
        FlankModification { bias: all.bias, ..none.clone() },
        FlankModification { topography: all.topography.clone(), ..none },
        all,
    ]
}

fn modified(beta_deg: f64, m: &FlankModification) -> Gear {
    nominal(beta_deg).with_modifications(GearModifications::both(m.clone())).unwrap()
}

/// Places on the flank away from starts of reliefs and grid lines, where differences mean something.
fn places(gear: &Gear) -> Vec<[f64; 2]> {
    let (low, high) = (gear.profile().roll_form(), gear.profile().roll_tip());
    let at = |f: f64| low + f * (high - low);
    let places = [0.011, 0.137, 0.319, 0.523, 0.741, 0.937].map(at);
    places.iter().flat_map(|&u| [-9.7, -8.1, -2.3, 0.7, 5.1, 8.9].map(|z| [u, z])).collect()
}

/// Derivatives of the depth are its differences; those of the surface point are its differences.
#[test]
fn derivatives_are_differences() {
    for shape in [ReliefShape::Linear, ReliefShape::Parabolic] {
        for (k, m) in each(shape).iter().enumerate() {
            let gear = modified(20.0, m);
            for side in [Side::Left, Side::Right] {
                let flank = gear.modified_flank(side, 7);
                for [u, z] in places(&gear) {
                    let (hu, hz) = (1e-6, 1e-5);
                    let d = |a: f64, b: f64| flank.depth(u + a, z + b).value;
                    let depth = flank.depth(u, z);
                    let by_roll = (d(hu, 0.0) - d(-hu, 0.0)) / (2.0 * hu);
                    let by_z = (d(0.0, hz) - d(0.0, -hz)) / (2.0 * hz);
                    let at = format!("modification {k}, {side:?}, u {u}, z {z}");
                    assert!((depth.by_roll - by_roll).abs() < 1e-8, "{at}: {} not {by_roll}", depth.by_roll);
                    assert!((depth.by_z - by_z).abs() < 1e-8, "{at}: {} not {by_z}", depth.by_z);
                    let [tu, tz] = flank.tangents(u, z);
                    let pu = (flank.point(u + hu, z) - flank.point(u - hu, z)) / (2.0 * hu);
                    let pz = (flank.point(u, z + hz) - flank.point(u, z - hz)) / (2.0 * hz);
                    assert!((tu - pu).amax() < 1e-7 && (tz - pz).amax() < 1e-8, "{at}: {tu} {pu} {tz} {pz}");
                }
            }
        }
    }
}

/// Depths of many places at once are those of each, bit by bit; none at a height is less than the least there, which is no
/// less than that of the whole flank; slopes jump at kinks and nowhere else.
#[test]
fn depths_at_once_are_those_of_each() {
    for shape in [ReliefShape::Linear, ReliefShape::Parabolic] {
        for (k, m) in each(shape).iter().enumerate() {
            let gear = modified(20.0, m);
            let whole = gear.modified_flank(Side::Left, 7);
            for flank in [whole.clone(), whole.split(0.0)] {
                let places = places(&gear);
                let (rolls, heights): (Vec<f64>, Vec<f64>) = places.iter().map(|&[u, z]| (u, z)).unzip();
                let mut depths = vec![f64::NAN; places.len()];
                flank.depths([&rolls, &heights], &mut depths);
                for ([u, z], depth) in places.into_iter().zip(depths) {
                    assert_eq!(depth, flank.depth(u, z).value, "modification {k}, u {u}, z {z}");
                    let least = flank.least_depth_at(z);
                    assert!(least <= depth + 4e-4, "modification {k}, u {u}, z {z}: {depth} below {least}");
                    let everywhere = flank.least_depth();
                    assert!(least >= everywhere - 1e-12 || m.bias != 0.0, "modification {k}: {least}, {everywhere}");
                }
            }
            let flank = gear.modified_flank(Side::Left, 7);
            let jump = |u: f64| flank.depth(u + 1e-9, 1.0).by_roll - flank.depth(u - 1e-9, 1.0).by_roll;
            let reliefs = [m.root_relief, m.tip_relief].into_iter().flatten().count();
            let kinks: Vec<f64> = flank.kinks().into_iter().flatten().collect();
            assert_eq!(kinks.len(), if shape == ReliefShape::Linear { reliefs } else { 0 }, "modification {k}");
            assert!(kinks.iter().all(|&u| jump(u).abs() > 1e-3), "modification {k}: {kinks:?}");
        }
    }
}

/// The normal is a unit vector across both tangents, out of the tooth.
#[test]
fn rates_of_depths_are_differences() {
    let base = all(ReliefShape::Linear);
    let more = |share: f64| {
        let grown = |relief: Relief| Relief { amount: relief.amount * (1.0 + share), ..relief };
        let ends = base.end_relief.map(|end| end.map(|end| EndRelief { amount: end.amount * (1.0 + share), ..end }));
        FlankModification {
            tip_relief: base.tip_relief.map(grown),
            end_relief: ends,
            lead_crowning: base.lead_crowning + share,
            profile_slope: base.profile_slope - 2.0 * share,
            bias: base.bias * (1.0 + share),
            ..base.clone()
        }
    };
    let starts = |by: f64| FlankModification {
        tip_relief: base.tip_relief.map(|relief| Relief { start: ProfilePlace::Diameter(98.0 + by), ..relief }),
        ..base.clone()
    };
    for (of, step) in [(&more as &dyn Fn(f64) -> FlankModification, 1e-3), (&starts, 1e-4)] {
        let flank = |by: f64| modified(20.0, &of(by)).modified_flank(Side::Left, 0);
        let [less, here, after] = [-step, 0.0, step].map(flank);
        let rate = DepthRate::between([&less, &here, &after], [step; 2]).unwrap();
        for [u, z] in places(&modified(20.0, &base)) {
            let found = rate.at(u, z).unwrap();
            let [a, b] = [less.depth(u, z), after.depth(u, z)];
            for (found, a, b) in
                [(found.value, a.value, b.value), (found.by_roll, a.by_roll, b.by_roll), (found.by_z, a.by_z, b.by_z)]
            {
                let wanted = (b - a) / (2.0 * step);
                assert!((found - wanted).abs() < 1e-9 * (1.0 + wanted.abs()), "{u}, {z}: {found}, not {wanted}");
            }
        }
        assert!(DepthRate::between([&here, &here, &here], [step; 2]).is_none());
    }
    // A relief that begins elsewhere on either side has no one rate at its start.
    let flank = |by: f64| modified(20.0, &starts(by)).modified_flank(Side::Left, 0);
    let rate = DepthRate::between([&flank(-0.01), &flank(0.0), &flank(0.01)], [0.01; 2]).unwrap();
    let start = ProfilePlace::Diameter(98.0).roll(nominal(20.0).base_radius());
    assert!(rate.at(start, 0.0).is_none());
}

#[test]
fn normal_is_across_the_surface() {
    for beta in [-20.0, 18.0, 20.0] {
        let gear = modified(beta, &all(ReliefShape::Parabolic));
        for side in [Side::Left, Side::Right] {
            let flank = gear.modified_flank(side, 3);
            for [u, z] in places(&gear) {
                let n = flank.normal(u, z);
                let [tu, tz] = flank.tangents(u, z);
                assert!((n.norm() - 1.0).abs() < 1e-14);
                assert!(n.dot(&tu.normalize()).abs() < 1e-13, "beta {beta} {side:?}: {}", n.dot(&tu));
                assert!(n.dot(&tz.normalize()).abs() < 1e-13, "beta {beta} {side:?}: {}", n.dot(&tz));
                assert!(n.dot(&flank.nominal().normal(u, z)) > 0.99);
            }
        }
    }
}

/// The surface itself is located at distance 0 at its own coordinates; beside it the distance is the true one to second
/// order.
#[test]
fn the_surface_is_where_it_is_located() {
    let gear = modified(20.0, &all(ReliefShape::Parabolic));
    for side in [Side::Left, Side::Right] {
        let flank = gear.modified_flank(side, 11);
        for [u, z] in places(&gear) {
            let foot = flank.locate(&flank.point(u, z)).unwrap();
            assert!(foot.distance.abs() < 1e-12, "distance {}", foot.distance);
            assert!((foot.roll - u).abs() < 1e-12 && (foot.z - z).abs() < 1e-11, "{foot:?} of ({u}, {z})");
            for gap in [-0.02, 0.02] {
                let beside = flank.point(u, z) + gap * flank.normal(u, z);
                // sqrt(1 + g^2) from the tilt of the normal; the depth's curvature enters with the square of the gap.
                let stretch = 1.0 / flank.normal(u, z).dot(&flank.nominal().normal(u, z));
                let off = flank.locate(&beside).unwrap().distance - gap * stretch;
                assert!(off.abs() < 1e-4 * gap * gap, "{side:?} u {u} z {z}: {off:e} beside a gap of {gap}");
            }
        }
    }
}

/// Nothing ground off: the nominal flank to the last bit.
#[test]
fn the_unmodified_flank_is_the_nominal_one() {
    let gear = nominal(20.0);
    let same = gear.clone().with_modifications(GearModifications::default()).unwrap();
    assert_eq!(gear, same);
    assert!(!same.is_modified(Side::Left));
    let (flank, modified) = (gear.flank_of(Side::Right, 4), same.modified_flank(Side::Right, 4));
    assert_eq!(modified, ModifiedFlank::from(flank));
    for [u, z] in places(&gear) {
        let p = flank.point(u, z) + 0.01 * flank.normal(u, z);
        assert_eq!(modified.point(u, z), flank.point(u, z));
        assert_eq!(modified.normal(u, z), flank.normal(u, z));
        assert_eq!(modified.tangents(u, z), flank.tangents(u, z));
        assert_eq!(modified.locate(&p), flank.locate(&p));
    }
}

/// Amounts stand where the documentation puts them.
#[test]
fn amounts_are_reached_at_the_ends_of_the_ranges() {
    let gear = nominal(20.0);
    let (form, tip) = (gear.profile().roll_form(), gear.profile().roll_tip());
    let middle = 0.5 * (form + tip);
    let depth = |m: FlankModification, u: f64, z: f64| modified(20.0, &m).depth(Side::Left, 0, u, z).value;
    let none = FlankModification::default;
    let c = 0.01;
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-16, "{a} not {b}");
    let crowned = FlankModification { profile_crowning: c, ..none() };
    for (u, want) in [(form, c), (middle, 0.0), (tip, c)] {
        close(depth(crowned.clone(), u, 3.0), want);
    }
    let sloped = FlankModification { profile_slope: c, ..none() };
    for (u, want) in [(form, -0.5 * c), (middle, 0.0), (tip, 0.5 * c)] {
        close(depth(sloped.clone(), u, 3.0), want);
    }
    let (crowned, sloped) =
        (FlankModification { lead_crowning: c, ..none() }, FlankModification { lead_slope: c, ..none() });
    for (z, crown, slope) in [(-10.0, c, -0.5 * c), (0.0, 0.0, 0.0), (10.0, c, 0.5 * c)] {
        close(depth(crowned.clone(), middle, z), crown);
        close(depth(sloped.clone(), middle, z), slope);
    }
    let twisted = FlankModification { bias: c, ..none() };
    let slope_at = |z: f64| depth(twisted.clone(), tip, z) - depth(twisted.clone(), form, z);
    close(slope_at(10.0) - slope_at(-10.0), c);
    for shape in [ReliefShape::Linear, ReliefShape::Parabolic] {
        let half = if shape == ReliefShape::Linear { 0.5 } else { 0.25 };
        let start = ProfilePlace::Roll(middle);
        let tip_relief = FlankModification { tip_relief: Some(Relief { amount: c, start, shape }), ..none() };
        let root_relief = FlankModification { root_relief: Some(Relief { amount: c, start, shape }), ..none() };
        for (u, at_tip, at_root) in [
            (form, 0.0, c),
            (0.5 * (form + middle), 0.0, half * c),
            (0.5 * (middle + tip), half * c, 0.0),
            (tip, c, 0.0),
        ] {
            assert!((depth(tip_relief.clone(), u, 0.0) - at_tip).abs() < 1e-15);
            assert!((depth(root_relief.clone(), u, 0.0) - at_root).abs() < 1e-15);
        }
        let ends = FlankModification {
            end_relief: [
                Some(EndRelief { amount: c, length: 4.0, shape }),
                Some(EndRelief { amount: 2.0 * c, length: 2.0, shape }),
            ],
            ..none()
        };
        for (z, want) in [(-10.0, c), (-8.0, half * c), (-6.0, 0.0), (8.0, 0.0), (9.0, 2.0 * half * c), (10.0, 2.0 * c)]
        {
            close(depth(ends.clone(), middle, z), want);
        }
    }
    // A range that starts higher up.
    let from = FlankModification { profile_crowning: c, evaluation_start: Some(ProfilePlace::Roll(0.3)), ..none() };
    close(depth(from.clone(), 0.3, 0.0), c);
    close(depth(from, 0.5 * (0.3 + tip), 0.0), 0.0);
}

/// A tooth out of pitch is the same tooth turned about the axis, both flanks of it.
#[test]
fn a_pitch_error_turns_the_tooth() {
    let gear = nominal(20.0);
    let mut pitch_errors = vec![0.0; 30];
    pitch_errors[4] = 0.025;
    pitch_errors[29] = -0.01;
    let off =
        gear.clone().with_modifications(GearModifications { pitch_errors, ..GearModifications::default() }).unwrap();
    for (tooth, error) in [(4, 0.025), (-1, -0.01), (34, 0.025), (5, 0.0)] {
        let turn = Rotation3::from_axis_angle(&nalgebra::Vector3::z_axis(), error / gear.reference_radius());
        for side in [Side::Left, Side::Right] {
            let flank = off.modified_flank(side, tooth);
            for [u, z] in places(&gear) {
                let p = turn * gear.flank_of(side, tooth).point(u, z);
                let distance = flank.locate(&p).unwrap().distance;
                assert!(distance.abs() < 1e-12, "tooth {tooth} {side:?}: {distance:e}");
            }
            // Seen from a frame turned by 10 pitches the error goes along with the tooth.
            let seen = off.modified_flank_at(side, tooth - 10, tooth);
            assert_eq!(seen.depth(0.4, 0.0), flank.depth(0.4, 0.0));
        }
    }
}

/// What is no micro-geometry of this gear is told with name, value and range.
#[test]
fn impossible_modifications_are_refused() {
    let none = FlankModification::default;
    let relief = |start| Some(Relief { amount: 0.01, start, shape: ReliefShape::Linear });
    let end = |length| [None, Some(EndRelief { amount: 0.01, length, shape: ReliefShape::Linear })];
    let radius_grid =
        GRID.replace(" 91", "45.5").replace("94,", "47,").replace("\n97", "\n48.5").replace("101", "50.5");
    let cases = [
        FlankModification { tip_relief: relief(ProfilePlace::Diameter(102.6)), ..none() },
        FlankModification { tip_relief: relief(ProfilePlace::Diameter(80.0)), ..none() },
        FlankModification { tip_relief: relief(ProfilePlace::Roll(f64::NAN)), ..none() },
        FlankModification { root_relief: relief(ProfilePlace::Diameter(1.0)), ..none() },
        FlankModification { end_relief: end(0.0), ..none() },
        FlankModification { end_relief: end(20.1), ..none() },
        FlankModification { lead_crowning: 10.0, ..none() },
        FlankModification { bias: f64::NAN, ..none() },
        FlankModification { topography: Topography::parse(&radius_grid, Path::new("g")).ok(), ..none() },
    ];
    for m in cases {
        let error = nominal(20.0).with_modifications(GearModifications::both(m.clone())).unwrap_err();
        assert!(error.hint().is_some(), "{error}");
    }
    let short = GearModifications { pitch_errors: vec![0.0; 29], ..GearModifications::default() };
    let error = nominal(20.0).with_modifications(short).unwrap_err();
    assert_eq!(error, GeometryError::PitchErrors { given: 29, teeth: 30 });
}

/// Grid values stand at the grid lines, in mm, whichever way the profile is counted.
#[test]
fn topography_keeps_its_values() {
    let gear = modified(
        20.0,
        &FlankModification {
            topography: Some(Topography::parse(GRID, Path::new("grid.csv")).unwrap()),
            ..FlankModification::default()
        },
    );
    let roll = |d: f64| ProfilePlace::Diameter(d).roll(gear.base_radius());
    for (d, z, um) in [(91.0, -9.0, 3.0), (94.0, 0.0, -0.5), (97.0, 4.0, 1.0), (101.0, 10.0, 9.0)] {
        let depth = gear.depth(Side::Right, 2, roll(d), z).value;
        assert!((depth - 1e-3 * um).abs() < 1e-15, "d {d}, z {z}: {depth} mm, not {um} um");
    }
    let mut by_roll = String::from("roll_deg -9 0 4 10\n");
    for line in GRID.lines().skip(2).filter(|l| !l.is_empty()) {
        let line = line.replace(',', " ");
        let (d, rest) = line.trim().split_once(' ').unwrap();
        by_roll += &format!("{} {rest}\n", roll(d.parse().unwrap()).to_degrees());
    }
    let same = modified(
        20.0,
        &FlankModification {
            topography: Some(Topography::parse(&by_roll, Path::new("grid.csv")).unwrap()),
            ..FlankModification::default()
        },
    );
    for [u, z] in places(&gear) {
        let off = gear.depth(Side::Left, 0, u, z).value - same.depth(Side::Left, 0, u, z).value;
        assert!(off.abs() < 1e-12, "{off:e}");
    }
}

/// Teeth of a file with a column `tooth` have their own depths, the others those of the nearest.
#[test]
fn a_topography_by_tooth_is_that_of_its_teeth() {
    let text = "tooth roll_deg -9 9\n3 10 1 1\n29 10 5 5\n3 40 2 2\n29 40 5 5\n20 10 7 7\n20 40 7 7\n";
    let topography = Topography::parse(text, Path::new("g.csv")).unwrap();
    assert_eq!(topography.teeth(), [3, 20, 29]);
    let flank = FlankModification { topography: Some(topography.clone()), ..FlankModification::default() };
    let gear = modified(0.0, &flank);
    assert!(gear.has_own_teeth());
    let um = |tooth: i64| (1e3 * gear.depth(Side::Left, tooth, 40f64.to_radians(), 0.0).value).round();
    // Tooth 1 is two from 3 and two from 29: that of the lower number.
    assert_eq!([3, 33, 5, 20, 25, 29, 1, 0, -1].map(um), [2.0, 2.0, 2.0, 7.0, 5.0, 5.0, 2.0, 5.0, 5.0]);
    assert_eq!(
        gear.modified_flank_at(Side::Left, 0, 20).depth(0.5, 0.0).value,
        gear.depth(Side::Left, 20, 0.5, 0.0).value
    );
    let error = topography.of_teeth(29).unwrap_err();
    assert_eq!(error, GeometryError::NoSuchTooth { tooth: 29, teeth: 29 });
    let says = |text: &str| Topography::parse(text, Path::new("g.csv")).unwrap_err().to_string();
    assert_eq!(says("tooth roll_deg 1 2\n-1 5 1 2\n"), "g.csv:2: expected a tooth, counted from 0, found `-1`");
    assert_eq!(
        says("tooth roll_deg 1 2\n1 5 1 2\n2 4 1 2\n1 5 1 2\n"),
        "g.csv:4: roll_deg must rise from value to value: 5 is followed by 5"
    );
    assert_eq!(
        says("tooth roll_deg 1 2\n1 5 1 2\n1 6 1 2\n2 4 1 2\n"),
        "g.csv: 1 rows of depths, at least 2 are needed"
    );
    assert!(says("tooth z 1 2\n").starts_with("g.csv:1: expected `diameter_mm` or `roll_deg`"));
}

/// A flank that is taken apart is the same flank: smooth part and deviation add up to the depth. A plane deviates by
/// nothing, and of short waves nothing is in the smooth part.
#[test]
fn smooth_part_and_deviation_are_the_flank() {
    let at = |of: &dyn Fn(f64, f64) -> f64| {
        let gear = nominal(20.0);
        let even = |from: f64, to: f64, n: usize| -> Vec<f64> {
            (0..n).map(|i| from + (to - from) * i as f64 / (n - 1) as f64).collect()
        };
        let rolls = even(gear.profile().roll_form(), gear.profile().roll_tip(), 161);
        let z = even(-10.0, 10.0, 41);
        let depths = rolls.iter().flat_map(|&u| z.iter().map(move |&z| (u, z))).map(|(u, z)| 1e-3 * of(u, z)).collect();
        let grid = TopographyGrid::new(ProfileAxis::Roll(rolls), z, depths).unwrap();
        let flank =
            FlankModification { topography: Some(grid.into()), profile_crowning: 2e-3, ..FlankModification::default() };
        modified(20.0, &flank)
    };
    let wavy = at(&|u, z| (150.0 * u).cos() + 0.02 * z * z);
    let [whole, split] = [wavy.modified_flank(Side::Left, 3), wavy.modified_flank(Side::Left, 3).split(0.0)];
    let mut largest = 0.0f64;
    for [u, z] in places(&wavy) {
        let sum = split.depth(u, z).value + split.deviation(u, z);
        assert!((sum - whole.depth(u, z).value).abs() < 1e-12, "at {u}, {z}");
        largest = largest.max(split.deviation(u, z).abs());
    }
    assert!(
        largest > 0.5e-3 && largest <= split.largest_deviation() * 1.01,
        "{largest} of {}",
        split.largest_deviation()
    );
    let plane = at(&|_, z| 3.0 + 0.5 * z).modified_flank(Side::Right, 0).split(0.8);
    assert!(plane.largest_deviation() < 1e-12, "{}", plane.largest_deviation());
    // A measured flank that is not taken apart, and one that was not measured.
    assert_eq!(whole.deviation(0.4, 1.0), 0.0);
    assert_eq!(nominal(20.0).modified_flank(Side::Left, 0).split(0.0), nominal(20.0).modified_flank(Side::Left, 0));
}

/// Every damage to a file is told with its line.
#[test]
fn damaged_files_name_the_line() {
    let says = |text: &str| Topography::parse(text, Path::new("g.csv")).unwrap_err().to_string();
    assert_eq!(says(""), "g.csv: 0 rows of depths, at least 2 are needed");
    assert_eq!(
        says("# a\nradius 1 2\n"),
        "g.csv:2: expected `diameter_mm` or `roll_deg`, then heights in mm, found `radius`"
    );
    assert_eq!(says("roll_deg 1\n1 2\n2 3\n"), "g.csv: 1 heights, at least 2 are needed");
    assert_eq!(says("roll_deg 1 2\n\n1 2 3\n2 3\n"), "g.csv:4: 2 values in this row, not 3");
    assert_eq!(says("roll_deg 1 2\n1 2 x\n"), "g.csv:2: expected a number, found `x`");
    assert_eq!(says("roll_deg 1 2\n1 2 nan\n"), "g.csv:2: expected a number, found `nan`");
    assert_eq!(says("roll_deg 1 1\n"), "g.csv:1: z must rise from value to value: 1 is followed by 1");
    assert_eq!(
        says("diameter_mm 1 2\n5 1 1\n4 1 1\n"),
        "g.csv:3: diameter_mm must rise from value to value: 5 is followed by 4"
    );
    assert_eq!(parse_pitch_errors("1, 2\n# x\n3;-4", Path::new("p")).unwrap(), [1e-3, 2e-3, 3e-3, -4e-3]);
    let bad = parse_pitch_errors("1\n2 z\n", Path::new("p.txt")).unwrap_err();
    assert_eq!(bad.to_string(), "p.txt:2: expected a number, found `z`");
    // Cut off anywhere: an error or a grid, never a panic.
    for end in 0..GRID.len() {
        let _ = Topography::parse(&GRID[..end], Path::new("g"));
    }
}
