//! The rotors of the references.

use fem::{
    Material,
    beam::{BeamPiece, BeamSection},
};
use gearbox::{Bearing, Disc, Shaft, Structure};

/// Steel of E 211 GPa, G 81.2 GPa, 7810 kg/m^3.
pub fn steel() -> Material {
    Material::new(2.11e5, 2.11e5 / (2.0 * 8.12e4) - 1.0, 7.81e-9).unwrap()
}

pub fn piece(length: f64, [outer, inner]: [f64; 2]) -> BeamPiece {
    BeamPiece { length, section: BeamSection::new(outer, inner, steel()).unwrap() }
}

pub fn shaft(pieces: Vec<BeamPiece>, longest_element: f64) -> Shaft {
    Shaft { name: "shaft".into(), origin: [0.0; 3], pieces, longest_element }
}

pub fn radial(position: f64, [x, y, z]: [f64; 3]) -> Bearing {
    Bearing::diagonal(format!("bearing at {position}"), 0, position, [x, y, z, 0.0, 0.0, 0.0])
}

/// Example 5.9.1 of M. I. Friswell et al., Dynamics of Rotating Machines, 2010: 1.5 m x 50 mm, discs at the thirds,
/// bearings of 1 MN/m, six Timoshenko elements.
pub fn friswell() -> Structure {
    let disc = |name: &str, at: f64, outer: f64| Disc::ring(name, 0, at, [outer, 50.0], 70.0, 7.81e-9);
    Structure {
        shafts: vec![shaft(vec![piece(1500.0, [50.0, 0.0])], 250.0)],
        discs: vec![disc("left", 500.0, 280.0), disc("right", 1000.0, 350.0)],
        bearings: [0.0, 1500.0].map(|z| radial(z, [1e3, 1e3, 0.0])).into(),
        ..Structure::default()
    }
}

/// An overhung disc on a stepped hollow shaft, a second disc between bearings of unlike stiffness.
pub fn overhung() -> Structure {
    let disc = |name: &str, position, mass, diametral_inertia, polar_inertia| Disc {
        name: name.into(),
        shaft: 0,
        position,
        reach: 0.0,
        mass,
        diametral_inertia,
        polar_inertia,
    };
    Structure {
        shafts: vec![shaft(
            vec![piece(200.0, [60.0, 20.0]), piece(200.0, [80.0, 20.0]), piece(200.0, [60.0, 30.0])],
            50.0,
        )],
        discs: vec![disc("overhung", 0.0, 0.012, 80.0, 150.0), disc("inner", 300.0, 0.005, 20.0, 30.0)],
        bearings: vec![radial(200.0, [2e5, 1e5, 5e4]), radial(550.0, [1e5, 3e5, 0.0])],
        ..Structure::default()
    }
}
