//! Contact lines of the nominal flanks of a pair over a mesh cycle. Pairs that differ only in micro-geometry and load
//! have them in common.

use ale::Station;
use contact::{
    ContactOptions, Offset, Pose,
    flank::FlankPatch,
    pose::{check_offsets, gear_pose, reference_angle},
    slice::{RigidFlanks, SliceHint},
};
use geometry::{GearData, GearPair};

use crate::StaticOptions;

/// Phases of the mesh cycle that are looked at.
const PHASES: usize = 8;
/// Places along the face at which gaps are taken, for each module of face width; at least, at most.
const PLACES: [usize; 3] = [64, 768, 2048];
/// How far beyond the ends of the path of contact gaps are taken, in base pitches: loaded tips meet early.
const BEYOND: f64 = 0.15;

/// Gaps along the face of one pair at evenly spaced places in the middles of as many strips, mm; infinite where the
/// flanks do not face each other.
pub(crate) type Line = Vec<f64>;

/// Positions at which nominal flanks are nearest along all contact lines, at several phases of a mesh cycle.
#[derive(Debug)]
pub struct NominalLines {
    gears: [GearData; 2],
    /// Centre distance, and height of the wheel's mid-face over the pinion's, mm.
    place: [f64; 2],
    contact: ContactOptions,
    phases: Vec<Vec<NominalLine>>,
}

/// One contact line.
#[derive(Debug)]
struct NominalLine {
    /// Teeth from the middle pair, and number of the pair.
    pair: [i64; 2],
    gaps: Line,
    /// Roll angles and heights (mm) on both flanks.
    at: [[Vec<f64>; 2]; 2],
}

impl NominalLines {
    /// The lines of a pair near its path of contact; empty where flanks cannot face each other.
    pub fn new(pair: &GearPair, options: &StaticOptions) -> Self {
        let at = |i: usize| Station { cycle: 0, phase: (i as f64 + 0.3) / PHASES as f64 };
        let count = if check_offsets(pair, &options.contact).is_ok() { PHASES } else { 0 };
        Self {
            gears: [&pair.pinion, &pair.wheel].map(|gear| gear.data().clone()),
            place: place(pair),
            contact: options.contact.clone(),
            phases: (0..count).map(|i| lines(pair, options, at(i))).collect(),
        }
    }

    /// Whether these are also the lines of another pair. It may differ only in micro-geometry and load.
    pub fn serves(&self, pair: &GearPair, options: &StaticOptions) -> bool {
        let (own, asked) = (&self.contact, &options.contact);
        let turn = |of: &ContactOptions| (of.driver, of.sense, of.offsets);
        let gears = [&pair.pinion, &pair.wheel].map(|gear| gear.data());
        turn(own) == turn(asked) && self.place == place(pair) && self.gears.each_ref() == gears
    }

    /// Gaps along all lines of each phase: those of the nominal flanks, as they stand, and the depths that are ground off
    /// where they are nearest.
    pub(crate) fn gaps(&self, pair: &GearPair, options: &StaticOptions) -> impl Iterator<Item = Vec<Line>> {
        let of_line = move |line: &NominalLine| {
            let side = options.side();
            let [tooth, running] = line.pair;
            let flanks = [
                pair.pinion.modified_flank_at(side, tooth, running),
                pair.wheel.modified_flank_at(side, -tooth, -running),
            ];
            let mut depths = [0, 1].map(|_| vec![0.0; line.gaps.len()]);
            for ((flank, at), depths) in flanks.into_iter().zip(&line.at).zip(&mut depths) {
                // A slice takes the mean of what is rough: that asks for no more of them.
                flank.split(0.0).depths(at.each_ref().map(|list| &list[..]), depths);
            }
            let [own, other] = depths;
            line.gaps.iter().zip(own.iter().zip(other)).map(|(gap, (own, other))| gap + (own + other)).collect()
        };
        self.phases.iter().map(move |lines| lines.iter().map(of_line).collect())
    }
}

fn place(pair: &GearPair) -> [f64; 2] {
    [pair.centre_distance(), pair.mid_face_offset()]
}

