//! Torque equilibrium at one station.

use std::collections::BTreeMap;

use contact::{Balance, ContactError, ContactRow, LinePoints, Pose, Slice, Solution, closest_points, complementarity};
use geometry::GearPair;

use crate::{MeshContact, StaticError, StaticOptions, friction::Friction, kinematic::Unloaded, parts::Parts, pose};

/// Where the pair stands: whole mesh cycles beside a phase in [0, 1), so that a million turns lose no digits.
///
/// At phase s the pair in the middle of the cycle stands, at mid-face, (s - 1/2) base pitches past the middle of the path of
/// contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Mesh cycles since the start, in the sense of rotation.
    pub cycle: i64,
    /// Phase of the cycle, 0 .. 1.
    pub phase: f64,
}

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
    /// Displacements of both gears' boundary coordinates, mm, in the matrices' frames; empty for slices on reduced gears, where nothing
    /// needs them: [`crate::ContactSet::displacements`] has them then.
    pub displacements: [Vec<f64>; 2],
    /// Active-set iterations over all pose steps.
    pub iterations: usize,
}

/// Mean line stiffness taken to guess the first approach, N/(mm mm); c' of ISO 6336 is about 14 N/(mm um).
const GUESSED_LINE_STIFFNESS: f64 = 1.4e4;
/// Pose steps before giving up.
const POSE_STEPS: usize = 40;
/// Last step of the pose relative to the approach.
const POSE_TOLERANCE: f64 = 1e-10;

impl Station {
    /// Angle of the pinion that pair numbers count from in this cycle, rad: sign (s - 1/2) 2 pi / z1 from the middle.
    pub(crate) fn pinion_angle(&self, pair: &GearPair, options: &StaticOptions) -> f64 {
        let middle = pair.middle_angle(options.side());
        middle + options.sense.sign() as f64 * (self.phase - 0.5) * pair.pinion.pitch_angle()
    }

    /// Running number of the pair in the middle of this cycle.
    pub(crate) fn middle_pair(&self, options: &StaticOptions) -> i64 {
        -options.sense.sign() * self.cycle
    }

    /// Running number, in fractions, of the place midway between the pairs.
    pub(crate) fn centre(&self, options: &StaticOptions) -> f64 {
        let sign = options.sense.sign() as f64;
        self.middle_pair(options) as f64 - sign * (self.phase - 0.5)
    }
}

/// Frames of the matrices when the driven gear is turned by `rotation` from the unloaded position.
pub(crate) fn poses(parts: &Parts, station: Station, rotation: f64) -> [Pose; 2] {
    let Parts { pair, set, window, options, .. } = *parts;
    let theta1 = station.pinion_angle(pair, options);
    let mut angles = [theta1, pose::reference_angle(pair, options, theta1)];
    angles[options.driven()] += rotation;
    // Teeth counted from the middle pair of the cycle stand at these angles; the matrices count from their first tooth.
    let first_pair = window.first() - station.middle_pair(options);
    let last_pair = first_pair + window.count() as i64 - 1;
    let [f1, f2] = set.first_teeth();
    let turn = [
        (first_pair - i64::from(f1)).rem_euclid(i64::from(pair.pinion.teeth())) as f64 * pair.pinion.pitch_angle(),
        (-last_pair - i64::from(f2)).rem_euclid(i64::from(pair.wheel.teeth())) as f64 * pair.wheel.pitch_angle(),
    ];
    [0, 1].map(|i| pose::pose(pair, options, i, angles[i] + turn[i]))
}

/// Forces by (pair of patches counted by running number, point): what a next solve starts from.
pub(crate) type Memory = BTreeMap<(usize, usize, usize), f64>;

