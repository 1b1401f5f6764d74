//! One flank in contact: smooth surface for gaps, finite-element faces for forces.

mod areas;
mod bins;
mod face;
mod locate;

use std::sync::Arc;

use mesh::{Face, FaceKind};

use crate::{ContactError, Vec3, flank::Surface};
use bins::Bins;
use face::{PatchFace, PatchNode, range};

/// Faces of one flank, and the positions of their nodes on its smooth nominal surface.
///
/// Patches of one flank with different micro-geometry share their faces (`with_surface`).
#[derive(Debug)]
pub struct FlankPatch {
    /// Number of the tooth (or any other number) to which the flank belongs.
    pub tooth: i64,
    surface: Box<dyn Surface>,
    faces: Arc<[PatchFace]>,
    nodes: Arc<[PatchNode]>,
    bins: Arc<Bins>,
    range: [[f64; 2]; 2],
    profile_length: f64,
}

/// A point on a finite-element face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacePoint {
    /// Face of the patch.
    pub face: usize,
    /// Reference coordinates in the face.
    pub xi: [f64; 2],
}

/// Interpolation at a face point: boundary nodes and shape functions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interpolation {
    pub nodes: [u32; 9],
    pub weights: [f64; 9],
    pub count: usize,
}

fn profile_length(surface: &dyn Surface, [[low, z], [high, _]]: [[f64; 2]; 2]) -> f64 {
    let [a, b, c] = [low, 0.5 * (low + high), high].map(|u| surface.point([u, z]));
    (b - a).norm() + (c - b).norm()
}

impl FlankPatch {
    /// Makes a patch from faces of a mesh. `boundary(node)` gives a node's number among the gear's boundary nodes.
    /// `tolerance` (mm) limits the distance of a node from the smooth nominal surface, because micro-geometry
    /// ([`Surface::depth`]) is in the gaps and not in the mesh.
    ///
    /// # Errors
    /// [`ContactError::OffSurface`] if mesh and surface do not describe the same flank; [`ContactError::NotOnBoundary`]
    /// for a node without a boundary number.
    pub fn new(
        tooth: i64,
        surface: Box<dyn Surface>,
        mesh_nodes: &[[f64; 3]],
        faces: &[Face],
        boundary: impl Fn(u32) -> Option<u32>,
        tolerance: f64,
    ) -> Result<Self, ContactError> {
        let mut numbers: Vec<u32> = faces.iter().flat_map(|f| f.nodes().iter().copied()).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let off = |node: u32, distance: f64| ContactError::OffSurface {
            patch: format!("tooth {tooth}'s flank"),
            node,
            distance_mm: distance,
            tolerance_mm: tolerance,
        };
        let mut nodes = Vec::with_capacity(numbers.len());
        for &node in &numbers {
            let position = Vec3::from(mesh_nodes[node as usize]);
            let foot = surface.locate_nominal(&position).ok_or_else(|| off(node, f64::INFINITY))?;
            if foot.distance.abs() > tolerance || foot.distance.is_nan() {
                return Err(off(node, foot.distance));
            }
            let boundary = boundary(node)
                .ok_or_else(|| ContactError::NotOnBoundary { patch: format!("tooth {tooth}'s flank"), node })?;
            nodes.push(PatchNode { position, at: foot.at, boundary });
        }
        let faces: Vec<PatchFace> = faces
            .iter()
            .map(|f| {
                let mut local = [0; 9];
                for (slot, node) in local.iter_mut().zip(f.nodes()) {
                    *slot = numbers.partition_point(|n| n < node) as u32;
                }
                PatchFace { kind: f.kind, nodes: local }
            })
            .collect();
        let bins = Bins::new(&faces, &nodes);
        let range = range(nodes.iter().map(|n| n.at));
        let profile_length = profile_length(&*surface, range);
        let (faces, nodes, bins) = (faces.into(), nodes.into(), bins.into());
        Ok(Self { tooth, surface, faces, nodes, bins, range, profile_length })
    }

    /// Patch of these faces on a surface that differs in its micro-geometry alone.
    #[must_use]
    pub(crate) fn with_surface(&self, surface: Box<dyn Surface>) -> Self {
        let Self { tooth, range, .. } = *self;
        let (faces, nodes, bins) = (Arc::clone(&self.faces), Arc::clone(&self.nodes), Arc::clone(&self.bins));
        let profile_length = profile_length(&*surface, range);
        Self { tooth, surface, faces, nodes, bins, range, profile_length }
    }

    /// A flank without a mesh, for rigid bodies: its smooth surface over a range [low, high] of surface coordinates.
    pub fn rigid(tooth: i64, surface: Box<dyn Surface>, range: [[f64; 2]; 2]) -> Self {
        let bins = Bins::new(&[], &[]).into();
        let profile_length = profile_length(&*surface, range);
        Self { tooth, surface, faces: Arc::new([]), nodes: Arc::new([]), bins, range, profile_length }
    }

