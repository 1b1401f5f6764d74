//! Summary of a mesh in numbers.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use rayon::prelude::*;
use serde::Serialize;

use crate::quality::{element_volume, positions};
use crate::tips::between_tips;
use crate::{Face, GroupNames, Mesh, SurfaceGroup, element::FaceQuadraturePoint};

/// Summary of a mesh. Lengths in mm.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeshInfo {
    /// Number of nodes.
    pub nodes: usize,
    /// Number of elements of each kind, by the kind's name.
    pub elements: BTreeMap<&'static str, usize>,
    /// Physical surfaces.
    pub surfaces: Vec<GroupInfo>,
    /// Names of the physical volumes.
    pub volumes: Vec<String>,
    /// Smallest coordinates, mm.
    pub low: [f64; 3],
    /// Largest coordinates, mm.
    pub high: [f64; 3],
    /// Volume by quadrature, mm^3.
    pub volume: f64,
    /// Smallest and largest distance of a node from the z axis, mm.
    pub radius_range: [f64; 2],
    /// Gear parameters estimated from the mesh.
    pub gear: LikelyGear,
}

/// One physical surface.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GroupInfo {
    /// Name of the group.
    pub name: String,
    /// Number of faces.
    pub faces: usize,
    /// Number of nodes on these faces.
    pub nodes: usize,
    /// Area by quadrature, mm^2.
    pub area: f64,
}

/// Gear parameters that can be estimated from the nodes and group names alone.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LikelyGear {
    /// Radius of the nodes of the bore group, mm, if they all have the same.
    pub bore_radius: Option<f64>,
    /// Largest radius, mm.
    pub tip_radius: f64,
    /// Extent along z, mm.
    pub face_width: f64,
    /// Number of teeth that have a named flank.
    pub named_teeth: usize,
    /// Number of teeth of the whole gear, from the angle between flanks of neighbouring teeth, between the cuts, or, in
    /// a mesh without groups, between the tips.
    pub teeth: Option<u32>,
    /// Smallest angle about z that contains all nodes, deg; 360 for a whole gear.
    pub angle_deg: f64,
}

impl MeshInfo {
    /// Counts and measures a mesh that uses the default group names.
    pub fn new(mesh: &Mesh) -> Self {
        Self::with_names(mesh, &GroupNames::default())
    }

    /// Counts and measures a mesh with the given group names.
    pub fn with_names(mesh: &Mesh, names: &GroupNames) -> Self {
        let mut elements = BTreeMap::new();
        let mut volume = 0.0;
        for block in &mesh.blocks {
            *elements.entry(block.kind.name()).or_insert(0) += block.len();
            let size = block.kind.node_count();
            // Partial sums of fixed chunks, added in order: the same bits for any number of threads.
            let parts: Vec<f64> = block
                .connectivity
                .par_chunks(512 * size)
                .map(|chunk| {
                    let mut at = [[0.0; 3]; 27];
                    chunk.chunks_exact(size).map(|e| element_volume(block.kind, positions(mesh, e, &mut at))).sum()
                })
                .collect();
            volume += parts.iter().sum::<f64>();
        }
        let mut low = mesh.nodes.first().copied().unwrap_or_default();
        let mut high = low;
        for x in &mesh.nodes {
            for k in 0..3 {
                low[k] = low[k].min(x[k]);
                high[k] = high[k].max(x[k]);
            }
        }
        let surfaces = mesh
            .surfaces
            .iter()
            .map(|s| GroupInfo {
                name: s.name.clone(),
                faces: s.faces.len(),
                nodes: s.nodes().len(),
                area: s.faces.iter().map(|f| mesh.area(f)).sum(),
            })
            .collect();
        let radius_range = radius_range(mesh.nodes.iter());
        Self {
            nodes: mesh.nodes.len(),
            elements,
            surfaces,
            volumes: mesh.volumes.clone(),
            low,
            high,
            volume,
            radius_range,
            gear: likely_gear(mesh, names, radius_range[1], high[2] - low[2]),
        }
    }
}

fn radius(x: &[f64; 3]) -> f64 {
    x[0].hypot(x[1])
}

fn radius_range<'a>(nodes: impl Iterator<Item = &'a [f64; 3]>) -> [f64; 2] {
    let range = nodes.map(radius).fold(None, |range: Option<[f64; 2]>, r| match range {
        None => Some([r, r]),
        Some([low, high]) => Some([low.min(r), high.max(r)]),
    });
    range.unwrap_or([0.0; 2])
}

impl Mesh {
    /// Area of a face by quadrature, mm^2.
    ///
    /// ```text
    /// A = sum over the points of w |dx/dxi x dx/deta|
    /// ```
    pub fn area(&self, face: &Face) -> f64 {
        self.areas(std::slice::from_ref(face))
    }

