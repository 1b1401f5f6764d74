//! The unloaded pair: the pose at which modified, misaligned flanks just touch. Theory (32), (33).

use ale::{SlidingWindow, Station};
use contact::{
    ContactOptions, Method, Pose, Vec3,
    flank::FlankPatch,
    line::{contact_intervals, covered, rigid_gap},
    pose::{check_offsets, gear_pose, reference_angle},
};
use geometry::{Gear, GearPair, ModifiedFlank};

use crate::{
    StaticError, StaticOptions,
    flank_gap::{DipPlace, FlankGap, STATIONS},
    pose_steps::round_off_of_places,
};

/// Steps of the rotation before giving up, and those of Newton's method, after which the middle is taken between
/// rotations on either side; the gap is nearly linear in it, so three or four do.
const STEPS: usize = 80;
const NEWTON_STEPS: usize = 10;
/// Share by which gaps of two pairs may change differently as the gear turns.
const OTHER_LEVERS: f64 = 0.05;
/// Heights between which a parabola tells where the gap is least, over half the face width.
const POLISH: f64 = 0.001;
/// Turn by which a difference tells how the gap follows the rotation, on the base circle as one part in so many of the
/// normal module.
const TURN: f64 = 3e4;
/// Flanks nearer than one part in so many of the normal module touch: a nanometre at 3 mm.
const TOUCHING: f64 = 3e6;

/// The gears of a station without load, in their own frames, teeth counted from the pair in the middle of the cycle.
#[derive(Debug, Clone)]
pub(crate) struct Unloaded<'a> {
    pair: &'a GearPair,
    options: &'a ContactOptions,
    pub station: Station,
    /// Rotation of the driven gear from the position of zero transmission error to where the flanks touch, rad.
    pub rotation: f64,
    /// Place where the flanks touch; none where nominal flanks touch along lines.
    pub touch: Option<Nearest>,
}

/// Least gap of one tooth pair.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Nearest {
    gap: f64,
    /// Roll angle and height on the pinion.
    at: [f64; 2],
    /// Tooth, counted from the middle pair.
    tooth: i64,
}

/// Teeth and places at which the least gap is searched.
enum Look {
    /// All over the face of these teeth.
    All(Vec<i64>),
    /// These places of these teeth.
    At(Vec<(i64, Vec<DipPlace>)>),
}

impl Look {
    fn teeth(&self) -> Vec<i64> {
        match self {
            Self::All(teeth) => teeth.clone(),
            Self::At(places) => places.iter().map(|(tooth, _)| *tooth).collect(),
        }
    }
}

impl<'a> Unloaded<'a> {
    /// Rotates the driven gear until the smallest gap over all pairs, heights and edges is zero.
    ///
    /// ```text
    /// min over pairs and z of min over u of g(u, z; theta) = 0,   theta <- theta - g / (dg/dtheta)
    /// ```
    /// g is the gap between the flanks with their micro-geometry at the poses of the displaced gears; it is nearly
    /// linear in theta. Unmodified flanks on parallel axes touch at zero by definition.
    ///
    /// # Errors
    /// [`StaticError::Apart`] if no flanks face each other.
    pub fn new(pair: &'a GearPair, options: &'a ContactOptions, station: Station) -> Result<Self, StaticError> {
        let mut unloaded = Self { pair, options, station, rotation: 0.0, touch: None };
        if unloaded.is_nominal() {
            return Ok(unloaded);
        }
        let round_off = round_off_of_places(pair.centre_distance());
        let radius = pair.pinion.base_radius().max(pair.wheel.base_radius().abs());
        let mut look = Look::All(unloaded.teeth().collect());
        // Rotations with the flanks apart, and with them in each other.
        let mut between = [None::<f64>; 2];
        for taken in 0..STEPS {
            let poses = unloaded.poses();
            let apart = StaticError::Apart { cycle: station.cycle, phase: station.phase };
            let Some((nearest, beside)) = unloaded.nearest(&poses, &look) else { return Err(apart) };
            look = beside;
            let lever = unloaded.lever(&poses, &nearest);
            let step = -nearest.gap / lever;
            if !step.is_finite() || step.abs() > 0.5 * pair.pinion.pitch_angle() {
                return Err(apart);
            }
            between[usize::from(nearest.gap < 0.0)] = Some(unloaded.rotation);
            unloaded.touch = Some(nearest);
            let touches = nearest.gap.abs() <= round_off && taken > 0;
            match between {
                // Steps that go to and fro over a kink: the end of what two flanks face of each other, another pair.
                [Some(out), Some(within)] if taken >= NEWTON_STEPS && !touches => {
                    unloaded.rotation = 0.5 * (out + within);
                    if (out - within).abs() * radius <= round_off {
                        return Ok(unloaded);
                    }
                }
                _ => unloaded.rotation += step,
            }
            if touches {
                return Ok(unloaded);
            }
        }
        Err(StaticError::Apart { cycle: station.cycle, phase: station.phase })
    }

