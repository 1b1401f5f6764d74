//! Contact of a window with any elastic model: points or slices, gears reduced or with all their degrees of freedom.

use std::collections::BTreeMap;

use geometry::GearPair;
use nalgebra::SMatrix;
use reduction::ElasticGear;

use crate::{
    ContactError, ContactOptions, ContactSet, Friction, MeshForce, Pose,
    complementarity::{self, Balance, LAST_COMPLIANCE, Law, Problem, Solution},
    nodal::{ContactRow, LinePoints, closest_points},
    opening_by_motion,
    slice::Slice,
    wrenches,
};

/// Forces by (patch of body 1, patch of body 2, point), used as start of a solution.
pub type WarmStart = BTreeMap<(usize, usize, usize), f64>;

/// Flanks, matrices and options of a window.
///
/// [`crate::slice::MeshContact`] solves slices on reduced gears much faster. This type serves all other cases and keeps
/// no memory between solutions.
#[derive(Debug, Clone, Copy)]
pub struct ElasticContact<'a> {
    /// The gear pair.
    pub pair: &'a GearPair,
    /// Elastic models of both gears.
    pub gears: &'a [ElasticGear; 2],
    /// Flanks and matrices of the window.
    pub set: &'a ContactSet,
    /// Points or slices, law and friction.
    pub options: &'a ContactOptions,
}

/// Candidate rows at a pose, and the slice of each row; no slices for contact of points.
#[derive(Debug, Clone, Default)]
pub struct CandidateRows {
    /// Points or slices within reach.
    pub rows: Vec<ContactRow>,
    /// The slice of each row.
    pub slices: Vec<Slice>,
}

