//! Beams against closed forms.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::PI;

use fem::beam::{BeamLine, BeamPiece, BeamSection, BeamTheory, NODE_COORDINATES};
use fem::{FemError, Material, natural_modes};
use nalgebra::{DMatrix, DVector};

const LENGTH: f64 = 200.0;

fn section() -> BeamSection {
    BeamSection::new(30.0, 12.0, Material::STEEL).unwrap()
}

fn line(elements: u32, theory: BeamTheory) -> BeamLine {
    let piece = BeamPiece { length: LENGTH, section: section() };
    BeamLine::new(&[piece], &[], LENGTH / f64::from(elements), theory).unwrap()
}

/// Rows and columns of the coordinates that are not `held`.
fn kept(a: &DMatrix<f64>, held: &[usize]) -> DMatrix<f64> {
    let free: Vec<usize> = (0..a.nrows()).filter(|i| !held.contains(i)).collect();
    DMatrix::from_fn(free.len(), free.len(), |i, j| a[(free[i], free[j])])
}

/// Every load at the end of a cantilever: deflection, slope, stretch and twist of elementary theory, with any number of
/// elements.
#[test]
fn cantilever_deflects_as_theory_says() {
    let s = section();
    let (l, ei, gip, ea) = (LENGTH, s.bending_stiffness(), s.torsional_stiffness(), s.axial_stiffness());
    for theory in [BeamTheory::Timoshenko, BeamTheory::Euler] {
        let shear = if theory == BeamTheory::Timoshenko { l / s.shear_stiffness() } else { 0.0 };
        // Displacement of the end by its load: x by f_x, theta_y by f_x, theta_y by m_y, y by f_y, theta_x by f_y, z,
        // theta_z.
        let cases = [
            (0, 0, l.powi(3) / (3.0 * ei) + shear),
            (4, 0, l * l / (2.0 * ei)),
            (4, 4, l / ei),
            (1, 1, l.powi(3) / (3.0 * ei) + shear),
            (3, 1, -l * l / (2.0 * ei)),
            (2, 2, l / ea),
            (5, 5, l / gip),
        ];
        for elements in [1, 7] {
            let line = line(elements, theory);
            let held: Vec<usize> = (0..NODE_COORDINATES).collect();
            let k = kept(&line.stiffness, &held);
            let end = k.nrows() - NODE_COORDINATES;
            for (of, by, expected) in cases {
                let mut load = DVector::zeros(k.nrows());
                load[end + by] = 1.0;
                let found = k.clone().lu().solve(&load).unwrap()[end + of];
                assert!(
                    (found / expected - 1.0).abs() < 1e-9,
                    "{theory:?}, {elements} elements, coordinate {of} by load {by}: {found:e}, not {expected:e}"
                );
            }
        }
    }
}

/// A free shaft: six motions without strain, and the mass that moves in each is that of the rigid body.
#[test]
fn rigid_motions_cost_nothing_and_carry_the_whole_mass() {
    let s = section();
    let line = line(5, BeamTheory::Timoshenko);
    let n = line.stiffness.nrows();
    let (mass, rotary) = (s.mass_per_length() * LENGTH, s.inertia_per_length() * LENGTH);
    let across = mass * LENGTH * LENGTH / 3.0 + rotary;
    let cases: [(&str, usize, f64); 6] = [
        ("x", 0, mass),
        ("y", 1, mass),
        ("z", 2, mass),
        ("about x", 3, across),
        ("about y", 4, across),
        ("about z", 5, 2.0 * rotary),
    ];
    for (name, axis, expected) in cases {
        let motion = DVector::from_fn(n, |i, _| {
            let (z, c) = (line.positions()[i / NODE_COORDINATES], i % NODE_COORDINATES);
            match (axis, c) {
                (3, 1) => -z,
                (4, 0) => z,
                _ => f64::from(u8::from(c == axis)),
            }
        });
        let force = (&line.stiffness * &motion).amax();
        let found = motion.dot(&(&line.mass * &motion));
        assert!(force < 1e-9 * line.stiffness.amax() * motion.amax(), "{name}: {force:e} N");
        assert!((found / expected - 1.0).abs() < 1e-12, "{name}: {found:e}, not {expected:e}");
    }
}