    /// Whether the loaded flanks are unmodified and the axes parallel.
    pub fn is_nominal(&self) -> bool {
        let side = self.options.side();
        let plain = |gear: &Gear| !gear.is_modified(side);
        plain(&self.pair.pinion) && plain(&self.pair.wheel) && !self.options.offsets.iter().any(|o| o.is_tilted())
    }

    /// Kinematic transmission error on the driven gear's base circle, mm; positive if it lags.
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

    /// Flanks of the pair `tooth` teeth from the middle one, each with the pitch error of the tooth that is there. What was
    /// measured is searched by its smooth part, as under load.
    fn flanks(&self, tooth: i64) -> [ModifiedFlank; 2] {
        let side = self.options.side();
        let running = self.station.middle_pair(self.options.sense) + tooth;
        [
            self.pair.pinion.modified_flank_at(side, tooth, running),
            self.pair.wheel.modified_flank_at(side, -tooth, -running),
        ]
        .map(|flank| match self.options.method {
            Method::Slice => flank.split(0.0),
            Method::Nodal => flank,
        })
    }

    /// Patches of the flanks of [`Self::flanks`], as the contact search takes them.
    fn patches(&self, tooth: i64) -> [FlankPatch; 2] {
        self.flanks(tooth).map(|flank| {
            let nominal = flank.nominal();
            let (half, rolls) = (nominal.half_width, nominal.roll_range());
            FlankPatch::rigid(tooth, Box::new(flank), [[rolls[0], -half], [rolls[1], half]])
        })
    }

    /// Teeth that can reach the path of contact, half a pitch beyond either end.
    fn teeth(&self) -> std::ops::RangeInclusive<i64> {
        let Self { pair, options, .. } = *self;
        let (side, pitch) = (options.side(), pair.transverse_base_pitch());
        let theta1 = self.station.pinion_angle(pair, options.side(), options.sense);
        let [start, end] = pair.path_of_contact();
        let reach = 0.5 * pair.face_width() * pair.base_helix_angle().tan().abs() + 0.5 * pitch;
        // The tooth number rises with xi for left flanks and falls for right ones.
        let at_zero = pair.path_coordinate(side, theta1, 0, pair.common_middle()[0]);
        let (low, high) = ((start - reach - at_zero) / pitch, (end + reach - at_zero) / pitch);
        let (low, high) = if side.sign() > 0.0 { (low, high) } else { (-high, -low) };
        low.floor() as i64..=high.ceil() as i64
    }

    /// Least gap over the pairs of some teeth, and where it may be once the gear has turned to where they touch: the
    /// gaps of all pairs change by nearly the same.
    ///
    /// Pairs are looked into in the order of what was seen of them, and no further than one may have the least gap.
    fn nearest(&self, poses: &[Pose; 2], look: &Look) -> Option<(Nearest, Look)> {
        let (teeth, first) = (look.teeth(), matches!(look, Look::All(_)));
        let flanks: Vec<[FlankPatch; 2]> = teeth.iter().map(|&tooth| self.patches(tooth)).collect();
        let mut enough = f64::INFINITY;
        let mut gaps: Vec<FlankGap<'_>> = match look {
            Look::All(_) => {
                let unseen: Vec<FlankGap<'_>> =
                    flanks.iter().map(|flanks| FlankGap::unseen(flanks, poses, self.module())).collect();
                let foretold: Vec<_> = unseen.iter().map(FlankGap::foretold).collect();
                // Whatever the least gap is, it is no larger than the least that may be.
                enough = foretold.iter().flatten().flatten().map(|[_, high]| *high).fold(f64::INFINITY, f64::min);
                // Nor than the one where the first order has it.
                let there = unseen.iter().zip(&foretold).filter_map(|(gap, told)| gap.told_least(told));
                let there = there.min_by(|a, b| a.1.total_cmp(&b.1)).and_then(|(z, _, gap)| gap.at(z));
                enough = there.map_or(enough, |(_, gap)| enough.min(gap));
                unseen.into_iter().zip(&foretold).map(|(gap, told)| gap.looked(told, enough)).collect()
            }
            Look::At(places) => flanks
                .iter()
                .zip(places)
                .map(|(flanks, (_, at))| FlankGap::seen(flanks, poses, self.module(), at))
                .collect(),
        };
        let mut best = nearest_of(&mut gaps, &teeth, first);
        if first && best.is_none_or(|b| b.gap > enough + self.touching()) {
            // Flanks that the first order says nothing true of, or whose gap it has too low: every station counts.
            gaps = flanks.iter().map(|flanks| FlankGap::new(flanks, poses, self.module())).collect();
            best = nearest_of(&mut gaps, &teeth, first);
        }
        let best = best?;
        if let Look::At(places) = look {
            return Some((best, Look::At(places.clone())));
        }
        let reach = best.gap + OTHER_LEVERS * best.gap.abs() + self.touching();
        let places = teeth.iter().zip(&gaps).map(|(&tooth, gap)| {
            let found = (tooth == best.tooth).then_some(best.at[1]);
            (tooth, gap.dips_below(reach, found))
        });
        Some((best, Look::At(places.filter(|(_, heights)| !heights.is_empty()).collect())))
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

