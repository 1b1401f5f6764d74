//! Laws that hold at every angle: equilibrium, contact-line length as load vanishes, reduced = full, mirror, scaling.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use contact::complementarity::Law;
use fem::{ElementOptions, IncompatibleModes};
use geometry::{Driver, Gear, GearData, GearPair, Sense};
use ltca::StaticOptions;
use testing::{Case, generated};

/// A pair of helix angle `beta` on small meshes of the built-in mesher.
fn small_case(beta_deg: f64) -> Case {
    generated(beta_deg, [4, 2, 2, 12, 2])
}

/// Total contact-line length as the torque goes to zero against the analytic value L(s), whatever the slices, also where a
/// line has come over an end face and to no slice: within a thousandth at 64 positions; at 30 deg within a hundredth, for a
/// piece of 0.2 mm is missed at one of them.
#[test]
fn contact_line_length_tends_to_the_analytic_one() {
    let angles = [(-20.0, 1e-3), (30.0, 1e-2), (0.0, 1e-3), (10.0, 1e-3)];
    for &(beta, allowed) in &angles[..testing::cases(2, angles.len())] {
        let case = small_case(beta);
        for slices in [12, 48] {
            let mut options = case.options();
            options.torque = 1e-2; // N mm: 150 N m over 1.5e7
            options.contact.slices = slices;
            let mut model = case.reduced(options);
            let history = model.run(64, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("beta {beta}: {e}"));
            let mut worst = (0.0f64, 0.0);
            for p in &history.positions {
                let off = p.contact_line_length / p.geometric_line_length - 1.0;
                if off.abs() > worst.0.abs() {
                    worst = (off, p.mesh_phase);
                }
            }
            println!("beta {beta} deg, {slices} slices: {:.4} % at phase {}", 100.0 * worst.0, worst.1);
            assert!(
                worst.0.abs() < allowed,
                "beta {beta} deg, {slices} slices: {:.4} % at {}",
                100.0 * worst.0,
                worst.1
            );
        }
    }
}

