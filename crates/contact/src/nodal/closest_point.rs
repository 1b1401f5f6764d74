//! Stage 2, point against surface: gap, normal and shape functions of each candidate point.

use std::collections::BTreeMap;

use crate::{
    Pose, Vec3,
    flank::{Candidates, ContactPoint, FacePoint, FlankPatch, GapSource, Interpolation},
    nodal::least_gap,
};

/// Both bodies of a contact with their patches.
#[derive(Debug, Clone, Copy)]
pub struct Scene<'a> {
    /// Patches of body 1, with their contact points.
    pub first: &'a [FlankPatch],
    /// Contact points of each patch of body 1.
    pub points: &'a [Vec<ContactPoint>],
    /// Patches of body 2.
    pub second: &'a [FlankPatch],
    /// Faces of body 1 for stage 1.
    pub first_tree: &'a Candidates,
    /// Faces of body 2 for stage 1.
    pub second_tree: &'a Candidates,
    /// Surfaces between which gaps are measured.
    pub source: GapSource,
    /// Further points of pairs of patches, from [`line_points`]. They represent no area, so they are only for exact
    /// contact, where a row needs no area. With them the first contact is found at its true position and not at the
    /// nearest Gauss point.
    pub line: &'a LinePoints,
}

/// Points of smallest gap, by pair of patches.
pub type LinePoints = BTreeMap<(usize, usize), Vec<ContactPoint>>;

/// Load of a unit contact force on one body: weights on boundary nodes, along one direction.
///
/// Opening of the gap by the body's displacement u: sum_i w_i d . u_i. The same weights distribute the force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Boundary nodes.
    pub nodes: [u32; 9],
    /// Weights of the nodes (shape functions).
    pub weights: [f64; 9],
    /// Number of nodes in use.
    pub count: usize,
    /// Direction d in the body's own frame: the direction of the normal force on the body.
    pub direction: Vec3,
    /// Force on the body for a unit normal force, own frame: `direction` plus friction.
    pub load: Vec3,
}

/// One candidate point with all data for the solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactRow {
    /// Patches of body 1 and 2.
    pub patches: (usize, usize),
    /// Number of the point in its patch.
    pub point: usize,
    /// Gap, mm, at the given poses, undeformed.
    pub gap: f64,
    /// Area that the point represents, mm^2.
    pub area: f64,
    /// Position of the point, common frame, mm.
    pub position: Vec3,
    /// Direction of the force on body 1, common frame.
    pub normal: Vec3,
    /// Surface coordinates on body 1.
    pub coordinates: [f64; 2],
    /// d gap / d angle of each body about its own z axis, whatever its pose, mm. A unit normal force exerts this moment
    /// on the body.
    pub levers: [f64; 2],
    /// Moment of a unit normal force, friction included, about each body's own z axis, mm; equal to the levers without
    /// friction.
    pub torque_levers: [f64; 2],
    /// Force on body 1 for a unit normal force, common frame: `normal` plus friction.
    pub traction: Vec3,
    /// Loads on the two bodies.
    pub supports: [Support; 2],
}

/// Gap rows of all candidate points nearer than `reach` (mm), ascending by (patch, point).
///
/// g = (x_1 - x_2) . n_2, where x_2 is the foot point of x_1 on body 2's smooth surface. A point whose foot lies off
/// the faces of body 2 is not a candidate. If several patches of body 2 are near, each gives a row of its own.
pub fn closest_points(scene: &Scene, poses: &[Pose; 2], reach: f64) -> Vec<ContactRow> {
    let pairs = scene.first_tree.pairs(&poses[0], scene.second_tree, &poses[1], reach);
    let mut touching: Vec<(usize, usize, usize)> = pairs.iter().map(|p| (p.first.0, p.second.0, p.first.1)).collect();
    touching.sort_unstable();
    touching.dedup();
    let mut rows = Vec::new();
    for of_pair in touching.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (first, second, _) = of_pair[0];
        let points = &scene.points[first];
        let per_face = points.len() / scene.first[first].face_count();
        let faces = of_pair.iter().map(|t| t.2);
        let gauss = faces.flat_map(|face| (face * per_face..(face + 1) * per_face).map(|i| (i, points[i])));
        let line = scene.line.get(&(first, second)).into_iter().flatten();
        let line = line.enumerate().map(|(i, p)| (points.len() + i, *p));
        rows.extend(
            gauss
                .chain(line)
                .filter_map(|(i, point)| contact_row(scene, poses, (first, second), i, &point))
                .filter(|row| row.gap <= reach),
        );
    }
    rows
}

/// Points of smallest gap of two patches at `stations` equally spaced heights.
pub fn line_points(first: &FlankPatch, second: &FlankPatch, poses: &[Pose; 2], stations: usize) -> Vec<ContactPoint> {
    let [low, high] = first.range();
    (0..stations)
        .filter_map(|i| {
            let z = low[1] + (high[1] - low[1]) * (i as f64 + 0.5) / stations as f64;
            let coordinates = least_gap(first, second, poses, z)?;
            let at = first.face_at(coordinates)?;
            Some(ContactPoint { at, coordinates, position: first.surface().point(coordinates), area: 0.0 })
        })
        .collect()
}

