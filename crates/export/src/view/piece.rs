//! The part of a gear's mesh about some of its teeth, and the surface of it.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use geometry::Gear;
use mesh::{ElementBlock, Face, FaceTable, Mesh, MeshedGear, RootFillets};

/// Points of a surface at most; a finer one is made coarser.
const POINTS: usize = 12_000;
/// Cells along the longest side of the piece that a surface is first made coarser to, and by how much fewer next.
const CELLS: f64 = 160.0;
const FEWER: f64 = 0.8;

/// Elements about some teeth.
#[derive(Debug)]
pub(super) struct Piece {
    /// With nodes of its own numbers.
    pub mesh: Mesh,
    /// Under each of them that of the gear's mesh, ascending.
    pub nodes: Vec<u32>,
    /// Nodes of the piece at the points of its surface.
    pub points: Vec<u32>,
    /// Corners, numbers of points.
    pub triangles: Vec<[u32; 3]>,
    /// Whether a point lies at or below the upper end of the fillets.
    pub at_root: Vec<bool>,
}

impl Piece {
    /// The elements whose middle is nearest to one of `teeth` (0 .. z-1). `None` where the mesh has none.
    pub(super) fn new(gear: &MeshedGear, exact: &Gear, teeth: &BTreeSet<u32>) -> Option<Self> {
        let whole = gear.mesh();
        let mut used = vec![false; whole.nodes.len()];
        let mut chosen: Vec<Vec<bool>> = Vec::new();
        for block in &whole.blocks {
            let of_block: Vec<bool> = block.elements().map(|e| teeth.contains(&tooth_of(whole, e, exact))).collect();
            let own = block.elements().zip(&of_block).filter(|(_, inside)| **inside);
            own.flat_map(|(e, _)| e).for_each(|&n| used[n as usize] = true);
            chosen.push(of_block);
        }
        let nodes: Vec<u32> = (0..whole.nodes.len() as u32).filter(|&n| used[n as usize]).collect();
        let mut numbers = vec![0; whole.nodes.len()];
        nodes.iter().zip(0..).for_each(|(&n, number)| numbers[n as usize] = number);
        let number = |n: u32| numbers[n as usize];
        let blocks = whole.blocks.iter().zip(&chosen).map(|(block, chosen)| {
            let mut own = part(block, |i, _| chosen[i]);
            own.connectivity.iter_mut().for_each(|n| *n = number(*n));
            own
        });
        let mesh = Mesh {
            nodes: nodes.iter().map(|&n| whole.nodes[n as usize]).collect(),
            node_tags: nodes.iter().map(|&n| whole.node_tags[n as usize]).collect(),
            blocks: blocks.collect(),
            ..Mesh::default()
        };
        let cuts: BTreeSet<[u32; 4]> =
            gear.cuts().into_iter().flatten().flat_map(|c| &c.faces).map(Face::corner_key).collect();
        // No element but those that touch the piece shares a face with it.
        let touches = |e: &[u32]| e.iter().any(|&n| used[n as usize]);
        let about = whole.blocks.iter().map(|block| part(block, |_, e| touches(e)));
        let about = Mesh { blocks: about.collect(), ..Mesh::default() };
        let inside = |block: (&ElementBlock, &Vec<bool>)| -> Vec<bool> {
            let near = block.0.elements().zip(block.1).filter(|(e, _)| touches(e));
            near.map(|(_, inside)| *inside).collect()
        };
        let inside: Vec<Vec<bool>> = whole.blocks.iter().zip(&chosen).map(inside).collect();
        let boundary = FaceTable::new(&about).boundary().into_iter();
        let own = boundary.filter(|o| inside[usize::from(o.block)][o.element as usize]).map(|o| o.face(&about));
        let mut corners = Vec::new();
        for face in own.filter(|f| !cuts.contains(&f.corner_key())) {
            let c: Vec<u32> = face.corners().iter().map(|&n| number(n)).collect();
            (2..c.len()).for_each(|k| corners.push([c[0], c[k - 1], c[k]]));
        }
        let (points, triangles) = coarse_enough(&mesh.nodes, corners);
        let (upper, sign) = (RootFillets::upper_radius(exact), exact.sign());
        let upper = upper * (1.0 + sign * 1e-9);
        let radius = |&n: &u32| mesh.nodes[n as usize][0].hypot(mesh.nodes[n as usize][1]);
        let at_root = points.iter().map(|n| sign * radius(n) <= upper).collect();
        (!triangles.is_empty()).then_some(Self { mesh, nodes, points, triangles, at_root })
    }
}

