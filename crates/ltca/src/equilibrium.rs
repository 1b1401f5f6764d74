//! Torque equilibrium at one station. Theory (20).

use ale::Station;
use contact::{
    ContactError, ContactSet, Pose, SliceState, WarmStart,
    complementarity::Solution,
    nodal::ContactRow,
    pose::frames,
    slice::{MeshContact, Slice},
};
use geometry::GearPair;
use nalgebra::{Rotation3, Vector3};

use crate::{
    DeflectionCourse, StaticError, WindowedPair,
    kinematic::{Nearest, Unloaded},
    pose_solver::{NEIGHBOURS_CLOSE, PoseSolution, PoseSolver, PoseStep},
    pose_steps::PoseSteps,
};

/// Solved contact at one station.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    /// Station of the mesh cycle.
    pub station: Station,
    /// Poses of both gears, for the frames in which their compliance matrices are given.
    pub poses: [Pose; 2],
    /// Rotation of the driven gear from the unloaded position, rad, about +z.
    pub rotation: f64,
    /// Rotation of the driven gear without load, rad about +z, at which the flanks just touch.
    pub unloaded_rotation: f64,
    /// Place where the unloaded flanks touch; none where nominal flanks touch along lines.
    pub(crate) unloaded_touch: Option<Nearest>,
    /// Transmission error, mm; positive if the driven gear lags.
    pub transmission_error: f64,
    /// Transmission error without load, mm.
    pub kinematic_transmission_error: f64,
    /// Candidate points.
    pub rows: Vec<ContactRow>,
    /// The slice of each row; empty for contact of points.
    pub slices: Vec<Slice>,
    /// Local state of each slice.
    pub states: Vec<SliceState>,
    /// Forces and gaps at the rows.
    pub solution: Solution,
    /// Displacements of both gears' boundary coordinates, mm, in the frames of the matrices. Empty for slices on
    /// reduced gears: [`Equilibrium::displacements_on`] computes them on request.
    pub displacements: [Vec<f64>; 2],
    /// Error of the pose at the last step, relative to the approach.
    pub pose_residual: f64,
    /// Number of active-set iterations over all steps of the pose.
    pub iterations: usize,
    /// Rotation caused by the load here and at the preceding stations.
    pub course: DeflectionCourse,
}

/// Reach that a search which found nothing begins with, over the normal module.
const LEAST_REACH: f64 = 1e-9 / 3.0;
/// Mean line stiffness for the first guess of the approach, N/(mm mm); c' of ISO 6336 is about 14 N/(mm um).
pub const GUESSED_LINE_STIFFNESS: f64 = 1.4e4;
/// Pose steps before giving up.
const POSE_STEPS: usize = 80;
/// Deflection over the module from which on the load parts the flanks: teeth are some two modules high.
const TOO_FAR: f64 = 0.25;
/// Estimated deflection of steel teeth over the module beyond which no search is begun.
const HOPELESS: f64 = 10.0;

/// Frames of the matrices when the driven gear is turned by `rotation` from the unloaded position.
pub(crate) fn poses(windowed: &WindowedPair, station: Station, rotation: f64) -> [Pose; 2] {
    let WindowedPair { pair, set, window, options, .. } = *windowed;
    let mut turns = [0.0; 2];
    turns[options.driven()] = rotation;
    frames(pair, set, window, &options.contact, station, turns)
}

impl Equilibrium {
    /// Displacements of both gears' boundary coordinates, mm, in the frames of the matrices of `set`, the window on
    /// which the equilibrium was found.
    pub fn displacements_on(&self, set: &ContactSet) -> [Vec<f64>; 2] {
        if self.displacements.iter().all(Vec::is_empty) {
            let rows = set.supported_rows(&self.poses, &self.rows, &self.slices, &self.solution.forces);
            if let Some(found) = set.displacements_under(&rows, &self.solution.forces) {
                return found;
            }
        }
        self.displacements.clone()
    }

    /// Loads on both gears: for reduced gears the forces on the boundary coordinates of `set`, the window on which the
    /// equilibrium was found, N, in the frames of its matrices; for whole gears their displacements, mm.
    pub fn loads_on(&self, set: &ContactSet) -> [Vec<f64>; 2] {
        let rows = set.supported_rows(&self.poses, &self.rows, &self.slices, &self.solution.forces);
        set.forces_of(&rows, &self.solution.forces).unwrap_or_else(|| self.displacements.clone())
    }

    pub(crate) fn warm_start(&self) -> WarmStart {
        contact::warm_start(&self.rows, &self.solution)
    }