/// Pinned at both ends. Euler: omega_k = (k pi/l)^2 sqrt(E I / rho A). Timoshenko: the lower root of omega^4 rho^2 /
/// (kappa G E) - omega^2 [rho A/(E I) + q^2 rho/E (1 + E/(kappa G))] + q^4 = 0, q = k pi/l. Shear is constant within an
/// element, so the error falls with the square of its length; without shear it is of fourth order.
#[test]
fn pinned_beam_vibrates_at_the_closed_form() {
    let s = section();
    let (rho, e) = (s.material().density_t_per_mm3(), s.material().young_mpa());
    let shear = s.shear_stiffness() / s.area();
    for (theory, order) in [(BeamTheory::Timoshenko, 2.0), (BeamTheory::Euler, 4.0)] {
        let [coarse, fine] = [12, 24].map(|elements| {
            let line = line(elements, theory);
            // One plane: x and theta_y.
            let last = NODE_COORDINATES * (line.positions().len() - 1);
            let held: Vec<usize> =
                (0..line.stiffness.nrows()).filter(|i| ![0, 4].contains(&(i % 6)) || *i == 0 || *i == last).collect();
            natural_modes(&kept(&line.stiffness, &held), &kept(&line.mass, &held)).unwrap().frequencies
        });
        for mode in 1..=4 {
            let q = f64::from(mode) * PI / LENGTH;
            let euler = q.powi(4) * s.bending_stiffness() / s.mass_per_length();
            let expected = match theory {
                BeamTheory::Euler => euler.sqrt(),
                BeamTheory::Timoshenko => {
                    let a = rho * rho / (shear * e);
                    let b = s.mass_per_length() / s.bending_stiffness() + q * q * rho / e * (1.0 + e / shear);
                    ((b - (b * b - 4.0 * a * q.powi(4)).sqrt()) / (2.0 * a)).sqrt()
                }
            };
            let [coarse, fine] = [&coarse, &fine].map(|all| all[mode as usize - 1] / expected - 1.0);
            let observed = (coarse / fine).log2();
            println!("{theory:?} {mode}: {:.2} Hz, off by {fine:.1e}, order {observed:.2}", expected / (2.0 * PI));
            assert!(fine > 0.0 && fine < 6e-3, "{theory:?} {mode}: off by {fine:e} of {expected} rad/s");
            assert!(fine < 1e-7 || (observed - order).abs() < 0.15, "{theory:?} {mode}: order {observed}");
        }
    }
}

#[test]
fn nodes_stand_where_they_are_wanted() {
    let thin = BeamSection::new(20.0, 0.0, Material::STEEL).unwrap();
    let pieces = [BeamPiece { length: 50.0, section: section() }, BeamPiece { length: 30.0, section: thin }];
    let line = BeamLine::new(&pieces, &[12.5, 50.0, 71.0, 80.0, 0.0], 20.0, BeamTheory::Timoshenko).unwrap();
    for place in [0.0, 12.5, 50.0, 71.0, 80.0] {
        assert!((line.positions()[line.node_at(place)] - place).abs() < 1e-12, "{:?}", line.positions());
    }
    assert!(line.positions().windows(2).all(|w| w[1] - w[0] <= 20.0 && w[1] > w[0]), "{:?}", line.positions());
}

/// A section that is cut once more, or a place, beside another place moves no frequency of a pinned shaft by more than a
/// cut of that size can, however near: from a tenth of the diameter down to less than the last digit. Sizes change nothing.
#[test]
fn what_nearly_coincides_changes_no_frequency() {
    let frequencies = |size: f64, apart: f64, as_place: bool| {
        let section = BeamSection::new(size * 20.0, 0.0, Material::STEEL).unwrap();
        let piece = |length: f64| BeamPiece { length, section };
        let (cut, mut places) = (size * (50.0 - apart), vec![size * 50.0]);
        let pieces = if as_place {
            places.push(cut);
            vec![piece(size * 200.0)]
        } else {
            vec![piece(cut), piece(size * 200.0 - cut)]
        };
        let line = BeamLine::new(&pieces, &places, size * 27.0, BeamTheory::Timoshenko).unwrap();
        let n = line.stiffness.nrows();
        // Pinned at both ends, x and y, and held along and about the axis at the first.
        let held = [0, 1, 2, 5, n - 6, n - 5];
        let modes = natural_modes(&kept(&line.stiffness, &held), &kept(&line.mass, &held)).unwrap();
        (line.positions().len(), modes.frequencies.iter().take(6).map(|w| w * size).collect::<Vec<f64>>())
    };
    for size in [1.0, 1e-2, 1e3] {
        let (nodes, wanted) = frequencies(size, 0.0, false);
        for as_place in [false, true] {
            for power in 1..=14 {
                let apart = 10f64.powi(-power);
                let (found_nodes, found) = frequencies(size, apart, as_place);
                // Without the cut the elements are those of before, but for its width.
                assert!(found_nodes <= nodes + 1, "{found_nodes} nodes, {nodes} without the cut");
                assert_eq!(
                    found_nodes == nodes,
                    apart < 1e-3,
                    "{apart} mm at {size}: {found_nodes} nodes beside {nodes}"
                );
                for (a, b) in found.iter().zip(&wanted) {
                    let off = (a / b - 1.0).abs();
                    assert!(off < 1e-7 + 1e-3 * apart, "{apart} mm at {size}: {a} beside {b} rad/s, {off:e}");
                }
            }
        }
    }
}

#[test]
fn nonsense_is_refused() {
    for (outer, inner) in [(0.0, 0.0), (10.0, 10.0), (10.0, -1.0), (f64::NAN, 0.0), (f64::INFINITY, 0.0)] {
        assert!(matches!(BeamSection::new(outer, inner, Material::STEEL), Err(FemError::Section { .. })));
    }
    let of = |length: f64, place: f64, longest: f64| {
        BeamLine::new(&[BeamPiece { length, section: section() }], &[place], longest, BeamTheory::Euler)
    };
    for (length, place, longest) in [
        (0.0, 0.0, 1.0),
        (-1.0, 0.0, 1.0),
        (f64::NAN, 0.0, 1.0),
        (10.0, 11.0, 1.0),
        (10.0, f64::NAN, 1.0),
        (10.0, 0.0, 0.0),
        (10.0, 0.0, f64::NAN),
    ] {
        assert!(matches!(of(length, place, longest), Err(FemError::Length { .. })), "{length}, {place}, {longest}");
    }
    assert!(BeamLine::new(&[], &[], 1.0, BeamTheory::Euler).is_err());
}
