//! Stage 1, surface against surface: finds faces of two flanks that may touch.

use parry3d_f64::{
    bounding_volume::{Aabb, BoundingVolume},
    math::{Pose as ParryPose, Vector},
    partitioning::{Bvh, BvhBuildStrategy, BvhNode},
};

use crate::{Pose, Vec3, flank::FlankPatch};

/// A face of a patch of body 1 and one of body 2 that may touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct FacePair {
    /// Patch and face of body 1.
    pub first: (usize, usize),
    /// Patch and face of body 2.
    pub second: (usize, usize),
}

/// Trees of bounding volumes over the flank faces of one body, in its own frame. They are built once and moved by the
/// pose.
#[derive(Debug)]
pub struct Candidates {
    boxes: Vec<Aabb>,
    owners: Vec<(usize, usize)>,
    tree: Bvh,
}

impl Candidates {
    /// A tree over all faces of the patches.
    pub fn new<'a>(patches: impl IntoIterator<Item = &'a FlankPatch>) -> Self {
        let (mut boxes, mut owners) = (Vec::new(), Vec::new());
        for (p, patch) in patches.into_iter().enumerate() {
            for face in 0..patch.face_count() {
                let [low, high] = patch.face_box(face);
                boxes.push(Aabb::new(Vector::new(low.x, low.y, low.z), Vector::new(high.x, high.y, high.z)));
                owners.push((p, face));
            }
        }
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        Self { boxes, owners, tree }
    }

    /// Pairs of faces whose boxes are within `reach` (mm) of each other, ascending; poses map own frames to the common
    /// one. Conservative: a pair that is not listed is farther apart than `reach`.
    pub fn pairs(&self, pose: &Pose, other: &Self, other_pose: &Pose, reach: f64) -> Vec<FacePair> {
        let relative = to_parry(&(pose.inverse() * other_pose));
        let near = |a: &Aabb, b: &Aabb| a.loosened(reach).intersects(&b.transform_by(&relative));
        let hit = |a: &BvhNode, b: &BvhNode| near(&a.aabb(), &b.aabb());
        let mut found: Vec<FacePair> = self
            .tree
            .leaf_pairs(&other.tree, hit)
            .map(|(i, j)| (i as usize, j as usize))
            // Root nodes of one-leaf trees come unchecked.
            .filter(|&(i, j)| near(&self.boxes[i], &other.boxes[j]))
            .map(|(i, j)| FacePair { first: self.owners[i], second: other.owners[j] })
            .collect();
        found.sort_unstable();
        found
    }
}

fn to_parry(pose: &Pose) -> ParryPose {
    let t: Vec3 = pose.translation.vector;
    let r: Vec3 = pose.rotation.scaled_axis();
    ParryPose::new(Vector::new(t.x, t.y, t.z), Vector::new(r.x, r.y, r.z))
}
