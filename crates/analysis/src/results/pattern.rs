//! The pressure pattern of a run on the driving flank of one tooth of each gear.

use std::f64::consts::PI;

use contact::SliceResult;
use geometry::{Flank, GearPair, Side};
use ltca::StaticPosition;
use study::{FlankPattern, StudyError, Touch};

use scene::Scene;

use super::pairs::in_cycle;

/// Steps of the pattern along the profile: less than the half-width of a usual band each.
const PROFILE_STEPS: usize = 40;

/// Pressure pattern on one gear.
#[derive(Debug, Clone, PartialEq)]
pub struct GearPattern {
    /// Name of the gear, `pinion` or `wheel`.
    pub name: &'static str,
    /// The driving flank of tooth 0 without micro-geometry, which is too small to be visible.
    pub flank: Flank,
    /// x and z of the gear's centre, at mid-face, mm; y is 0.
    pub centre: [f64; 2],
    /// Ends of the common face relative to the gear's own mid-face, mm: the part of the flank that the grid covers.
    pub face: [f64; 2],
    /// Largest pressure and line load over roll angle and height.
    pub grid: FlankPattern,
}

impl GearPattern {
    /// Diameter at roll angle `roll` (rad), mm: d = 2 r_b sqrt(1 + u^2).
    pub fn diameter(&self, roll: f64) -> f64 {
        diameter(self.flank.base_radius, roll)
    }

    /// Height of the lower edge of a station's strip relative to the gear's mid-face, mm. For the index after the last
    /// station it is the upper end of the common face.
    pub fn strip_edge(&self, station: usize) -> f64 {
        let ([low, high], count) = (self.face, self.grid.stations().len());
        0.5 * (low + high) + 0.5 * (high - low) * (2.0 * station.min(count) as f64 / count as f64 - 1.0)
    }

    /// Largest pressure of the pattern, MPa.
    pub fn largest_pressure(&self) -> f64 {
        self.grid.max_pressure().iter().copied().fold(0.0, f64::max)
    }
}

/// d = 2 r_b sqrt(1 + u^2), mm.
pub fn diameter(base_radius: f64, roll: f64) -> f64 {
    2.0 * base_radius * roll.hypot(1.0)
}

/// Patterns of pinion and wheel.
///
/// All pairs of a mesh cycle together are one complete engagement of one tooth: pair k at phase s is where a tooth is
/// k + s cycles after pair 0 began. Over several cycles, and so over teeth with different pitch errors, the largest
/// values count.
///
/// # Errors
/// [`StudyError`] if the flank has no height, or if a result is not a finite number.
pub fn patterns(scene: &Scene, pair: &GearPair, positions: &[StaticPosition]) -> Result<[GearPattern; 2], StudyError> {
    Ok([pattern(scene, pair, positions, 0)?, pattern(scene, pair, positions, 1)?])
}

/// A driving flank without contact.
///
/// # Errors
/// [`StudyError`] if the flank has no height.
pub fn untouched(scene: &Scene, pair: &GearPair, gear: usize) -> Result<FlankPattern, StudyError> {
    let flank = [&pair.pinion, &pair.wheel][gear].flank(scene.side());
    let stations = stations(pair, gear, scene.contact.slices.unwrap_or(1) as usize);
    FlankPattern::new(flank.roll_range(), PROFILE_STEPS, stations)
}

/// A grid with the flank on which it lies.
pub fn on_flank(scene: &Scene, pair: &GearPair, gear: usize, grid: FlankPattern) -> GearPattern {
    let flank = [&pair.pinion, &pair.wheel][gear].flank(scene.side());
    let centre = [[0.0, 0.0], [pair.centre_distance(), pair.mid_face_offset()]][gear];
    let face = pair.common_face().map(|z| z - centre[1]);
    GearPattern { name: ["pinion", "wheel"][gear], flank, centre, face, grid }
}

/// Contact of a loaded slice of a pair on the pattern of a gear.
pub fn touch(slice: &SliceResult, gear: usize, engagement: f64) -> Touch {
    Touch {
        z: [slice.z, slice.wheel_z][gear],
        engagement,
        roll: slice.roll[gear],
        pressure: slice.pressure,
        line_load: slice.line_load,
    }
}

/// Largest pressures that positions put on the driving flank of a tooth: the slices of each, and the mesh cycles from one
/// position to the next. Where pairs have no numbers the roll angle says how far an engagement has gone, which grows with
/// the turn.
///
/// # Errors
/// [`StudyError`] when the flank has no height, or a result is no number.
pub(crate) fn pressed<'a>(
    scene: &Scene,
    pair: &GearPair,
    gear: usize,
    (slices, cycles): (impl Iterator<Item = &'a SliceResult>, f64),
) -> Result<FlankPattern, StudyError> {
    let pitch = [&pair.pinion, &pair.wheel][gear].pitch_angle().abs();
    let mut grid = untouched(scene, pair, gear)?;
    let driving = slices.filter(|s| s.side == scene.side());
    let touches: Vec<Touch> = driving.map(|s| touch(s, gear, s.roll[gear] / pitch)).collect();
    grid.press(&touches, 1.5 * cycles)?;
    Ok(grid)
}

fn pattern(
    scene: &Scene,
    pair: &GearPair,
    positions: &[StaticPosition],
    gear: usize,
) -> Result<GearPattern, StudyError> {
    let side = scene.side();
    let mut grid = untouched(scene, pair, gear)?;
    let pitch = 2.0 * PI / f64::from(scene.pinion.teeth);
    let per_cycle = (scene.analysis.positions_per_cycle as usize).max(1);
    for cycle in positions.chunks(per_cycle) {
        let touches: Vec<Touch> = cycle.iter().flat_map(|p| touches(p, side, gear, pitch)).collect();
        // One and a half distances of two positions: neighbours are joined, others never.
        grid.press(&touches, 1.5 / per_cycle as f64)?;
    }
    Ok(on_flank(scene, pair, gear, grid))
}

/// Mid-heights of `count` slices of the common face over the gear's own mid-face, mm.
fn stations(pair: &GearPair, gear: usize, count: usize) -> Vec<f64> {
    let (width, middle) = (pair.face_width(), pair.common_middle()[gear]);
    (0..count).map(|i| middle + width * ((i as f64 + 0.5) / count as f64 - 0.5)).collect()
}

/// The loaded slices of a position on `side` as touches of one tooth of a gear.
fn touches(position: &StaticPosition, side: Side, gear: usize, pitch: f64) -> impl Iterator<Item = Touch> + '_ {
    position.pairs.iter().flat_map(move |pair| {
        let engagement = in_cycle(position, pair.pair, pitch) as f64 + position.mesh_phase;
        pair.slices.iter().filter(move |s| s.side == side).map(move |s| touch(s, gear, engagement))
    })
}
