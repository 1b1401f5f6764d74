//! Nodes that no element uses, nodes at the same position, bodies that are not connected.

use rayon::prelude::*;

use super::{Finding, FindingKind, Severity};
use crate::Mesh;
use crate::periodic::{distance, place};

/// Nodes nearer than this times the size of the mesh are in one place.
const COINCIDENT: f64 = 1e-9;

/// Largest extent of the mesh, mm.
fn extent(mesh: &Mesh) -> f64 {
    (0..3)
        .map(|k| {
            let range =
                mesh.nodes.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x[k]), h.max(x[k])));
            range.1 - range.0
        })
        .fold(0.0, f64::max)
}

pub(super) fn orphans(mesh: &Mesh, findings: &mut Vec<Finding>) {
    let mut used = vec![false; mesh.nodes.len()];
    for &node in mesh.blocks.iter().flat_map(|b| &b.connectivity) {
        used[node as usize] = true;
    }
    let orphans: Vec<u32> = (0..mesh.nodes.len() as u32).filter(|&n| !used[n as usize]).collect();
    if !orphans.is_empty() {
        let text = format!("{} nodes belong to no element: the stiffness matrix would be singular", orphans.len());
        let finding = Finding::new(Severity::Error, FindingKind::OrphanNodes, orphans.len(), text);
        findings.push(finding.at_nodes(mesh, orphans));
    }
}

/// Pairs of nodes in one place: sorted along a skew direction, then neighbours compared.
pub(super) fn doubles(mesh: &Mesh, findings: &mut Vec<Finding>) {
    let tolerance = COINCIDENT * extent(mesh);
    let mut order: Vec<(f64, u32)> = mesh.nodes.par_iter().enumerate().map(|(i, x)| (place(x), i as u32)).collect();
    order.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut double: Vec<u32> = Vec::new();
    for (i, &(at, node)) in order.iter().enumerate() {
        let near = order[i + 1..].iter().take_while(|o| o.0 - at <= tolerance);
        // A crowd of thousands in one place needs no more pairs than this to be reported.
        for &(_, other) in near.take(64) {
            if distance(&mesh.nodes[node as usize], &mesh.nodes[other as usize]) <= tolerance {
                double.push(node.max(other));
            }
        }
    }
    double.sort_unstable();
    double.dedup();
    if !double.is_empty() {
        let text = format!("{} nodes lie where another node is: parts that touch are not joined", double.len());
        let finding = Finding::new(Severity::Warning, FindingKind::DoubleNodes, double.len(), text);
        findings.push(finding.at_nodes(mesh, double));
    }
}

/// Bodies that share no node.
pub(super) fn bodies(mesh: &Mesh, findings: &mut Vec<Finding>) {
    let mut parent: Vec<u32> = (0..mesh.nodes.len() as u32).collect();
    let mut used = vec![false; mesh.nodes.len()];
    for block in &mesh.blocks {
        for element in block.elements() {
            for &node in element {
                used[node as usize] = true;
                let (a, b) = (root(&mut parent, element[0]), root(&mut parent, node));
                parent[a.max(b) as usize] = a.min(b);
            }
        }
    }
    let roots: Vec<u32> =
        (0..mesh.nodes.len() as u32).filter(|&n| used[n as usize] && parent[n as usize] == n).collect();
    if roots.len() > 1 {
        let text = format!("{} bodies that share no node; one node of each is named", roots.len());
        let finding = Finding::new(Severity::Error, FindingKind::Disconnected, roots.len(), text);
        findings.push(finding.at_nodes(mesh, roots));
    }
}

/// Root of a node's tree, halving the path to it.
fn root(parent: &mut [u32], mut node: u32) -> u32 {
    while parent[node as usize] != node {
        parent[node as usize] = parent[parent[node as usize] as usize];
        node = parent[node as usize];
    }
    node
}
