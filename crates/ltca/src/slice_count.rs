//! Number of slices that a pair needs under its load, and the errors of the spring model with that number.
//! Theory (21c).
//!
//! The count is chosen on a cheap model: a row of equal springs along every contact line, over the exact gaps of the
//! flanks at some phases of a mesh cycle. When it is cut into slices, the model shows the same errors as the contact:
//! where load ends within a slice, at tip edges and end faces, near crowning, relief or misalignment.

use ale::Station;
use contact::{
    Offset, Pose,
    flank::{FlankPatch, Surface},
    pose::{check_offsets, gear_pose, reference_angle},
    slice::{RigidFlanks, SliceHint},
};
use geometry::GearPair;

use crate::{StaticOptions, equilibrium::GUESSED_LINE_STIFFNESS};

/// Counts that are tried, ascending. The first one is what a narrow pair has.
const COUNTS: [usize; 15] = [32, 40, 48, 56, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320, 384];
/// Phases of the mesh cycle that are looked at.
const PHASES: usize = 8;
/// Places along the face at which gaps are taken, for each module of face width; at least, at most.
const PLACES: [usize; 3] = [64, 768, 2048];
/// How far beyond the ends of the path of contact gaps are taken, in base pitches: loaded tips meet early.
const BEYOND: f64 = 0.15;
/// Largest errors of the spring model, relative to infinitely many slices: mean approach; its peak to peak, relative to
/// itself or to a share of the mean where it is small; largest line load. Elastic gears have smaller errors, because
/// teeth share load with their neighbourhood and springs do not: measured on pairs of 5, 8, 15 and 40 modules, crowned
/// and misaligned (`crates/ltca/tests/ltca_laws/width_and_crowning.rs`).
const MEAN: f64 = 0.0125;
const SWING: f64 = 0.025;
const LEAST_SWING: f64 = 0.01;
const PEAK: f64 = 0.04;

/// How many slices a pair asks for under its load, and what the springs that say so are off by with them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliceCount {
    /// Slices over the face width.
    pub count: usize,
    /// Errors of the springs with as many.
    pub errors: SpringErrors,
}

/// Errors of a row of springs that is cut into slices, relative.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SpringErrors {
    /// Error of the mean approach.
    pub mean: f64,
    /// Error of the approach's peak to peak, relative to it, or to a hundredth of the mean where that is larger.
    pub swing: f64,
    /// Error of the largest line load.
    pub peak: f64,
}

impl SpringErrors {
    /// Whether any of them is more than `times` what a chosen count may have.
    pub fn exceed(&self, times: f64) -> bool {
        self.mean > times * MEAN || self.swing > times * SWING || self.peak > times * PEAK
    }
}

/// The least of the counts tried with which a row of springs over the pair's gaps is good to 1.25 % in the mean
/// approach, 2.5 % in its peak to peak and 4 % in the largest line load; the largest one where none is.
///
/// ```text
/// sum over the contact lines of k h max(0, delta - g_i) = F_bn cos b_b,   h = b / n
/// ```
/// k is a typical mesh stiffness, g the gap of the flanks, with micro-geometry and misalignment, at the position of
/// zero transmission error; both sides of a cut are solved exactly at eight phases. Without torque, or where the flanks
/// face each other nowhere, the first count.
pub fn slices_needed(pair: &GearPair, options: &StaticOptions) -> SliceCount {
    let springs = Springs::new(pair, options);
    let of = |count: usize| SliceCount { count, errors: springs.errors(count) };
    COUNTS.into_iter().map(of).find(|c| !c.errors.exceed(1.0)).unwrap_or_else(|| of(COUNTS[COUNTS.len() - 1]))
}

/// What the springs lose with any count of slices: see [`slices_needed`].
pub fn slice_errors(pair: &GearPair, options: &StaticOptions, count: usize) -> SpringErrors {
    Springs::new(pair, options).errors(count)
}

/// Gaps of all lines at each phase.
struct Springs {
    phases: Vec<Vec<Line>>,
    /// F_bn cos b_b / (k b): mean overlap over the face, mm.
    load: f64,
}

