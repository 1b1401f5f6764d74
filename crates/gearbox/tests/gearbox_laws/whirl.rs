//! Whirl modes of rotors: references, symmetry, and what must be zero.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::PI;

use fem::beam::BeamPiece;
use gearbox::{Assembly, Component, GearboxError, MeshSpring, Rotors, Structure};
use nalgebra::{DMatrix, Vector6};

use crate::rotors::{friswell, overhung, piece, radial, shaft};

fn rotors(structure: Structure) -> Rotors {
    Rotors::new(Assembly::new(structure).unwrap()).unwrap()
}

/// Frequencies of Friswell's example 5.9.1 to the printed digits, rad/s; the fifth at rest is torsion.
#[test]
fn friswells_rotor_has_the_printed_frequencies() {
    let rotor = rotors(friswell());
    let printed = [
        (0.0, [86.66, 86.66, 274.31, 274.31, 650.41, 716.79]),
        (4000.0 * PI / 30.0, [85.39, 87.80, 251.78, 294.71, 600.18, 650.41]),
    ];
    for (speed, wanted) in printed {
        let found = rotor.whirl_modes(&[speed]).unwrap();
        println!("{speed:.1} rad/s: {:.4?}", found.modes.iter().take(6).map(|m| m.frequency).collect::<Vec<_>>());
        for (mode, wanted) in found.modes.iter().zip(wanted) {
            // Half a unit of the last digit printed; 716.78 is printed for 716.786, cut and not rounded.
            let off = (mode.frequency - wanted).abs();
            assert!(off <= 0.0051, "{speed} rad/s: {} beside {wanted} rad/s", mode.frequency);
        }
    }
}

/// Each pair of bending modes splits into one that whirls against the spin and falls, and one with it that rises.
#[test]
fn backward_whirl_falls_and_forward_whirl_rises_with_speed() {
    let rotor = rotors(friswell());
    for spin in [400.0, -400.0] {
        let found = rotor.whirl_modes(&[spin]).unwrap();
        for (i, wanted) in [(0, -1.0), (1, 1.0), (2, -1.0), (3, 1.0)] {
            let whirl = found.modes[i].whirl[0];
            // Alike bearings: circles, to the digits that the eigenvectors of modes so near have.
            assert!((whirl - wanted).abs() < 1e-6, "{spin} rad/s, mode {i}: whirl {whirl}");
        }
        let rest = rotor.whirl_modes(&[0.0]).unwrap();
        assert!(found.modes[0].frequency < rest.modes[0].frequency);
        assert!(found.modes[1].frequency > rest.modes[0].frequency);
        assert!(rest.modes.iter().all(|m| m.whirl == [0.0]), "nothing whirls at rest");
    }
}

/// Bearings of unlike stiffness make ellipses; torsion whirls nowhere; and unheld turning is two zeros.
#[test]
fn torsion_does_not_whirl_and_a_free_turn_is_zero() {
    let found = rotors(overhung()).whirl_modes(&[1000.0]).unwrap();
    assert_eq!(found.zeros, 2, "the shaft turns freely");
    let torsion = found.modes.iter().find(|m| (m.frequency - 3810.679).abs() < 1.0).unwrap();
    assert_eq!(torsion.whirl, [0.0]);
    let lateral = found.modes[0].whirl[0];
    assert!(lateral < 0.0 && lateral > -1.0, "an ellipse: {lateral}");
}

/// A free shaft at rest has its six rigid motions, twelve zeros, and nothing else below its first bending mode.
#[test]
fn the_six_rigid_motions_of_a_free_shaft_are_zero() {
    let free = Structure { shafts: vec![shaft(vec![piece(400.0, [50.0, 0.0])], 50.0)], ..Structure::default() };
    let rotor = rotors(free);
    let rest = &rotor.modes_at_rest().frequencies;
    assert!(rest[..6].iter().all(|w| *w == 0.0) && rest[6] > 1e3, "{:?}", &rest[..8]);
    let found = rotor.whirl_modes(&[0.0]).unwrap();
    assert_eq!(found.zeros, 12);
    // Euler-Bernoulli, free at both ends: 22.37 sqrt(E I/(m l^4)); shear and rotary inertia take some per cent of it.
    let section = piece(400.0, [50.0, 0.0]).section;
    let slender = 22.3733 * (section.bending_stiffness() / section.mass_per_length()).sqrt() / 400.0f64.powi(2);
    assert!((0.9..1.0).contains(&(found.modes[0].frequency / slender)), "{} of {slender}", found.modes[0].frequency);
    // A spinning free body precesses at I_p/I_d of its spin: gyroscopic moments alone, no strain.
    let spinning = rotor.whirl_modes(&[100.0]).unwrap();
    let first = &spinning.modes[0];
    let (mass, radius, length) = (section.mass_per_length() * 400.0, 25.0f64, 400.0f64);
    let polar = 0.5 * mass * radius * radius;
    let ratio = polar / (0.5 * polar + mass * length * length / 12.0);
    assert!((first.frequency / (100.0 * ratio) - 1.0).abs() < 1e-6, "{} of {}", first.frequency, 100.0 * ratio);
    assert!(first.energy.strain.is_empty() && (first.whirl[0] - 1.0).abs() < 1e-6, "{first:?}");
}

