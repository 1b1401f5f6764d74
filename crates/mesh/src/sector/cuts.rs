//! Pairs each node of one cut with a node of the other.

use std::collections::HashSet;

use crate::check::tag;
use crate::periodic::{Places, Turn};
use crate::{Face, FaceTable, Mesh, MeshError, SurfaceGroup};

/// `cut_1` has no such node: the cut's node is its own.
pub(super) const NO_PARTNER: u32 = u32::MAX;

/// For every node of the mesh the node of `second` that it falls on when turned by `angle` (rad);
/// [`NO_PARTNER`] for nodes off `first`.
pub(super) fn partners(
    mesh: &Mesh,
    first: &SurfaceGroup,
    second: &SurfaceGroup,
    angle: f64,
) -> Result<Vec<u32>, MeshError> {
    let turn = Turn::new(angle);
    let (from, to) = (first.nodes(), second.nodes());
    let targets = Places::new(mesh, &to);
    let mut partner = vec![NO_PARTNER; mesh.nodes.len()];
    let apart = |node: u32, places: &Places, turn: Turn, cuts: [&SurfaceGroup; 2], angle: f64| MeshError::CutsApart {
        node: tag(mesh, node),
        cut: cuts[0].name.clone(),
        other: cuts[1].name.clone(),
        angle_deg: angle.to_degrees(),
        distance_mm: places.nearest(&turn.of(mesh.nodes[node as usize])),
        tolerance_mm: places.tolerance,
    };
    for &node in &from {
        let Some(there) = targets.at(&turn.of(mesh.nodes[node as usize])) else {
            return Err(apart(node, &targets, turn, [first, second], angle));
        };
        partner[node as usize] = there;
    }
    let back = Turn::new(-angle);
    let sources = Places::new(mesh, &from);
    for &node in &to {
        if sources.at(&back.of(mesh.nodes[node as usize])).is_none() {
            return Err(apart(node, &sources, back, [second, first], -angle));
        }
    }
    same_faces(mesh, first, second, &partner)?;
    all_of_the_cut(mesh, [first, second], &partner, turn)?;
    Ok(partner)
}

/// Every face of the one cut, turned, is a face of the other, and the other way round.
fn same_faces(mesh: &Mesh, first: &SurfaceGroup, second: &SurfaceGroup, partner: &[u32]) -> Result<(), MeshError> {
    // All nodes, not corners alone: a quadrilateral of eight nodes does not fit one of four or nine.
    let key = |nodes: &mut [u32; 9]| {
        nodes.sort_unstable();
        *nodes
    };
    let padded = |face: &Face, through: &dyn Fn(u32) -> u32| {
        let mut nodes = [u32::MAX; 9];
        for (slot, &node) in nodes.iter_mut().zip(face.nodes()) {
            *slot = through(node);
        }
        key(&mut nodes)
    };
    let refuse = |face: &Face, cut: &SurfaceGroup, other: &SurfaceGroup| MeshError::CutFaces {
        cut: cut.name.clone(),
        other: other.name.clone(),
        nodes: face.corners().iter().map(|&n| tag(mesh, n)).collect(),
    };
    let here: HashSet<[u32; 9]> = first.faces.iter().map(|f| padded(f, &|n| partner[n as usize])).collect();
    let there: HashSet<[u32; 9]> = second.faces.iter().map(|f| padded(f, &|n| n)).collect();
    if let Some(face) = first.faces.iter().find(|f| !there.contains(&padded(f, &|n| partner[n as usize]))) {
        return Err(refuse(face, first, second));
    }
    match second.faces.iter().find(|f| !here.contains(&padded(f, &|n| n))) {
        Some(face) => Err(refuse(face, second, first)),
        None => Ok(()),
    }
}

/// No node off the cuts falls on another when turned: else the gear would have slits where a cut's group lacks faces.
fn all_of_the_cut(
    mesh: &Mesh,
    [first, second]: [&SurfaceGroup; 2],
    partner: &[u32],
    turn: Turn,
) -> Result<(), MeshError> {
    let table = FaceTable::new(mesh);
    let boundary = SurfaceGroup { name: String::new(), faces: table.boundary().iter().map(|o| o.face(mesh)).collect() };
    let nodes = boundary.nodes();
    let places = Places::new(mesh, &nodes);
    for &node in nodes.iter().filter(|&&n| partner[n as usize] == NO_PARTNER) {
        if let Some(other) = places.at(&turn.of(mesh.nodes[node as usize])).filter(|&other| other != node) {
            let cuts = [first.name.clone(), second.name.clone()];
            return Err(MeshError::CutInPart { node: tag(mesh, node), other: tag(mesh, other), cuts });
        }
    }
    Ok(())
}
