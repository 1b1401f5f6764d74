//! Loaded contact of modified, misaligned flanks: what symmetry, continuity and the unloaded pair demand.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use ale::Station;
use contact::{Method, Misalignment, Offset};
use geometry::{
    FlankModification, GearModifications, GearPair, Sense,
    modification::{ProfilePlace, Relief, ReliefShape},
};
use ltca::{StaticHistory, StaticOptions, kinematic_transmission_error};
use testing::{Case, generated};

const SMALL: [u32; 5] = [2, 2, 2, 4, 1];

fn ground(case: Case, gears: [GearModifications; 2]) -> Case {
    let [a, b] = gears;
    let pinion = case.pair.pinion.clone().with_modifications(a).unwrap();
    let wheel = case.pair.wheel.clone().with_modifications(b).unwrap();
    Case { pair: GearPair::new(pinion, wheel, None).unwrap(), ..case }
}

fn relieved(case: &Case, amount: f64) -> FlankModification {
    let profile = case.pair.pinion.profile();
    let start = ProfilePlace::Roll(0.4 * profile.roll_form() + 0.6 * profile.roll_tip());
    let tip_relief = Some(Relief { amount, start, shape: ReliefShape::Parabolic });
    FlankModification { tip_relief, lead_crowning: 0.005, lead_slope: 0.003, ..FlankModification::default() }
}

/// Pitch errors that no two neighbours share, mm.
fn scatter(amount: f64) -> Vec<f64> {
    (0..30).map(|k| amount * (f64::from(k * k) * 0.7 + f64::from(k)).sin()).collect()
}

fn run(case: &Case, options: StaticOptions, positions: usize, cycles: usize) -> StaticHistory {
    let at = format!("{options:?}");
    case.reduced(options).run(positions, cycles, |_, _, _| ()).unwrap_or_else(|e| panic!("{at}: {e}"))
}

fn methods(case: &Case) -> [StaticOptions; 2] {
    [Method::Nodal, Method::Slice].map(|method| {
        case.options().with_contact(|c| {
            c.method = method;
            c.slices = 20;
            c.points_per_face_edge = 4
        })
    })
}

/// Modifications of size nothing leave every bit of the answer where it was.
#[test]
fn unmodified_is_bit_for_bit_the_nominal_pair() {
    let nominal = generated(20.0, SMALL);
    let same = ground(generated(20.0, SMALL), Default::default());
    for options in methods(&nominal) {
        let offsets = [Misalignment::default().wheel_offset(&nominal.pair, options.side()), Offset::default()];
        let a = run(&nominal, options.clone(), 4, 1);
        let b = run(&same, options.clone().with_contact(|c| c.offsets = offsets), 4, 1);
        assert_eq!(format!("{a:?}"), format!("{b:?}"));
        assert!(a.positions.iter().all(|p| p.kinematic_transmission_error == 0.0));
    }
}

/// As the load goes to zero the loaded pair becomes the unloaded one, and the secant stiffness stays that of contact.
#[test]
fn the_loaded_error_tends_to_the_kinematic_one() {
    let case = generated(20.0, SMALL);
    let flank = relieved(&case, 0.01);
    let pitch_errors = scatter(0.002);
    let gears =
        [GearModifications { pitch_errors, ..GearModifications::both(flank.clone()) }, GearModifications::both(flank)];
    let case = ground(case, gears);
    let m = Misalignment { in_plane_of_action: 0.006, deviation: -0.002, ..Misalignment::default() };
    for options in methods(&case) {
        let offsets = [Offset::default(), m.wheel_offset(&case.pair, options.side())];
        let at_load = |torque: f64| {
            run(&case, StaticOptions { torque, ..options.clone() }.with_contact(|c| c.offsets = offsets), 4, 2)
        };
        let (unloaded, feather, loaded) = (at_load(0.0), at_load(1e-3), at_load(150e3));
        for ((zero, little), full) in unloaded.positions.iter().zip(&feather.positions).zip(&loaded.positions) {
            let at = format!("{:?}, angle {:.4}", options.contact.method, zero.pinion_angle);
            let kinematic = zero.transmission_error;
            assert_eq!(kinematic, zero.kinematic_transmission_error);
            assert_eq!(kinematic, full.kinematic_transmission_error);
            // Points and slices are not everywhere: the flanks touch between them.
            let late = little.transmission_error - kinematic;
            assert!((-1e-6..2e-4).contains(&late), "{at}: {late:e} mm from {kinematic}");
            assert!(full.transmission_error > kinematic + 0.002, "{at}: {}", full.transmission_error);
            let force = 150e3 / case.pair.wheel.base_radius();
            let secant = force / (full.transmission_error - kinematic);
            assert!((full.secant_stiffness / secant - 1.0).abs() < 1e-12, "{at}");
            assert!(zero.contact_line_length < 0.2 * zero.geometric_line_length, "{at}: {}", zero.contact_line_length);
            assert!(full.certificate.torque_residual < 1e-6, "{at}: {:?}", full.certificate);
        }
    }
}

