//! Gears of two face widths, and mid-faces at two heights: what must hold whatever the widths are.
#![allow(clippy::print_stdout, reason = "the figures are what the tests are for")]

use ale::Station;
use contact::Bulk;
use geometry::{FlankModification, GearData, GearModifications, Sense};
use ltca::{StaticModel, StaticOptions, StaticPosition};
use mesh::Extent;
use verification::{Case, default_data, modified, of_widths, summary};

const COUNTS: [u32; 4] = [3, 2, 2, 2];

/// 23/37 teeth at a helix angle of the pinion, degrees.
fn data(beta_deg: f64) -> [GearData; 2] {
    let [pinion, wheel] = default_data(beta_deg);
    [GearData { teeth: 23, bore_diameter: 40.0, ..pinion }, GearData { teeth: 37, bore_diameter: 60.0, ..wheel }]
}

fn case(beta_deg: f64, widths: [f64; 2], offset: f64) -> Case {
    of_widths(1, data(beta_deg), widths, offset, COUNTS, Extent::Periodic)
}

/// Slices without tables of compliance, so that only round-off stands between equal pairs.
fn options(case: &Case) -> StaticOptions {
    case.slice_options().with_contact(|c| (c.bulk, c.slices) = (Bulk::Exact, 40))
}

fn cycle(case: &Case) -> Vec<StaticPosition> {
    case.reduced(options(case)).run(4, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}")).positions
}

fn mean_error_um(case: &Case) -> f64 {
    summary(cycle(case).iter().map(|p| 1e3 * p.transmission_error)).0
}

/// Height of the resultant on the pinion, mm.
fn height(p: &StaticPosition) -> f64 {
    let slices = || p.pairs.iter().flat_map(|pair| &pair.slices);
    slices().map(|s| s.z * s.line_load).sum::<f64>() / slices().map(|s| s.line_load).sum::<f64>()
}

/// An offset of nothing is none, bit by bit.
#[test]
fn no_offset_is_the_pair_as_it_was() {
    let case = case(15.0, [20.0, 20.0], 0.0);
    let plain = of_widths(1, data(15.0), [20.0, 20.0], 0.0, COUNTS, Extent::Periodic).pair;
    let again = plain.clone().with_mid_face_offset(0.0).unwrap();
    assert_eq!((plain.common_face(), plain.face_width()), ([-10.0, 10.0], 20.0));
    let solve = |pair: geometry::GearPair| {
        let gears = case.reduced_gears(&options(&case));
        StaticModel::new(pair, gears, options(&case)).unwrap().solve(Station { cycle: 0, phase: 0.3 }).unwrap()
    };
    assert_eq!(format!("{:?}", solve(plain)), format!("{:?}", solve(again)));
}

/// Seen in a mirror across the axes a pair is the pair of the other hand with the other offset: the same errors, axial
/// forces and tilting moments with the other sign.
#[test]
fn a_mirrored_pair_has_the_mirrored_offset() {
    for (beta, widths, offset) in [(15.0, [26.0, 20.0], 3.0), (0.0, [26.0, 20.0], 5.0), (-25.0, [20.0, 30.0], -7.0)] {
        let [one, other] = [cycle(&case(beta, widths, offset)), cycle(&case(-beta, widths, -offset))];
        for (a, b) in one.iter().zip(&other) {
            let off = (a.transmission_error / b.transmission_error - 1.0).abs();
            assert!(off < 1e-7, "beta {beta}, offset {offset}, phase {}: {off:e}", a.mesh_phase);
            for (w, v) in a.wrench.iter().zip(&b.wrench) {
                let size = w.moment[2].abs();
                let apart = (0..3).map(|k| w.moment[k] - v.moment[k] * if k == 2 { 1.0 } else { -1.0 });
                let worst = apart.map(f64::abs).fold(0.0, f64::max);
                assert!(worst < 1e-6 * size, "beta {beta}, offset {offset}: moments {:?} and {:?}", w.moment, v.moment);
            }
            assert!((height(a) + height(b)).abs() < 1e-5, "heights {} and {}", height(a), height(b));
        }
    }
}

