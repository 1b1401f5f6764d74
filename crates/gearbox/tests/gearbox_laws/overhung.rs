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

/// A gear that moves with a cross-section some way off: what a force and a moment do to its middle is what they do to
/// the section, carried over as by a rigid body; and the other way round.
#[test]
fn a_reach_is_a_rigid_body() {
    let (l, c, reach, k) = (300.0, 70.0, 50.0, 2e5);
    let held = |name: &str, at: f64, axial: f64| Bearing::diagonal(name, 0, at, [k, k, axial, 0.0, 0.0, axial]);
    let assembly = |disc: Disc| {
        let structure = Structure {
            shafts: vec![shaft(vec![piece(l + c, [60.0, 20.0])], 1e3)],
            discs: vec![disc],
            bearings: vec![held("far", 0.0, 1e5), held("near", l, 0.0)],
            ..Structure::default()
        };
        Assembly::new(structure).unwrap()
    };
    // Beyond the end of the shaft, and back over it.
    for reach in [reach, -reach] {
        let with = assembly(Disc::seat("gear", 0, l + c + reach).seated_at(l + c));
        let section = assembly(Disc::seat("gear", 0, l + c));
        let (at, on) = (with.disc(0).unwrap(), section.disc(0).unwrap());
        let [compliance, of_section] = [&with, &section].map(|a| a.stiffness().try_inverse().unwrap());
        // u = u_s + turn x (0, 0, h);  forces on the section: f, m + (0, 0, h) x f.
        let mut carried = nalgebra::Matrix6::<f64>::identity();
        carried[(0, 4)] = reach;
        carried[(1, 3)] = -reach;
        let wanted = carried * of_section.fixed_view::<6, 6>(on, on) * carried.transpose();
        let found = compliance.fixed_view::<6, 6>(at, at).into_owned();
        let apart = (found - wanted).amax() / wanted.amax();
        println!("reach {reach}: compliance off by {apart:.1e}");
        assert!(apart < 1e-10, "reach {reach}: compliance of the gear off by {apart:e}");
        let line =
            with.of_sections(&(&compliance * DVector::from_fn(with.size(), |i, _| f64::from(u8::from(i == at)))));
        let straight = (line[at]
            - of_section.fixed_view::<6, 6>(on, on)[(0, 0)]
            - reach * of_section.fixed_view::<6, 6>(on, on)[(0, 4)])
            .abs();
        assert!(straight < 1e-12, "reach {reach}: the section is {straight:e} mm off");
    }
}

/// Mass and inertia of shaft and gear as one body that turns about the origin: the gear counts at its own middle.
#[test]
fn a_reach_carries_its_mass() {
    let (l, reach) = (200.0, 40.0);
    let gear = Disc { mass: 2e-3, diametral_inertia: 3.0, polar_inertia: 5.0, ..Disc::seat("gear", 0, l + reach) };
    let of = |disc: Disc| {
        let structure = Structure {
            shafts: vec![shaft(vec![piece(l, [60.0, 20.0])], 20.0)],
            discs: vec![disc],
            ..Structure::default()
        };
        Assembly::new(structure).unwrap()
    };
    let bare = of(Disc::seat("gear", 0, l));
    let with = of(gear.seated_at(l));
    // u = turn x (0, 0, z) about y: u_x = z; the disc's own coordinates are at its own height.
    let turning = |assembly: &Assembly, end: f64| {
        let node = assembly.disc(0).unwrap();
        let step = l / (assembly.size() as f64 / 6.0 - 1.0);
        DVector::from_fn(assembly.size(), |i, _| match i % 6 {
            0 if i == node => end,
            0 => step * (i / 6) as f64,
            4 => 1.0,
            _ => 0.0,
        })
    };
    let inertia = |assembly: &Assembly, end: f64| {
        let q = turning(assembly, end);
        q.dot(&(assembly.mass() * &q))
    };
    let wanted = inertia(&bare, l) + 2e-3 * (l + reach).powi(2) + 3.0;
    let found = inertia(&with, l + reach);
    assert!((found / wanted - 1.0).abs() < 1e-12, "inertia about the origin {found} beside {wanted} t mm^2");
    // A rigid motion strains nothing.
    let left = (with.stiffness() * turning(&with, l + reach)).amax();
    assert!(left < 1e-4, "{left} N left by a rigid motion");
}

/// Nothing else can be at a section whose coordinates are those of a gear elsewhere.
#[test]
fn a_shared_seat_is_refused() {
    let structure = Structure {
        shafts: vec![shaft(vec![piece(200.0, [60.0, 20.0])], 1e3)],
        discs: vec![Disc::seat("gear", 0, 230.0).seated_at(200.0)],
        bearings: vec![Bearing::diagonal("end", 0, 200.0, [1e5; 6])],
        ..Structure::default()
    };
    let error = Assembly::new(structure).unwrap_err();
    assert!(matches!(error, gearbox::GearboxError::SharedSeat { .. }), "{error}");
    assert!(error.to_string().contains("gear") && error.to_string().contains("end"), "{error}");
}