/// Gaps along the face of one pair at evenly spaced places in the middles of as many strips, mm; infinite where the
/// flanks do not face each other.
type Line = Vec<f64>;

impl Springs {
    fn new(pair: &GearPair, options: &StaticOptions) -> Self {
        let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()][options.driven()].abs();
        let load = options.torque / (base_radius * GUESSED_LINE_STIFFNESS * pair.face_width());
        if !(load.is_finite() && load > 0.0) || check_offsets(pair, &options.contact).is_err() {
            return Self { phases: Vec::new(), load: 0.0 };
        }
        let at = |i: usize| Station { cycle: 0, phase: (i as f64 + 0.3) / PHASES as f64 };
        let phases = (0..PHASES).map(|i| lines(pair, options, at(i))).filter(|lines| !lines.is_empty()).collect();
        Self { phases, load }
    }

    /// The worst of three counts next to each other: an error that comes and goes with the place of the stations is not
    /// missed where it happens to be zero.
    fn errors(&self, count: usize) -> SpringErrors {
        let of = [count - count / 8, count, count + count / 8].map(|n| self.errors_of(n.max(1)));
        let worst = |value: fn(&SpringErrors) -> f64| of.iter().map(value).fold(0.0, f64::max);
        SpringErrors { mean: worst(|e| e.mean), swing: worst(|e| e.swing), peak: worst(|e| e.peak) }
    }

    fn errors_of(&self, count: usize) -> SpringErrors {
        if self.phases.is_empty() {
            return SpringErrors::default();
        }
        let mut whole = Vec::new();
        let mut cut = Vec::new();
        let mut peak = 0.0f64;
        let mut touch = 0.0;
        for lines in &self.phases {
            let fine: Vec<f64> = lines.iter().flatten().copied().collect();
            let of_slices: Vec<f64> = lines.iter().flat_map(|line| sliced(line, count)).collect();
            let least = |gaps: &[f64]| gaps.iter().copied().fold(f64::INFINITY, f64::min);
            let (a, b) = (approach(&fine, self.load, lines[0].len()), approach(&of_slices, self.load, count));
            let (most, seen) = (a - least(&fine), b - least(&of_slices));
            peak = peak.max((seen / most - 1.0).abs());
            touch += least(&fine);
            whole.push(a);
            cut.push(b);
        }
        let phases = whole.len() as f64;
        let mean = whole.iter().sum::<f64>() / phases;
        let elastic = mean - touch / phases;
        let [swing, of_cut] = [&whole, &cut].map(|all| span(all));
        let off: Vec<f64> = whole.iter().zip(&cut).map(|(a, b)| b - a).collect();
        // What errors at single positions may do to the peak to peak, and what they have done here.
        let lost = span(&off).max((of_cut - swing).abs());
        SpringErrors {
            mean: (off.iter().sum::<f64>() / phases / elastic).abs(),
            swing: lost / swing.max(LEAST_SWING * elastic),
            peak,
        }
    }
}

fn span(values: &[f64]) -> f64 {
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    most - values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Gaps at the stations of `count` slices, straight between the places of a line.
fn sliced(line: &[f64], count: usize) -> impl Iterator<Item = f64> + '_ {
    let places = line.len() as f64;
    (0..count).map(move |i| {
        let place = ((i as f64 + 0.5) / count as f64 * places - 0.5).clamp(0.0, places - 1.0);
        let (below, share) = (place.floor() as usize, place.fract());
        let [a, b] = [line[below], line[(below + 1).min(line.len() - 1)]];
        match (a.is_finite(), b.is_finite()) {
            (true, true) => a + share * (b - a),
            _ => {
                if share < 0.5 {
                    a
                } else {
                    b
                }
            }
        }
    })
}

