//! The contact patch test: two blocks with meshes that do not match, pressed together by a uniform pressure.
//!
//! Exact answer: sigma_z = -p everywhere, u_z linear, both faces sinking evenly. Pressing body 1's quadrature points
//! loads body 2 by the integrals of its shape functions, whose kinks along its element edges run through the faces of
//! body 1: what Gauss points miss of them is the error, and it has to vanish with the number of points along a face's
//! edge.

use contact::{
    Condensed, Pose, Vec3, complementarity,
    complementarity::{Balance, Law, LinearContact},
    flank::{Candidates, FlankPatch, Foot, GapSource, Surface, contact_points},
    nodal::{LinePoints, Scene, closest_points},
};
use faer::Mat;
use fem::{BoundaryLastFactor, DofMap, ElementOptions, Material, SymmetricMatrix};
use mesh::{ElementBlock, ElementKind, Face, Mesh};

use crate::{EnvelopeError, bench::largest};

const PIECE: &str = "contact patch";
const SIZE: [f64; 3] = [2.0, 2.0, 1.0];
const PRESSURE: f64 = 100.0;
const YOUNG: f64 = 206e3;

/// The plane z = 0, material below (`up` = 1) or above it.
#[derive(Debug)]
struct Plane {
    up: f64,
}

impl Surface for Plane {
    fn point(&self, [x, y]: [f64; 2]) -> Vec3 {
        Vec3::new(x, y, 0.0)
    }
    fn normal(&self, _: [f64; 2]) -> Vec3 {
        Vec3::new(0.0, 0.0, self.up)
    }
    fn profile_tangent(&self, _: [f64; 2]) -> Vec3 {
        Vec3::x()
    }
    fn curvature(&self, _: [f64; 2]) -> f64 {
        0.0
    }
    fn locate(&self, p: &Vec3) -> Option<Foot> {
        Some(Foot { at: [p.x, p.y], distance: self.up * p.z })
    }
}

struct Body {
    mesh: Mesh,
    top: Vec<Face>,
}

/// A block of n[0] x n[1] x n[2] elements from the plane away; inner lattice lines are moved so that no two meshes
/// share one.
fn block(kind: ElementKind, n: [usize; 3], up: f64, skew: f64) -> Body {
    let order = if kind == ElementKind::Hex8 { 1 } else { 2 };
    let counts = n.map(|k| k * order + 1);
    let mut number = vec![u32::MAX; counts.iter().product()];
    let index = |[i, j, k]: [usize; 3]| (k * counts[1] + j) * counts[0] + i;
    let mut nodes = Vec::new();
    for k in 0..counts[2] {
        for j in 0..counts[1] {
            for i in 0..counts[0] {
                let odd = [i, j, k].iter().filter(|&&c| order == 2 && c % 2 == 1).count();
                if odd > 1 {
                    continue;
                }
                number[index([i, j, k])] = nodes.len() as u32;
                let part = |c: usize, axis: usize| c as f64 / (counts[axis] - 1) as f64;
                // Corners move with x (1 - x); quadratic edges bend a little with them.
                let shift = |p: f64| p + skew * p * (1.0 - p);
                nodes.push([SIZE[0] * shift(part(i, 0)), SIZE[1] * shift(part(j, 1)), -up * SIZE[2] * part(k, 2)]);
            }
        }
    }
    let (mut connectivity, mut top) = (Vec::new(), Vec::new());
    for k in 0..n[2] {
        for j in 0..n[1] {
            for i in 0..n[0] {
                let local: Vec<u32> = kind
                    .reference_nodes()
                    .iter()
                    .map(|xi| {
                        let step = [0, 1, 2].map(|a| ((xi[a] + 1.0) * 0.5 * order as f64).round() as usize);
                        // Depth runs along -z below the plane: turn the element over there.
                        let w = if up > 0.0 { order - step[2] } else { step[2] };
                        number[index([i * order + step[0], j * order + step[1], k * order + w])]
                    })
                    .collect();
                if k == 0 {
                    let end = if up > 0.0 { 1.0 } else { -1.0 };
                    let reference = kind.reference_nodes();
                    let on_top = kind.faces().iter().filter(|(_, f)| f.iter().all(|&l| reference[l][2] == end));
                    top.extend(on_top.map(|(face, corner)| {
                        Face::new(*face, &corner.iter().map(|&l| local[l]).collect::<Vec<u32>>())
                    }));
                }
                connectivity.extend(local);
            }
        }
    }
    let tags = (1..=(connectivity.len() / kind.node_count()) as u64).collect();
    let node_tags = (1..=nodes.len() as u64).collect();
    let blocks = vec![ElementBlock { kind, connectivity, tags }];
    Body { mesh: Mesh { nodes, node_tags, blocks, ..Mesh::default() }, top }
}

