//! Stage 2, point against surface: gap, normal and shape functions of each candidate point.

use crate::{Candidates, ContactPoint, FlankPatch, Pose, Vec3, patch::Interpolation};

/// What a gap is measured between.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum GapSource {
    /// The smooth flanks.
    #[default]
    Smooth,
    /// The finite-element faces as they are: shows the facet error h^2 / (8 rho); for study only.
    Facet,
}

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
    /// Gaps between what.
    pub source: GapSource,
}

/// How a unit contact force loads one body: weights on boundary nodes, along one direction.
///
/// Opening of the gap by the body's displacement u: sum_i w_i d . u_i; the same weights distribute the force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Boundary nodes.
    pub nodes: [u32; 9],
    /// Shape functions.
    pub weights: [f64; 9],
    /// How many of them are used.
    pub count: usize,
    /// Direction d in the body's own frame: the direction of the force on the body.
    pub direction: Vec3,
}

/// One candidate point with everything the solve needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactRow {
    /// Patches of body 1 and 2.
    pub patches: (usize, usize),
    /// Number of the point in its patch.
    pub point: usize,
    /// Gap, mm, at the given poses, undeformed.
    pub gap: f64,
    /// Area it stands for, mm^2.
    pub area: f64,
    /// Position of the point, common frame, mm.
    pub position: Vec3,
    /// Direction of the force on body 1, common frame.
    pub normal: Vec3,
    /// Surface coordinates on body 1.
    pub coordinates: [f64; 2],
    /// d gap / d angle of each body about its own z axis, mm; a unit normal force turns the body with just this moment.
    pub levers: [f64; 2],
    /// Loading of the bodies.
    pub supports: [Support; 2],
}

/// Gap rows of all candidate points nearer than `reach` [mm], ascending by (patch, point).
///
/// g = (x_1 - x_2) . n_2 with x_2 the foot of x_1 on body 2's smooth surface. A point whose foot lies off body 2's
/// faces is no candidate. Where several patches of body 2 are near, each makes a row of its own.
pub fn closest_points(scene: &Scene, poses: &[Pose; 2], reach: f64) -> Vec<ContactRow> {
    let pairs = scene.first_tree.pairs(&poses[0], scene.second_tree, &poses[1], reach);
    let mut touching: Vec<(usize, usize, usize)> = pairs.iter().map(|p| (p.first.0, p.first.1, p.second.0)).collect();
    touching.dedup();
    touching.sort_unstable();
    touching.dedup();
    let mut rows = Vec::new();
    for (first, face, second) in touching {
        let points = &scene.points[first];
        let per_face = points.len() / scene.first[first].face_count();
        for point in face * per_face..(face + 1) * per_face {
            if let Some(row) = contact_row(scene, poses, (first, second), point, &points[point])
                && row.gap <= reach
            {
                rows.push(row);
            }
        }
    }
    rows
}

/// Gap row of a point `p` (numbered `point`) of one pair of patches; `None` when it has no foot on the faces of body 2.
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
        GapSource::Facet => (seen - other.facet_point(at)).dot(&normal_2),
    };
    let normal = poses[1].rotation * normal_2;
    let lever = |pose: &Pose| {
        let arm = position - pose.translation.vector;
        arm.x * normal.y - arm.y * normal.x
    };
    let support =
        |i: Interpolation, direction: Vec3| Support { nodes: i.nodes, weights: i.weights, count: i.count, direction };
    Some(ContactRow {
        patches: (first, second),
        point,
        gap,
        area: p.area,
        position,
        normal,
        coordinates: p.coordinates,
        levers: [lever(&poses[0]), -lever(&poses[1])],
        supports: [
            support(patch.interpolation(p.at), poses[0].inverse_transform_vector(&normal)),
            support(other.interpolation(at), -normal_2),
        ],
    })
}
