//! Finds defects of a mesh before they make a solver fail.

mod conformity;
mod cuts;
mod nodes;

use std::collections::BTreeSet;

use rayon::prelude::*;
use serde::Serialize;

use crate::error::list;
use crate::quality::{min_det_j, positions, scaled_jacobian};
use crate::{Face, FaceTable, GroupNames, Mesh, info};

/// Severity of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// For information.
    Note,
    /// Results will be less accurate.
    Warning,
    /// The mesh cannot be used.
    Error,
}

/// Subject of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum FindingKind {
    /// Elements with det J <= 0 at some point.
    Inverted,
    /// Elements with a scaled Jacobian below [`BAD_SHAPE`].
    BadShape,
    /// Nodes that no element uses.
    OrphanNodes,
    /// Several nodes at the same position.
    DoubleNodes,
    /// Faces that belong to more than two elements.
    CrowdedFaces,
    /// Elements that touch but do not share a whole face.
    NotConforming,
    /// Bodies that are not connected to each other.
    Disconnected,
    /// A part of the gear that has no group.
    MissingGroup,
    /// Faces of a group that lie inside the body or belong to no element.
    NotOnBoundary,
    /// Periodic faces that do not match each other.
    CutsDiffer,
    /// A bore that is not a cylinder about z.
    BoreNotRound,
    /// A gear whose axis does not seem to be the z axis.
    Axis,
    /// A mid-face that is not at z = 0.
    MidFace,
    /// A size that is implausible for a gear in mm: wrong units.
    Units,
}

/// One finding.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// Severity of the finding.
    pub severity: Severity,
    /// Kind of the finding.
    pub kind: FindingKind,
    /// Text of the finding, with figures.
    pub text: String,
    /// Number of elements, nodes or faces concerned.
    pub count: usize,
    /// Tags of the elements concerned, the worst first, at most [`SHOWN`].
    pub elements: Vec<u64>,
    /// Tags of the nodes concerned, at most [`SHOWN`].
    pub nodes: Vec<u64>,
}

/// Limit of the scaled Jacobian. Elements below it make stresses doubtful. (Verdict recommends 0.2 and more for
/// hexahedra; fillets of fine gears come close to this limit.)
pub const BAD_SHAPE: f64 = 0.1;

/// Largest number of tags that a finding lists.
pub const SHOWN: usize = 20;

/// All findings about a mesh, the worst first.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct MeshReport {
    /// The findings.
    pub findings: Vec<Finding>,
}

impl MeshReport {
    /// Checks a mesh that uses the default group names.
    pub fn new(mesh: &Mesh) -> Self {
        Self::of_gear(mesh, &GroupNames::default(), None)
    }

    /// Checks the mesh of a gear with `teeth` teeth and the given group names.
    pub fn of_gear(mesh: &Mesh, names: &GroupNames, teeth: Option<u32>) -> Self {
        let table = FaceTable::new(mesh);
        let mut findings = Vec::new();
        shapes(mesh, &mut findings);
        nodes::orphans(mesh, &mut findings);
        nodes::doubles(mesh, &mut findings);
        nodes::bodies(mesh, &mut findings);
        crowded(mesh, &table, &mut findings);
        conformity::check(mesh, &table, &mut findings);
        groups(mesh, names, &mut findings);
        off_boundary(mesh, &table, &mut findings);
        cuts::check(mesh, names, teeth, &mut findings);
        size(mesh, names, &mut findings);
        place(mesh, names, &mut findings);
        findings.sort_by_key(|f| std::cmp::Reverse(f.severity));
        Self { findings }
    }

    /// The worst severity; `None` if there are no findings.
    pub fn worst(&self) -> Option<Severity> {
        self.findings.iter().map(|f| f.severity).max()
    }

    /// Findings of one kind.
    pub fn of(&self, kind: FindingKind) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(move |f| f.kind == kind)
    }
}

impl Finding {
    pub(crate) fn new(severity: Severity, kind: FindingKind, count: usize, text: String) -> Self {
        Self { severity, kind, text, count, elements: Vec::new(), nodes: Vec::new() }
    }

    pub(crate) fn at_nodes(mut self, mesh: &Mesh, nodes: impl IntoIterator<Item = u32>) -> Self {
        self.nodes = nodes.into_iter().take(SHOWN).map(|n| tag(mesh, n)).collect();
        self
    }
}

