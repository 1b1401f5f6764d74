//! Teeth that may touch, and where, slice by slice.

use contact::{
    Pose,
    flank::FlankPatch,
    slice::{NearestPoint, RigidFlanks, SliceHint},
};
use geometry::{Gear, GearPair, Side};

/// How far beyond the ends of the path of contact slices are looked at, in base pitches: overlapping tips meet early.
const BEYOND: f64 = 0.35;

/// All flanks of both gears on one side of the teeth, in their gears' own frames.
#[derive(Debug)]
pub(super) struct FlankSide {
    side: Side,
    patches: [Vec<FlankPatch>; 2],
    /// Heights of the slices on the pinion, mm.
    stations: Vec<f64>,
    /// Start of the search for each slice of each pinion tooth: where it was found before.
    hints: Vec<SliceHint>,
}

/// Nearest points of the flanks of one slice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slice {
    /// Running number of the pinion tooth.
    pub tooth: i64,
    pub place: NearestPoint,
}

/// Where a pair stands: angles for the pair in the middle of its cycle, and how many teeth have gone by.
#[derive(Debug, Clone, Copy)]
pub(super) struct NominalPose {
    /// Pinion angle by which tooth `shift` stands where tooth 0 stood, rad.
    pub pinion_angle: f64,
    /// Running number of that tooth.
    pub shift: i64,
    /// Wheel angle of the nominal motion that belongs to it, rad.
    pub wheel_angle: f64,
}

impl NominalPose {
    /// Angles of the gears' own frames.
    pub fn frame_angles(&self, pair: &GearPair) -> [f64; 2] {
        let whole = |gear: &Gear| self.shift.rem_euclid(i64::from(gear.teeth())) as f64 * gear.pitch_angle();
        [self.pinion_angle - whole(&pair.pinion), self.wheel_angle + whole(&pair.wheel)]
    }
}

impl FlankSide {
    pub fn new(pair: &GearPair, side: Side, slices: usize) -> Self {
        let patches = [&pair.pinion, &pair.wheel].map(|gear| {
            let flank = gear.flank(side);
            let half = flank.half_width;
            let [low, high] = flank.roll_range();
            let range = [[low, -half], [high, half]];
            (0..i64::from(gear.teeth()))
                .map(|tooth| FlankPatch::rigid(tooth, Box::new(gear.modified_flank(side, tooth)), range))
                .collect()
        });
        let (width, [middle, _]) = (pair.face_width(), pair.common_middle());
        let stations = (0..slices).map(|i| middle + width * ((i as f64 + 0.5) / slices as f64 - 0.5)).collect();
        let hints = vec![SliceHint::default(); slices * pair.pinion.teeth() as usize];
        Self { side, patches, stations, hints }
    }

    /// Calls `found` for every slice near the path of contact, by tooth and height, the gears' own frames at `poses`.
    pub fn search(&mut self, pair: &GearPair, at: &NominalPose, poses: &[Pose; 2], found: impl FnMut(Slice)) {
        self.search_within(BEYOND, pair, at, poses, found);
    }

    fn search_within(
        &mut self,
        beyond: f64,
        pair: &GearPair,
        at: &NominalPose,
        poses: &[Pose; 2],
        mut found: impl FnMut(Slice),
    ) {
        let [start, end] = pair.path_of_contact();
        let pitch = pair.transverse_base_pitch();
        let (low, high) = (start - beyond * pitch, end + beyond * pitch);
        let reach = 0.5 * pair.face_width() * pair.base_helix_angle().tan().abs();
        let s = self.side.sign();
        // xi(tooth) = xi_0 + s tooth p_bt in the middle of the common face.
        let middle = pair.path_coordinate(self.side, at.pinion_angle, 0, pair.common_middle()[0]);
        let ends = [(low - reach - middle) / pitch, (high + reach - middle) / pitch].map(|x| s * x);
        let (first, last) = (ends[0].min(ends[1]).ceil() as i64, ends[0].max(ends[1]).floor() as i64);
        // The wheel tooth that stands nearest to these flanks of pinion tooth 0.
        let facing = pair.wheel_angle(self.side, at.pinion_angle);
        let partner = ((facing - at.wheel_angle) / pair.wheel.pitch_angle()).round() as i64;
        let Self { side, patches, stations, hints } = self;
        let teeth = [pair.pinion.teeth(), pair.wheel.teeth()].map(i64::from);
        for tooth in first..=last {
            let own = (tooth + at.shift).rem_euclid(teeth[0]) as usize;
            let other = (partner - tooth - at.shift).rem_euclid(teeth[1]) as usize;
            let flanks = RigidFlanks::new([&patches[0][own], &patches[1][other]], poses);
            for (i, &z) in stations.iter().enumerate() {
                let xi = pair.path_coordinate(*side, at.pinion_angle, tooth, z);
                if xi < low || xi > high {
                    continue;
                }
                if let Some(place) = flanks.nearest(z, &mut hints[own * stations.len() + i]) {
                    found(Slice { tooth: tooth + at.shift, place });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use contact::Vec3;
    use geometry::{Gear, GearData};
    use nalgebra::{Translation3, UnitQuaternion};

    use super::*;

    /// Flanks that overlap by a fiftieth of the module, a heavy load, touch early at their tips; no slice in contact
    /// lies beyond where the search looks, at any phase.
    #[test]
    fn no_contact_is_missed_beyond_the_path() {
        let data = GearData { thickness_allowance: 0.0, ..GearData::default() };
        let wheel = GearData { helix_angle: -data.helix_angle, teeth: 41, ..data.clone() };
        let pair = GearPair::new(Gear::new(data).unwrap(), Gear::new(wheel).unwrap(), None).unwrap();
        for side in [Side::Left, Side::Right] {
            let mut flanks = FlankSide::new(&pair, side, 15);
            for phase in 0..20 {
                let pinion_angle =
                    pair.middle_angle(side) + pair.pinion.pitch_angle() * (f64::from(phase) / 20.0 - 0.5);
                let wheel_angle = pair.wheel_angle(side, pinion_angle);
                let at = NominalPose { pinion_angle, shift: 7, wheel_angle };
                let overlap = 0.02 * pair.pinion.data().normal_module;
                let lag = side.sign() * overlap / pair.wheel.base_radius();
                let angles = at.frame_angles(&pair);
                let about = |angle: f64| UnitQuaternion::from_axis_angle(&Vec3::z_axis(), angle);
                let poses = [
                    Pose::from_parts(Translation3::identity(), about(angles[0])),
                    Pose::from_parts(Translation3::new(pair.centre_distance(), 0.0, 0.0), about(angles[1] + lag)),
                ];
                let [some, more] = [BEYOND, 2.0 * BEYOND].map(|beyond| {
                    let mut all = Vec::new();
                    flanks.search_within(beyond, &pair, &at, &poses, |s| all.push(s));
                    all.retain(|s| s.place.gap < 0.0);
                    all.iter().map(|s| (s.tooth, (1e6 * s.place.gap).round())).collect::<Vec<_>>()
                });
                assert!(!some.is_empty(), "{side:?}, phase {phase}: nothing touches");
                assert_eq!(some, more, "{side:?}, phase {phase}");
            }
        }
    }
}
