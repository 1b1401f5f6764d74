//! A pinion outside of its bearings: how its seat leans.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use fem::beam::BeamPiece;
use gearbox::{Assembly, Bearing, Disc, Structure};
use nalgebra::DVector;

use crate::rotors::{piece, shaft};

/// Slope and deflection at an overhung seat under a force against the closed form with bending and shear, to 1e-6: the
/// elements are exact for loads at nodes, and what is left is the round-off of a stiffness matrix.
///
/// ```text
/// theta = F c (2 l + 3 c)/(6 E I) + F c/(l kappa G A) + theta_b      span l, overhang c, force F at the end
/// u = F c^2 (l + c)/(3 E I) + F c (1 + c/l)/(kappa G A) + u_b      theta_b, u_b: by what the bearings give way
/// ```
/// theta is the turn of the section. In the span the shear force -F c/l shears the axis one way, and as its ends are
/// held the sections turn the other way, the overhang with them.
#[test]
fn slope_and_deflection_of_an_overhung_seat_are_the_closed_form() {
    let (l, c, force, k) = (300.0, 120.0, 5000.0, 2e5);
    let pieces: Vec<BeamPiece> = vec![piece(l + c, [60.0, 20.0])];
    let section = pieces[0].section;
    let held = |name: &str, at: f64, axial: f64| Bearing::diagonal(name, 0, at, [k, k, axial, 0.0, 0.0, axial]);
    let structure = Structure {
        shafts: vec![shaft(pieces, 1e3)],
        discs: vec![Disc::seat("pinion", 0, l + c)],
        bearings: vec![held("far", 0.0, 1e5), held("near", l, 0.0)],
        ..Structure::default()
    };
    let assembly = Assembly::new(structure).unwrap();
    let at = assembly.disc(0).unwrap();
    let (bending, shear) = (section.bending_stiffness(), section.shear_stiffness());
    // Bearing forces -F c/l at 0 and F (1 + c/l) at l press the bearings by these.
    let [far, near] = [-force * c / l / k, force * (1.0 + c / l) / k];
    let rigid = (near - far) / l;
    let turn = force * c * (2.0 * l + 3.0 * c) / (6.0 * bending) + force * c / (l * shear) + rigid;
    let shift = force * c * c * (l + c) / (3.0 * bending) + force * c * (1.0 + c / l) / shear + near + rigid * c;
    for (axis, about, sign) in [(0, 4, 1.0), (1, 3, -1.0)] {
        let mut load = DVector::zeros(assembly.size());
        load[at + axis] = force;
        let q = assembly.stiffness().lu().solve(&load).unwrap();
        let (u, theta) = (q[at + axis], sign * q[at + about]);
        println!("axis {axis}: deflection off by {:.1e}, slope by {:.1e}", u / shift - 1.0, theta / turn - 1.0);
        assert!((u / shift - 1.0).abs() < 1e-6, "axis {axis}: deflection {u} beside {shift} mm");
        assert!((theta / turn - 1.0).abs() < 1e-6, "axis {axis}: slope {theta} beside {turn} rad");
    }
}