/// Lines of all pairs near the path of contact at a station.
fn lines(pair: &GearPair, options: &StaticOptions, station: Station) -> Vec<NominalLine> {
    let side = options.side();
    let theta1 = station.pinion_angle(pair, options.side(), options.contact.sense);
    let angles = [theta1, reference_angle(pair, &options.contact, theta1)];
    let poses = [0, 1].map(|i| gear_pose(pair, &options.contact, i, angles[i]));
    let [start, end] = pair.path_of_contact();
    let pitch = pair.transverse_base_pitch();
    let [low, high] = [start - BEYOND * pitch, end + BEYOND * pitch];
    let reach = 0.5 * pair.face_width() * pair.base_helix_angle().tan().abs();
    let middle = pair.path_coordinate(side, theta1, 0, pair.common_middle()[0]);
    let ends = [(low - reach - middle) / pitch, (high + reach - middle) / pitch].map(|x| side.sign() * x);
    let teeth = ends[0].min(ends[1]).ceil() as i64..=ends[0].max(ends[1]).floor() as i64;
    let running = station.middle_pair(options.contact.sense);
    let [each, least, most] = PLACES;
    let places = (each as f64 * pair.face_width() / pair.pinion.data().normal_module) as usize;
    // An odd number: no station of an even number of slices then stands on the border of two places, where it would belong
    // to the upper one, and the lower one of the mirrored pair.
    let places = places.clamp(least, most) | 1;
    let of_tooth = |tooth: i64| line(pair, options, [tooth, running + tooth], &poses, theta1, places);
    teeth.map(of_tooth).filter(|line| line.gaps.iter().any(|g| g.is_finite())).collect()
}

/// The line of the pair `tooth` teeth from the middle one, `running` its number.
fn line(
    pair: &GearPair,
    options: &StaticOptions,
    [tooth, running]: [i64; 2],
    poses: &[Pose; 2],
    theta1: f64,
    places: usize,
) -> NominalLine {
    let side = options.side();
    let patches = [(&pair.pinion, tooth), (&pair.wheel, -tooth)].map(|(gear, tooth)| {
        let flank = gear.flank_of(side, tooth);
        let half = flank.half_width;
        let [low, high] = flank.roll_range();
        FlankPatch::rigid(tooth, Box::new(flank), [[low, -half], [high, half]])
    });
    let facing = RigidFlanks::new([&patches[0], &patches[1]], poses);
    let [start, end] = pair.path_of_contact();
    let slack = BEYOND * pair.transverse_base_pitch();
    let mut hint = SliceHint::default();
    let (width, common) = (pair.face_width(), pair.common_middle()[0]);
    let is_nominal = options.contact.offsets.iter().all(|offset| *offset == Offset::default());
    let (length, base_radii) = (pair.tangent_length(), [pair.pinion.base_radius(), pair.wheel.base_radius()]);
    let [middle, beside] = [0.0, 1.0].map(|z| pair.path_coordinate(side, theta1, tooth, z));
    let mut line = NominalLine { pair: [tooth, running], gaps: Vec::new(), at: Default::default() };
    for i in 0..places {
        let z = common + width * ((i as f64 + 0.5) / places as f64 - 0.5);
        let xi = middle + (beside - middle) * z;
        let (gap, at) = if xi < start - slack || xi > end + slack {
            (f64::INFINITY, [[0.0; 2]; 2])
        } else if is_nominal && xi >= start && xi <= end {
            // On parallel axes in their places nominal flanks touch all along the path of contact.
            (0.0, [[xi / base_radii[0], z], [(length - xi) / base_radii[1], z - pair.mid_face_offset()]])
        } else {
            facing.nearest(z, &mut hint).map_or((f64::INFINITY, [[0.0; 2]; 2]), |place| (place.gap, place.at))
        };
        line.gaps.push(gap);
        for (lists, at) in line.at.iter_mut().zip(at) {
            lists.iter_mut().zip(at).for_each(|(list, x)| list.push(x));
        }
    }
    line
}
