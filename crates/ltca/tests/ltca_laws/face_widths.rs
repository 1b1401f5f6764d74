//! Gears of two face widths, and mid-faces at two heights: what must hold whatever the widths are.
#![allow(clippy::print_stdout, reason = "the figures are what the tests are for")]

use ale::Station;
use contact::{Bulk, complementarity::Law, flank::GapSource};
use fem::Integration;
use geometry::{FlankModification, GearData, GearModifications, Sense};
use ltca::{StaticModel, StaticOptions, StaticPosition};
use mesh::Extent;
use testing::{Case, default_data, mean_and_peak_to_peak, modified, of_widths};

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
    mean_and_peak_to_peak(cycle(case).iter().map(|p| 1e3 * p.transmission_error)).0
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
    let [(mean, swing), (other, of_other)] =
        [&a, &b].map(|all| mean_and_peak_to_peak(all.iter().map(|p| p.transmission_error)));
    println!("mean {mean} and {other} mm, peak to peak {swing} and {of_other} mm");
    assert!((mean / other - 1.0).abs() < 1e-4, "mean transmission errors {mean} and {other} mm");
    assert!((swing / of_other - 1.0).abs() < 2e-2, "peak to peak {swing} and {of_other} mm");
    let tilt = |all: &[StaticPosition], gear: usize, k: usize| {
        mean_and_peak_to_peak(all.iter().map(|p| p.wrench[gear].moment[k])).0
    };
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
                // The foot is off by the gap times the sine of the helix.
                assert!((s.z - s.wheel_z - offset).abs() < 0.05, "{told}: {} mm on the wheel, {} mm", s.wheel_z, s.z);
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

/// The tilting moment of a spur pair is the force times the height of the load over the gear's own mid-face. Two equal gears
/// see each other the other way up, at a phase s as at 1 - s: the load is as far above the middle of the common face there
/// as it is below it here.
#[test]
fn tilting_moments_follow_the_offset() {
    let case = of_widths(1, default_data(0.0), [26.0, 26.0], 6.0, COUNTS, Extent::Periodic);
    let positions = cycle(&case);
    let above: Vec<f64> = positions.iter().map(|p| height(p) - 3.0).collect();
    assert!(above[2].abs() < 1e-3 && (above[1] + above[3]).abs() < 1e-3, "{above:?} mm above the middle");
    for p in &positions {
        for (g, z) in [(0, height(p)), (1, height(p) - 6.0)] {
            let [force, moment] = [p.wrench[g].force, p.wrench[g].moment];
            let wanted = [-z * force[1], z * force[0]];
            let off = (0..2).map(|k| (moment[k] - wanted[k]).abs()).fold(0.0, f64::max);
            assert!(off < 1e-3 * force[1].abs(), "gear {g}: {moment:?}, not {wanted:?} N mm");
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

/// So it does with one gear alone wider than its mate, whichever it is.
#[test]
fn each_wide_gear_stiffens() {
    let of = |widths| mean_error_um(&case(15.0, widths, 0.0));
    let none = of([20.0, 20.0]);
    for wide in [[[24.0, 20.0], [28.0, 20.0], [36.0, 20.0]], [[20.0, 24.0], [20.0, 28.0], [20.0, 36.0]]] {
        let [a, b, c] = wide.map(of);
        println!("mean STE {none:.4} um of equal faces, {a:.4}, {b:.4}, {c:.4} um of {wide:?}");
        let rates = [(none - a) / 4.0, (a - b) / 4.0, (b - c) / 8.0];
        assert!(rates[2] > 0.0 && rates[1] < rates[0] && rates[2] < rates[1], "{wide:?}: {rates:?} um a mm");
    }
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

/// Face widths, offset, and at phases 1/4, 1/2 and 3/4 the STE (um) and the forces of pairs -1, 0, +1 (N).
type Reference = ([f64; 2], f64, [(f64, [f64; 3]); 3]);

/// CalculiX 2.20, surface-to-surface penalty 1e7 MPa/mm, frictionless: the decks of `study::calculix` of the very meshes
/// below (C3D20, sectors of 5 teeth), default pair, 150 N m.
const CALCULIX: [Reference; 3] = [
    (
        [20.0, 20.0],
        0.0,
        [(9.4510, [0.0, 2374.9, 1172.1]), (9.8210, [493.6, 2556.3, 497.5]), (9.4614, [1163.4, 2384.0, 0.0])],
    ),
    (
        [26.0, 20.0],
        2.0,
        [(8.7498, [0.0, 2345.3, 1201.7]), (9.0304, [489.9, 2517.6, 539.8]), (8.7716, [1150.4, 2396.9, 0.0])],
    ),
    (
        [20.0, 26.0],
        -3.0,
        [(8.3459, [0.0, 2379.3, 1167.7]), (8.7573, [437.0, 2591.7, 518.6]), (8.6387, [1087.9, 2459.5, 0.0])],
    ),
];

/// Pressed points on the facets of these meshes have CalculiX's transmission error to 0.7 % and its forces to 0.5 % of
/// all; what wide gears and the offset take off the error is known to 0.2 % of it, and by slices to a tenth of itself.
#[test]
fn calculix_sees_the_same_overhang() {
    let mut even = Vec::new();
    for (widths, offset, reference) in CALCULIX {
        let mut case = of_widths(2, default_data(20.0), widths, offset, [4, 3, 2, 2], Extent::Sector(5));
        case.elements.integration = Integration::Full;
        let points = case.options().with_contact(|c| {
            (c.law, c.gap, c.points_per_face_edge) = (Law::Penalty(1e7), GapSource::Facet, 8);
        });
        let window = |options| StaticOptions { window: Some(3), ..options };
        let mut models = [window(points), window(case.slice_options())].map(|options| case.reduced(options));
        let mut means = [0.0; 3];
        for (phase, (wanted, forces)) in [0.25, 0.5, 0.75].into_iter().zip(reference) {
            let [nodal, slices] = models.each_mut().map(|m| m.solve(Station { cycle: 0, phase }).unwrap());
            let told = format!("widths {widths:?} mm, offset {offset} mm, phase {phase}");
            let [own, sliced] = [&nodal, &slices].map(|p| 1e3 * p.transmission_error);
            println!("{told}: STE {own:.4} um, CalculiX {wanted}; slices {sliced:.4}");
            assert!((own / wanted - 1.0).abs() < 7e-3, "{told}: {own} um, CalculiX {wanted} um");
            let all: f64 = forces.iter().sum();
            for (pair, force) in nodal.pairs.iter().zip(forces) {
                let off = (pair.normal_force - force) / all;
                assert!(off.abs() < 5e-3, "{told}: pair {} has {} N, CalculiX {force} N", pair.pair, pair.normal_force);
            }
            means.iter_mut().zip([wanted, own, sliced]).for_each(|(mean, ste)| *mean += ste / 3.0);
        }
        if even.is_empty() {
            even.extend(means);
        }
        let [wanted, own, sliced] = [0, 1, 2].map(|i| means[i] / even[i]);
        println!(
            "widths {widths:?} mm: {own:.4} of the error of equal faces, CalculiX {wanted:.4}; slices {sliced:.4}"
        );
        assert!((own - wanted).abs() < 2e-3, "widths {widths:?} mm: {own} of the error, CalculiX {wanted}");
        // Slices have a local approach that does not go with the mesh: what the overhang takes off is compared in um.
        let [taken, by_slices] = [0, 2].map(|i| even[i] - means[i]);
        let off = (by_slices - taken).abs();
        assert!(off <= 0.1 * taken, "widths {widths:?} mm: slices have {by_slices} um less, CalculiX {taken} um");
    }
}
