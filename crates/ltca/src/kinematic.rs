//! The unloaded pair: where modified, misaligned flanks just touch. Theory (32), (33).

use ale::Station;
use contact::{
    ContactOptions, Pose, SurfacePair, Vec3, check_offsets, contact_intervals, covered, gear_pose, last_inside,
    reference_angle,
};
use geometry::{Gear, GearPair, ModifiedFlank};

use crate::StaticError;

/// Axial stations of each pair at which the least gap is looked at first.
const STATIONS: usize = 41;
/// Dips of the gap along the face that are looked into.
const DIPS: usize = 3;
/// Steps of the golden section in z: the bracket shrinks to a 10^8th.
const GOLDEN_STEPS: usize = 40;
/// Steps of the rotation before giving up; the gap is nearly linear in it, so three or four do.
const STEPS: usize = 30;
/// Flanks nearer than this touch, mm: a nanometre.
const TOUCHING: f64 = 1e-6;

/// The gears of a station without load, in their own frames, teeth counted from the pair in the middle of the cycle.
#[derive(Debug, Clone)]
pub(crate) struct Unloaded<'a> {
    pair: &'a GearPair,
    options: &'a ContactOptions,
    station: Station,
    /// Rotation of the driven gear from the position of zero transmission error to where the flanks touch, rad.
    pub rotation: f64,
}

/// Least gap of one tooth pair.
#[derive(Debug, Clone, Copy)]
struct Nearest {
    gap: f64,
    /// Roll angle and height on the pinion.
    at: [f64; 2],
    /// Tooth, counted from the middle pair.
    tooth: i64,
}

impl<'a> Unloaded<'a> {
    /// Turns the driven gear until the least gap over all pairs, heights and edges is zero.
    ///
    /// ```text
    /// min over pairs and z of min over u of g(u, z; theta) = 0,   theta <- theta - g / (dg/dtheta)
    /// ```
    /// g is the gap between the flanks with their micro-geometry at the poses of the displaced gears. It is nearly
    /// linear in theta. Unmodified flanks on parallel axes touch at zero by definition.
    ///
    /// # Errors
    /// [`StaticError::Apart`] when no flanks face each other.
    pub fn new(pair: &'a GearPair, options: &'a ContactOptions, station: Station) -> Result<Self, StaticError> {
        let mut unloaded = Self { pair, options, station, rotation: 0.0 };
        if unloaded.is_nominal() {
            return Ok(unloaded);
        }
        let round_off = 16.0 * f64::EPSILON * pair.centre_distance();
        for _ in 0..STEPS {
            let poses = unloaded.poses();
            let apart = StaticError::Apart { cycle: station.cycle, phase: station.phase };
            let Some(nearest) = unloaded.nearest(&poses) else { return Err(apart) };
            let lever = unloaded.lever(&poses, &nearest);
            let step = -nearest.gap / lever;
            if !step.is_finite() || step.abs() > 0.5 * pair.pinion.pitch_angle() {
                return Err(apart);
            }
            unloaded.rotation += step;
            if nearest.gap.abs() <= round_off {
                return Ok(unloaded);
            }
        }
        // Two pairs that touch alternately at the last bits: the gap is far below any tolerance by then, or it is an
        // error.
        match unloaded.nearest(&unloaded.poses()) {
            Some(nearest) if nearest.gap.abs() <= 1e-3 * TOUCHING => Ok(unloaded),
            _ => Err(StaticError::Apart { cycle: station.cycle, phase: station.phase }),
        }
    }

    /// Whether the loaded flanks are unmodified and the axes parallel.
    pub fn is_nominal(&self) -> bool {
        let side = self.options.side();
        let plain = |gear: &Gear| !gear.is_modified(side);
        plain(&self.pair.pinion) && plain(&self.pair.wheel) && !self.options.offsets.iter().any(|o| o.is_tilted())
    }

    /// Kinematic transmission error on the driven gear's base circle, mm; positive when it lags.
    pub fn transmission_error(&self) -> f64 {
        let driven = self.options.driven();
        let base_radius = [self.pair.pinion.base_radius(), self.pair.wheel.base_radius()][driven];
        self.options.side().sign() * base_radius * self.rotation
    }

    /// Poses of the gears' own frames, tooth 0 belonging to the pair in the middle of the cycle.
    fn poses(&self) -> [Pose; 2] {
        let Self { pair, options, .. } = *self;
        let theta1 = self.station.pinion_angle(pair, options.side(), options.sense);
        let mut angles = [theta1, reference_angle(pair, options, theta1)];
        angles[options.driven()] += self.rotation;
        [0, 1].map(|i| gear_pose(pair, options, i, angles[i]))
    }