/// The file's tag of a node.
pub(crate) fn tag(mesh: &Mesh, node: u32) -> u64 {
    mesh.node_tags.get(node as usize).copied().unwrap_or(u64::from(node))
}

/// Inverted and badly shaped elements.
fn shapes(mesh: &Mesh, findings: &mut Vec<Finding>) {
    let mut inverted: Vec<(f64, u64)> = Vec::new();
    let mut bad: Vec<(f64, u64)> = Vec::new();
    for block in &mesh.blocks {
        let judged: Vec<(f64, f64)> = block
            .connectivity
            .par_chunks_exact(block.kind.node_count())
            .map(|element| {
                let mut at = [[0.0; 3]; 27];
                let at = positions(mesh, element, &mut at);
                (min_det_j(block.kind, at), scaled_jacobian(block.kind, at))
            })
            .collect();
        for (&(det_j, scaled), &tag) in judged.iter().zip(&block.tags) {
            if det_j <= 0.0 || det_j.is_nan() {
                inverted.push((det_j, tag));
            } else if scaled < BAD_SHAPE {
                bad.push((scaled, tag));
            }
        }
    }
    for list in [&mut inverted, &mut bad] {
        list.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    }
    let tags = |list: &[(f64, u64)]| list.iter().take(SHOWN).map(|l| l.1).collect();
    if let Some(&(det_j, tag)) = inverted.first() {
        let mut text = format!("{} inverted: det J = {det_j:.3e} mm^3 in element {tag}", elements(inverted.len()));
        if inverted.len() == mesh.element_count() {
            text += "; these are all: was the mesh mirrored, or written in another program's node order?";
        }
        let finding = Finding::new(Severity::Error, FindingKind::Inverted, inverted.len(), text);
        findings.push(Finding { elements: tags(&inverted), ..finding });
    }
    if let Some(&(scaled, tag)) = bad.first() {
        let text =
            format!("{} of a scaled Jacobian below {BAD_SHAPE}: {scaled:.3} in element {tag}", elements(bad.len()));
        let finding = Finding::new(Severity::Warning, FindingKind::BadShape, bad.len(), text);
        findings.push(Finding { elements: tags(&bad), ..finding });
    }
}

fn elements(count: usize) -> String {
    if count == 1 { "1 element".into() } else { format!("{count} elements") }
}

fn crowded(mesh: &Mesh, table: &FaceTable, findings: &mut Vec<Finding>) {
    let crowded = table.crowded();
    if let Some(first) = crowded.first() {
        let text = format!("{} faces belong to more than two elements: bodies overlap", crowded.len());
        let finding = Finding::new(Severity::Error, FindingKind::CrowdedFaces, crowded.len(), text);
        let elements = crowded.iter().take(SHOWN).map(|o| o.element_tag(mesh)).collect();
        let finding = finding.at_nodes(mesh, first.face(mesh).corners().iter().copied());
        findings.push(Finding { elements, ..finding });
    }
}

/// Names of the groups that there are.
fn group_list(mesh: &Mesh) -> String {
    list(&mesh.surfaces.iter().map(|s| s.name.clone()).collect::<Vec<_>>())
}

/// Bore and flanks must be named, or the flanks found by other means.
fn groups(mesh: &Mesh, names: &GroupNames, findings: &mut Vec<Finding>) {
    let kind = FindingKind::MissingGroup;
    let flanks: Vec<_> = mesh.surfaces.iter().filter_map(|s| names.parse(&s.name)).collect();
    let there: BTreeSet<_> = flanks.iter().copied().collect();
    if mesh.surface(&names.bore).is_none() {
        let text = format!(
            "no physical group `{}`: which nodes are held by the shaft? The mesh has {}",
            names.bore,
            group_list(mesh)
        );
        findings.push(Finding::new(Severity::Warning, kind, 1, text));
    }
    if flanks.is_empty() {
        let text = format!(
            "no physical group `{}`: flanks must be found from the gear's data. The mesh has {}",
            names.flank_left,
            group_list(mesh)
        );
        findings.push(Finding::new(Severity::Warning, kind, 1, text));
    }
    for &(side, tooth) in &flanks {
        if !there.contains(&(side.opposite(), tooth)) {
            let text = format!("no physical group `{}`", names.flank_of(side.opposite(), tooth));
            findings.push(Finding::new(Severity::Note, kind, 1, text));
        }
    }
    if mesh.surface(&names.cut_0).is_some() != mesh.surface(&names.cut_1).is_some() {
        let text = format!("of `{}` and `{}` only one is there", names.cut_0, names.cut_1);
        findings.push(Finding::new(Severity::Error, kind, 1, text));
    }
}