    /// Sum of [`Mesh::area`] over several faces; the quadrature of a kind of face is computed once.
    pub fn areas(&self, faces: &[Face]) -> f64 {
        let mut slopes: Vec<[[f64; 2]; 9]> = Vec::new();
        let mut of = None;
        let area = |face: &Face| {
            let points = face.kind.quadrature();
            if of.replace(face.kind) != Some(face.kind) {
                slopes.clear();
                for q in points {
                    let mut dn = [[0.0; 2]; 9];
                    face.kind.shape_gradient(q.xi, &mut dn);
                    slopes.push(dn);
                }
            }
            let at = |(q, dn): (&FaceQuadraturePoint, &[[f64; 2]; 9])| {
                let mut t = [nalgebra::Vector3::zeros(); 2];
                for (g, &node) in dn.iter().zip(face.nodes()) {
                    let x = nalgebra::Vector3::from(self.nodes[node as usize]);
                    t[0] += g[0] * x;
                    t[1] += g[1] * x;
                }
                q.weight * t[0].cross(&t[1]).norm()
            };
            points.iter().zip(&slopes).map(at).sum::<f64>()
        };
        faces.iter().map(area).sum()
    }
}

/// Radius of the bore group's nodes, when they agree to 1e-4.
pub(crate) fn bore_radius(mesh: &Mesh, names: &GroupNames) -> Option<[f64; 2]> {
    let bore = mesh.surface(&names.bore)?.nodes();
    Some(radius_range(bore.iter().map(|&n| &mesh.nodes[n as usize])))
}

fn likely_gear(mesh: &Mesh, names: &GroupNames, tip_radius: f64, face_width: f64) -> LikelyGear {
    let bore_radius =
        bore_radius(mesh, names).filter(|[low, high]| high - low < 1e-4 * high).map(|r| 0.5 * (r[0] + r[1]));
    // Directions of the named flanks and of the cuts: those of the means of their nodes.
    let mut directions = BTreeMap::new();
    for group in &mesh.surfaces {
        if let Some((side, tooth)) = names.parse(&group.name) {
            directions.insert((side, tooth), direction(mesh, group));
        }
    }
    let mut named: Vec<i64> = directions.keys().map(|k| k.1).collect();
    named.sort_unstable();
    named.dedup();
    let between_flanks = directions.iter().find_map(|(&(side, tooth), angle)| {
        let next = directions.get(&(side, tooth.checked_add(1)?))?;
        let around = (next - angle).rem_euclid(TAU);
        // Teeth of a ring are numbered clockwise.
        Some(around.min(TAU - around))
    });
    let pitch = between_flanks.or_else(|| {
        let around = between_cuts(mesh, names)?;
        // One tooth of a ring goes on clockwise.
        Some(if named.len() == 1 { around.min(TAU - around) } else { around / named.len() as f64 })
    });
    let pitch = pitch.or_else(|| if named.is_empty() { between_tips(mesh) } else { None });
    let teeth = pitch.map(|p| TAU / p).filter(|z| (3.0..1e5).contains(z)).map(|z| z.round() as u32);
    LikelyGear { bore_radius, tip_radius, face_width, named_teeth: named.len(), teeth, angle_deg: angle_held(mesh) }
}

/// Angle from the first cut to the second, by the means of their nodes, rad in 0..2 pi.
pub(crate) fn between_cuts(mesh: &Mesh, names: &GroupNames) -> Option<f64> {
    let [first, second] = [&names.cut_0, &names.cut_1].map(|n| mesh.surface(n).map(|g| direction(mesh, g)));
    Some((second? - first?).rem_euclid(TAU))
}

/// Angle about z of the mean of a group's nodes, rad.
fn direction(mesh: &Mesh, group: &SurfaceGroup) -> f64 {
    let sum = group.nodes().iter().map(|&n| mesh.nodes[n as usize]).fold([0.0; 2], |s, x| [s[0] + x[0], s[1] + x[1]]);
    sum[1].atan2(sum[0])
}

/// Angle about z that holds all nodes, deg: a full turn less the widest gap, if that is no mere element.
fn angle_held(mesh: &Mesh) -> f64 {
    let mut angles: Vec<f64> = mesh.nodes.par_iter().filter(|x| radius(x) > 0.0).map(|x| x[1].atan2(x[0])).collect();
    angles.par_sort_unstable_by(f64::total_cmp);
    let (Some(first), Some(last)) = (angles.first(), angles.last()) else { return 0.0 };
    let around = first + TAU - last;
    let gap = angles.windows(2).map(|w| w[1] - w[0]).fold(around, f64::max);
    // A whole gear has a node at least every few degrees; a sector's gap is wider than any element.
    if gap < 0.1 { 360.0 } else { (TAU - gap).to_degrees() }
}