/// Elements of a block, by place and nodes.
fn part(block: &ElementBlock, is_in: impl Fn(usize, &[u32]) -> bool) -> ElementBlock {
    let mut part = ElementBlock { kind: block.kind, connectivity: Vec::new(), tags: Vec::new() };
    for ((_, element), tag) in block.elements().enumerate().zip(&block.tags).filter(|((i, e), _)| is_in(*i, e)) {
        part.connectivity.extend_from_slice(element);
        part.tags.push(*tag);
    }
    part
}

/// Tooth, 0 .. z-1, about whose centre line the middle of an element lies.
fn tooth_of(mesh: &Mesh, element: &[u32], exact: &Gear) -> u32 {
    let mut sum = [0.0; 3];
    for &node in element {
        let [x, y, z] = mesh.nodes[node as usize];
        sum = [sum[0] + x, sum[1] + y, sum[2] + z];
    }
    let z = sum[2] / element.len().max(1) as f64;
    let pitches = (sum[1].atan2(sum[0]) - exact.twist() * z) / TAU * exact.signed_teeth();
    (pitches.round() as i64).rem_euclid(i64::from(exact.teeth())) as u32
}

/// Points and triangles with no more points than a page can hold: those that share a cell of a grid become one, as
/// often as it takes.
fn coarse_enough(nodes: &[[f64; 3]], corners: Vec<[u32; 3]>) -> (Vec<u32>, Vec<[u32; 3]>) {
    let (mut points, mut triangles) = numbered(corners);
    let ends = |axis: usize, start: f64, pick: fn(f64, f64) -> f64| {
        points.iter().map(|&n| nodes[n as usize][axis]).fold(start, pick)
    };
    let low = [0, 1, 2].map(|axis| ends(axis, f64::INFINITY, f64::min));
    let high = [0, 1, 2].map(|axis| ends(axis, f64::NEG_INFINITY, f64::max));
    let longest = (0..3).map(|a| high[a] - low[a]).fold(0.0, f64::max);
    let mut cells = CELLS;
    while points.len() > POINTS && cells > 1.0 {
        let cell = |n: u32| [0, 1, 2].map(|a| ((nodes[n as usize][a] - low[a]) / longest * cells) as i32);
        let mut first = BTreeMap::new();
        points.iter().for_each(|&n| _ = first.entry(cell(n)).or_insert(n));
        let merged = triangles.iter().map(|t| t.map(|k| points[k as usize])).map(|t| t.map(|n| first[&cell(n)]));
        let kept = merged.filter(|[a, b, c]| a != b && b != c && c != a).collect();
        (points, triangles) = numbered(kept);
        cells *= FEWER;
    }
    (points, triangles)
}

/// Nodes that triangles use, ascending, and the triangles in places of that list.
fn numbered(corners: Vec<[u32; 3]>) -> (Vec<u32>, Vec<[u32; 3]>) {
    let mut points: Vec<u32> = corners.iter().flatten().copied().collect();
    points.sort_unstable();
    points.dedup();
    let place = |n: u32| points.binary_search(&n).unwrap_or_default() as u32;
    let triangles = corners.into_iter().map(|t| t.map(place)).collect();
    (points, triangles)
}