/// Gap row of a point `p` (numbered `point`) of one pair of patches; `None` if it has no foot point on the faces of
/// body 2.
pub fn contact_row(
    scene: &Scene,
    poses: &[Pose; 2],
    (first, second): (usize, usize),
    point: usize,
    p: &ContactPoint,
) -> Option<ContactRow> {
    let (patch, other) = (&scene.first[first], &scene.second[second]);
    let position = poses[0].transform_point(&p.position.into()).coords;
    let seen = poses[1].inverse_transform_point(&position.into()).coords;
    let foot = other.surface().locate(&seen)?;
    let at = other.face_at(foot.at)?;
    let normal_2 = other.surface().normal(foot.at);
    let gap = match scene.source {
        GapSource::Smooth => foot.distance,
        // Facets are those of the nominal flanks: what is ground off either of them opens the gap.
        GapSource::Facet => {
            let ground_off = patch.surface().depth(p.coordinates) + other.surface().depth(foot.at);
            (seen - other.facet_point(at)).dot(&normal_2) + ground_off
        }
    };
    let normal = poses[1].rotation * normal_2;
    Some(ContactRow {
        patches: (first, second),
        point,
        gap,
        area: p.area,
        position,
        normal,
        coordinates: p.coordinates,
        levers: levers(poses, &position, &normal),
        torque_levers: levers(poses, &position, &normal),
        traction: normal,
        supports: [
            Support::new(patch.interpolation(p.at), poses[0].inverse_transform_vector(&normal)),
            Support::new(other.interpolation(at), -normal_2),
        ],
    })
}

/// d gap / d angle of each body about its own z axis, mm, for a force at `position` along `normal` on body 1.
pub(crate) fn levers(poses: &[Pose; 2], position: &Vec3, normal: &Vec3) -> [f64; 2] {
    let lever = |pose: &Pose| {
        let arm = position - pose.translation.vector;
        arm.cross(normal).dot(&(pose.rotation * Vec3::z()))
    };
    [lever(&poses[0]), -lever(&poses[1])]
}

/// Row of a pair of points with known surface coordinates and gap; on which nodes it rests is left open.
pub(crate) fn row_at(
    patches: [&FlankPatch; 2],
    poses: &[Pose; 2],
    numbers: (usize, usize),
    point: usize,
    at: [[f64; 2]; 2],
    gap: f64,
) -> ContactRow {
    let position = poses[0].transform_point(&patches[0].surface().point(at[0]).into()).coords;
    row_between(poses, numbers, point, at[0], gap, (position, patches[1].surface().normal(at[1])))
}

/// Row of a point at a position in the common frame, with the unit normal out of body 2 at its foot in that one's own.
pub(crate) fn row_between(
    poses: &[Pose; 2],
    numbers: (usize, usize),
    point: usize,
    coordinates: [f64; 2],
    gap: f64,
    (position, normal_2): (Vec3, Vec3),
) -> ContactRow {
    let normal = poses[1].rotation * normal_2;
    let levers = levers(poses, &position, &normal);
    ContactRow {
        patches: numbers,
        point,
        gap,
        area: 0.0,
        position,
        normal,
        coordinates,
        levers,
        torque_levers: levers,
        traction: normal,
        supports: [Support::free(poses[0].inverse_transform_vector(&normal)), Support::free(-normal_2)],
    }
}

/// Loading of a body at surface coordinates; those past the edge of the faces load the edge.
///
/// `face`: a face point found for coordinates nearby, and the one found now.
pub(crate) fn support_at(
    patch: &FlankPatch,
    at: [f64; 2],
    direction: Vec3,
    face: &mut Option<FacePoint>,
) -> Option<Support> {
    let found = patch.nearest_face_from(at, *face)?;
    *face = Some(found);
    Some(Support::new(patch.interpolation(found), direction))
}

impl Support {
    /// Support of a direction alone, without nodes.
    fn free(direction: Vec3) -> Self {
        Self { nodes: [0; 9], weights: [0.0; 9], count: 0, direction, load: direction }
    }

    /// Takes the nodes and weights of a face point.
    pub(crate) fn rest_on(&mut self, patch: &FlankPatch, at: FacePoint) {
        let Interpolation { nodes, weights, count } = patch.interpolation(at);
        (self.nodes, self.weights, self.count) = (nodes, weights, count);
    }

    fn new(i: Interpolation, direction: Vec3) -> Self {
        Self { nodes: i.nodes, weights: i.weights, count: i.count, direction, load: direction }
    }
}

impl ContactRow {
    /// Adds friction: `tangential` (common frame) is the friction force on body 1 for a unit normal force.
    ///
    /// The gap does not change; the bodies and the moments get normal and friction force together.
    #[must_use]
    pub fn with_friction(mut self, poses: &[Pose; 2], tangential: &Vec3) -> Self {
        self.traction = self.normal + tangential;
        self.torque_levers = levers(poses, &self.position, &self.traction);
        self.supports[0].load = poses[0].inverse_transform_vector(&self.traction);
        self.supports[1].load = -poses[1].inverse_transform_vector(&self.traction);
        self
    }

    /// Whether the nodes that carry the row are known.
    pub fn is_supported(&self) -> bool {
        self.supports.iter().all(|s| s.count > 0)
    }

    /// Whether friction acts.
    pub(crate) fn has_friction(&self) -> bool {
        self.traction != self.normal
    }
}