/// The tangent stiffness is the slope of the base force over the transmission error: of slices, of points with a penalty, and of
/// points without, of which more press than the faces can tell apart. What is left is that the slope follows the flanks as they
/// turn on, and the tangent does not.
#[test]
fn the_tangent_stiffness_is_a_slope() {
    let case = small_case(20.0);
    let points = |law, points| case.options().with_contact(|c| (c.law, c.points_per_face_edge) = (law, points));
    let all = [
        ("slices", case.slice_options()),
        ("points, penalty", points(Law::Penalty(1e6), 2)),
        ("points", points(Law::Exact, 2)),
        ("many points", points(Law::Exact, 6)),
    ];
    for (name, options) in all {
        let (torque, step) = (options.torque, 1e-4);
        let base_radius = [&case.pair.pinion, &case.pair.wheel][options.driven()].base_radius();
        let solved = |factor: f64| {
            let mut model = case.reduced(StaticOptions { torque: factor * torque, ..options.clone() });
            model.run(8, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{name}: {e}")).positions
        };
        let [less, own, more] = [1.0 - step, 1.0, 1.0 + step].map(solved);
        let mut worst = 0.0f64;
        for ((a, p), b) in less.iter().zip(&own).zip(&more) {
            let slope = 2.0 * step * torque / base_radius / (b.transmission_error - a.transmission_error);
            worst = worst.max((p.tangent_stiffness / slope - 1.0).abs());
        }
        println!("{name}: tangent stiffness {worst:.1e} off its slope at the most");
        assert!(worst < 1e-3, "{name}: {worst}");
    }
}

/// Contact forces balance the torque; axial / transverse base force = tan(b_b); action = reaction; force sum = T / (r_b
/// cos b_b).
#[test]
fn forces_are_in_equilibrium() {
    for (driver, sense) in [
        (Driver::Pinion, Sense::Ccw),
        (Driver::Pinion, Sense::Cw),
        (Driver::Wheel, Sense::Ccw),
        (Driver::Wheel, Sense::Cw),
    ] {
        let case = small_case(20.0);
        let options = StaticOptions { torque: 20e3, ..case.options() }.with_contact(|c| {
            c.driver = driver;
            c.sense = sense
        });
        let driven = options.driven();
        let base_radius = [&case.pair.pinion, &case.pair.wheel][driven].base_radius();
        let mut model = case.reduced(options);
        let history = model.run(8, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{driver:?} {sense:?}: {e}"));
        for p in &history.positions {
            let [w1, w2] = p.wrench;
            let at = format!("{driver:?} {sense:?}, phase {}", p.mesh_phase);
            assert!(p.certificate.torque_residual < 1e-8, "{at}: torque residual {:e}", p.certificate.torque_residual);
            assert!(
                p.certificate.action_reaction_residual < 1e-8,
                "{at}: {:e}",
                p.certificate.action_reaction_residual
            );
            for k in 0..3 {
                assert!((w1.force[k] + w2.force[k]).abs() < 1e-9 * 500.0, "{at}: forces {w1:?} {w2:?}");
            }
            // On the plane of action every normal force has the same direction.
            let a_wt = case.pair.working_pressure_angle();
            let on_plane = w1.force[0].hypot(w1.force[1]);
            // The transverse base force is the torque over the base radius. The resultant of the transverse forces is a
            // few 1e-6 smaller: the loaded band has a width, and across it the normals turn.
            let base_force = w2.moment[2].abs() / case.pair.wheel.base_radius();
            let ratio = w1.force[2].abs() / base_force;
            let wanted = case.pair.base_helix_angle().tan();
            assert!((ratio / wanted - 1.0).abs() < 1e-6, "{at}: axial / base force {ratio}, tan b_b {wanted}");
            assert!((on_plane / base_force - 1.0).abs() < 1e-5, "{at}: resultant {on_plane}, base force {base_force}");
            assert!((w1.force[0].abs() / on_plane - a_wt.sin()).abs() < 1e-3, "{at}: pressure angle");
            let total: f64 = p.pairs.iter().map(|q| q.normal_force).sum();
            let sum = 20e3 / base_radius / case.pair.base_helix_angle().cos();
            // The normals are the wheel's: exact for its torque, to the width of the band for the pinion's.
            assert!((total / sum - 1.0).abs() < 1e-4, "{at}: sum of normal forces {total}, {sum}");
            assert!(p.transmission_error > 0.0, "{at}: the driven gear lags: {}", p.transmission_error);
        }
    }
}

/// Contact on all degrees of freedom and on the reduced gears agrees: STE and pair forces within 1e-8, with either
/// law.
#[test]
fn reduced_equals_full() {
    let case = generated(20.0, [2, 2, 2, 4, 1]);
    for law in [Law::Penalty(1e7), Law::Exact] {
        let options = case.options().with_contact(|c| {
            c.law = law;
            c.points_per_face_edge = 4
        });
        let reduced = case.reduced(options.clone()).run(4, 1, |_, _, _| ()).unwrap();
        let full = case.full(options).run(4, 1, |_, _, _| ()).unwrap();
        let mut worst = [0.0f64; 2];
        for (r, f) in reduced.positions.iter().zip(&full.positions) {
            worst[0] = worst[0].max((r.transmission_error / f.transmission_error - 1.0).abs());
            let total: f64 = f.pairs.iter().map(|p| p.normal_force).sum();
            for (a, b) in r.pairs.iter().zip(&f.pairs) {
                worst[1] = worst[1].max((a.normal_force - b.normal_force).abs() / total);
            }
        }
        println!("{law:?}: STE within {:.1e}, pair forces within {:.1e}", worst[0], worst[1]);
        assert!(worst[0] < 1e-8 && worst[1] < 1e-8, "{law:?}: {worst:?}");
    }
}

/// The other hand turned the other way is the mirror image: same STE, axial force and its moment flip.
#[test]
fn mirror_image_has_the_mirrored_answer() {
    let right = small_case(20.0);
    let left = small_case(-20.0);
    let run = |case: &Case, sense| {
        let options = case.options().with_contact(|c| c.sense = sense);
        case.reduced(options).run(4, 1, |_, _, _| ()).unwrap()
    };
    for (a, b) in run(&right, Sense::Ccw).positions.iter().zip(&run(&left, Sense::Cw).positions) {
        let off = a.transmission_error / b.transmission_error - 1.0;
        assert!(off.abs() < 1e-8, "phase {}: {} and {}", a.mesh_phase, a.transmission_error, b.transmission_error);
        // Mirrored in the plane y = 0: x and z forces stay, y flips; hand and sense both flipped leave the axial force.
        let (f, g) = (a.wrench[0].force, b.wrench[0].force);
        assert!((f[0] - g[0]).abs() < 1e-5 && (f[1] + g[1]).abs() < 1e-5 && (f[2] - g[2]).abs() < 1e-5, "{f:?} {g:?}");
        assert_eq!(
            a.pairs.iter().map(|p| p.pair).collect::<Vec<_>>(),
            b.pairs.iter().map(|p| p.pair).collect::<Vec<_>>()
        );
    }
    for (a, b) in run(&right, Sense::Ccw).positions.iter().zip(&run(&left, Sense::Ccw).positions) {
        let ratio = a.wrench[0].force[2] / b.wrench[0].force[2];
        assert!((ratio + 1.0).abs() < 1e-6, "the other hand flips the axial force: {ratio}");
    }
}

/// Geometry times s and line load times s: the transmission error times s.
#[test]
fn answers_scale_with_the_gears() {
    let one = small_case(20.0);
    let scale = 2.5;
    let bigger = |sign: f64| {
        let d = GearData::default();
        Gear::new(GearData {
            normal_module: scale * d.normal_module,
            face_width: scale * d.face_width,
            thickness_allowance: scale * d.thickness_allowance,
            bore_diameter: scale * d.bore_diameter,
            helix_angle: sign * d.helix_angle,
            ..d
        })
        .unwrap()
    };
    let pair = GearPair::new(bigger(1.0), bigger(-1.0), None).unwrap();
    let meshes = one.meshes.clone().map(|m| testing::scaled(&m, scale));
    let large = Case { pair, meshes, elements: one.elements, torque: one.torque * scale.powi(3) };
    let a = one.reduced(one.options()).run(4, 1, |_, _, _| ()).unwrap();
    let b = large.reduced(large.options()).run(4, 1, |_, _, _| ()).unwrap();
    for (a, b) in a.positions.iter().zip(&b.positions) {
        let ratio = b.transmission_error / a.transmission_error;
        assert!((ratio / scale - 1.0).abs() < 1e-9, "phase {}: {ratio}", a.mesh_phase);
    }
}

/// Same bits whether one thread works or four.
#[test]
fn threads_do_not_change_a_bit() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let case = generated(20.0, [2, 2, 2, 4, 1]);
            case.reduced(case.options()).run(4, 1, |_, _, _| ()).unwrap()
        })
    };
    let one = run(1);
    for threads in [2, 4] {
        assert_eq!(format!("{one:?}"), format!("{:?}", run(threads)), "{threads} threads");
    }
}