/// Faces of groups that do not bound the body.
fn off_boundary(mesh: &Mesh, table: &FaceTable, findings: &mut Vec<Finding>) {
    for group in &mesh.surfaces {
        let off: Vec<_> = group.faces.iter().filter(|f| table.owners(f.corner_key()).len() != 1).collect();
        if let Some(first) = off.first() {
            let text = format!(
                "group `{}`: {} of {} faces lie inside the body or on no element",
                group.name,
                off.len(),
                group.faces.len()
            );
            let finding = Finding::new(Severity::Warning, FindingKind::NotOnBoundary, off.len(), text);
            findings.push(finding.at_nodes(mesh, first.corners().iter().copied()));
        }
    }
}

/// Size and place: the program counts in mm, and the axis is z.
fn size(mesh: &Mesh, names: &GroupNames, findings: &mut Vec<Finding>) {
    let largest = mesh.nodes.iter().map(|x| x[0].hypot(x[1])).fold(0.0, f64::max);
    let guess = match largest {
        // From watch gears of 0.5 mm to ring gears of 5 m.
        r if r < 0.5 => Some(("metres", 1000.0)),
        r if r < 5.0 => Some(("inches", 25.4)),
        r if r > 5000.0 => Some(("micrometres", 0.001)),
        _ => None,
    };
    if let Some((unit, factor)) = guess {
        let text = format!(
            "largest radius {largest:.4} mm: is the mesh in {unit}? Scaled by {factor} it would be {:.4} mm",
            largest * factor
        );
        findings.push(Finding::new(Severity::Warning, FindingKind::Units, 1, text));
    }
    // The end of a shaft that is meshed in one with its gear is as good a bore as a cylinder.
    let flat = |face: &Face| {
        let z = |n: &u32| mesh.nodes[*n as usize][2];
        face.nodes().iter().all(|n| (z(n) - z(&face.nodes()[0])).abs() < 1e-6 * largest)
    };
    let is_end = mesh.surface(&names.bore).is_some_and(|bore| bore.faces.iter().all(flat));
    if let Some([low, high]) = info::bore_radius(mesh, names).filter(|[low, high]| !is_end && high - low > 1e-3 * high)
    {
        let text = format!("bore radius between {low:.4} and {high:.4} mm: is the gear's axis the z axis?");
        findings.push(Finding::new(Severity::Warning, FindingKind::BoreNotRound, 1, text));
    }
}

/// Axis and mid-face: about z, at z = 0.
fn place(mesh: &Mesh, names: &GroupNames, findings: &mut Vec<Finding>) {
    let least_and_largest = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)])
    };
    let range = |value: &dyn Fn(&[f64; 3]) -> f64| least_and_largest(&mut mesh.nodes.iter().map(value));
    // A gear with a bore has no node near its axis.
    let hollow = |a: usize, b: usize| {
        let [low, high] = range(&|x| x[a].hypot(x[b]));
        low / high
    };
    if hollow(0, 1) < 0.01
        && let Some((name, _)) = [("x", hollow(1, 2)), ("y", hollow(2, 0))].into_iter().find(|(_, open)| *open > 0.1)
    {
        let text = format!("nodes lie on the z axis, none near the {name} axis: is that the gear's? It must be z");
        findings.push(Finding::new(Severity::Warning, FindingKind::Axis, 1, text));
        return;
    }
    // Hubs and shafts may reach farther on one side than on the other: where flanks are named, they say where
    // mid-face is.
    let flanks = mesh.surfaces.iter().filter(|group| names.parse(&group.name).is_some());
    let heights = flanks.flat_map(|g| &g.faces).flat_map(Face::nodes).map(|&n| mesh.nodes[n as usize][2]);
    let [mut low, mut high] = least_and_largest(&mut heights.into_iter());
    if low >= high {
        [low, high] = range(&|x| x[2]);
    }
    let middle = 0.5 * (low + high);
    if middle.abs() > 1e-3 * (high - low) {
        let text = format!("mid-face at z = {middle:.4} mm, not at 0: tooth 0 is where it should be at z = 0 only");
        findings.push(Finding::new(Severity::Warning, FindingKind::MidFace, 1, text));
    }
}
