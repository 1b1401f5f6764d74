//! Steps of the pose towards equilibrium, and the criterion for the last step.

/// Steps of Newton's method alone; it wants less than ten.
const NEWTON_STEPS: usize = 15;
/// Last step relative to the approach.
const TOLERANCE: f64 = 1e-10;
/// Sum of the steps that are not taken any more, relative to the approach: two steps tell it to a hundredth. Forces that
/// do not go on with the pose lack ten times as much, the ends of contact lines a hundred times.
const REMAINDER: f64 = 5e-10;
const REMAINDER_OF_FORCES: f64 = 1e-12;
/// Ratio of steps that follow each other below which they are a geometric series.
const GEOMETRIC: f64 = 0.05;
/// Steps below this that no longer decrease are round-off of the gaps at kinks and edges.
const ROUND_OFF: f64 = 1e-9;

/// Jump of the equilibrium, relative to the approach, that a pose may lie in: where the place of a slice goes over from
/// one part of a profile to another with the same gap and another curvature, its force jumps, and no pose balances the
/// load any better. The tables of the compliance are off by half as much.
const JUMP: f64 = 2e-3;

/// Smallest step (mm) that the flanks of gears at this centre distance (mm) resolve.
pub fn round_off_of_places(centre_distance: f64) -> f64 {
    // An angle of a few radians resolves no smaller steps.
    16.0 * f64::EPSILON * centre_distance.abs()
}

/// Steps of a rotation.
///
/// Compliance and levers move with the pose, and the tangent leaves that out: each step is some 3e-4 of the one before,
///
/// ```text
/// t_k = r t_(k-1),   t_(k+1) + t_(k+2) + ... = t_k r / (1 - r)
/// ```
/// so that two steps tell where the others lead (Aitken). The forces go the same way: they change from pose to pose as
/// the steps before these poses.
pub(crate) struct PoseSteps {
    radius: f64,
    /// Round-off of places, mm.
    round_off: f64,
    taken: usize,
    /// The last step and the one before, rad; none where the middle was taken in place of a step.
    turns: [Option<f64>; 2],
    step_mm: f64,
    before_mm: f64,
    /// Rotations between which the equilibrium lies: more load than the contact carries turns the gear on, less back.
    below: Option<f64>,
    above: Option<f64>,
}

impl PoseSteps {
    /// Start without a step, for a gear with a base radius (mm) in a pair with a centre distance (mm).
    pub fn new(radius: f64, centre_distance: f64) -> Self {
        let round_off = round_off_of_places(centre_distance);
        let (turns, step_mm, before_mm) = ([None; 2], f64::INFINITY, f64::INFINITY);
        Self { radius, round_off, taken: 0, turns, step_mm, before_mm, below: None, above: None }
    }

    /// Next pose after `from`, from which Newton's method would go by `turn`. It is the middle if steps alternate, as
    /// they do at an edge at which a slice enters or leaves contact.
    pub fn next(&mut self, from: f64, turn: f64) -> f64 {
        (self.before_mm, self.step_mm) = (self.step_mm, (turn * self.radius).abs());
        self.taken += 1;
        if turn > 0.0 {
            self.below = Some(from)
        } else {
            self.above = Some(from)
        }
        let (newton, late) = (from + turn, self.taken > NEWTON_STEPS);
        let stays = |below: f64, above: f64| self.step_mm > 0.5 * self.before_mm || newton <= below || newton >= above;
        let (next, newton) = match (self.below, self.above) {
            (Some(below), Some(above)) if late && below < above && stays(below, above) => {
                (0.5 * (below + above), false)
            }
            _ => (newton, true),
        };
        self.turns = [newton.then_some(turn), self.turns[0]];
        next
    }

    /// The last step, mm.
    pub fn step_mm(&self) -> f64 {
        self.step_mm
    }

    /// Sum of the expected steps after the last one, rad; 0 if the steps do not form a series.
    pub fn remainder(&self) -> f64 {
        self.series().unwrap_or(0.0)
    }

    /// Remaining change of the pose, relative to the change before the last solution; 0 if the steps do not form a
    /// series.
    pub fn share_left(&self) -> f64 {
        let before = self.turns[1].unwrap_or(f64::INFINITY);
        self.series().map_or(0.0, |rest| (rest + self.turns[0].unwrap_or(0.0)) / before)
    }

    fn series(&self) -> Option<f64> {
        let [Some(now), Some(before)] = self.turns else { return None };
        let ratio = now / before;
        (ratio.abs() < GEOMETRIC).then(|| now * ratio / (1.0 - ratio))
    }

    /// Whether no further step is needed, for an approach (mm) of this size. `forces` tells whether these can be
    /// extrapolated with the pose.
    pub fn is_last(&self, approach: f64, forces: bool) -> bool {
        let remainder = if forces { REMAINDER } else { REMAINDER_OF_FORCES };
        let stays = self.step_mm > 0.5 * self.before_mm && self.step_mm.max(self.before_mm) <= ROUND_OFF * approach;
        let told = self.series().is_some_and(|rest| (rest * self.radius).abs() <= remainder * approach);
        let jumps = self.is_between_bits() && self.step_mm <= JUMP * approach;
        stays || told || jumps || self.step_mm <= (TOLERANCE * approach).max(self.round_off)
    }

    /// Whether the equilibrium lies between two poses that no digits lie between.
    fn is_between_bits(&self) -> bool {
        let (Some(below), Some(above)) = (self.below, self.above) else { return false };
        (above - below).abs() * self.radius <= self.round_off
    }

    /// Estimated error of the pose beyond the round-off of positions, mm, from the last steps.
    pub fn left_mm(&self) -> f64 {
        let left = self.series().map_or(self.step_mm, |rest| (rest * self.radius).abs());
        (left - self.round_off).max(0.0)
    }
}