    /// The smooth surface.
    pub fn surface(&self) -> &dyn Surface {
        &*self.surface
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// Kind of a face.
    pub(crate) fn face_kind(&self, face: usize) -> FaceKind {
        self.faces[face].kind
    }

    fn corners(&self, face: usize) -> impl Iterator<Item = &PatchNode> {
        let f = &self.faces[face];
        f.nodes[..f.kind.node_count()].iter().map(|&n| &self.nodes[n as usize])
    }

    /// Shape functions and boundary nodes at a face point.
    pub(crate) fn interpolation(&self, at: FacePoint) -> Interpolation {
        let f = &self.faces[at.face];
        let count = f.kind.node_count();
        let mut weights = [0.0; 9];
        f.kind.shape(at.xi, &mut weights[..count]);
        let mut nodes = [0; 9];
        for (slot, &n) in nodes.iter_mut().zip(&f.nodes[..count]) {
            *slot = self.nodes[n as usize].boundary;
        }
        Interpolation { nodes, weights, count }
    }

    /// Boundary nodes at a face point and their shape functions.
    pub(crate) fn node_weights(&self, at: FacePoint) -> Vec<(u32, f64)> {
        let i = self.interpolation(at);
        i.nodes[..i.count].iter().copied().zip(i.weights).collect()
    }

    /// Surface coordinates at a face point, interpolated from those of the nodes.
    pub fn coordinates(&self, at: FacePoint) -> [f64; 2] {
        let mut sum = [0.0; 2];
        self.interpolate(at, |node, w| {
            sum[0] += w * node.at[0];
            sum[1] += w * node.at[1];
        });
        sum
    }

    /// Point on the finite-element face itself (a facet of the gear), mm.
    pub(crate) fn facet_point(&self, at: FacePoint) -> Vec3 {
        let mut sum = Vec3::zeros();
        self.interpolate(at, |node, w| sum += w * node.position);
        sum
    }

    /// Area of the face per unit of reference area at a face point, mm^2.
    pub(crate) fn area_ratio(&self, at: FacePoint) -> f64 {
        let f = &self.faces[at.face];
        let count = f.kind.node_count();
        let mut slopes = [[0.0; 2]; 9];
        f.kind.shape_gradient(at.xi, &mut slopes[..count]);
        let (mut a, mut b) = (Vec3::zeros(), Vec3::zeros());
        for (&n, [da, db]) in f.nodes[..count].iter().zip(slopes) {
            let p = self.nodes[n as usize].position;
            a += da * p;
            b += db * p;
        }
        a.cross(&b).norm()
    }

    fn interpolate(&self, at: FacePoint, mut add: impl FnMut(&PatchNode, f64)) {
        let f = &self.faces[at.face];
        let count = f.kind.node_count();
        let mut weights = [0.0; 9];
        f.kind.shape(at.xi, &mut weights[..count]);
        for (&n, w) in f.nodes[..count].iter().zip(weights) {
            add(&self.nodes[n as usize], w);
        }
    }

    /// Box [low, high] that holds the face's part of the smooth surface, mm, own frame.
    ///
    /// Sampled at the nodes and a 4 x 4 grid of surface coordinates; a surface that bulges between the samples does so
    /// by less than a twentieth of the face's diagonal as long as a face spans less than about 0.8 rad of normal.
    pub(crate) fn face_box(&self, face: usize) -> [Vec3; 2] {
        let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        let mut take = |p: Vec3| {
            low = low.inf(&p);
            high = high.sup(&p);
        };
        self.corners(face).for_each(|n| take(n.position));
        let [from, to] = self.face_range(face);
        for i in 0..4 {
            for j in 0..4 {
                let at = [
                    from[0] + (to[0] - from[0]) * f64::from(i) / 3.0,
                    from[1] + (to[1] - from[1]) * f64::from(j) / 3.0,
                ];
                take(self.surface.point(at));
            }
        }
        let margin = 0.05 * (high - low).norm();
        [low.add_scalar(-margin), high.add_scalar(margin)]
    }

    /// Range of surface coordinates of a face.
    pub(crate) fn face_range(&self, face: usize) -> [[f64; 2]; 2] {
        range(self.corners(face).map(|n| n.at))
    }

    /// Range of surface coordinates of the whole patch.
    pub fn range(&self) -> [[f64; 2]; 2] {
        self.range
    }

    /// The end of the profile that is its tip edge: the higher one, of a ring's flank the lower one.
    pub(crate) fn tip(&self) -> f64 {
        let [[low, _], [high, _]] = self.range;
        if self.is_hollow() { low } else { high }
    }

    /// Whether the surface is a ring's flank: hollow, with its tip edge at the lower end of the profile.
    pub(crate) fn is_hollow(&self) -> bool {
        self.surface.nominal_flank().is_some_and(|flank| flank.base_radius < 0.0)
    }

    /// Length of the profile at the lower end of the width, by two chords, mm.
    pub(crate) fn profile_length(&self) -> f64 {
        self.profile_length
    }

    /// Surface coordinates of a boundary node of the patch.
    pub(crate) fn node_coordinates(&self, boundary: u32) -> Option<[f64; 2]> {
        // Boundary nodes are numbered in the order of the mesh's nodes, which is the order here.
        self.nodes.binary_search_by_key(&boundary, |n| n.boundary).ok().map(|i| self.nodes[i].at)
    }

    /// Mean size of a face in each surface coordinate.
    pub(crate) fn mean_face_size(&self) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for face in 0..self.faces.len() {
            let [low, high] = self.face_range(face);
            (0..2).for_each(|k| sum[k] += high[k] - low[k]);
        }
        sum.map(|s| s / self.faces.len().max(1) as f64)
    }
}
