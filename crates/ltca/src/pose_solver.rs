//! The contact of one pose while the driven gear looks for its place.

use std::collections::BTreeMap;

use contact::{
    Balance, ContactError, ContactRow, Friction, LinePoints, MeshContact, Pose, Slice, Solution, closest_points,
    complementarity,
};

use crate::Parts;

/// Forces by (pair of patches counted by running number, point): what a next solve starts from.
pub(crate) type Memory = BTreeMap<(usize, usize, usize), f64>;

/// The contact of one pose with the driven gear's turn as an unknown.
pub(crate) struct Touched {
    pub rows: Vec<ContactRow>,
    pub slices: Vec<Slice>,
    pub solution: Solution,
    pub displacements: [Vec<f64>; 2],
}

/// Who solves the contact of a pose.
pub(crate) enum Solver<'a> {
    /// Slices on reduced gears.
    Mesh(&'a mut MeshContact),
    /// Points, and gears with all their degrees of freedom: what was touched last is kept.
    General { line: LinePoints, memory: Memory, touched: Option<Box<Touched>> },
}

/// What a pose came to.
pub(crate) enum Step {
    /// Turn of the driven gear, rad, and iterations.
    Turn(f64, usize),
    /// No row that could carry the torque is within reach.
    OutOfReach,
    /// Rows beyond the reach could close: the farthest way of a row, mm.
    TooShort(f64),
}

impl Solver<'_> {
    pub fn step(&mut self, parts: &Parts, poses: &[Pose; 2], reach: f64) -> Result<Step, ContactError> {
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
                let rows: Vec<ContactRow> = match Friction::new(pair, &options.contact) {
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
                *touched = Some(Box::new(Touched { rows, slices, solution, displacements }));
                Ok(step)
            }
        }
    }

    pub fn touched(&mut self, poses: &[Pose; 2]) -> Option<Box<Touched>> {
        match self {
            Self::General { touched, .. } => touched.take(),
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
                Some(Box::new(Touched { rows, slices, solution, displacements: Default::default() }))
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
    let mut rows = closest_points(&set.scene(&options.contact, line), poses, reach);
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
        complementarity::solve(&mut *bodies, rows, driven, moment, options.contact.law, &start)?
    };
    let displacements = bodies.displacements(&solution.forces);
    Ok((solution, displacements))
}

pub(crate) fn remembered(rows: &[ContactRow], solution: &Solution) -> Memory {
    let active = solution.active.iter();
    active.map(|&i| ((rows[i].patches.0, rows[i].patches.1, rows[i].point), solution.forces[i])).collect()
}