    /// Flanks of the pair `tooth` teeth from the middle one, each with the pitch error of the tooth that is there.
    fn flanks(&self, tooth: i64) -> [ModifiedFlank; 2] {
        let side = self.options.side();
        let running = self.station.middle_pair(self.options.sense) + tooth;
        [
            self.pair.pinion.modified_flank_at(side, tooth, running),
            self.pair.wheel.modified_flank_at(side, -tooth, -running),
        ]
    }

    /// Teeth that can reach the path of contact, half a pitch beyond either end.
    fn teeth(&self) -> std::ops::RangeInclusive<i64> {
        let Self { pair, options, .. } = *self;
        let (side, pitch) = (options.side(), pair.transverse_base_pitch());
        let theta1 = self.station.pinion_angle(pair, options.side(), options.sense);
        let [start, end] = pair.path_of_contact();
        let half = 0.5 * pair.pinion.face_width().max(pair.wheel.face_width());
        let reach = half * pair.base_helix_angle().tan().abs() + 0.5 * pitch;
        // The tooth number rises with xi for left flanks and falls for right ones.
        let at_zero = pair.path_coordinate(side, theta1, 0, 0.0);
        let (low, high) = ((start - reach - at_zero) / pitch, (end + reach - at_zero) / pitch);
        let (low, high) = if side.sign() > 0.0 { (low, high) } else { (-high, -low) };
        low.floor() as i64..=high.ceil() as i64
    }

    fn nearest(&self, poses: &[Pose; 2]) -> Option<Nearest> {
        let of_pair = |tooth| {
            let flanks = self.flanks(tooth);
            FlankGap::new(&flanks, poses).nearest().map(|(gap, at)| Nearest { gap, at, tooth })
        };
        self.teeth().filter_map(of_pair).min_by(|a, b| a.gap.total_cmp(&b.gap))
    }

    /// d gap / d angle of the driven gear, mm.
    fn lever(&self, poses: &[Pose; 2], nearest: &Nearest) -> f64 {
        let driven = self.options.driven();
        let [first, _] = self.flanks(nearest.tooth);
        let [u, z] = nearest.at;
        let position = poses[0].transform_point(&first.point(u, z).into()).coords;
        // Where they touch the normals are opposite, but at an edge there is only one: that of the flank that it
        // touches. Both have the same lever to the order of the micro-geometry, and a step off by that much is made up
        // by the next.
        let normal = -(poses[0].rotation * first.normal(u, z));
        let arm = position - poses[driven].translation.vector;
        let sign = if driven == 0 { 1.0 } else { -1.0 };
        sign * arm.cross(&normal).dot(&(poses[driven].rotation * Vec3::z()))
    }

    /// Length of the contact line (mm) of the pair of a running number: the stretch on which the flanks touch to a
    /// nanometre, over cos b_b.
    pub fn line_length(&self, running: i64) -> f64 {
        let poses = self.poses();
        let flanks = self.flanks(running - self.station.middle_pair(self.options.sense));
        let gap = FlankGap::new(&flanks, &poses);
        let Some((least, [_, z])) = gap.nearest() else { return 0.0 };
        if least > TOUCHING {
            return 0.0;
        }
        let touches = |z: f64| gap.at(z).map_or(f64::INFINITY, |g| g.1);
        let half = gap.half_width();
        let mut intervals = contact_intervals(touches, [-half, half], STATIONS, TOUCHING);
        if !intervals.iter().any(|i| (i[0]..=i[1]).contains(&z)) {
            // Touching between two stations only: from the place of least gap to the stations beside it.
            let step = 2.0 * half / (STATIONS - 1) as f64;
            let beside = [(z - step).max(-half), z, (z + step).min(half)];
            let left = contact_intervals(touches, [beside[0], z], 2, TOUCHING);
            let right = contact_intervals(touches, [z, beside[2]], 2, TOUCHING);
            intervals = left.into_iter().chain(right).collect();
        }
        covered(&intervals, [-half, half]) / self.pair.base_helix_angle().cos()
    }
}

/// Gap between the two flanks of a pair.
struct FlankGap<'a> {
    flanks: &'a [ModifiedFlank; 2],
    poses: &'a [Pose; 2],
}

impl<'a> FlankGap<'a> {
    fn new(flanks: &'a [ModifiedFlank; 2], poses: &'a [Pose; 2]) -> Self {
        Self { flanks, poses }
    }