/// Pitch errors go with the gear's teeth and not with the frame of the matrices: the reduced model, whose window
/// slides, answers as the full one, which has no frames, and the errors come round again after a turn of both gears.
#[test]
fn pitch_errors_stay_with_their_teeth() {
    let case = generated(20.0, SMALL);
    let pitch = |amount| GearModifications { pitch_errors: scatter(amount), ..GearModifications::default() };
    let case = ground(case, [pitch(0.004), pitch(-0.003)]);
    for sense in [Sense::Ccw, Sense::Cw].into_iter().take(testing::cases(1, 2)) {
        let options = case.options().with_contact(|c| {
            c.sense = sense;
            c.points_per_face_edge = 4;
            c.method = Method::Nodal
        });
        let reduced = run(&case, options.clone(), 1, 6);
        let full = case.full(options).run(1, 6, |_, _, _| ()).unwrap();
        assert!(reduced.positions.last().unwrap().tooth_changes >= 4);
        for (r, f) in reduced.positions.iter().zip(&full.positions) {
            let off = r.transmission_error / f.transmission_error - 1.0;
            assert!(off.abs() < 1e-8, "{sense:?}, angle {}: {off:e}", r.pinion_angle);
        }
    }
    for options in methods(&case) {
        let mut model = case.reduced(options);
        let mut first = Vec::new();
        for cycle in 0..=33 {
            let position = model.advance(Station { cycle, phase: 0.4 }, |_| ()).unwrap();
            first.push(position.transmission_error);
            if cycle >= 30 {
                let off = position.transmission_error / first[cycle as usize - 30] - 1.0;
                assert!(off.abs() < 1e-9, "cycle {cycle}: {off:e} from a turn before");
            }
        }
        let (_, span) = testing::mean_and_peak_to_peak(first.into_iter());
        assert!(span > 1e-3, "pitch errors of some um show: {span} mm");
    }
}

/// A misalignment in the plane of action undoes a lead slope under load as well; alone each of them softens the mesh.
#[test]
fn lead_slope_and_misalignment_cancel_under_load() {
    let slope = 0.015;
    let plain = generated(0.0, SMALL);
    let sloped = FlankModification { lead_slope: slope, ..FlankModification::default() };
    let sloped = ground(generated(0.0, SMALL), [GearModifications::both(sloped), GearModifications::default()]);
    for options in methods(&plain) {
        let m = Misalignment { in_plane_of_action: -slope, ..Misalignment::default() };
        let offsets = [Offset::default(), m.wheel_offset(&plain.pair, options.side())];
        let (a, b) = (run(&plain, options.clone(), 4, 1), run(&sloped, options.clone(), 4, 1));
        let c = run(&sloped, options.clone().with_contact(|c| c.offsets = offsets), 4, 1);
        for ((a, b), c) in a.positions.iter().zip(&b.positions).zip(&c.positions) {
            let at = format!("{:?}, phase {}", options.contact.method, a.mesh_phase);
            assert!(
                b.secant_stiffness < 0.97 * a.secant_stiffness,
                "{at}: {} {}",
                b.secant_stiffness,
                a.secant_stiffness
            );
            let off = c.transmission_error / a.transmission_error - 1.0;
            assert!(off.abs() < 0.005, "{at}: {off:e}");
        }
    }
}

