//! Finds the point at which two rigid flanks are nearest.

use crate::{
    Pose, Vec3,
    flank::FlankPatch,
    slice::{
        SliceHint,
        flank_pair::opposite_edge,
        profile_search::{LeastGapPoint, ProfilePair},
    },
};

/// The point at which two flanks are nearest along the profile at one height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestPoint {
    /// Gap along the normal, mm; negative if the flanks overlap.
    pub gap: f64,
    /// Position, common frame, mm: on the flank whose edge touches, otherwise on body 1.
    pub position: Vec3,
    /// Unit direction in which body 1 is pushed: out of body 2, or into body 1 if an edge of body 2 touches.
    pub normal: Vec3,
    /// Surface coordinates on each flank.
    pub at: [[f64; 2]; 2],
}

/// Two rigid flanks with their bodies at given poses.
///
/// Search and edges are those of two deformable flanks. The teeth behind the flanks are not known, so edges are sharp.
#[derive(Debug, Clone, Copy)]
pub struct RigidFlanks<'a> {
    poses: &'a [Pose; 2],
    profiles: ProfilePair<'a>,
    /// Largest deviation of both flanks from their smooth surfaces, mm.
    deviation: f64,
}

impl<'a> RigidFlanks<'a> {
    /// Two flanks with their bodies at `poses`.
    pub fn new(patches: [&'a FlankPatch; 2], poses: &'a [Pose; 2]) -> Self {
        let deviation = patches.iter().map(|patch| patch.surface().largest_deviation()).sum();
        Self { poses, profiles: ProfilePair::new(patches, [&poses[0], &poses[1]]), deviation }
    }

    /// Roll angle of body 1 at the smallest gap at height `z` (mm), the gap there (mm) and its foot point on body 2.
    /// All are measured from body 1, even if an edge of body 2 touches. `None` if the flanks do not face each other.
    pub fn least_gap(&self, z: f64, hint: &mut SliceHint) -> Option<(f64, f64, [f64; 2])> {
        let (point, sample) = self.profiles.nearest_point(z, hint)?;
        Some((point.roll(), sample.gap + self.deviation([[point.roll(), z], sample.foot]), sample.foot))
    }

    /// First-order bounds of the smallest gap at height `z` (mm); `None` if the flank faces nothing.
    pub fn foretold(&self, z: f64) -> Option<[f64; 2]> {
        self.profiles.foretold(z).map(|[low, high]| [low - self.deviation, high + self.deviation])
    }

    /// What both flanks lie below their smooth surfaces at a place of contact, mm. A flank that was taken apart
    /// (`geometry::ModifiedFlank::split`) is searched by its smooth part; the rest counts where that touches.
    fn deviation(&self, at: [[f64; 2]; 2]) -> f64 {
        if self.deviation == 0.0 {
            return 0.0;
        }
        self.profiles.patches.iter().zip(at).map(|(patch, at)| patch.surface().deviation(at)).sum()
    }

    /// The point at which the flanks are nearest at height `z` (mm, body 1's own frame); `None` if they do not face
    /// each other.
    ///
    /// Gap and normal are consistent: a small displacement d of a body changes the gap by its component along the
    /// normal, because the point is a minimum or stays on an edge.
    pub fn nearest(&self, z: f64, hint: &mut SliceHint) -> Option<NearestPoint> {
        let (point, sample) = self.profiles.nearest_point(z, hint)?;
        let [first, second] = self.profiles.patches.map(FlankPatch::surface);
        let nearest = match point {
            LeastGapPoint::Inside(u) | LeastGapPoint::OwnEnd(u) => Some(NearestPoint {
                gap: sample.gap,
                position: self.poses[0].transform_point(&first.point([u, z]).into()).coords,
                normal: self.poses[1].rotation * second.normal(sample.foot),
                at: [[u, z], sample.foot],
            }),
            LeastGapPoint::OtherKink(u) => Some(NearestPoint {
                gap: sample.gap,
                position: self.poses[1].transform_point(&second.point(sample.foot).into()).coords,
                normal: -(self.poses[0].rotation * first.normal([u, z])),
                at: [[u, z], sample.foot],
            }),
            LeastGapPoint::OtherEnd(_) => {
                let (edge, opposite) = opposite_edge(self.profiles.patches, self.poses, &sample)?;
                Some(NearestPoint {
                    gap: opposite.gap,
                    position: self.poses[1].transform_point(&second.point(edge).into()).coords,
                    normal: -(self.poses[0].rotation * first.normal(opposite.foot)),
                    at: [opposite.foot, edge],
                })
            }
        };
        nearest.map(|own| NearestPoint { gap: own.gap + self.deviation(own.at), ..own })
    }
}
