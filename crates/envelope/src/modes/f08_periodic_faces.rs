//! F8: faces of a tooth sector that do not match.

use mesh::{Extent, Mesh, StructuredOptions, generate};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, errors_um, farthest, mean},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 8,
    name: "periodic faces that do not match",
    file: "F08-periodic-faces",
    scene: scene_text!("F08-periodic-faces"),
    fails: "Both cut faces of a tooth sector must be the same face, turned by one pitch; a node beside its partner tears or overlaps the gear.",
    does: "Faces are paired node by node to a tolerance; a mesh off by more is refused with the place.",
    naive: &[],
    look,
};

/// A node this far beside its partner is no longer the same node, mm.
const OFF_MM: f64 = 1e-2;

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let scene = bench.scene(&AS_IT_IS)?;
    let pair = scene.gear_pair()?;
    let options = StructuredOptions {
        elements_profile: 2,
        elements_fillet: 2,
        elements_thickness: 2,
        elements_face: 4,
        elements_rim: 2,
        extent: Extent::Periodic,
        ..StructuredOptions::default()
    };
    let made = |gear| generate(gear, &options).map_err(EnvelopeError::of("sector"));
    let sound = [made(&pair.pinion)?, made(&pair.wheel)?];
    let mut torn = sound[0].clone();
    push_cut_node(&mut torn)?;
    let refused = analysis::StaticAnalysis::new(&scene).with_meshes([&torn, &sound[1]]).solve();
    let sector = errors_um(&bench.at_rest(&AS_IT_IS)?);
    let whole = errors_um(&bench.at_rest(&["pinion.mesher.sector_teeth=0", "wheel.mesher.sector_teeth=0"])?);
    Ok(vec![
        Figure::new("a node of a cut face 10 um beside its partner", Shown::refused(&refused, "cut")),
        Figure::new(
            "matched sector against the whole gear, transmission error, parts off",
            Shown::at_most(farthest(&sector, &whole) / mean(&whole), 1e-9),
        ),
    ])
}

/// Moves a node of the counter-clockwise cut face along the axis.
fn push_cut_node(mesh: &mut Mesh) -> Result<(), EnvelopeError> {
    let missing = || EnvelopeError::piece("sector", "the mesh has no cut face");
    let faces = &mesh.surface("cut_1").ok_or_else(missing)?.faces;
    let node = faces.iter().flat_map(|f| f.nodes().iter().copied()).max_by(|a, b| {
        let radius = |n: &u32| mesh.nodes[*n as usize][0].hypot(mesh.nodes[*n as usize][1]);
        radius(a).total_cmp(&radius(b))
    });
    mesh.nodes[node.ok_or_else(missing)? as usize][2] += OFF_MM;
    Ok(())
}