/// delta of springs that share a load: sum of max(0, delta - g) over `count` slices a face = `load` times `count`.
fn approach(gaps: &[f64], load: f64, count: usize) -> f64 {
    let mut gaps: Vec<f64> = gaps.iter().copied().filter(|g| g.is_finite()).collect();
    gaps.sort_unstable_by(f64::total_cmp);
    let (mut sum, target) = (0.0, load * count as f64);
    for (k, gap) in gaps.iter().enumerate() {
        // With the first k springs loaded.
        if k > 0 && (target + sum) / k as f64 <= *gap {
            return (target + sum) / k as f64;
        }
        sum += gap;
    }
    (target + sum) / gaps.len().max(1) as f64
}

/// Gaps of all pairs near the path of contact at a station.
fn lines(pair: &GearPair, options: &StaticOptions, station: Station) -> Vec<Line> {
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
    teeth.map(of_tooth).filter(|line| line.iter().any(|g| g.is_finite())).collect()
}

/// Gaps of the pair `tooth` teeth from the middle one, `running` its number: those of the nominal flanks, as they
/// stand, and the depths that are ground off where they are nearest.
fn line(
    pair: &GearPair,
    options: &StaticOptions,
    [tooth, running]: [i64; 2],
    poses: &[Pose; 2],
    theta1: f64,
    places: usize,
) -> Line {
    let side = options.side();
    let flanks =
        [pair.pinion.modified_flank_at(side, tooth, running), pair.wheel.modified_flank_at(side, -tooth, -running)];
    // A slice takes the mean of what is rough: that asks for no more of them.
    let flanks = flanks.map(|flank| flank.split(0.0));
    let patches = [0, 1].map(|i| {
        let flank = *flanks[i].nominal();
        let half = flank.half_width;
        let [low, high] = flank.roll_range();
        let range = [[low, -half], [high, half]];
        FlankPatch::rigid([tooth, -tooth][i], Box::new(flank), range)
    });
    let facing = RigidFlanks::new([&patches[0], &patches[1]], poses);
    let [start, end] = pair.path_of_contact();
    let slack = BEYOND * pair.transverse_base_pitch();
    let mut hint = SliceHint::default();
    let (width, common) = (pair.face_width(), pair.common_middle()[0]);
    let is_nominal = options.contact.offsets.iter().all(|offset| *offset == Offset::default());
    let (length, base_radii) = (pair.tangent_length(), [pair.pinion.base_radius(), pair.wheel.base_radius()]);
    let [middle, beside] = [0.0, 1.0].map(|z| pair.path_coordinate(side, theta1, tooth, z));
    let gap = |i: usize| {
        let z = common + width * ((i as f64 + 0.5) / places as f64 - 0.5);
        let xi = middle + (beside - middle) * z;
        if xi < start - slack || xi > end + slack {
            return f64::INFINITY;
        }
        if is_nominal && xi >= start && xi <= end {
            // On parallel axes in their places nominal flanks touch all along the path of contact.
            let rolls = [xi / base_radii[0], (length - xi) / base_radii[1]];
            let heights = [z, z - pair.mid_face_offset()];
            return [0, 1].map(|k| Surface::depth(&flanks[k], [rolls[k], heights[k]])).iter().sum();
        }
        let Some(place) = facing.nearest(z, &mut hint) else { return f64::INFINITY };
        place.gap + [0, 1].map(|k| Surface::depth(&flanks[k], place.at[k])).iter().sum::<f64>()
    };
    (0..places).map(gap).collect()
}

#[cfg(test)]
mod tests {
    use super::{approach, sliced};

    /// The load of springs with gaps 0, 1, 2, ... is carried by the first of them.
    #[test]
    fn springs_balance_their_load() {
        let gaps: Vec<f64> = (0..10).map(f64::from).collect();
        for load in [0.01, 0.3, 2.0, 50.0] {
            let delta = approach(&gaps, load, 10);
            let carried: f64 = gaps.iter().map(|g| (delta - g).max(0.0)).sum();
            assert!((carried / (10.0 * load) - 1.0).abs() < 1e-12, "{load}: {carried}");
        }
        assert!(sliced(&gaps, 5).zip([0.5, 2.5, 4.5, 6.5, 8.5]).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}
