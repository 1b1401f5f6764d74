//! A pair with meshes that the caller holds in memory: here those of the built-in mesher, one sector each.
//!
//! `cargo run --release -p analysis --example own_mesh`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::error::Error;

use analysis::StaticAnalysis;
use mesh::{Extent, StructuredOptions, generate};
use scene::Scene;

fn main() -> Result<(), Box<dyn Error>> {
    let scene = Scene::builder()
        .pinion(24, 18.0)
        .wheel(31)
        .normal_module_mm(3.0)
        .face_width_mm(20.0)
        .torque_nm(120.0)
        .set("analysis.positions_per_cycle", 8)
        .build()?;
    // Any `mesh::Mesh` with the groups of a gear will do: read from Gmsh's bytes by `Mesh::parse`, or filled by hand.
    let options = StructuredOptions { extent: Extent::Periodic, ..StructuredOptions::default() };
    let pair = scene.gear_pair()?;
    let [pinion, wheel] = [generate(&pair.pinion, &options)?, generate(&pair.wheel, &options)?];
    let result = StaticAnalysis::new(&scene).with_meshes([&pinion, &wheel]).solve()?;
    println!("{} and {} nodes", pinion.nodes.len(), wheel.nodes.len());
    for position in &result.history.positions {
        println!("phase {:.3}: STE {:.4} um", position.mesh_phase, 1e3 * position.transmission_error);
    }
    Ok(())
}
