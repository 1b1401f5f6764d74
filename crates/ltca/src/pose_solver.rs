//! The contact problem at one pose, solved for forces and the rotation of the driven gear.

use contact::{
    CandidateRows, ContactError, ElasticContact, Pose, SliceState, WarmStart,
    complementarity::{Balance, Solution},
    nodal::{ContactRow, LinePoints},
    slice::{MeshContact, Slice},
};

use crate::WindowedPair;

/// Contact at one pose.
pub(crate) struct PoseSolution {
    pub rows: Vec<ContactRow>,
    pub slices: Vec<Slice>,
    pub states: Vec<SliceState>,
    pub solution: Solution,
    pub displacements: [Vec<f64>; 2],
}

/// Gap over the approach up to which rows are candidates: what loads on other teeth may close.
pub(crate) const NEIGHBOURS_CLOSE: f64 = 0.25;
/// Violation of the conditions, relative to the approach, with which the contact of a station's first pose is solved: the
/// next pose makes up for it.
const FIRST_POSE: f64 = 1e-8;

/// Rows that were found at an earlier pose and serve near it.
pub(crate) struct HeldRows {
    /// Largest gap of a row there, mm.
    reach: f64,
    /// Turn of the driven gear since, the one of the last step included, rad.
    turned: f64,
    /// Forces (N) and openings (mm) of the step before the last; none before there is one.
    before: [Vec<f64>; 2],
}

/// How the contact of a pose is solved.
pub(crate) enum PoseSolver<'a> {
    /// Slices on reduced gears; `solved`: how many poses of the station.
    Mesh { mesh: &'a mut MeshContact, held: Option<HeldRows>, solved: usize },
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
        let moment = options.moment(pair);
        let carries = |rows: &[ContactRow]| rows.iter().any(|r| r.levers[driven] * moment > 0.0);
        let farthest =
            |rows: &[ContactRow], turn: f64| rows.iter().fold(0.0f64, |m, r| m.max((r.levers[driven] * turn).abs()));
        // Every row that the step can close must be among the rows.
        let short = |farthest: f64, reach: f64| 1.05 * farthest > reach;
        match self {
            Self::Mesh { mesh, held, solved } => {
                // Loads on other teeth close some gaps as well.
                let enough = |rows: &HeldRows, mesh: &MeshContact| {
                    !short((1.0 + NEIGHBOURS_CLOSE) * farthest(mesh.rows(), rows.turned), rows.reach)
                };
                if let Some(rows) = held {
                    let solver = mesh.solver();
                    for (before, now) in rows.before.iter_mut().zip([solver.forces(), solver.openings()]) {
                        before.clear();
                        before.extend(now);
                    }
                }
                if let Some(rows) = held
                    && enough(rows, mesh)
                    && mesh.solve_moved(poses, Balance::Moment(moment), driven)
                {
                    let turn = mesh.solver().rotation();
                    rows.turned += turn;
                    if enough(rows, mesh) {
                        *solved += 1;
                        return Ok(PoseStep::Turn(turn, mesh.solver().iterations()));
                    }
                }
                *held = None;
                mesh.prepare(poses, Some(reach));
                if !carries(mesh.rows()) {
                    return Ok(PoseStep::OutOfReach);
                }
                mesh.solve_to(if *solved == 0 { FIRST_POSE } else { 0.0 }, Balance::Moment(moment), driven)?;
                let (turn, iterations) = (mesh.solver().rotation(), mesh.solver().iterations());
                let moved = farthest(mesh.rows(), turn);
                if short(moved, reach) {
                    return Ok(PoseStep::ReachExceeded(moved));
                }
                *solved += 1;
                *held = Some(HeldRows { reach, turned: turn, before: Default::default() });
                Ok(PoseStep::Turn(turn, iterations))
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
                let moved = farthest(&rows, solution.rotation);
                if short(moved, reach) {
                    return Ok(PoseStep::ReachExceeded(moved));
                }
                *warm_start = contact::warm_start(&rows, &solution);
                let step = PoseStep::Turn(solution.rotation, solution.iterations);
                let of_row = |(slice, &f): (&Slice, &f64)| SliceState::new(&slice.local.law(), slice.length, f);
                let states = slices.iter().zip(&solution.forces).map(of_row).collect();
                *last = Some(Box::new(PoseSolution { rows, slices, states, solution, displacements }));
                Ok(step)
            }
        }
    }

    /// Whether the forces of the last two poses can be extrapolated.
    pub fn tells_forces(&self) -> bool {
        matches!(self, Self::Mesh { held: Some(rows), .. } if !rows.before[0].is_empty())
    }

    /// The last solution under a moment (N mm). `left` is the remaining change of the pose relative to that of the last
    /// step. Forces are smooth functions of the pose and are extrapolated with it.
    pub fn take_solution(&mut self, moment: f64, left: f64) -> Option<Box<PoseSolution>> {
        let moved = self.tells_forces();
        match self {
            Self::General { last, .. } => last.take(),
            // The contact of the first pose is not solved to the last digits.
            Self::Mesh { solved: ..2, .. } => None,
            Self::Mesh { mesh, held, .. } => {
                if moved {
                    mesh.refine_stiffness(Balance::Moment(moment));
                }
                let solver = mesh.solver();
                let before = held.as_ref().map_or([&[][..]; 2], |rows| rows.before.each_ref().map(|list| &list[..]));
                let goes_on = |now: &[f64], before: &[f64]| {
                    let mut all = now.to_vec();
                    all.iter_mut().zip(before).for_each(|(now, before)| *now += left * (*now - before));
                    all
                };
                let forces = goes_on(solver.forces(), before[0]);
                let openings = goes_on(solver.openings(), before[1]);
                let states = mesh.states(&forces).collect();
                let solution = Solution {
                    forces,
                    active: solver.active().to_vec(),
                    rotation: solver.rotation(),
                    openings,
                    stiffness: solver.stiffness(),
                    iterations: solver.iterations(),
                    residual: solver.residual(),
                };
                let (rows, slices) = mesh.take_rows();
                Some(Box::new(PoseSolution { rows, slices, states, solution, displacements: Default::default() }))
            }
        }
    }
}
