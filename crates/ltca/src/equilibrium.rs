//! Torque equilibrium at one station. Theory (20).

use ale::Station;
use contact::{ContactError, ContactRow, ContactSet, MeshContact, Pose, Slice, Solution, WarmStart, frames};
use geometry::GearPair;

use crate::{
    StaticError, WindowedPair,
    kinematic::Unloaded,
    pose_solver::{PoseSolution, PoseSolver, PoseStep},
};

/// Solved contact at one station.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    /// Where.
    pub station: Station,
    /// Poses of the matrices' frames of both gears.
    pub poses: [Pose; 2],
    /// Rotation of the driven gear from the unloaded position, rad, about +z.
    pub rotation: f64,
    /// The same without load: where the flanks just touch.
    pub unloaded_rotation: f64,
    /// Transmission error, mm; positive when the driven gear lags.
    pub transmission_error: f64,
    /// Transmission error without load, mm.
    pub kinematic_transmission_error: f64,
    /// Candidate points.
    pub rows: Vec<ContactRow>,
    /// The slice of each row; none where points touch.
    pub slices: Vec<Slice>,
    /// Forces and gaps at the rows.
    pub solution: Solution,
    /// Displacements of both gears' boundary coordinates, mm, in the matrices' frames. Empty for slices on reduced
    /// gears: [`Equilibrium::displacements_on`] computes them where they are needed.
    pub displacements: [Vec<f64>; 2],
    /// Active-set iterations over all pose steps.
    pub iterations: usize,
}

/// Mean line stiffness taken to guess the first approach, N/(mm mm); c' of ISO 6336 is about 14 N/(mm um).
pub(crate) const GUESSED_LINE_STIFFNESS: f64 = 1.4e4;
/// Pose steps before giving up.
const POSE_STEPS: usize = 80;
/// Steps of Newton's method alone; it wants less than ten.
const NEWTON_STEPS: usize = 15;
/// Last step of the pose relative to the approach.
const POSE_TOLERANCE: f64 = 1e-10;
/// Deflection over the module from which on the load parts the flanks: teeth are some two modules high.
const TOO_FAR: f64 = 0.25;
/// Estimated deflection of steel teeth over the module beyond which no search is begun.
const HOPELESS: f64 = 10.0;
/// Steps below this that no longer decrease are round-off of the gaps at kinks and edges.
const POSE_ROUND_OFF: f64 = 1e-9;

/// Frames of the matrices when the driven gear is turned by `rotation` from the unloaded position.
pub(crate) fn poses(windowed: &WindowedPair, station: Station, rotation: f64) -> [Pose; 2] {
    let WindowedPair { pair, set, window, options, .. } = *windowed;
    let mut turns = [0.0; 2];
    turns[options.driven()] = rotation;
    frames(pair, set, window, &options.contact, station, turns)
}

impl Equilibrium {
    /// Displacements of both gears' boundary coordinates, mm, in the frames of the matrices of `set`, the window that
    /// the equilibrium was found on.
    pub fn displacements_on(&self, set: &ContactSet) -> [Vec<f64>; 2] {
        if self.displacements.iter().all(Vec::is_empty)
            && let Some(found) = set.displacements_under(&self.rows, &self.solution.forces)
        {
            return found;
        }
        self.displacements.clone()
    }

    pub(crate) fn warm_start(&self) -> WarmStart {
        contact::warm_start(&self.rows, &self.solution)
    }

    /// Transmission error that is due to load, mm.
    pub fn elastic_error(&self) -> f64 {
        self.transmission_error - self.kinematic_transmission_error
    }

    /// Opening of the gaps at the rows' normal approach, largest, mm.
    pub fn approach(&self, pair: &GearPair) -> f64 {
        self.elastic_error().abs() * pair.base_helix_angle().cos()
    }
}

/// Rotations between which the equilibrium lies: more load than the contact carries turns the gear on, less back.
#[derive(Default)]
struct Between {
    below: Option<f64>,
    above: Option<f64>,
}

impl Between {
    /// Where to go from `from`, which Newton's method would leave by `turn`; the middle where steps go to and fro
    /// (`stays`), as they do over an edge at which a slice begins or ends to touch.
    fn next(&mut self, from: f64, turn: f64, stays: bool) -> f64 {
        if turn > 0.0 {
            self.below = Some(from)
        } else {
            self.above = Some(from)
        }
        match (self.below, self.above) {
            (Some(below), Some(above)) if stays && below < above => 0.5 * (below + above),
            _ => from + turn,
        }
    }
}

