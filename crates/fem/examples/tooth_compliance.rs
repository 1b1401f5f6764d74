//! How far does the tip of a tooth give way under a force? Stiffness matrix of a gear sector, condensed to one node at
//! the tip.
//!
//! `cargo run -p fem --example tooth_compliance`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::{error::Error, path::Path};

use fem::{BoundaryLastFactor, DofMap, ElementOptions, Material, assemble_stiffness, mass_properties};
use mesh::Mesh;

fn main() -> Result<(), Box<dyn Error>> {
    // Three teeth, 20-node hexahedra, by Gmsh; mm. The bore is held, the cut faces are free.
    let mesh = Mesh::read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../meshes/sector3_hex20.msh")))?;
    let mass = mass_properties(&mesh, &Material::STEEL)?;
    println!("{:.0} mm^3, {:.1} g", mass.volume_mm3, 1e6 * mass.mass_t);

    let bore = mesh.surface("bore").ok_or("the mesh has no bore")?;
    let held: Vec<u32> = bore.faces.iter().flat_map(|face| face.nodes().to_vec()).collect();
    let dofs = DofMap::new(mesh.nodes.len(), &held);
    let stiffness = assemble_stiffness(&mesh, &Material::STEEL, &dofs, &ElementOptions::default())?;

    // Tooth 0 points to +x: the node farthest out there, its three displacements last in the factor.
    let tip = dofs.free_nodes().iter().copied().max_by(|&a, &b| {
        let out = |node: u32| mesh.nodes[node as usize][0] - 0.1 * mesh.nodes[node as usize][2].abs();
        out(a).total_cmp(&out(b))
    });
    let tip = tip.ok_or("every node is held")?;
    let boundary: Vec<usize> = (0..3).filter_map(|axis| dofs.dof(tip, axis)).collect();
    let factor = BoundaryLastFactor::new(&stiffness, &boundary)?;
    let [x, y, z] = mesh.nodes[tip as usize];
    println!("{} unknowns, {} numbers in the factor", dofs.free_count(), factor.nonzeros());
    println!("node at ({x:.2}, {y:.2}, {z:.2}) mm; compliance, um/kN:");
    let compliance = factor.compliance();
    for row in 0..3 {
        let numbers: Vec<String> = (0..3).map(|column| format!("{:9.3}", 1e6 * compliance[(row, column)])).collect();
        println!("  {}", numbers.join(" "));
    }
    Ok(())
}