    /// Derivative of the transmission error by the gap at the contact position. The position itself is a minimum of the
    /// gap, so its motion has no effect to first order. `None` if the flank faces nothing next to it.
    pub fn error_by_gap(&self, touch: &Nearest) -> Option<f64> {
        let driven = self.options.driven();
        let base_radius = [self.pair.pinion.base_radius(), self.pair.wheel.base_radius()][driven];
        let turn = self.module() / TURN / base_radius;
        let at = |turn: f64| Self { rotation: self.rotation + turn, ..self.clone() }.gap_at(touch);
        let lever = (at(turn)? - at(-turn)?) / (2.0 * turn);
        Some(-self.options.side().sign() * base_radius / lever)
    }

    /// The contact moved to the height of smallest gap, which a golden-section search finds to the square root of the
    /// gap's round-off. `None` if the flanks touch at the end of the range in which they face each other, because that
    /// end moves with the gears.
    pub fn polished(&self, touch: &Nearest) -> Option<Nearest> {
        let (flanks, poses) = (self.patches(touch.tooth), self.poses());
        let gap = FlankGap::unseen(&flanks, &poses, self.module());
        let (z, half) = (touch.at[1], gap.half_width());
        if z.abs() == half {
            return Some(*touch);
        }
        let step = POLISH * half;
        let at = |z: f64| gap.at(z).filter(|_| z.abs() <= half).map(|(_, gap)| gap);
        let [below, here, above] = [at(z - step)?, at(z)?, at(z + step)?];
        let moved = 0.5 * step * (below - above) / (below - 2.0 * here + above);
        let is_least = below > here && above > here && moved.abs() < 0.5 * step;
        // Over a kink there is no parabola.
        let is_smooth = at(z + moved)? <= here + round_off_of_places(self.pair.centre_distance());
        (is_least && is_smooth).then(|| Nearest { at: [touch.at[0], z + moved], ..*touch })
    }

    /// Gap at the height at which another, similar pair touches, mm.
    pub fn gap_at(&self, touch: &Nearest) -> Option<f64> {
        let (flanks, poses) = (self.patches(touch.tooth), self.poses());
        FlankGap::unseen(&flanks, &poses, self.module()).at(touch.at[1]).map(|(_, gap)| gap)
    }

    /// A pair at a given rotation of its driven gear, whether or not its flanks touch.
    pub fn turned(pair: &'a GearPair, options: &'a ContactOptions, station: Station, rotation: f64) -> Self {
        Self { pair, options, station, rotation, touch: None }
    }

    /// Least gap of the pair of a running number at the poses of this one, mm.
    fn gap_of(&self, running: i64, poses: &[Pose; 2]) -> f64 {
        let [first, second] = self.flanks(running - self.station.middle_pair(self.options.sense));
        rigid_gap(self.pair, self.options, self.station, running, [&first, &second], poses)
    }

    /// Normal module, mm.
    fn module(&self) -> f64 {
        self.pair.pinion.data().normal_module
    }

    /// Gap up to which flanks touch, mm.
    fn touching(&self) -> f64 {
        self.module() / TOUCHING
    }

