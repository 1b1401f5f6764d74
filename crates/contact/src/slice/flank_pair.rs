//! Contact by axial slices: at each station the point of the profile at which two flanks are nearest.

use crate::{
    Pose,
    flank::{FlankPatch, Surface},
    local::{BandMean, LocalBody, LocalContact, SAMPLES},
    nodal::{ContactRow, row_at, row_between},
    slice::profile_search::{GapSample, LeastGapPoint, ProfilePair},
    slice::{SliceHint, ToothLayer},
};

/// One flank for contact of slices.
#[derive(Debug, Clone, Copy)]
pub struct SliceFlank<'a> {
    /// Smooth surface, and faces that carry the load.
    pub patch: &'a FlankPatch,
    /// Layer of the tooth behind the flank.
    pub layer: &'a ToothLayer,
}

/// One slice of a contact line.
#[derive(Debug, Clone, PartialEq)]
pub struct Slice {
    /// Height z of the station on body 1, mm.
    pub z: f64,
    /// Surface coordinates of the contact on each flank.
    pub at: [[f64; 2]; 2],
    /// Length of contact line that the slice represents, mm.
    pub length: f64,
    /// Local contact at this position.
    pub local: LocalContact,
    /// Whether plain flanks touch here on parallel axes, so that the force acts along the normals of both.
    pub is_along_normals: bool,
}

/// Two flanks at the poses of their bodies, ready to be cut into slices.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlankPair<'a> {
    flanks: [SliceFlank<'a>; 2],
    poses: &'a [Pose; 2],
    profiles: ProfilePair<'a>,
    /// Largest deviation of both flanks from their smooth surfaces, mm.
    deviation: f64,
}

/// Place of a slice before anything is made of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SlicePoint {
    point: LeastGapPoint,
    sample: GapSample,
    z: f64,
    /// What both flanks lie below their smooth surfaces, as a band without width sees it, mm.
    deviation: f64,
}

impl SlicePoint {
    /// Smallest gap between the flanks along the profile, mm, without the increase by the rounding of an edge.
    pub fn gap(&self) -> f64 {
        self.sample.gap + self.deviation
    }
}

/// The slice at height `z` (mm, body 1's own frame) for `length` mm of contact line, and its gap row; `None` if the
/// flanks do not face each other.
///
/// For flank against flank, the gap's slope along the profile, n_2 . dx_1/du, is zero. If this point lies beyond a tip,
/// the tip edge touches the other flank along that flank's normal; contact off the line of action needs no special
/// case. The same holds for the kink at which a linear relief begins: a kink has no normal, but the flank that it
/// touches has.
pub fn slice(
    flanks: [SliceFlank; 2],
    poses: &[Pose; 2],
    patches: (usize, usize),
    station: usize,
    z: f64,
    length: f64,
) -> Option<(ContactRow, Slice)> {
    let pair = FlankPair::new(flanks, poses);
    let mut hint = SliceHint::default();
    let point = pair.nearest_point(z, &mut hint)?;
    let (mut row, slice) = pair.slice(&point, patches, station, length)?;
    pair.support(&mut row, &slice, &mut hint).then_some((row, slice))
}

impl SliceHint {
    /// A start near a roll angle of body 1.
    pub fn near(roll: f64) -> Self {
        Self { roll: Some(roll), ..Self::default() }
    }
}

