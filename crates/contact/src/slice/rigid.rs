//! Where two flanks are nearest when nothing but their shape counts: rigid bodies.

use crate::{
    FlankPatch, Pose, SliceHint, Vec3,
    slice::{
        flank_pair::facing_edge,
        profile_search::{Facing, Place},
    },
};

/// Where two flanks are nearest along the profile at one height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestPlace {
    /// Gap along the normal, mm; below zero where the flanks overlap.
    pub gap: f64,
    /// The place, common frame, mm: on the flank whose edge presses, or on body 1.
    pub position: Vec3,
    /// Unit direction in which body 1 is pushed: out of body 2, or into body 1 where an edge of body 2 presses.
    pub normal: Vec3,
    /// Surface coordinates on each flank.
    pub at: [[f64; 2]; 2],
}

/// Two rigid flanks with their bodies at given poses.
///
/// Search and edges are those of [`crate::FlankPair`]; nothing is known of what stands behind the flanks, so edges are sharp.
#[derive(Debug, Clone, Copy)]
pub struct RigidFlanks<'a> {
    poses: &'a [Pose; 2],
    facing: Facing<'a>,
}

impl<'a> RigidFlanks<'a> {
    /// Two flanks with their bodies at `poses`.
    pub fn new(patches: [&'a FlankPatch; 2], poses: &'a [Pose; 2]) -> Self {
        Self { poses, facing: Facing::new(patches, [&poses[0], &poses[1]]) }
    }

    /// Where they are nearest at height `z` (mm, body 1's own frame); `None` where they do not face each other.
    ///
    /// Gap and normal fit together: moving a body by a small d changes the gap by the normal's part of it, as the place is a least one or stays
    /// on an edge.
    pub fn nearest(&self, z: f64, hint: &mut SliceHint) -> Option<NearestPlace> {
        let (place, look) = self.facing.place(z, hint)?;
        let [first, second] = self.facing.patches.map(FlankPatch::surface);
        match place {
            Place::Inside(u) | Place::OwnEnd(u) => Some(NearestPlace {
                gap: look.gap,
                position: self.poses[0].transform_point(&first.point([u, z]).into()).coords,
                normal: self.poses[1].rotation * second.normal(look.foot),
                at: [[u, z], look.foot],
            }),
            Place::OtherKink(u) => Some(NearestPlace {
                gap: look.gap,
                position: self.poses[1].transform_point(&second.point(look.foot).into()).coords,
                normal: -(self.poses[0].rotation * first.normal([u, z])),
                at: [[u, z], look.foot],
            }),
            Place::OtherEnd(_) => {
                let (edge, seen) = facing_edge(self.facing.patches, self.poses, &look)?;
                Some(NearestPlace {
                    gap: seen.gap,
                    position: self.poses[1].transform_point(&second.point(edge).into()).coords,
                    normal: -(self.poses[0].rotation * first.normal(seen.foot)),
                    at: [seen.foot, edge],
                })
            }
        }
    }
}
