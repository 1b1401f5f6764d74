//! Contact at poses that come in steps and small changes of these. Theory (46a).
//!
//! Rows are found, and their contact is solved, in the middle of the [`Cell`] that the first pose of a step is in; gaps follow the motion from there to first order, forces by the tangent of
//! the middle until they are exact. A motion that repeats itself comes through the same cells again, where all of that is known.

use crate::{Balance, ContactError, Pose};

use super::{Found, MeshContact, MeshForce, NEAR, cell::Cell, found::Tangent, local, problem};

/// What is wanted of an evaluation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Want {
    /// What [`MeshContact::strain_energy`] takes, and nothing else.
    Energy,
    /// Forces as well.
    Forces,
    /// And their tangent: that of the middle of the cell.
    Tangent,
}

/// Violation of the conditions, relative to the largest approach, up to which energy is good to a millionth of a millionth.
const OF_ENERGY: f64 = 1e-6;

impl MeshContact {
    /// As [`MeshContact::evaluate`], for poses that come in steps and small changes of these: rows that were found for poses next to them, up to a um away, are kept
    /// with their places and compliance, and their gaps follow the motion to first order.
    ///
    /// Forces are then the exact derivative of the strain energy, and the tangent that of the forces in the middle of the cell. The answer depends on the poses since the last
    /// [`MeshContact::start_anew`] alone.
    ///
    /// # Errors
    /// [`ContactError`] when the contact problem cannot be solved.
    pub fn evaluate_near(&mut self, poses: &[Pose; 2], want: Want) -> Result<&MeshForce, ContactError> {
        let motion = self.come_near(poses)?;
        self.found.follow(&motion);
        self.bend();
        self.solve_near(if want == Want::Energy { OF_ENERGY } else { 0.0 })?;
        if want == Want::Energy {
            return Ok(&self.force);
        }
        self.sum_forces();
        if let Some(modal) = &mut self.modal {
            modal.sum_forces(&self.found.modal, &self.solver);
        }
        if want == Want::Tangent {
            self.tangent_near();
        }
        Ok(&self.force)
    }

    /// Gap (mm) that flanks beside the window have at least with the gears' frames at `poses`, next to those of the last evaluation, if `gap` tells what they have at given ones: what no
    /// motion from the middle of the cell can have closed.
    pub fn gap_beside(&mut self, poses: &[Pose; 2], gap: impl FnOnce(&[Pose; 2]) -> f64) -> f64 {
        let motion =
            self.found.cell.as_ref().and_then(|_| self.found.motion_to(poses, self.radius, self.modal.as_ref()));
        let (Some(motion), Some(at)) = (motion, self.found.at) else { return gap(poses) };
        let way = |m: &[f64]| {
            let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            size(&m[..3]) + self.radius * size(&m[3..])
        };
        let gone = way(&motion[..6]) + way(&motion[6..]);
        *self.found.beside.get_or_insert_with(|| gap(&at)) - gone
    }

    /// From here on nothing counts that was evaluated before; what is known of cells remains known.
    pub(super) fn start_anew(&mut self) {
        self.leave();
        self.kept.start();
    }

    /// Forgets what is known of cells.
    pub(super) fn drop_cells(&mut self) {
        (self.found.at, self.found.cell) = (None, None);
        self.kept.clear();
    }

    /// Puts away what was found, if it belongs to a cell.
    pub(super) fn leave(&mut self) {
        if self.found.cell.is_some() {
            self.kept.put_away(&mut self.found);
        }
        (self.found.at, self.found.cell) = (None, None);
    }

    /// Goes over to rows that serve `poses`; the motion from where they were found.
    fn come_near(&mut self, poses: &[Pose; 2]) -> Result<[f64; 12], ContactError> {
        let (radius, modal) = (self.radius, self.modal.as_ref());
        let motion_from = |found: &Found| found.cell.is_some().then(|| found.motion_to(poses, radius, modal)).flatten();
        if let Some(motion) = motion_from(&self.found) {
            return Ok(motion);
        }
        if let Some(motion) = self.kept.last().and_then(motion_from) {
            self.kept.go_back(&mut self.found);
            self.solver.take_up(&self.found.held);
            return Ok(motion);
        }
        let cell = Cell::of(poses, radius, modal);
        if self.kept.bring(&cell, &mut self.found) {
            self.solver.take_up(&self.found.held);
        } else {
            self.leave();
            self.fill(cell)?;
        }
        // The middle of a cell is next to all of it, if numbers are numbers.
        Ok(self.found.motion_to(poses, radius, self.modal.as_ref()).unwrap_or([f64::NAN; 12]))
    }

    /// Finds the rows of a cell and solves their contact in its middle.
    fn fill(&mut self, cell: Cell) -> Result<(), ContactError> {
        let poses = cell.middle(self.radius);
        self.find_places_from_ends(&poses);
        let reach = self.reach(cell.reach());
        self.rows_within(&poses, reach + 2.0 * NEAR, Some(&cell));
        if let Some(modal) = &mut self.modal {
            let amplitudes = cell.amplitudes(modal);
            self.found.follow(&[0.0; 12]);
            modal.bend_by(&self.found.modal, &amplitudes, &mut self.found.rows);
            self.gaps.clear();
            self.gaps.extend(self.found.rows.iter().map(|r| r.gap));
        }
        self.levers.clear();
        self.levers.resize(self.found.rows.len(), 0.0);
        let Self { found, gaps, levers, solver, friction, .. } = self;
        let held = problem(found, gaps, [levers, levers], friction.is_none(), Balance::Held);
        solver.solve(&held, local(found), |_| 0.0)?;
        solver.put_away(&mut found.held);
        self.found.cell = Some(cell);
        Ok(())
    }

    fn solve_near(&mut self, accuracy: f64) -> Result<(), ContactError> {
        self.levers.clear();
        self.levers.resize(self.found.rows.len(), 0.0);
        let Self { found, gaps, levers, solver, friction, .. } = self;
        let problem = problem(found, gaps, [levers, levers], friction.is_none(), Balance::Held);
        solver.solve_near(&problem, local(found), accuracy)
    }

    /// The tangent in the middle of the cell, unless rows have come or gone since.
    fn tangent_near(&mut self) {
        let of_middle = self.solver.is_held();
        if of_middle && let Some(known) = &self.found.tangent {
            self.force.tangent = known.rigid;
            if let Some(modal) = &mut self.modal {
                modal.take_tangent(&known.all);
            }
            return;
        }
        self.find_tangent();
        if of_middle {
            let all = self.modal.as_ref().map_or(Vec::new(), |modal| modal.forces().tangent.clone());
            self.found.tangent = Some(Box::new(Tangent { rigid: self.force.tangent, all }));
        }
    }
}
