//! Checks that the second cut face of a sector is the first one rotated by the sector's angle.

use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

use geometry::Side;

use super::{Finding, FindingKind, Severity};
use crate::periodic::{Places, Turn};
use crate::{FaceKind, GroupNames, Mesh, SurfaceGroup, info};

/// Compares `cut_1` with `cut_0` turned by the angle of the sector: node count, face kinds, distances.
///
/// For one tooth a misfit is an error: the sector cannot be closed to a ring. Sectors of several
/// teeth are used with free cuts, where it does not matter.
pub(super) fn check(mesh: &Mesh, names: &GroupNames, teeth: Option<u32>, findings: &mut Vec<Finding>) {
    let (Some(first), Some(second)) = (mesh.surface(&names.cut_0), mesh.surface(&names.cut_1)) else { return };
    let named = named_teeth(mesh, names);
    // Without named flanks the directions of the cuts tell how many teeth lie between them.
    let between = || Some((info::between_cuts(mesh, names)? / TAU * f64::from(teeth?)).round().max(1.0));
    let count = if named > 0 { Some(named as f64) } else { between() };
    let severity = if count == Some(1.0) { Severity::Error } else { Severity::Note };
    let mut report = |count: usize, nodes: &[u32], text: String| {
        let finding = Finding::new(severity, FindingKind::CutsDiffer, count, text);
        findings.push(finding.at_nodes(mesh, nodes.iter().copied()));
    };

    let (from, to) = (first.nodes(), second.nodes());
    if from.len() != to.len() {
        report(1, &[], format!("`{}` has {} nodes, `{}` {}", first.name, from.len(), second.name, to.len()));
    }
    if kinds(first) != kinds(second) {
        report(1, &[], format!("`{}` and `{}` have faces of different kinds or numbers", first.name, second.name));
    }
    let (Some(teeth), Some(count)) = (teeth.filter(|&z| z > 0), count) else { return };
    // One tooth of a ring goes on clockwise.
    let clockwise = count == 1.0 && info::between_cuts(mesh, names).is_some_and(|angle| angle > PI);
    let angle = if clockwise { -1.0 } else { 1.0 } * (TAU * count / f64::from(teeth));
    let turn = Turn::new(angle);
    let targets = Places::new(mesh, &to);
    let mut stray = Vec::new();
    let mut farthest: f64 = 0.0;
    for &node in &from {
        let turned = turn.of(mesh.nodes[node as usize]);
        if targets.at(&turned).is_none() {
            // The true distance costs a search, so take it of the first few alone.
            if stray.len() < 100 {
                farthest = farthest.max(targets.nearest(&turned));
            }
            stray.push(node);
        }
    }
    if !stray.is_empty() {
        let text = format!(
            "{} of {} nodes of `{}`, turned by {:.6} deg, meet no node of `{}`: {farthest:.3e} mm apart",
            stray.len(),
            from.len(),
            first.name,
            angle.to_degrees(),
            second.name
        );
        report(stray.len(), &stray, text);
    }
}

/// Teeth of the sector by its named flanks; a sector cut through the teeth has a left and a right flank of two of them.
fn named_teeth(mesh: &Mesh, names: &GroupNames) -> usize {
    let flanks: BTreeSet<_> = mesh.surfaces.iter().filter_map(|s| names.parse(&s.name)).collect();
    let of = |side| flanks.iter().filter(|f| f.0 == side).count();
    of(Side::Left).max(of(Side::Right))
}

fn kinds(group: &SurfaceGroup) -> Vec<FaceKind> {
    let mut kinds: Vec<FaceKind> = group.faces.iter().map(|f| f.kind).collect();
    kinds.sort_unstable();
    kinds
}