/// Turns the driven gear until contact balances its torque.
///
/// Newton's method on the pose. At each step the gaps are computed from the smooth flanks at the current pose, and the
/// contact problem with its one rotation is solved exactly. The levers are exact, so convergence is quadratic. `mesh`
/// solves the contact of slices on reduced gears.
pub(crate) fn equilibrium(
    windowed: &WindowedPair,
    mesh: Option<&mut MeshContact>,
    station: Station,
    guess: Option<&Equilibrium>,
) -> Result<Equilibrium, StaticError> {
    let WindowedPair { pair, set, options, .. } = *windowed;
    let fail = |source: ContactError| StaticError::Contact { cycle: station.cycle, phase: station.phase, source };
    let side = options.side();
    let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()][options.driven()];
    let unloaded = Unloaded::new(pair, &options.contact, station)?;
    let kinematic = unloaded.transmission_error();
    let mut solver = match mesh {
        Some(mesh) => PoseSolver::Mesh(mesh),
        None => PoseSolver::General {
            line: set.line_points(&options.contact, &poses(windowed, station, unloaded.rotation)),
            warm_start: guess.map(Equilibrium::warm_start).unwrap_or_default(),
            last: None,
        },
    };
    let force = options.torque / base_radius;
    // Start: the position where the flanks touch, turned by the deflection of the station before.
    let deflection = guess.map_or(0.0, |g| g.rotation - g.unloaded_rotation);
    let mut rotation = unloaded.rotation + deflection;
    let guessed = force / (GUESSED_LINE_STIFFNESS * pair.face_width());
    let module_mm = pair.pinion.data().normal_module;
    let overloaded = |deflection_mm: f64| {
        let Station { cycle, phase } = station;
        StaticError::Overloaded { cycle, phase, torque_nm: 1e-3 * options.torque, deflection_mm, module_mm }
    };
    // Beyond this the contact problem is lost in round-off.
    if guessed > HOPELESS * module_mm {
        return Err(overloaded(guessed));
    }
    // Facets lie up to their sagitta above the smooth flanks: search as far as the mesh may be off.
    let facets = if options.contact.gap == contact::GapSource::Facet { options.contact.surface_tolerance } else { 0.0 };
    let mut reach = facets + if guess.is_some() { 0.5 * guessed } else { 2.5 * guessed };
    let mut iterations = 0;
    let mut step_mm = f64::INFINITY;
    let mut between = Between::default();
    for tried in 0..POSE_STEPS {
        let poses = poses(windowed, station, rotation);
        let (turn, steps) = match solver.step(windowed, &poses, reach).map_err(fail)? {
            PoseStep::Turn(turn, steps) => (turn, steps),
            PoseStep::OutOfReach => {
                if reach > module_mm {
                    let turned = base_radius * (rotation - unloaded.rotation).abs();
                    let deflection_mm = turned.max(guessed);
                    if deflection_mm > TOO_FAR * module_mm {
                        return Err(overloaded(deflection_mm));
                    }
                    return Err(fail(ContactError::NoCandidates { reach_mm: reach }));
                }
                reach = 4.0 * reach.max(1e-9);
                continue;
            }
            PoseStep::ReachExceeded(farthest) => {
                reach = 1.5 * farthest;
                continue;
            }
        };
        iterations += steps;
        let before = step_mm;
        step_mm = (turn * base_radius).abs();
        let from = rotation;
        rotation = between.next(from, turn, tried > NEWTON_STEPS && step_mm > 0.5 * before);
        let error = side.sign() * base_radius * rotation;
        let elastic = (error - kinematic).abs();
        // An angle of a few radians resolves no smaller steps.
        let round_off = 16.0 * f64::EPSILON * pair.centre_distance();
        let stays = step_mm > 0.5 * before && step_mm.max(before) <= POSE_ROUND_OFF * elastic;
        if (step_mm <= (POSE_TOLERANCE * elastic).max(round_off) || stays)
            && let Some(found) = solver.take_solution(&poses)
        {
            let PoseSolution { rows, slices, solution, displacements } = *found;
            return Ok(Equilibrium {
                station,
                poses,
                rotation,
                unloaded_rotation: unloaded.rotation,
                transmission_error: error,
                kinematic_transmission_error: kinematic,
                rows,
                slices,
                solution,
                displacements,
                iterations,
            });
        }
        reach = facets + (0.25 * elastic).max(2.0 * step_mm);
    }
    Err(StaticError::NoEquilibrium { cycle: station.cycle, phase: station.phase, iterations: POSE_STEPS, step_mm })
}