/// Both gears moved alike, across and along: the same spur pair elsewhere. A wheel moved along its axis alone is the
/// same pair with a narrower face in common.
#[test]
fn a_common_shift_changes_nothing() {
    let case = generated(0.0, SMALL);
    let flank = relieved(&case, 0.01);
    let case = ground(case, [GearModifications::both(flank.clone()), GearModifications::both(flank)]);
    for options in methods(&case) {
        let moved = Offset { x: -0.3, y: 0.5, z: 3.0, ..Offset::default() };
        let shifted = options.clone().with_contact(|c| c.offsets = [moved, moved]);
        let aside = [Offset::default(), Offset { z: 2.0, ..Offset::default() }];
        let narrower = run(&case, options.clone().with_contact(|c| c.offsets = aside), 4, 1);
        let at = format!("{:?}", options.contact.method);
        let (here, there) = (run(&case, options.clone(), 4, 1), run(&case, shifted, 4, 1));
        for ((a, b), c) in here.positions.iter().zip(&there.positions).zip(&narrower.positions) {
            let off = a.transmission_error / b.transmission_error - 1.0;
            assert!(off.abs() < 1e-9, "{at}, phase {}: {off:e}", a.mesh_phase);
            // The pinion's lowest 2 mm have no partner.
            let lowest = c.pairs.iter().flat_map(|p| &p.slices).map(|s| s.z).fold(f64::INFINITY, f64::min);
            assert!(lowest > -8.0, "{at}, phase {}: pressed at z = {lowest}", a.mesh_phase);
        }
    }
}

/// The mirror image (other hand, other sense, offsets mirrored) has the mirrored answer.
#[test]
fn the_mirror_image_is_loaded_alike() {
    let flank = relieved(&generated(20.0, SMALL), 0.01);
    let answer = |beta: f64, sense: Sense, mirror: f64| {
        let gears = || GearModifications::both(flank.clone());
        let case = ground(generated(beta, SMALL), [gears(), gears()]);
        let wheel = Offset { x: 0.02, y: 0.01 * mirror, z: 0.1, tilt_x: 3e-4 * mirror, tilt_y: -2e-4 };
        methods(&case).map(|o| {
            let options = o.clone().with_contact(|c| {
                c.sense = sense;
                c.offsets = [Offset::default(), wheel]
            });
            run(&case, options, 4, 1)
        })
    };
    for (a, b) in answer(20.0, Sense::Ccw, 1.0).iter().zip(&answer(-20.0, Sense::Cw, -1.0)) {
        for (a, b) in a.positions.iter().zip(&b.positions) {
            let off = a.transmission_error / b.transmission_error - 1.0;
            assert!(off.abs() < 1e-7, "phase {}: {} and {}", a.mesh_phase, a.transmission_error, b.transmission_error);
        }
    }
}

/// Offsets are checked before anything is solved, and the unloaded pair needs no mesh.
#[test]
fn the_unloaded_model_is_the_kinematic_one() {
    let case = generated(20.0, SMALL);
    let flank = relieved(&case, 0.01);
    let case = ground(case, [GearModifications::both(flank), GearModifications::default()]);
    let options = StaticOptions { torque: 0.0, ..case.options() };
    for p in &run(&case, options.clone(), 8, 1).positions {
        let station = Station { cycle: 0, phase: p.mesh_phase };
        assert_eq!(p.transmission_error, kinematic_transmission_error(&case.pair, &options.contact, station).unwrap());
    }
}

/// A model that takes gears and tables from one with other micro-geometry, wherever that stands, has the results of one
/// that is made anew, bit by bit: both ways, with pitch errors, friction, misalignment, other slices and another load too.
#[test]
fn modified_models_are_as_new() {
    let case = generated(20.0, SMALL);
    let flank = relieved(&case, 0.012);
    let pitched = GearModifications { pitch_errors: scatter(0.002), ..GearModifications::both(flank.clone()) };
    let offset = Misalignment { inclination: 2e-4, ..Misalignment::default() };
    for options in methods(&case) {
        let other = options.clone().with_contact(|c| {
            c.friction = 0.05;
            c.slices += 8;
            c.offsets = [offset.wheel_offset(&case.pair, options.side()), Offset::default()];
        });
        let other = StaticOptions { torque: 0.6 * options.torque, ..other };
        let variants = [
            (testing::modified(&case.pair, [pitched.clone(), GearModifications::both(flank.clone())]), other),
            (case.pair.clone(), options.clone()),
        ];
        let mut last = case.reduced(options.clone());
        last.run(5, 2, |_, _, _| ()).unwrap();
        for (pair, options) in variants {
            let gears = std::sync::Arc::new(case.reduced_gears(&options));
            let mut anew = ltca::StaticModel::new(pair.clone(), gears, options.clone()).unwrap();
            let mut taken = last.modified(pair, options).unwrap();
            let tables = |model: &ltca::StaticModel| model.contact_set().slices()?.bulk().map(std::ptr::from_ref);
            assert_eq!(tables(&taken), tables(&last), "tables are shared");
            let [a, b] = [&mut anew, &mut taken].map(|model| model.run(6, 1, |_, _, _| ()).unwrap());
            assert_eq!(format!("{a:?}"), format!("{b:?}"));
            last = taken;
        }
    }
}