    fn half_width(&self) -> f64 {
        self.flanks[0].nominal().half_width
    }

    /// Roll angle of least gap at height `z` of the pinion, and the gap.
    fn at(&self, z: f64) -> Option<(f64, f64)> {
        let [first, second] = self.flanks;
        let (f, s) = (first.nominal(), second.nominal());
        // The foot of an end face's point lies on the end face to round-off.
        let end = s.half_width * (1.0 + 1e-9);
        let covers = |[u, z]: [f64; 2]| u >= s.roll_form && u <= s.roll_tip && z.abs() <= end;
        SurfacePair { first, second, poses: self.poses }.least_gap([f.roll_form, f.roll_tip], &covers, z)
    }

    /// Least gap over the face and where on the pinion.
    fn nearest(&self) -> Option<(f64, [f64; 2])> {
        let half = self.half_width();
        let z = |i: usize| half * (2.0 * i as f64 / (STATIONS - 1) as f64 - 1.0);
        let gaps: Vec<f64> = (0..STATIONS).map(|i| self.at(z(i)).map_or(f64::INFINITY, |g| g.1)).collect();
        let mut dips: Vec<usize> = (0..STATIONS)
            .filter(|&i| {
                let beside = |k: Option<&f64>| k.is_none_or(|g| gaps[i] <= *g);
                gaps[i].is_finite() && beside(i.checked_sub(1).and_then(|k| gaps.get(k))) && beside(gaps.get(i + 1))
            })
            .collect();
        dips.sort_by(|&a, &b| gaps[a].total_cmp(&gaps[b]));
        // A stretch of equal gaps is one dip after another; any of them is as good.
        dips.truncate(DIPS);
        dips.into_iter()
            .filter_map(|i| {
                let (from, to) = (z(i.saturating_sub(1)), z((i + 1).min(STATIONS - 1)));
                let place = self.golden(self.facing_end(z(i), from), self.facing_end(z(i), to));
                [z(i), place].into_iter().filter_map(|z| self.at(z).map(|(u, gap)| (gap, [u, z]))).min_by(by_gap)
            })
            .min_by(by_gap)
    }

    /// `to`, or the last place on the way there from `from` at which the flanks face each other.
    fn facing_end(&self, from: f64, to: f64) -> f64 {
        if self.at(to).is_some() {
            return to;
        }
        last_inside(|z| self.at(z).is_some(), [from, to], GOLDEN_STEPS, 0.0)
    }

    /// Place of the least gap between `a` and `b`, ends included.
    fn golden(&self, mut a: f64, mut b: f64) -> f64 {
        const RATIO: f64 = 0.618_033_988_749_894_9;
        let gap = |z: f64| self.at(z).map_or(f64::INFINITY, |g| g.1);
        let ends = [(a, gap(a)), (b, gap(b))];
        let (mut x, mut y) = (b - RATIO * (b - a), a + RATIO * (b - a));
        let (mut gx, mut gy) = (gap(x), gap(y));
        for _ in 0..GOLDEN_STEPS {
            if gx <= gy {
                (b, y, gy) = (y, x, gx);
                x = b - RATIO * (b - a);
                gx = gap(x);
            } else {
                (a, x, gx) = (x, y, gy);
                y = a + RATIO * (b - a);
                gy = gap(y);
            }
        }
        let inner = if gx <= gy { (x, gx) } else { (y, gy) };
        // At an end of the flanks the gap may still fall: the end itself is the place then, and no golden section
        // reaches it.
        ends.into_iter().fold(inner, |best, end| if end.1 <= best.1 { end } else { best }).0
    }
}

fn by_gap(a: &(f64, [f64; 2]), b: &(f64, [f64; 2])) -> std::cmp::Ordering {
    a.0.total_cmp(&b.0)
}

/// Kinematic transmission error of an unloaded pair, mm: see [`crate::StaticPosition::kinematic_transmission_error`].
///
/// It needs no mesh. Zero for unmodified flanks on parallel axes.
///
/// # Errors
/// [`StaticError::Apart`] when no flanks face each other; [`StaticError::OutOfRange`] for offsets with which they
/// cannot.
pub fn kinematic_transmission_error(
    pair: &GearPair,
    options: &ContactOptions,
    station: Station,
) -> Result<f64, StaticError> {
    check_offsets(pair, options)?;
    Ok(Unloaded::new(pair, options, station)?.transmission_error())
}