    /// Length of the contact line (mm) of the pair with a running number: the interval over which the gap is below a
    /// nanometre at a module of 3 mm, divided by cos b_b.
    pub fn line_length(&self, running: i64) -> f64 {
        let poses = self.poses();
        let flanks = self.patches(running - self.station.middle_pair(self.options.sense));
        let mut gap = FlankGap::new(&flanks, &poses, self.module());
        let Some((least, [_, z])) = gap.nearest_below(f64::INFINITY, false) else { return 0.0 };
        let touching = self.touching();
        if least > touching {
            return 0.0;
        }
        let touches = |z: f64| gap.at(z).map_or(f64::INFINITY, |g| g.1);
        let half = gap.half_width();
        let mut intervals = contact_intervals(touches, [-half, half], STATIONS, touching);
        if !intervals.iter().any(|i| (i[0]..=i[1]).contains(&z)) {
            // Touching between two stations only: from the place of least gap to the stations beside it.
            let step = 2.0 * half / (STATIONS - 1) as f64;
            let beside = [(z - step).max(-half), z, (z + step).min(half)];
            let left = contact_intervals(touches, [beside[0], z], 2, touching);
            let right = contact_intervals(touches, [z, beside[2]], 2, touching);
            intervals = left.into_iter().chain(right).collect();
        }
        covered(&intervals, [-half, half]) / self.pair.base_helix_angle().cos()
    }
}

/// A window that must be wider than the contact ratio requires, because of the load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForeseenWindow {
    /// Number of teeth of the window.
    pub teeth: usize,
    /// Running number of the pair that would touch next to a window with one tooth less.
    pub pair: i64,
}

/// Positions of the mesh cycle at which a window is foreseen.
const FORESEEN: usize = 8;

impl ForeseenWindow {
    /// The window with all pairs whose undeformed flanks overlap when the teeth have deflected by `deflection` (mm, on
    /// the base circle of the driven gear) from their nominal position, at several positions of the mesh cycle. `None`
    /// if the window of the contact ratio is sufficient, or if a gear has no more teeth.
    pub fn new(pair: &GearPair, options: &StaticOptions, deflection: f64) -> Option<Self> {
        let (teeth, contact) = ([pair.pinion.teeth(), pair.wheel.teeth()], &options.contact);
        let radius = [&pair.pinion, &pair.wheel][options.driven()].base_radius();
        let rotation = options.side().sign() * deflection / radius;
        let mut count = options.window_teeth(pair);
        let mut found = None;
        for i in 0..FORESEEN {
            let station = Station { cycle: 0, phase: i as f64 / FORESEEN as f64 };
            let bent = Unloaded::turned(pair, contact, station, rotation);
            let poses = bent.poses();
            loop {
                let window = match i {
                    0 => SlidingWindow::at_start(count, teeth, contact.sense),
                    _ => SlidingWindow::at(station, count, teeth, contact.sense),
                };
                let beside = window.ok()?.window().neighbours();
                let Some(pair) = beside.into_iter().find(|&running| bent.gap_of(running, &poses) < 0.0) else { break };
                count += 1;
                found = Some(Self { teeth: count, pair });
            }
        }
        found
    }
}

/// Least of some gaps, each of a tooth; they are looked into in the order of what was seen of them.
fn nearest_of(gaps: &mut [FlankGap<'_>], teeth: &[i64], first: bool) -> Option<Nearest> {
    let mut order: Vec<usize> = (0..teeth.len()).collect();
    order.sort_by(|&i, &j| gaps[i].lowest().total_cmp(&gaps[j].lowest()));
    let mut best: Option<Nearest> = None;
    for i in order {
        let enough = best.map_or(f64::INFINITY, |b| b.gap);
        let Some((gap, at)) = gaps[i].nearest_below(enough, first) else { continue };
        best = Some(Nearest { gap, at, tooth: teeth[i] });
    }
    best
}

/// Kinematic transmission error of an unloaded pair, mm: see [`crate::StaticPosition::kinematic_transmission_error`].
///
/// No mesh is needed. Zero for unmodified flanks on parallel axes.
///
/// # Errors
/// [`StaticError::Apart`] if no flanks face each other; [`StaticError::OutOfRange`] for offsets at which they cannot.
pub fn kinematic_transmission_error(
    pair: &GearPair,
    options: &ContactOptions,
    station: Station,
) -> Result<f64, StaticError> {
    check_offsets(pair, options)?;
    Ok(Unloaded::new(pair, options, station)?.transmission_error())
}
