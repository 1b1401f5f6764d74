//! What is in a Gmsh file, is it fit for a gear, and where are its bore and flanks?
//!
//! `cargo run -p mesh --example read_mesh -- FILE TEETH`; without arguments a mesh of the repository.
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::{error::Error, path::PathBuf};

use geometry::Side;
use mesh::{GroupNames, Mesh, MeshInfo, MeshReport, MeshedGear};

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let repository = concat!(env!("CARGO_MANIFEST_DIR"), "/../../meshes/coarse_hex20_pinion.msh");
    let path = PathBuf::from(words.next().unwrap_or_else(|| repository.to_owned()));
    let teeth: u32 = words.next().as_deref().unwrap_or("30").parse()?;

    let mesh = Mesh::read(&path)?;
    let info = MeshInfo::new(&mesh);
    println!("{}: {} nodes, volume {:.1} mm^3", path.display(), info.nodes, info.volume);

    // Everything that would make a result wrong, worst first: inverted elements, loose nodes, metres taken for
    // millimetres.
    let names = GroupNames::default();
    let report = MeshReport::of_gear(&mesh, &names, Some(teeth));
    for finding in &report.findings {
        println!("{:?}: {}", finding.severity, finding.text);
    }
    println!("{} findings", report.findings.len());

    let gear = MeshedGear::from_groups(mesh, &names, teeth)?;
    println!("{} nodes on the bore, flanks of {} teeth", gear.bore_nodes().len(), gear.teeth().len());
    for side in [Side::Left, Side::Right] {
        let faces = gear.flank(0, side).map_or(0, <[_]>::len);
        println!("tooth 0, {} flank: {faces} faces", side.name());
    }
    Ok(())
}
