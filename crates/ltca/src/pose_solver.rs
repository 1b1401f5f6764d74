//! The contact problem of one pose, solved for forces and the turn of the driven gear.

use contact::{
    Balance, CandidateRows, ContactError, ContactRow, ElasticContact, LinePoints, MeshContact, Pose, Slice, Solution,
    WarmStart,
};

use crate::WindowedPair;

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
        let WindowedPair { pair, gears, set, options, .. } = *windowed;
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
                let contact = ElasticContact { pair, gears, set, options: &options.contact };
                let candidates = contact.rows(line, poses, reach);
                if !carries(&candidates.rows) {
                    return Ok(PoseStep::OutOfReach);
                }
                let (solution, displacements) =
                    contact.solve(&candidates, Balance::Moment(moment), driven, warm_start)?;
                let CandidateRows { rows, slices } = candidates;
                if let Some(short) = short(&rows, solution.rotation) {
                    return Ok(short);
                }
                *warm_start = contact::warm_start(&rows, &solution);
                let step = PoseStep::Turn(solution.rotation, solution.iterations);
                *last = Some(Box::new(PoseSolution { rows, slices, solution, displacements }));
                Ok(step)
            }
        }
    }

    pub fn take_solution(&mut self) -> Option<Box<PoseSolution>> {
        match self {
            Self::General { last, .. } => last.take(),
            Self::Mesh(mesh) => {
                let rows = mesh.rows().to_vec();
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