/// A rotor of less than a hertz on soft bearings, its shaft cut once more beside a disc: however near, the modes are
/// those of the shaft that is not cut, and so is the number of rigid motions.
#[test]
fn a_cut_beside_a_seat_loses_no_mode() {
    let soft = |apart: f64| {
        let mut structure = friswell();
        let whole = structure.shafts[0].pieces[0];
        let piece = |length: f64| BeamPiece { length, ..whole };
        structure.shafts[0].pieces = vec![piece(500.0 - apart), piece(1000.0 + apart)];
        structure.bearings = [0.0, 1500.0].map(|z| radial(z, [1.0, 1.0, 0.0])).into();
        // A length that the cut does not take over a whole number of elements.
        structure.shafts[0].longest_element = 260.0;
        structure
    };
    let wanted = rotors(soft(0.0)).whirl_modes(&[300.0]).unwrap();
    assert!(wanted.zeros == 4 && wanted.modes[0].frequency < 10.0, "{} zeros", wanted.zeros);
    for power in 2..=12 {
        let apart = 10f64.powi(-power);
        let found = rotors(soft(apart)).whirl_modes(&[300.0]).unwrap();
        assert_eq!(found.zeros, wanted.zeros, "{apart} mm: {} modes beside {}", found.modes.len(), wanted.modes.len());
        for (a, b) in found.modes.iter().zip(&wanted.modes).take(8) {
            let off = (a.frequency / b.frequency - 1.0).abs();
            assert!(off < 1e-5 + 1e-4 * apart, "{apart} mm: {} beside {} rad/s", a.frequency, b.frequency);
        }
    }
}

/// A bearing so soft that its mode cannot be told from round-off is refused, where it once counted as none; one that is
/// not there at all is none.
#[test]
fn a_mode_that_round_off_hides_is_refused() {
    let with = |stiffness: f64| {
        let mut structure = friswell();
        structure.bearings[0].stiffness[(2, 2)] = stiffness;
        Rotors::new(Assembly::new(structure).unwrap())
    };
    let hidden = with(1e-9).unwrap_err();
    assert!(matches!(hidden, GearboxError::LostMode { .. }) && hidden.hint().is_some(), "{hidden}");
    let zeros = |rotor: Rotors| rotor.modes_at_rest().frequencies.iter().filter(|w| **w == 0.0).count();
    assert_eq!([0.0, 1.0].map(|stiffness| zeros(with(stiffness).unwrap())), [2, 1]);
}

/// G' = -G to the last bit, and it grows with the spin.
#[test]
fn gyroscopic_matrices_are_skew() {
    let assembly = Assembly::new(friswell()).unwrap();
    let g = assembly.gyroscopic(&[300.0]).unwrap();
    assert!(g.amax() > 0.0);
    assert_eq!((&g + g.transpose()).amax(), 0.0);
    let twice = assembly.gyroscopic(&[600.0]).unwrap();
    assert!((twice - 2.0 * &g).amax() <= 1e-15 * g.amax());
    // A rigid turn of all about x meets the whole polar inertia: half of the mass times the square of the radius.
    let (mut about_x, mut about_y) =
        (nalgebra::DVector::zeros(assembly.size()), nalgebra::DVector::zeros(assembly.size()));
    for node in 0..7 {
        let z = 250.0 * node as f64;
        about_x[6 * node + 3] = 1.0;
        about_x[6 * node + 1] = -z;
        about_y[6 * node + 4] = 1.0;
        about_y[6 * node] = z;
    }
    let of_shaft = 0.5 * piece(1500.0, [50.0, 0.0]).section.mass_per_length() * 1500.0 * 25.0f64.powi(2);
    let of_discs: f64 = friswell().discs.iter().map(|d| d.polar_inertia).sum();
    let momentum = about_x.dot(&(&g * &about_y));
    assert!((momentum / (300.0 * (of_shaft + of_discs)) - 1.0).abs() < 1e-12, "{momentum}");
}

