//! Checks that elements that touch share whole faces. Otherwise the body has slits that no picture shows.

use std::collections::BTreeMap;

use super::{Finding, FindingKind, Severity};
use crate::model::corner_key;
use crate::{Face, FaceOwner, FaceTable, Mesh};

/// Finds faces of which the two sides differ: in their middle nodes (linear beside quadratic elements), a quadrilateral
/// beside two triangles (hexahedra beside tetrahedra), or two pairs of triangles with crossing diagonals.
pub(super) fn check(mesh: &Mesh, table: &FaceTable, findings: &mut Vec<Finding>) {
    let mut report = |found: &[FaceOwner], what: &str| {
        if let Some(first) = found.first() {
            let text = format!("{} {what}", found.len());
            let finding = Finding::new(Severity::Warning, FindingKind::NotConforming, found.len(), text);
            let finding = finding.at_nodes(mesh, first.face(mesh).corners().iter().copied());
            let elements = found.iter().take(super::SHOWN).map(|o| o.element_tag(mesh)).collect();
            findings.push(Finding { elements, ..finding });
        }
    };
    report(&of_other_nodes(mesh, table), "faces between two elements have other nodes seen from either side");

    let boundary = table.boundary();
    let triangles: BTreeMap<[u32; 4], FaceOwner> = boundary
        .iter()
        .map(|&owner| (owner.face(mesh), owner))
        .filter(|(face, _)| face.kind.corner_count() == 3)
        .map(|(face, owner)| (face.corner_key(), owner))
        .collect();
    let covered = |owner: &&FaceOwner| {
        let face = owner.face(mesh);
        let &[a, b, c, d] = face.corners() else { return false };
        let both = |one: [u32; 3], two: [u32; 3]| {
            triangles.contains_key(&corner_key(&one)) && triangles.contains_key(&corner_key(&two))
        };
        both([a, b, c], [a, c, d]) || both([a, b, d], [b, c, d])
    };
    let quadrilaterals: Vec<FaceOwner> = boundary.iter().filter(covered).copied().collect();
    report(&quadrilaterals, "quadrilaterals meet two triangles: hexahedra or wedges beside tetrahedra, not joined");
    report(&crossed(&triangles), "pairs of triangles meet pairs with the other diagonal: tetrahedra not joined");
}

/// Nodes of a face at most.
const MOST_NODES: usize = 9;

/// Faces of two elements whose middle nodes differ.
fn of_other_nodes(mesh: &Mesh, table: &FaceTable) -> Vec<FaceOwner> {
    let sorted = |face: &Face| {
        let mut nodes = [u32::MAX; MOST_NODES];
        nodes.iter_mut().zip(face.nodes()).for_each(|(own, node)| *own = *node);
        nodes.sort_unstable();
        nodes
    };
    table
        .inner()
        .filter(|[a, b]| {
            let (a, b) = (a.face(mesh), b.face(mesh));
            // Corners are the same; linear faces have no more.
            (a.kind != b.kind || a.kind.order() > 1) && sorted(&a) != sorted(&b)
        })
        .map(|[a, _]| a)
        .collect()
}

/// Triangles of an edge that are compared with each other: a boundary has two, and a crowd of thousands needs no more
/// pairs than these to be reported.
const CROWD: usize = 64;

/// Boundary triangles over four nodes that are there with both diagonals; one of each four, in the order of their
/// nodes.
fn crossed(triangles: &BTreeMap<[u32; 4], FaceOwner>) -> Vec<FaceOwner> {
    // Triangles by edge, with the corner opposite.
    let mut edges: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    for key in triangles.keys() {
        let [a, b, c, _] = *key;
        for (edge, opposite) in [([a, b], c), ([a, c], b), ([b, c], a)] {
            edges.entry(edge).or_default().push(opposite);
        }
    }
    // The same four is met from each of its six edges.
    let mut found: BTreeMap<[u32; 4], FaceOwner> = BTreeMap::new();
    for (&[a, b], opposite) in &edges {
        let opposite = &opposite[..opposite.len().min(CROWD)];
        for (i, &c) in opposite.iter().enumerate() {
            for &d in &opposite[i + 1..] {
                let owners = [[a, b, c], [a, b, d], [a, c, d], [b, c, d]].map(|t| triangles.get(&corner_key(&t)));
                let [Some(one), Some(two), Some(three), Some(four)] = owners else { continue };
                let place = |o: &FaceOwner| (o.block, o.element);
                // The faces of a tetrahedron that stands alone are such a four as well.
                if [two, three, four].iter().any(|o| place(o) != place(one)) {
                    found.insert(corner_key(&[a, b, c, d]), *one);
                }
            }
        }
    }
    found.into_values().collect()
}
