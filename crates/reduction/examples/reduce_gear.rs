//! A whole gear, condensed from one tooth: how many unknowns are left, how stiff are the flanks, how slow is its
//! slowest vibration?
//!
//! `cargo run -p reduction --example reduce_gear`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::{error::Error, path::Path};

use fem::{ElementOptions, Material};
use geometry::Side;
use mesh::{GroupNames, Mesh, MeshedGear};
use reduction::{GearReducer, ReductionOptions};

fn main() -> Result<(), Box<dyn Error>> {
    // A sector of one tooth with periodic cut faces stands for the gear of 30 teeth.
    let mesh = Mesh::read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../meshes/periodic_hex20.msh")))?;
    let gear = MeshedGear::from_groups(mesh, &GroupNames::default(), 30)?;
    let options =
        ReductionOptions { sides: vec![Side::Left], window: 3, first: 0, elements: ElementOptions::default() };
    let reducer = GearReducer::new(gear, Material::STEEL, options)?;

    let window = reducer.window(0)?;
    println!("{}: {} unknowns of the gear", reducer.way().name(), reducer.free_count());
    println!("{} are left on one flank each of teeth {:?}", window.reduced.coordinates(), window.reduced.teeth);

    // Displacement of a flank node of the middle tooth under a force on it: one 3 x 3 block of C.
    let node = window.reduced.nodes.len() / 2;
    println!("compliance of a flank node, um/kN:");
    for row in 0..3 {
        let entry = |column: usize| 1e6 * window.reduced.compliance()[(3 * node + row, 3 * node + column)];
        println!("  {:9.3} {:9.3} {:9.3}", entry(0), entry(1), entry(2));
    }

    let frequencies = reducer.lowest_frequencies()?;
    println!(
        "lowest frequency, bore held: {:.0} Hz with the flanks free, {:.0} Hz with those of the window held",
        frequencies.flanks_free_hz, frequencies.flanks_held_hz
    );
    Ok(())
}