impl<'a> FlankPair<'a> {
    /// Two flanks with their bodies at `poses`.
    pub fn new(flanks: [SliceFlank<'a>; 2], poses: &'a [Pose; 2]) -> Self {
        let profiles = ProfilePair::new(flanks.map(|f| f.patch), [&poses[0], &poses[1]]);
        let deviation = flanks.iter().map(|f| f.patch.surface().largest_deviation()).sum();
        Self { flanks, poses, profiles, deviation }
    }

    fn patches(&self) -> [&'a FlankPatch; 2] {
        self.flanks.map(|f| f.patch)
    }

    /// The smooth surfaces of both flanks.
    pub(super) fn surfaces(&self) -> [&'a dyn Surface; 2] {
        self.flanks.map(|f| f.patch.surface())
    }

    /// The layer behind a flank at surface coordinates.
    pub(super) fn layer(&self, body: usize, at: [f64; 2]) -> LocalBody {
        self.flanks[body].layer.body(at)
    }

    /// Where the flanks are nearest at height `z` (mm) of body 1; `None` where they do not face each other.
    pub(crate) fn nearest_point(&self, z: f64, hint: &mut SliceHint) -> Option<SlicePoint> {
        self.nearest_within(z, hint, f64::INFINITY)
    }

    /// Where the flanks are nearest at height `z` (mm) of body 1, if the gap there is at most `reach` (mm): the place
    /// of a wider gap is not always searched.
    pub(crate) fn nearest_within(&self, z: f64, hint: &mut SliceHint, reach: f64) -> Option<SlicePoint> {
        let (point, sample) = self.profiles.nearest_within(z, hint, reach + self.deviation)?;
        let nearest = SlicePoint { point, sample, z, deviation: 0.0 };
        if self.deviation == 0.0 || sample.gap > reach + self.deviation {
            return Some(nearest);
        }
        Some(SlicePoint { deviation: self.band_mean(&nearest).map_or(0.0, |mean| mean.at_rest()), ..nearest })
    }

    /// What bands at a place see of the flanks' deviations from their smooth surfaces.
    fn band_mean(&self, nearest: &SlicePoint) -> Option<Box<BandMean>> {
        if self.deviation == 0.0 {
            return None;
        }
        let (at, off) = self.place(nearest)?;
        let local = local(self.flanks, at, off, None);
        let widest = BandMean::widest(local.radius);
        let mut samples = [0.0; SAMPLES];
        let distances = BandMean::places().map(|x| x * widest);
        for (flank, at) in self.flanks.iter().zip(at) {
            flank.patch.surface().beside_parabola(at, &distances, &mut samples);
        }
        let law = local.law();
        let load = law.load_of(widest);
        Some(Box::new(BandMean::new(widest, &samples).kept_rising(load, law.under(load).slope)))
    }

    /// Surface coordinates of the contact on each flank, and how far off the line of action.
    fn place(&self, nearest: &SlicePoint) -> Option<([[f64; 2]; 2], f64)> {
        let SlicePoint { point, sample, z, .. } = *nearest;
        let at = [[point.roll(), z], sample.foot];
        match point {
            LeastGapPoint::Inside(_) | LeastGapPoint::OtherKink(_) => Some((at, 0.0)),
            LeastGapPoint::OwnEnd(_) => Some((at, off_line(self.patches(), sample.slope, at))),
            LeastGapPoint::OtherEnd(_) => self.other_edge(&sample).map(|(at, _, off)| (at, off)),
        }
    }

    /// Gap of the slice at a point, mm: [`SlicePoint::gap`] plus the increase by the rounding of an edge.
    pub fn gap(&self, nearest: &SlicePoint) -> f64 {
        let SlicePoint { point, sample, z, deviation } = *nearest;
        let smooth = match point {
            LeastGapPoint::OtherKink(_) => sample.gap,
            LeastGapPoint::OtherEnd(_) => {
                let Some((at, sample, off)) = self.other_edge(&sample) else { return nearest.gap() };
                sample.gap + self.edge_opening(at, off)
            }
            LeastGapPoint::Inside(_) | LeastGapPoint::OwnEnd(_) => {
                let at = [[point.roll(), z], sample.foot];
                let inside = matches!(point, LeastGapPoint::Inside(_));
                sample.gap
                    + self.edge_opening(at, if inside { 0.0 } else { off_line(self.patches(), sample.slope, at) })
            }
        };
        smooth + deviation
    }

    /// Whether an edge presses at a place, off the line of action.
    pub(crate) fn is_off_line(&self, nearest: &SlicePoint) -> bool {
        let SlicePoint { point, sample, .. } = *nearest;
        match point {
            LeastGapPoint::Inside(_) | LeastGapPoint::OtherKink(_) => false,
            LeastGapPoint::OwnEnd(_) => sample.slope != 0.0,
            LeastGapPoint::OtherEnd(_) => self.other_edge(&sample).is_some_and(|(_, _, off)| off != 0.0),
        }
    }

    fn edge_opening(&self, at: [[f64; 2]; 2], off_line: f64) -> f64 {
        let rounded = self.flanks.iter().any(|f| f.layer.edge_radius() > 0.0);
        if rounded { local(self.flanks, at, off_line, None).edge_opening() } else { 0.0 }
    }

    /// Body 2's edge on body 1: from the other body the same place is its own end. Surface coordinates, what is seen
    /// there, and how far off the line of action.
    fn other_edge(&self, sample: &GapSample) -> Option<([[f64; 2]; 2], GapSample, f64)> {
        let [a, b] = self.patches();
        let (edge, opposite) = opposite_edge([a, b], self.poses, sample)?;
        Some(([opposite.foot, edge], opposite, off_line([b, a], opposite.slope, [edge, opposite.foot])))
    }

    /// The slice at a point, for `length` mm of contact line, and its gap row without the nodes that carry it.
    /// [`FlankPair::support`] finds these nodes if they are needed.
    pub fn slice(
        &self,
        nearest: &SlicePoint,
        numbers: (usize, usize),
        station: usize,
        length: f64,
    ) -> Option<(ContactRow, Slice)> {
        let SlicePoint { point, sample, z, deviation: at_rest } = *nearest;
        let deviation = self.band_mean(nearest);
        let (patches, poses) = (self.patches(), self.poses);
        let at = [[point.roll(), z], sample.foot];
        match point {
            LeastGapPoint::Inside(_) | LeastGapPoint::OwnEnd(_) => {
                let position = poses[1].transform_point(&sample.point.into()).coords;
                let mut row = row_between(poses, numbers, station, at[0], sample.gap, (position, sample.normal));
                let inside = matches!(point, LeastGapPoint::Inside(_));
                let off = if inside { 0.0 } else { off_line(patches, sample.slope, at) };
                let local = local(self.flanks, at, off, deviation);
                row.gap += local.edge_opening() + at_rest;
                let is_along_normals = inside && self.profiles.is_plain();
                Some((row, Slice { z, at, length, local, is_along_normals }))
            }
            LeastGapPoint::OtherKink(_) => {
                let row = self.edge_row(numbers, station, at, nearest.gap());
                let local = local(self.flanks, at, 0.0, deviation);
                Some((row, Slice { z, at, length, local, is_along_normals: false }))
            }
            LeastGapPoint::OtherEnd(_) => {
                let (at, sample, off) = self.other_edge(&sample)?;
                let mut row = self.edge_row(numbers, station, at, sample.gap);
                let local = local(self.flanks, at, off, deviation);
                row.gap += local.edge_opening() + at_rest;
                Some((row, Slice { z, at, length, local, is_along_normals: false }))
            }
        }
    }

    /// Finds the nodes that carry a row of [`FlankPair::slice`], and their weights; returns whether there are any.
    pub fn support(&self, row: &mut ContactRow, slice: &Slice, hint: &mut SliceHint) -> bool {
        let patches = self.patches();
        (0..2).all(|i| {
            let Some(nearest) = patches[i].nearest_face_from(slice.at[i], hint.faces[i]) else { return false };
            hint.faces[i] = Some(nearest);
            row.supports[i].rest_on(patches[i], nearest);
            true
        })
    }

    /// Row of an edge of body 2 that presses on body 1: the force acts along body 1's normal.
    fn edge_row(&self, numbers: (usize, usize), station: usize, at: [[f64; 2]; 2], gap: f64) -> ContactRow {
        let (patches, poses) = (self.patches(), self.poses);
        let mut row = row_at(patches, poses, numbers, station, at, gap);
        let normal = -(poses[0].rotation * patches[0].surface().normal(at[0]));
        row.position = poses[1].transform_point(&patches[1].surface().point(at[1]).into()).coords;
        row.normal = normal;
        row.levers = crate::nodal::levers(poses, &row.position, &normal);
        row.torque_levers = row.levers;
        row.traction = normal;
        for (i, sign) in [1.0, -1.0].into_iter().enumerate() {
            let direction = sign * poses[i].inverse_transform_vector(&normal);
            (row.supports[i].direction, row.supports[i].load) = (direction, direction);
        }
        row
    }
}

/// Body 2's tip edge at the foot of a look, and what is seen of body 1 from there.
pub(crate) fn opposite_edge(
    [a, b]: [&FlankPatch; 2],
    poses: &[Pose; 2],
    sample: &GapSample,
) -> Option<([f64; 2], GapSample)> {
    let turned = ProfilePair::unguided([b, a], [&poses[1], &poses[0]]);
    let edge = [b.tip(), sample.foot[1]];
    Some((edge, turned.sample(edge)?))
}

/// How far past an edge of body 1 that presses off the line of action the smooth flanks would touch, mm of its flank's
/// arc: by the angle at which the flanks recede from each other there.
///
/// ```text
/// o = R epsilon,   epsilon = |dg/du| / (r_b u),   1/R: relative curvature
/// ```
fn off_line(patches: [&FlankPatch; 2], slope: f64, at: [[f64; 2]; 2]) -> f64 {
    let tangent = patches[0].surface().profile_tangent(at[0]).norm();
    let curvature = [0, 1].map(|i| patches[i].surface().curvature(at[i]));
    let receding = (slope / tangent).abs();
    // tangent = r_b u; the flanks' relative curvature turns arc length into receding angle.
    receding / (curvature[0] + curvature[1])
}

fn local(flanks: [SliceFlank; 2], at: [[f64; 2]; 2], off_line: f64, deviation: Option<Box<BandMean>>) -> LocalContact {
    let curvature: f64 = [0, 1].map(|i| flanks[i].patch.surface().curvature(at[i])).iter().sum();
    LocalContact {
        bodies: [0, 1].map(|i| flanks[i].layer.body(at[i])),
        radius: curvature.max(f64::MIN_POSITIVE).recip(),
        off_line,
        deviation,
    }
}