    /// Transmission error that is due to load, mm.
    pub(crate) fn elastic_error(&self) -> f64 {
        self.transmission_error - self.kinematic_transmission_error
    }

    /// Largest closing of a gap by the normal approach of the flanks, mm.
    pub fn approach(&self, pair: &GearPair) -> f64 {
        self.elastic_error().abs() * pair.base_helix_angle().cos()
    }
}

/// Turns the driven gear until contact balances its torque.
///
/// Newton's method on the pose. At each step the gaps are computed from the smooth flanks at the current pose, and the
/// contact problem with its one rotation is solved exactly. Compliance and levers are those of the pose, so that a step
/// is a small part of the one before: see [`PoseSteps`]. `mesh` solves the contact of slices on reduced gears.
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
        Some(mesh) => PoseSolver::Mesh { mesh, held: None, solved: 0 },
        None => PoseSolver::General {
            line: set.line_points(&options.contact, &poses(windowed, station, unloaded.rotation)),
            warm_start: guess.map(Equilibrium::warm_start).unwrap_or_default(),
            last: None,
        },
    };
    let force = options.base_force(pair);
    // Start: the position where the flanks touch, turned by the deflection of the stations before as it goes on.
    let deflection = guess.map_or(0.0, |g| g.course.at(station));
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
    let facets =
        if options.contact.gap == contact::flank::GapSource::Facet { options.contact.surface_tolerance } else { 0.0 };
    let of_guess = NEIGHBOURS_CLOSE * base_radius.abs() * deflection.abs();
    let mut reach = facets + if deflection == 0.0 { 2.5 * guessed } else { of_guess };
    let mut iterations = 0;
    let mut steps = PoseSteps::new(base_radius.abs(), pair.centre_distance());
    for _ in 0..POSE_STEPS {
        let poses = poses(windowed, station, rotation);
        let (turn, newton) = match solver.step(windowed, &poses, reach).map_err(fail)? {
            PoseStep::Turn(turn, newton) => (turn, newton),
            PoseStep::OutOfReach => {
                if reach > module_mm {
                    let turned = base_radius.abs() * (rotation - unloaded.rotation).abs();
                    let deflection_mm = turned.max(guessed);
                    if deflection_mm > TOO_FAR * module_mm {
                        return Err(overloaded(deflection_mm));
                    }
                    return Err(fail(ContactError::NoCandidates { reach_mm: reach }));
                }
                reach = 4.0 * reach.max(LEAST_REACH * module_mm);
                continue;
            }
            PoseStep::ReachExceeded(farthest) => {
                reach = 1.5 * farthest;
                continue;
            }
        };
        iterations += newton;
        let of_rows = rotation;
        rotation = steps.next(rotation, turn);
        let elastic_mm = base_radius.abs() * (rotation - unloaded.rotation).abs();
        if steps.is_last(elastic_mm, solver.tells_forces())
            && let Some(found) = solver.take_solution(options.moment(pair), steps.share_left())
        {
            rotation += steps.remainder();
            let error = side.sign() * base_radius * rotation;
            let course = guess.map(|g| g.course.clone()).unwrap_or_default();
            let PoseSolution { mut rows, slices, states, solution, displacements } = *found;
            // Poses and gaps as they are after the last step, which no search follows any more.
            let poses = self::poses(windowed, station, rotation);
            let driven = options.driven();
            // Forces keep their direction in space: in the frame of the gear that went on they turn back.
            let back = Rotation3::from_axis_angle(&Vector3::z_axis(), of_rows - rotation);
            for row in &mut rows {
                row.gap += row.levers[driven] * solution.rotation;
                let support = &mut row.supports[driven];
                (support.direction, support.load) = (back * support.direction, back * support.load);
            }
            return Ok(Equilibrium {
                station,
                poses,
                rotation,
                unloaded_rotation: unloaded.rotation,
                unloaded_touch: unloaded.touch,
                transmission_error: error,
                kinematic_transmission_error: kinematic,
                rows,
                slices,
                states,
                solution,
                displacements,
                pose_residual: steps.left_mm() / elastic_mm.max(f64::MIN_POSITIVE),
                iterations,
                course: course.and(station, rotation - unloaded.rotation),
            });
        }
        reach = facets + NEIGHBOURS_CLOSE * elastic_mm.max(steps.step_mm());
    }
    let Station { cycle, phase } = station;
    Err(StaticError::NoEquilibrium { cycle, phase, iterations: POSE_STEPS, step_mm: steps.step_mm() })
}