/// A plain hex8 locks in tooth bending; the incompatible modes set it free.
#[test]
fn plain_hex8_locks() {
    let soft = generated(20.0, [3, 2, 2, 6, 2]);
    let options = ElementOptions { incompatible_modes: IncompatibleModes::Off, ..ElementOptions::default() };
    let stiff = Case { elements: options, ..generated(20.0, [3, 2, 2, 6, 2]) };
    let mean = |case: &Case| {
        let history = case.reduced(case.options()).run(4, 1, |_, _, _| ()).unwrap();
        testing::mean_and_peak_to_peak(history.positions.iter().map(|p| p.transmission_error)).0
    };
    let (soft, stiff) = (mean(&soft), mean(&stiff));
    println!("mean STE: incompatible modes {:.3} um, plain hex8 {:.3} um", 1e3 * soft, 1e3 * stiff);
    assert!(stiff < 0.97 * soft, "{stiff} against {soft}");
}

/// Keeping the coast flanks too changes nothing as long as they do not touch; flanks that are no pair are never rows,
/// although their smooth surfaces go on behind the teeth.
#[test]
fn coast_flanks_stay_out_of_it() {
    let case = generated(20.0, [2, 2, 2, 4, 1]);
    let run = |both_flanks: bool| {
        let options = case.options().with_contact(|c| {
            c.both_flanks = both_flanks;
            c.points_per_face_edge = 4
        });
        case.reduced(options).run(8, 2, |_, _, _| ()).unwrap()
    };
    for (a, b) in run(false).positions.iter().zip(&run(true).positions) {
        let off = a.transmission_error / b.transmission_error - 1.0;
        assert!(off.abs() < 1e-9, "phase {}: {off:e}", a.mesh_phase);
    }
}

/// From a feather's touch to overload: equilibrium is found, and without torque the flanks just touch. Teeth bent far
/// enough bring in pairs beside the least window, which is an error; a wider window solves it.
#[test]
fn any_torque_is_solved() {
    let case = generated(20.0, [2, 2, 2, 4, 1]);
    let starved = StaticOptions { torque: 1e7, ..case.options() }.with_contact(|c| c.points_per_face_edge = 4);
    let error = case.reduced(starved).run(4, 1, |_, _, _| ()).unwrap_err();
    assert!(error.is_starved(), "{error}");
    for (torque, window) in
        [(0.0, None), (1e-9, None), (1e-3, None), (1.0, None), (1e3, None), (1e6, None), (1e7, Some(5))]
    {
        let options = StaticOptions { torque, window, ..case.options() }.with_contact(|c| c.points_per_face_edge = 4);
        let history = case.reduced(options).run(4, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{torque} N mm: {e}"));
        for p in &history.positions {
            assert!(p.certificate.torque_residual < 1e-8, "{torque} N mm: {:?}", p.certificate);
            // An angle of a few radians is known to some 1e-14 mm on the base circle.
            assert!(p.transmission_error >= -1e-13, "{torque} N mm: {}", p.transmission_error);
        }
    }
}