/// Compliance of the top nodes, the block on rollers: far face in z, faces x = 0 and y = 0 across. Uniform pressure is
/// then an exact solution for any Poisson's ratio.
fn compliance(body: &Body, nodes: &[u32]) -> Result<Mat<f64>, EnvelopeError> {
    let fail = EnvelopeError::of::<fem::FemError>(PIECE);
    let dofs = DofMap::new(body.mesh.nodes.len(), &[]);
    let steel = Material::new(YOUNG, 0.3, 7.85e-9).map_err(EnvelopeError::of(PIECE))?;
    let k = fem::assemble_stiffness(&body.mesh, &steel, &dofs, &ElementOptions::default()).map_err(&fail)?;
    let mut number = vec![None; k.n()];
    let mut count = 0;
    for (node, at) in body.mesh.nodes.iter().enumerate() {
        let held = [at[0].abs() < 1e-9, at[1].abs() < 1e-9, (at[2].abs() - SIZE[2]).abs() < 1e-9];
        for axis in (0..3).filter(|&a| !held[a]) {
            if let Some(dof) = dofs.dof(node as u32, axis) {
                number[dof] = Some(count);
                count += 1;
            }
        }
    }
    let kept: Vec<_> = k.entries().filter_map(|(i, j, v)| Some((number[i]?, number[j]?, v))).collect();
    let matrix = SymmetricMatrix::from_triplets(count, &kept).map_err(&fail)?;
    let of = |i: usize| number[dofs.dof(nodes[i / 3], i % 3)?];
    let boundary: Vec<usize> = (0..3 * nodes.len()).filter_map(of).collect();
    let c = BoundaryLastFactor::new(&matrix, &boundary).map_err(&fail)?.compliance();
    let place: Vec<Option<usize>> =
        (0..3 * nodes.len()).map(|i| of(i).and_then(|d| boundary.iter().position(|&b| b == d))).collect();
    Ok(Mat::from_fn(3 * nodes.len(), 3 * nodes.len(), |i, j| match (place[i], place[j]) {
        (Some(a), Some(b)) => c[(a, b)],
        _ => 0.0,
    }))
}

/// Contact patch test of two blocks of hex8 or hex20 with `per_edge` points along each edge of a face: largest deviation
/// of the faces' normal displacement from the uniform one, relative to it, on either body.
///
/// # Errors
/// [`EnvelopeError::Piece`] where the blocks or their contact cannot be solved.
pub fn contact_patch_deviation(kind: ElementKind, per_edge: usize, law: Law) -> Result<[f64; 2], EnvelopeError> {
    let bodies = [block(kind, [3, 2, 2], 1.0, 0.2), block(kind, [2, 3, 2], -1.0, -0.3)];
    let (mut patches, mut compliances, mut all) = (Vec::new(), Vec::new(), Vec::new());
    for (body, up) in bodies.iter().zip([1.0, -1.0]) {
        let mut nodes: Vec<u32> = body.top.iter().flat_map(|f| f.nodes().to_vec()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let number = |node: u32| nodes.binary_search(&node).ok().map(|i| i as u32);
        let plane = Box::new(Plane { up });
        let patch = FlankPatch::new(0, plane, &body.mesh.nodes, &body.top, number, 1e-9);
        patches.push(patch.map_err(EnvelopeError::of(PIECE))?);
        compliances.push(compliance(body, &nodes)?);
        all.push(nodes);
    }
    let points = [contact_points(&patches[0], per_edge, GapSource::Smooth)];
    let trees = [Candidates::new(&patches[..1]), Candidates::new(&patches[1..])];
    let scene = Scene {
        first: &patches[..1],
        points: &points,
        second: &patches[1..],
        first_tree: &trees[0],
        second_tree: &trees[1],
        source: GapSource::Smooth,
        line: &LinePoints::new(),
    };
    let mut rows = closest_points(&scene, &[Pose::identity(), Pose::identity()], 1.0);
    if rows.len() != points[0].len() {
        return Err(EnvelopeError::piece(PIECE, "a point faces no block"));
    }
    for row in &mut rows {
        row.levers[0] = row.normal.z;
        row.torque_levers[0] = row.normal.z;
    }
    let mut elastic = Condensed::new(&rows, [compliances[0].as_ref(), compliances[1].as_ref()]);
    let load = -PRESSURE * SIZE[0] * SIZE[1];
    let solution = complementarity::solve(&mut elastic, &rows, 0, Balance::Moment(load), law, &vec![0.0; rows.len()])
        .map_err(EnvelopeError::of(PIECE))?;
    let displacements = elastic.displacements(&solution.forces);
    let even = PRESSURE * SIZE[2] / YOUNG;
    Ok([0, 1].map(|b| {
        let sign = [-1.0, 1.0][b];
        let z = displacements[b].iter().skip(2).step_by(3);
        largest(z.map(|u| (u * sign / even - 1.0).abs()))
    }))
}