/// Seen from the other gear, turned half a turn about an axis along them, the wheel is the pinion: the offset has the other
/// sign. Points of the one are found on the other, so that the slices are not the same ones to the last digit.
#[test]
fn the_gears_may_be_exchanged() {
    let one = case(20.0, [26.0, 20.0], 2.0);
    let [first, second] = data(20.0);
    let turned = of_widths(1, [second, first], [20.0, 26.0], -2.0, COUNTS, Extent::Periodic);
    // The torque on what is driven is that of the same gear, and so is the sense in which it turns.
    let mut exchanged = options(&turned);
    exchanged.contact.driver = geometry::Driver::Wheel;
    exchanged.contact.sense = Sense::Cw;
    let a = cycle(&one);
    let b = turned.reduced(exchanged).run(4, 1, |_, _, _| ()).unwrap().positions;
    let [(mean, swing), (other, of_other)] = [&a, &b].map(|all| summary(all.iter().map(|p| p.transmission_error)));
    println!("mean {mean} and {other} mm, peak to peak {swing} and {of_other} mm");
    assert!((mean / other - 1.0).abs() < 1e-4, "mean transmission errors {mean} and {other} mm");
    assert!((swing / of_other - 1.0).abs() < 2e-2, "peak to peak {swing} and {of_other} mm");
    let tilt = |all: &[StaticPosition], gear: usize, k: usize| summary(all.iter().map(|p| p.wrench[gear].moment[k])).0;
    for k in [0, 1] {
        let (own, seen) = (tilt(&a, 0, k), tilt(&b, 1, k));
        assert!((own + seen).abs() < 2e-3 * own.hypot(tilt(&a, 0, 1 - k)), "moment {k}: {own} and {seen} N mm");
    }
}

/// Contact lies within the common face, and so does its resultant; forces and moments on both gears about their own
/// mid-faces are those of one force: M_1 + M_2 + (a, 0, o) x F_2 = 0.
#[test]
fn load_lies_on_the_common_face() {
    for (beta, widths, offset) in
        [(0.0, [30.0, 14.0], 3.0), (0.0, [20.0, 20.0], -12.0), (35.0, [40.0, 20.0], 16.0), (20.0, [20.0, 20.0], 18.0)]
    {
        let case = case(beta, widths, offset);
        let [low, high] = case.pair.common_face();
        for p in cycle(&case) {
            let told = format!("beta {beta}, widths {widths:?}, offset {offset}, phase {}", p.mesh_phase);
            for s in p.pairs.iter().flat_map(|pair| &pair.slices) {
                assert!(s.z > low && s.z < high, "{told}: a slice at {} mm of {low} .. {high}", s.z);
                assert!((s.z - s.wheel_z - offset).abs() < 1e-2, "{told}: {} mm on the wheel, {} mm", s.wheel_z, s.z);
            }
            let z = height(&p);
            assert!(z > low && z < high, "{told}: the load at {z} mm of {low} .. {high}");
            let [m1, m2] = [0, 1].map(|g| nalgebra::Vector3::from(p.wrench[g].moment));
            let across = nalgebra::Vector3::new(case.pair.centre_distance(), 0.0, offset);
            let left = m1 + m2 + across.cross(&nalgebra::Vector3::from(p.wrench[1].force));
            assert!(left.amax() < 1e-8 * m1.amax(), "{told}: {left:?} N mm left of {m1:?}");
            let whole = p.contact_line_length / p.geometric_line_length;
            assert!((0.9..1.6).contains(&whole), "{told}: {whole} of the unloaded contact lines");
        }
    }
}

/// A spur pair that is the same above and below the middle of its common face carries the load there: the tilting moment
/// is the force times its height.
#[test]
fn tilting_moments_follow_the_offset() {
    let case = case(0.0, [26.0, 26.0], 6.0);
    for p in cycle(&case) {
        assert!((height(&p) - 3.0).abs() < 1e-6, "the load at {} mm", height(&p));
        for (g, z) in [(0, 3.0), (1, -3.0)] {
            let [force, moment] = [p.wrench[g].force, p.wrench[g].moment];
            let wanted = [-z * force[1], z * force[0]];
            let off = (0..2).map(|k| (moment[k] - wanted[k]).abs()).fold(0.0, f64::max);
            assert!(off < 1e-6 * force[1].abs(), "gear {g}: {moment:?}, not {wanted:?} N mm");
        }
    }
}

