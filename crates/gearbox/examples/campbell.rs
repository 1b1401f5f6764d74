//! A rotor of two discs over speed: which modes whirl with the spin and which against it, and what they strain.
//!
//! `cargo run -p gearbox --example campbell`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::{error::Error, f64::consts::PI};

use fem::{
    Material,
    beam::{BeamPiece, BeamSection},
};
use gearbox::{Assembly, Bearing, Component, Disc, Rotors, Shaft, Structure};

fn main() -> Result<(), Box<dyn Error>> {
    let section = BeamSection::new(50.0, 0.0, Material::STEEL)?;
    let disc = |name: &str, at: f64, outer: f64| Disc::ring(name, 0, at, [outer, 50.0], 70.0, 7.85e-9);
    let bearing = |name: &str, at: f64| Bearing::diagonal(name, 0, at, [1e3, 2e3, 1e3, 0.0, 0.0, 0.0]);
    let rotors = Rotors::new(Assembly::new(Structure {
        shafts: vec![Shaft {
            name: "shaft".into(),
            origin: [0.0; 3],
            pieces: vec![BeamPiece { length: 1500.0, section }],
            longest_element: 100.0,
        }],
        discs: vec![disc("left", 500.0, 280.0), disc("right", 1000.0, 350.0)],
        bearings: vec![bearing("A", 0.0), bearing("B", 1500.0)],
        ..Structure::default()
    })?)?;
    println!("{:>8} {:>10} {:>7} {:>9} {:>9}", "1/min", "Hz", "whirl", "shaft %", "bearings %");
    for speed in [0.0, 1000.0, 4000.0] {
        let found = rotors.campbell(&[1.0], &[speed * PI / 30.0])?;
        for mode in found[0].modes.iter().take(6) {
            let part = |of: fn(Component) -> bool| {
                let parts = mode.energy.strain.iter().filter(|s| of(s.component));
                100.0 * parts.map(|s| s.share).sum::<f64>()
            };
            let shaft = part(|c| matches!(c, Component::Shaft(_)));
            let bearings = part(|c| matches!(c, Component::Bearing(_)));
            let hz = mode.frequency / (2.0 * PI);
            println!("{speed:>8.0} {hz:>10.3} {:>7.2} {shaft:>9.1} {bearings:>9.1}", mode.whirl[0]);
        }
    }
    Ok(())
}