impl ElasticContact<'_> {
    /// Rows whose gap is at most `reach` (mm), with friction. `line` has the points of smallest gap
    /// ([`ContactSet::line_points`]).
    pub fn rows(&self, line: &LinePoints, poses: &[Pose; 2], reach: f64) -> CandidateRows {
        let Self { pair, set, options, .. } = *self;
        let (mut rows, slices) = match set.scene(options, line) {
            None => set.slices().map_or_else(Default::default, |slices| {
                slices.rows([&set.patches()[0], &set.patches()[1]], &set.pairs(), poses, reach)
            }),
            Some(scene) => {
                let mut rows = closest_points(&scene, poses, reach);
                rows.retain(|r| set.partners(r.patches));
                (rows, Vec::new())
            }
        };
        if let Some(friction) = Friction::new(pair, options) {
            rows = rows.into_iter().map(|row| friction.on(poses, row)).collect();
        }
        CandidateRows { rows, slices }
    }

    /// Forces on the rows, and the displacements of both gears' boundary coordinates, mm. If a moment is balanced, gear
    /// `body` rotates.
    ///
    /// # Errors
    /// [`ContactError::NotConverged`], [`ContactError::CannotCarryTorque`], and the errors of the elastic model.
    pub fn solve(
        &self,
        of: &CandidateRows,
        balance: Balance,
        body: usize,
        warm_start: &WarmStart,
    ) -> Result<(Solution, [Vec<f64>; 2]), ContactError> {
        let CandidateRows { rows, slices } = of;
        let key = |r: &ContactRow| (r.patches.0, r.patches.1, r.point);
        let start: Vec<f64> = rows.iter().map(|r| warm_start.get(&key(r)).copied().unwrap_or(0.0)).collect();
        let mut bodies = self.set.bodies(self.gears, rows)?;
        let solution = if self.set.slices().is_some() {
            complementarity::solve_slices(&mut *bodies, rows, body, balance, |i, f| approach(&slices[i], f), &start)?
        } else {
            complementarity::solve(&mut *bodies, rows, body, balance, self.options.law, &start)?
        };
        let displacements = bodies.displacements(&solution.forces);
        Ok((solution, displacements))
    }

    /// Forces with the gears' frames held at `poses`, and their tangent, as in [`crate::slice::MeshContact::evaluate`].
    ///
    /// The candidates are the points whose gap is smaller than the deepest undeformed overlap, including all points
    /// that penetrate: deflections under load on other points close no larger gap.
    ///
    /// # Errors
    /// The errors of [`ElasticContact::solve`].
    pub fn evaluate(&self, poses: &[Pose; 2]) -> Result<MeshForce, ContactError> {
        let line = self.set.line_points(self.options, poses);
        let overlapping = self.rows(&line, poses, 0.0);
        let deepest = overlapping.rows.iter().fold(0.0f64, |m, r| m.max(-r.gap));
        let mut pair_forces = vec![0.0; self.set.pairs().len()];
        if deepest == 0.0 {
            return Ok(MeshForce::none(pair_forces));
        }
        let of = self.rows(&line, poses, deepest);
        let (solution, _) = self.solve(&of, Balance::Held, 0, &WarmStart::new())?;
        for (row, f) in of.rows.iter().zip(&solution.forces) {
            pair_forces[self.set.pair_of(row.patches.0)] += f;
        }
        Ok(MeshForce {
            wrench: wrenches(poses, &of.rows, &solution.forces),
            tangent: self.tangent(&of, &solution, poses)?,
            pair_forces,
            iterations: solution.iterations,
            residual: solution.residual,
        })
    }

    /// T = -J_t' (S + D)^-1 J on the active rows. Exact contact of more points than nodes has no regular S: D is then
    /// that of the last proximal step, a millionth of a row's own compliance.
    fn tangent(
        &self,
        of: &CandidateRows,
        solution: &Solution,
        poses: &[Pose; 2],
    ) -> Result<[[f64; 12]; 12], ContactError> {
        let CandidateRows { rows, slices } = of;
        let centres = poses.map(|p| p.translation.vector);
        let along = |i: usize| {
            let row: &ContactRow = &rows[i];
            [row.normal, row.traction].map(|direction| opening_by_motion(row, &direction, &centres))
        };
        let mut bodies = self.set.bodies(self.gears, rows)?;
        let own = match self.options.law {
            Law::Exact if slices.is_empty() => LAST_COMPLIANCE * bodies.self_compliance()?,
            _ => 0.0,
        };
        let compliance = |i: usize| match (slices.get(i), self.options.law) {
            (Some(slice), _) => approach(slice, solution.forces[i]).1,
            (None, Law::Penalty(stiffness)) => 1.0 / (stiffness * rows[i].area),
            (None, Law::Exact) => own,
        };
        let n = rows.len();
        let mut problem = Problem {
            gaps: vec![0.0; n],
            levers: vec![0.0; n],
            torque_levers: vec![0.0; n],
            compliance: (0..n).map(compliance).collect(),
            moment: 0.0,
            held: true,
        };
        let mut tangent = SMatrix::<f64, 12, 12>::zeros();
        for q in 0..12 {
            // How the forces answer when coordinate q opens the gaps.
            solution.active.iter().for_each(|&i| problem.gaps[i] = along(i)[0][q]);
            let forces = bodies.solve(&solution.active, &problem)?.forces;
            for (&i, f) in solution.active.iter().zip(&forces) {
                let loads = along(i)[1];
                (0..12).for_each(|p| tangent[(p, q)] += loads[p] * f);
            }
        }
        Ok(std::array::from_fn(|p| std::array::from_fn(|q| tangent[(p, q)])))
    }
}

/// Local approach of a slice under its force (N), mm, and its slope, mm/N.
fn approach(slice: &Slice, force: f64) -> (f64, f64) {
    let state = slice.local.under(force / slice.length);
    (state.approach, state.slope / slice.length)
}

/// Forces of the active rows of a solution.
pub fn warm_start(rows: &[ContactRow], solution: &Solution) -> WarmStart {
    let active = solution.active.iter();
    active.map(|&i| ((rows[i].patches.0, rows[i].patches.1, rows[i].point), solution.forces[i])).collect()
}
