//! Nodes on the surface of the root fillets.
//!
//! Meshes do not name their fillets, so they are found by position: the free surface between the teeth, from the root
//! circle up to a circle below the root form circle. This works on any mesh, structured or not, whole gear or sector.

use std::collections::BTreeMap;

use geometry::{Gear, Side};

use crate::{Face, FaceTable, MeshedGear};

/// Nodes may lie this many modules below the root circle: mid-side nodes of straight edges across a hollow do.
const BELOW_ROOT_MODULES: f64 = 0.02;
/// Nodes may lie this many modules above the upper circle: round-off of whoever wrote the file.
const ABOVE_MODULES: f64 = 1e-4;
/// The fillet is followed up to where its tangent makes this angle with the tooth's centre line, rad (20 deg).
///
/// Bending stress is greatest near 30 deg (the critical section of ISO 6336-3, clause 6.2). Farther up, next to the
/// flank, a mesh coarser than the contact band smears the stress of contact over the nodes: with a tooth just coming
/// into contact at its corner that is more than the bending of any tooth, and it grows with every refinement of the
/// fillet.
const STEEPEST_TANGENT: f64 = 20.0 * std::f64::consts::PI / 180.0;
/// From this |n_z| on a face is an end face; the teeth of a 60 deg helix have 0.87.
const END_FACE_NORMAL: f64 = 0.95;
/// How far, in pitches, a node may be from the middle of a tooth space to count as lying on it.
const MIDDLE_PITCHES: f64 = 1e-6;

/// Surface nodes of the root fillets, by tooth and side, and the free faces that contain them.
///
/// The fillet on the left of tooth k starts where its tangent makes 20 deg with the tooth's centre line (or at the root
/// form circle, if the fillet ends before that). It ends in the middle of the tooth space between k and k + 1, so half
/// of the root land belongs to it. A node exactly in the middle belongs to both fillets of the space.
#[derive(Debug, Clone, PartialEq)]
pub struct RootFillets {
    nodes: BTreeMap<(u32, Side), Vec<u32>>,
    faces: [Vec<Face>; 2],
}

impl RootFillets {
    /// Finds the fillets of all teeth in the mesh.
    ///
    /// A node belongs to a fillet if it lies on a boundary face other than bore, cut and end face (|n_z| above 0.95),
    /// at a radius from the root circle of `gear` to the upper end of the fillet, and not on a flank, where contact
    /// forces act. Its angle from the tooth's twisted centre line determines tooth and side.
    pub fn new(mesh: &MeshedGear, gear: &Gear) -> Self {
        let body = mesh.mesh();
        let module = gear.data().normal_module;
        let upper = Self::upper_radius(gear) + ABOVE_MODULES * module;
        let radii = gear.root_radius() - BELOW_ROOT_MODULES * module..=upper;
        let mut elsewhere: Vec<[u32; 4]> = mesh.bore().faces.iter().map(|f| f.corner_key()).collect();
        elsewhere.extend(mesh.cuts().into_iter().flatten().flat_map(|c| &c.faces).map(|f| f.corner_key()));
        elsewhere.sort_unstable();

        let (mut surface, mut faces): (Vec<u32>, Vec<Face>) = Default::default();
        for face in FaceTable::new(body).boundary().iter().map(|owner| owner.face(body)) {
            let on_radius = |&n: &u32| {
                let [x, y, _] = body.nodes[n as usize];
                radii.contains(&(gear.sign() * x.hypot(y)))
            };
            if !face.nodes().iter().any(on_radius) || elsewhere.binary_search(&face.corner_key()).is_ok() {
                continue;
            }
            let corners: Vec<[f64; 3]> = face.corners().iter().map(|&n| body.nodes[n as usize]).collect();
            if axial_share(&corners) < END_FACE_NORMAL {
                surface.extend(face.nodes().iter().filter(|n| on_radius(n)));
                faces.push(face);
            }
        }
        surface.sort_unstable();
        surface.dedup();
        let flanks = mesh.teeth().into_iter().flat_map(|k| [(k, Side::Left), (k, Side::Right)]);
        let mut loaded: Vec<u32> = flanks
            .filter_map(|(tooth, side)| mesh.flank(tooth, side))
            .flatten()
            .flat_map(|face| face.nodes().iter().copied())
            .collect();
        loaded.sort_unstable();
        surface.retain(|node| loaded.binary_search(node).is_err());
        faces.retain(|face| face.nodes().iter().any(|node| surface.binary_search(node).is_ok()));

        let mut nodes: BTreeMap<(u32, Side), Vec<u32>> = BTreeMap::new();
        let teeth = i64::from(gear.teeth());
        let place_of = |[x, y, z]: [f64; 3]| (y.atan2(x) - gear.twist() * z) / gear.pitch_angle();
        let of_left = |face: &Face| {
            let mut sum = [0.0; 3];
            face.corners().iter().for_each(|&n| (0..3).for_each(|k| sum[k] += body.nodes[n as usize][k]));
            let place = place_of(sum.map(|c| c / face.corners().len() as f64));
            place > place.round()
        };
        let (left, right): (Vec<Face>, Vec<Face>) = faces.into_iter().partition(of_left);
        let faces = [right, left];
        for node in surface {
            let place = place_of(body.nodes[node as usize]);
            let tooth = place.round();
            let mut put = |tooth: i64, side| {
                nodes.entry((tooth.rem_euclid(teeth) as u32, side)).or_default().push(node);
            };
            // -1/2 .. 1/2: from the middle of the space before the tooth to that of the one behind it.
            let off = place - tooth;
            if 0.5 - off.abs() <= MIDDLE_PITCHES {
                let space = (place - 0.5).round() as i64;
                put(space, Side::Left);
                put(space + 1, Side::Right);
            } else {
                put(tooth as i64, if off > 0.0 { Side::Left } else { Side::Right });
            }
        }
        Self { nodes, faces }
    }

    /// All free faces that contain a node of a fillet, including faces that extend above its upper end: first those of
    /// right fillets, then those of left ones. Left and right fillets meet in the middle of a tooth space, where a
    /// sector may be cut. Therefore an evaluation by surfaces finds the same on a sector as on a whole mesh.
    pub fn faces(&self) -> &[Vec<Face>; 2] {
        &self.faces
    }

    /// Radius at which the fillets of `gear` end, mm; negative for a ring.
    pub fn upper_radius(gear: &Gear) -> f64 {
        let profile = gear.profile();
        profile.fillet(profile.fillet_at_tangent(STEEPEST_TANGENT)).0
    }

    /// Nodes of the fillet on one side of a tooth (0 .. z-1), ascending. Empty if the mesh does not have this fillet.
    pub fn nodes(&self, tooth: u32, side: Side) -> &[u32] {
        self.nodes.get(&(tooth, side)).map_or(&[], Vec::as_slice)
    }
}

/// |n_z| of the plane through a face's corners; 1 for a face without area, which has no side to look at.
fn axial_share(corners: &[[f64; 3]]) -> f64 {
    // Diagonals of a quadrilateral, edges of a triangle.
    let (a, b) = match corners {
        [p, q, r, s] => (minus(r, p), minus(s, q)),
        [p, q, r] => (minus(q, p), minus(r, p)),
        _ => return 1.0,
    };
    let n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
    if length > 0.0 { n[2].abs() / length } else { 1.0 }
}

fn minus(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