/// Material beyond the common face holds the teeth: the transmission error falls with every millimetre that both gears
/// are wider than it, by less and less. The elements of the common face stay where they are.
#[test]
fn overhang_stiffens_to_a_limit() {
    for beta in [0.0, 15.0] {
        let errors: Vec<f64> = [0.0, 2.0, 4.0, 8.0, 16.0]
            .into_iter()
            .map(|overhang| mean_error_um(&case(beta, [20.0 + 2.0 * overhang, 20.0 + 2.0 * overhang], 2.0 * overhang)))
            .collect();
        println!("beta {beta}: mean STE {errors:.4?} um with 0, 2, 4, 8 and 16 mm beyond the common face of 20 mm");
        let gains: Vec<f64> = errors.windows(2).map(|two| two[0] - two[1]).collect();
        assert!(gains.iter().all(|gain| *gain > 0.0), "beta {beta}: {errors:?} um");
        // A millimetre gains less the farther away it is.
        let rates: Vec<f64> = gains.iter().zip([2.0, 2.0, 4.0, 8.0]).map(|(gain, more)| gain / more).collect();
        assert!(rates.windows(2).all(|two| two[1] < 0.7 * two[0]), "beta {beta}: {rates:?} um a mm");
        assert!(errors[4] > 0.75 * errors[0], "beta {beta}: {errors:?} um");
    }
}

/// One gear alone wider than its mate: softer than both, stiffer than none, on either side.
#[test]
fn each_wide_gear_stiffens() {
    let of = |widths, offset| mean_error_um(&case(15.0, widths, offset));
    let (none, pinion, wheel) = (of([20.0, 20.0], 0.0), of([28.0, 20.0], 0.0), of([20.0, 28.0], 0.0));
    let both = of([28.0, 28.0], 8.0);
    println!("mean STE {none:.4}, wide pinion {pinion:.4}, wide wheel {wheel:.4}, both {both:.4} um");
    assert!(both < pinion.min(wheel) && pinion.max(wheel) < none, "{none}, {pinion}, {wheel}, {both} um");
}

/// As the load goes to zero the contact lines are those of the geometry: nominal flanks touch over the common face as
/// they do over the whole one.
#[test]
fn light_loads_have_the_geometric_lines() {
    for (beta, widths, offset) in [(15.0, [26.0, 20.0], 5.0), (-30.0, [20.0, 30.0], -9.0)] {
        let mut case = case(beta, widths, offset);
        case.torque = 20.0;
        let positions = cycle(&case);
        for p in &positions {
            let (found, wanted) = (p.contact_line_length, p.geometric_line_length);
            assert!(
                (found / wanted - 1.0).abs() < 2e-2,
                "beta {beta}, phase {}: {found}, not {wanted} mm",
                p.mesh_phase
            );
            assert!(p.transmission_error.abs() < 1e-5, "beta {beta}: {} mm without load", p.transmission_error);
        }
    }
}

/// Crowning is about a gear's own mid-face: with little load the flanks touch at that of the crowned gear.
#[test]
fn crowning_is_about_the_own_mid_face() {
    let crowned = GearModifications::both(FlankModification { lead_crowning: 0.02, ..Default::default() });
    for (which, wanted) in [(0, 0.0), (1, 4.0)] {
        let mut case = case(0.0, [30.0, 30.0], 4.0);
        let mut own = [GearModifications::default(), GearModifications::default()];
        own[which] = crowned.clone();
        (case.pair, case.torque) = (modified(&case.pair, own), 300.0);
        let p = &cycle(&case)[1];
        assert!((height(p) - wanted).abs() < 0.1, "gear {which}: the load at {} mm, not {wanted}", height(p));
        let unloaded = p.kinematic_transmission_error;
        assert!(unloaded.abs() < 1e-9, "gear {which}: {unloaded} mm where the crowning takes nothing off");
    }
}

/// Reduction is exact for gears of two widths as for others: all degrees of freedom say the same.
#[test]
fn all_degrees_of_freedom_agree() {
    let sector = of_widths(1, data(15.0), [26.0, 20.0], 2.0, [2, 2, 2, 1], Extent::Whole);
    let station = Station { cycle: 0, phase: 0.3 };
    let own = options(&sector);
    let whole = sector.full(own.clone()).solve(station).unwrap().transmission_error;
    let reduced = sector.reduced(own).solve(station).unwrap().transmission_error;
    assert!((whole / reduced - 1.0).abs() < 1e-8, "{whole} mm with all, {reduced} mm reduced");
}
