//! The contact problem of one pose, solved for forces and the turn of the driven gear.

use std::collections::BTreeMap;

use contact::{
    Balance, ContactError, ContactRow, Friction, LinePoints, MeshContact, Pose, Slice, Solution, closest_points,
    complementarity,
};

use crate::WindowedPair;

/// Forces by (patches, point), from which the next solution starts.
pub(crate) type WarmStart = BTreeMap<(usize, usize, usize), f64>;

/// Contact at one pose.
pub(crate) struct PoseSolution {
    pub rows: Vec<ContactRow>,
    pub slices: Vec<Slice>,
    pub solution: Solution,
    pub displacements: [Vec<f64>; 2],
}

/// How the contact of a pose is solved.
pub(crate) enum PoseSolver<'a> {
    /// Slices on reduced gears.
    Mesh(&'a mut MeshContact),
    /// Points, and gears with all their degrees of freedom; the last solution is kept.
    General { line: LinePoints, warm_start: WarmStart, last: Option<Box<PoseSolution>> },
}

/// Result of one pose.
pub(crate) enum PoseStep {
    /// Turn of the driven gear, rad, and iterations.
    Turn(f64, usize),
    /// No row that could carry the torque is within reach.
    OutOfReach,
    /// Rows beyond the search distance could close: the farthest approach of a row, mm.
    ReachExceeded(f64),
}

impl PoseSolver<'_> {
    pub fn step(&mut self, windowed: &WindowedPair, poses: &[Pose; 2], reach: f64) -> Result<PoseStep, ContactError> {
        let WindowedPair { pair, options, .. } = *windowed;
        let driven = options.driven();
        let moment = -options.side().sign() * options.torque;
        let carries = |rows: &[ContactRow]| rows.iter().any(|r| r.levers[driven] * moment > 0.0);
        let short = |rows: &[ContactRow], turn: f64| {
            // Every row that the step can close must be among the rows.
            let farthest = rows.iter().fold(0.0f64, |m, r| m.max((r.levers[driven] * turn).abs()));
            (1.05 * farthest > reach).then_some(PoseStep::ReachExceeded(farthest))
        };
        match self {
            Self::Mesh(mesh) => {
                mesh.prepare(poses, Some(reach));
                if !carries(mesh.rows()) {
                    return Ok(PoseStep::OutOfReach);
                }
                mesh.solve(Balance::Moment(moment), driven)?;
                let (turn, iterations) = (mesh.solver().rotation(), mesh.solver().iterations());
                Ok(short(mesh.rows(), turn).unwrap_or(PoseStep::Turn(turn, iterations)))
            }
            Self::General { line, warm_start, last } => {
                let (rows, slices) = candidates(windowed, line, poses, reach);
                let rows: Vec<ContactRow> = match Friction::new(pair, &options.contact) {
                    Some(friction) => rows.into_iter().map(|row| friction.on(poses, row)).collect(),
                    None => rows,
                };
                if !carries(&rows) {
                    return Ok(PoseStep::OutOfReach);
                }
                let (solution, displacements) = general(windowed, &rows, &slices, moment, warm_start)?;
                if let Some(short) = short(&rows, solution.rotation) {
                    return Ok(short);
                }
                *warm_start = warm_start_of(&rows, &solution);
                let step = PoseStep::Turn(solution.rotation, solution.iterations);
                *last = Some(Box::new(PoseSolution { rows, slices, solution, displacements }));
                Ok(step)
            }
        }
    }

    pub fn take_solution(&mut self, poses: &[Pose; 2]) -> Option<Box<PoseSolution>> {
        match self {
            Self::General { last, .. } => last.take(),
            Self::Mesh(mesh) => {
                let rows = mesh.supported_rows(poses);
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
                let slices = mesh.slices().to_vec();
                Some(Box::new(PoseSolution { rows, slices, solution, displacements: Default::default() }))
            }
        }
    }
}

/// Rows within `reach` (mm), and their slices.
fn candidates(
    windowed: &WindowedPair,
    line: &LinePoints,
    poses: &[Pose; 2],
    reach: f64,
) -> (Vec<ContactRow>, Vec<Slice>) {
    let WindowedPair { set, options, .. } = *windowed;
    if let Some(slices) = set.slices() {
        return slices.rows([&set.patches()[0], &set.patches()[1]], &set.pairs(), poses, reach);
    }
    let mut rows = closest_points(&set.scene(&options.contact, line), poses, reach);
    rows.retain(|r| set.partners(r.patches));
    (rows, Vec::new())
}

/// Solution on any elastic model, and the displacements of its boundary coordinates.
fn general(
    windowed: &WindowedPair,
    rows: &[ContactRow],
    slices: &[Slice],
    moment: f64,
    warm_start: &WarmStart,
) -> Result<(Solution, [Vec<f64>; 2]), ContactError> {
    let WindowedPair { gears, set, options, .. } = *windowed;
    let driven = options.driven();
    let start: Vec<f64> =
        rows.iter().map(|r| warm_start.get(&(r.patches.0, r.patches.1, r.point)).copied().unwrap_or(0.0)).collect();
    let mut bodies = set.bodies(gears, rows)?;
    let solution = if set.slices().is_some() {
        let local = |i: usize, force: f64| {
            let state = slices[i].local.under(force / slices[i].length);
            (state.approach, state.slope / slices[i].length)
        };
        complementarity::solve_slices(&mut *bodies, rows, driven, moment, local, &start)?
    } else {
        complementarity::solve(&mut *bodies, rows, driven, moment, options.contact.law, &start)?
    };
    let displacements = bodies.displacements(&solution.forces);
    Ok((solution, displacements))
}

pub(crate) fn warm_start_of(rows: &[ContactRow], solution: &Solution) -> WarmStart {
    let active = solution.active.iter();
    active.map(|&i| ((rows[i].patches.0, rows[i].patches.1, rows[i].point), solution.forces[i])).collect()
}