impl Equilibrium {
    pub(crate) fn memory(&self) -> Memory {
        remembered(&self.rows, &self.solution)
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

/// The contact of one pose with the driven gear's turn as an unknown.
struct Touched {
    rows: Vec<ContactRow>,
    slices: Vec<Slice>,
    solution: Solution,
    displacements: [Vec<f64>; 2],
}

/// Who solves the contact of a pose.
enum Solver<'a> {
    /// Slices on reduced gears.
    Mesh(&'a mut MeshContact),
    /// Points, and gears with all their degrees of freedom: what was touched last is kept.
    General { line: LinePoints, memory: Memory, touched: Option<Touched> },
}

/// What a pose came to.
enum Step {
    /// Turn of the driven gear, rad, and iterations.
    Turn(f64, usize),
    /// No row that could carry the torque is within reach.
    OutOfReach,
    /// Rows beyond the reach could close: the farthest way of a row, mm.
    TooShort(f64),
}

impl Solver<'_> {
    fn step(&mut self, parts: &Parts, poses: &[Pose; 2], reach: f64) -> Result<Step, ContactError> {
        let Parts { pair, options, .. } = *parts;
        let driven = options.driven();
        let moment = -options.side().sign() * options.torque;
        let carries = |rows: &[ContactRow]| rows.iter().any(|r| r.levers[driven] * moment > 0.0);
        let short = |rows: &[ContactRow], turn: f64| {
            // A row that the step can close must have been among the rows.
            let farthest = rows.iter().fold(0.0f64, |m, r| m.max((r.levers[driven] * turn).abs()));
            (1.05 * farthest > reach).then_some(Step::TooShort(farthest))
        };
        match self {
            Self::Mesh(mesh) => {
                mesh.prepare(poses, Some(reach));
                if !carries(mesh.rows()) {
                    return Ok(Step::OutOfReach);
                }
                mesh.solve(Balance::Moment(moment), driven)?;
                let (turn, iterations) = (mesh.solver().rotation(), mesh.solver().iterations());
                Ok(short(mesh.rows(), turn).unwrap_or(Step::Turn(turn, iterations)))
            }
            Self::General { line, memory, touched } => {
                let (rows, slices) = candidates(parts, line, poses, reach);
                let rows: Vec<ContactRow> = match Friction::new(pair, options) {
                    Some(friction) => rows.into_iter().map(|row| friction.on(poses, row)).collect(),
                    None => rows,
                };
                if !carries(&rows) {
                    return Ok(Step::OutOfReach);
                }
                let (solution, displacements) = general(parts, &rows, &slices, moment, memory)?;
                if let Some(short) = short(&rows, solution.rotation) {
                    return Ok(short);
                }
                *memory = remembered(&rows, &solution);
                let step = Step::Turn(solution.rotation, solution.iterations);
                *touched = Some(Touched { rows, slices, solution, displacements });
                Ok(step)
            }
        }
    }

    fn touched(&mut self) -> Option<Touched> {
        match self {
            Self::General { touched, .. } => touched.take(),
            Self::Mesh(mesh) => {
                let solver = mesh.solver();
                let solution = Solution {
                    forces: solver.forces().to_vec(),
                    active: solver.active().to_vec(),
                    rotation: solver.rotation(),
                    openings: solver.openings().to_vec(),
                    stiffness: solver.stiffness(),
                    iterations: solver.iterations(),
                    residual: solver.residual(),
                };
                let (rows, slices) = (mesh.rows().to_vec(), mesh.slices().to_vec());
                Some(Touched { rows, slices, solution, displacements: Default::default() })
            }
        }
    }
}

/// Rows within `reach` (mm), and their slices.
fn candidates(parts: &Parts, line: &LinePoints, poses: &[Pose; 2], reach: f64) -> (Vec<ContactRow>, Vec<Slice>) {
    let Parts { set, options, .. } = *parts;
    if let Some(slices) = set.slices() {
        return slices.rows([&set.patches()[0], &set.patches()[1]], &set.pairs(), poses, reach);
    }
    let mut rows = closest_points(&set.scene(options, line), poses, reach);
    rows.retain(|r| set.partners(r.patches));
    (rows, Vec::new())
}

/// Solution on any elastic model, and the displacements of its boundary coordinates.
fn general(
    parts: &Parts,
    rows: &[ContactRow],
    slices: &[Slice],
    moment: f64,
    memory: &Memory,
) -> Result<(Solution, [Vec<f64>; 2]), ContactError> {
    let Parts { gears, set, options, .. } = *parts;
    let driven = options.driven();
    let start: Vec<f64> =
        rows.iter().map(|r| memory.get(&(r.patches.0, r.patches.1, r.point)).copied().unwrap_or(0.0)).collect();
    let mut bodies = set.bodies(gears, rows)?;
    let solution = if set.slices().is_some() {
        let local = |i: usize, force: f64| {
            let state = slices[i].local.under(force / slices[i].length);
            (state.approach, state.slope / slices[i].length)
        };
        complementarity::solve_slices(&mut *bodies, rows, driven, moment, local, &start)?
    } else {
        complementarity::solve(&mut *bodies, rows, driven, moment, options.law, &start)?
    };
    let displacements = bodies.displacements(&solution.forces);
    Ok((solution, displacements))
}

fn remembered(rows: &[ContactRow], solution: &Solution) -> Memory {
    let active = solution.active.iter();
    active.map(|&i| ((rows[i].patches.0, rows[i].patches.1, rows[i].point), solution.forces[i])).collect()
}

/// Turns the driven gear until contact balances its torque.
///
/// Newton on the pose: at each step the gaps are taken anew from the smooth flanks where the gears then stand, and the
/// contact problem with its one rotation is solved exactly; the step falls quadratically, since the levers are exact. `mesh` solves it
/// where contact is made of slices on reduced gears.
pub(crate) fn equilibrium(
    parts: &Parts,
    mesh: Option<&mut MeshContact>,
    station: Station,
    guess: Option<&Equilibrium>,
) -> Result<Equilibrium, StaticError> {
    let Parts { pair, set, options, .. } = *parts;
    let fail = |source: ContactError| StaticError::Contact { cycle: station.cycle, phase: station.phase, source };
    let side = options.side();
    let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()][options.driven()];
    let unloaded = Unloaded::new(pair, options, station)?;
    let kinematic = unloaded.transmission_error();
    let mut solver = match mesh {
        Some(mesh) => Solver::Mesh(mesh),
        None => Solver::General {
            line: set.line_points(options, &poses(parts, station, unloaded.rotation)),
            memory: guess.map(Equilibrium::memory).unwrap_or_default(),
            touched: None,
        },
    };
    let force = options.torque / base_radius;
    // From the flanks' touch on by the deflection of the station before.
    let deflection = guess.map_or(0.0, |g| g.rotation - g.unloaded_rotation);
    let mut rotation = unloaded.rotation + deflection;
    let guessed = force / (GUESSED_LINE_STIFFNESS * pair.face_width());
    // Facets stand up to their sagitta above the smooth flanks: look as far as the mesh may be off.
    let facets = if options.gap == contact::GapSource::Facet { options.surface_tolerance } else { 0.0 };
    let mut reach = facets + if guess.is_some() { 0.5 * guessed } else { 2.5 * guessed };
    let mut iterations = 0;
    let mut step_mm = f64::INFINITY;
    for _ in 0..POSE_STEPS {
        let poses = poses(parts, station, rotation);
        let (turn, steps) = match solver.step(parts, &poses, reach).map_err(fail)? {
            Step::Turn(turn, steps) => (turn, steps),
            Step::OutOfReach => {
                if reach > pair.pinion.data().normal_module {
                    return Err(fail(ContactError::NoCandidates { reach_mm: reach }));
                }
                reach = 4.0 * reach.max(1e-9);
                continue;
            }
            Step::TooShort(farthest) => {
                reach = 1.5 * farthest;
                continue;
            }
        };
        iterations += steps;
        rotation += turn;
        step_mm = (turn * base_radius).abs();
        let error = side.sign() * base_radius * rotation;
        let elastic = (error - kinematic).abs();
        // An angle of a few radians resolves no smaller steps.
        let round_off = 16.0 * f64::EPSILON * pair.centre_distance();
        if step_mm <= (POSE_TOLERANCE * elastic).max(round_off)
            && let Some(Touched { rows, slices, solution, displacements }) = solver.touched()
        {
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