/// Two shafts in mesh, on a housing: shares of strain and kinetic energy of every mode add up to the whole.
#[test]
fn energy_of_a_mode_is_that_of_its_parts() {
    let mut structure = friswell();
    let mut second = friswell();
    second.shafts[0].origin = [300.0, 0.0, 0.0];
    second.discs.iter_mut().for_each(|d| d.shaft = 1);
    second.bearings.iter_mut().for_each(|b| b.shaft = 1);
    structure.shafts.append(&mut second.shafts);
    structure.discs.append(&mut second.discs);
    structure.bearings.append(&mut second.bearings);
    // A foundation under each seat, and a wall between the seats of each side.
    let mut housing = DMatrix::from_diagonal_element(24, 24, 3e3);
    for axis in 0..3 {
        for (a, b) in [(0, 2), (1, 3)] {
            let (i, j) = (6 * a + axis, 6 * b + axis);
            for (row, column, sign) in [(i, i, 1.0), (j, j, 1.0), (i, j, -1.0), (j, i, -1.0)] {
                housing[(row, column)] += sign * 2e3;
            }
        }
    }
    structure.housing = Some(housing);
    structure.springs.push(MeshSpring {
        name: "mesh".into(),
        discs: [0, 2],
        levers: [Vector6::new(0.3, 0.9, 0.2, 10.0, -5.0, 130.0), Vector6::new(-0.3, -0.9, -0.2, 10.0, -5.0, 130.0)],
        stiffness: 2e5,
    });
    let found = rotors(structure).whirl_modes(&[300.0, -300.0]).unwrap();
    let mut by_mesh = 0;
    for mode in &found.modes {
        for (what, shares) in [("strain", &mode.energy.strain), ("kinetic", &mode.energy.kinetic)] {
            let sum: f64 = shares.iter().map(|s| s.share).sum();
            // Entries of the stiffness are some 1e9 times the energy of a low mode.
            assert!((sum - 1.0).abs() < 1e-6, "{what} energy at {} rad/s adds up to {sum}", mode.frequency);
            assert!(shares.iter().all(|s| s.share > -1e-6), "{what} at {}: {shares:?}", mode.frequency);
        }
        let share = |c: Component| mode.energy.strain.iter().find(|s| s.component == c).map_or(0.0, |s| s.share);
        by_mesh += usize::from(share(Component::Mesh(0)) > 0.1);
        assert!(mode.decay.abs() < 1e-6 * mode.frequency, "nothing takes energy: {} 1/s", mode.decay);
    }
    assert!(by_mesh > 0, "no mode bends the mesh");
}

/// A bearing on a housing is the two springs in series, and a soft housing lowers the frequencies.
#[test]
fn bearing_and_housing_are_springs_in_series() {
    let mut series = friswell();
    series.housing = Some(DMatrix::from_diagonal_element(12, 12, 1e3));
    let mut soft = friswell();
    soft.bearings.iter_mut().for_each(|b| b.stiffness *= 0.5);
    let (a, b) = (rotors(series).whirl_modes(&[200.0]).unwrap(), rotors(soft).whirl_modes(&[200.0]).unwrap());
    for (a, b) in a.modes.iter().zip(&b.modes).take(8) {
        assert!((a.frequency / b.frequency - 1.0).abs() < 1e-9, "{} beside {}", a.frequency, b.frequency);
    }
    let stiff = rotors(friswell()).whirl_modes(&[200.0]).unwrap();
    assert!(a.modes[0].frequency < stiff.modes[0].frequency);
}

/// Dampers in the bearings take energy: every mode that moves them decays.
#[test]
fn damped_bearings_let_motions_decay() {
    let mut structure = friswell();
    structure.bearings.iter_mut().for_each(|b| b.damping = 1e-3 * b.stiffness);
    let found = rotors(structure).whirl_modes(&[200.0]).unwrap();
    let first = &found.modes[0];
    assert!(first.decay > 0.0 && first.decay < first.frequency, "{} 1/s", first.decay);
}

/// What has no meaning is refused with the part's name.
#[test]
fn parts_beside_the_shaft_or_without_sense_are_refused() {
    assert_eq!(Assembly::new(Structure::default()), Err(GearboxError::NoShafts));
    let mut beside = friswell();
    beside.discs[0].position = 1501.0;
    assert!(matches!(Assembly::new(beside), Err(GearboxError::OffShaft { .. })));
    let mut skew = friswell();
    skew.bearings[0].stiffness[(0, 1)] = 500.0;
    assert!(matches!(Assembly::new(skew), Err(GearboxError::NotElastic { .. })));
    let mut pushing = friswell();
    pushing.bearings[0].stiffness[(0, 0)] = -1.0;
    assert!(matches!(Assembly::new(pushing), Err(GearboxError::NotElastic { .. })));
    let mut small = friswell();
    small.housing = Some(DMatrix::zeros(6, 6));
    assert!(matches!(Assembly::new(small), Err(GearboxError::HousingSize { found: 6, wanted: 12, .. })));
    let mut nan = friswell();
    nan.discs[0].mass = f64::NAN;
    assert!(matches!(Assembly::new(nan), Err(GearboxError::OutOfRange { .. })));
    let mut fine = friswell();
    fine.shafts[0].longest_element = 1e-3;
    assert!(matches!(Assembly::new(fine), Err(GearboxError::TooLarge { most: 600, .. })));
    let mut endless = friswell();
    endless.shafts[0].longest_element = f64::NAN;
    assert!(matches!(Assembly::new(endless), Err(GearboxError::Shaft { .. })));
    let mut elsewhere = friswell();
    elsewhere.bearings[0].shaft = 3;
    assert!(matches!(Assembly::new(elsewhere), Err(GearboxError::NoShaft { shaft: 3, count: 1, .. })));
    let rotor = rotors(friswell());
    assert!(matches!(rotor.whirl_modes(&[]), Err(GearboxError::Count { found: 0, wanted: 1, .. })));
    assert!(matches!(rotor.whirl_modes(&[f64::INFINITY]), Err(GearboxError::OutOfRange { .. })));
}
