//! Contact at poses that come in steps and small changes of these. Theory (46a).
//!
//! Rows are found, and their contact is solved, in the middle of the [`PoseBin`] that the first pose of a step is in;
//! gaps follow the motion from there to first order, forces by the tangent of the middle until they are exact. A motion
//! that repeats itself comes through the same cells again, where all of that is known.

use crate::{Balance, ContactError, Pose};

use super::{
    LINEAR_RANGE, MeshContact, MeshForce, PoseContact, local, pose_bin::PoseBin, pose_contact::Tangent, problem,
};

/// What is wanted of an evaluation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum EvaluationLevel {
    /// What [`MeshContact::strain_energy`] takes, and nothing else.
    Energy,
    /// Forces as well.
    Forces,
    /// And their tangent: that of the middle of the cell.
    Tangent,
}

/// Violation of the conditions, relative to the largest approach, up to which energy is good to a millionth of a
/// millionth.
const ENERGY_ACCURACY: f64 = 1e-6;

impl MeshContact {
    /// As [`MeshContact::evaluate`], for poses that come in steps and small changes of these: rows that were found for
    /// poses next to them, up to a um away, are kept with their places and compliance, and their gaps follow the motion
    /// to first order.
    ///
    /// Forces are then the exact derivative of the strain energy, and the tangent that of the forces in the middle of
    /// the cell. The answer depends on the poses since the last [`MeshContact::start_anew`] alone.
    ///
    /// # Errors
    /// [`ContactError`] when the contact problem cannot be solved.
    pub fn evaluate_near(&mut self, poses: &[Pose; 2], level: EvaluationLevel) -> Result<&MeshForce, ContactError> {
        let motion = self.select_rows(poses)?;
        self.contact.follow(&motion);
        self.add_modal_openings();
        self.solve_near(if level == EvaluationLevel::Energy { ENERGY_ACCURACY } else { 0.0 })?;
        if level == EvaluationLevel::Energy {
            return Ok(&self.force);
        }
        self.sum_forces();
        if let Some(modal) = &mut self.modal {
            modal.sum_forces(&self.contact.modal, &self.solver);
        }
        if level == EvaluationLevel::Tangent {
            self.tangent_near();
        }
        Ok(&self.force)
    }

    /// Gap (mm) that flanks beside the window have at least with the gears' frames at `poses`, next to those of the
    /// last evaluation, if `gap` tells what they have at given ones: what no motion from the middle of the cell can
    /// have closed.
    pub fn gap_of_neighbours(&mut self, poses: &[Pose; 2], gap: impl FnOnce(&[Pose; 2]) -> f64) -> f64 {
        let motion =
            self.contact.bin.as_ref().and_then(|_| self.contact.motion_to(poses, self.radius, self.modal.as_ref()));
        let (Some(motion), Some(at)) = (motion, self.contact.at) else { return gap(poses) };
        let way = |m: &[f64]| {
            let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            size(&m[..3]) + self.radius * size(&m[3..])
        };
        let gone = way(&motion[..6]) + way(&motion[6..]);
        *self.contact.neighbour_gap.get_or_insert_with(|| gap(&at)) - gone
    }

    /// From here on nothing counts that was evaluated before; what is known of cells remains known.
    pub(super) fn start_anew(&mut self) {
        self.stash();
        self.cache.start();
    }

    /// Forgets what is known of cells.
    pub(super) fn clear_cache(&mut self) {
        (self.contact.at, self.contact.bin) = (None, None);
        self.cache.clear();
    }

    /// Puts away what was found, if it belongs to a cell.
    pub(super) fn stash(&mut self) {
        if self.contact.bin.is_some() {
            self.cache.put_away(&mut self.contact);
        }
        (self.contact.at, self.contact.bin) = (None, None);
    }

    /// Goes over to rows that serve `poses`; the motion from where they were found.
    fn select_rows(&mut self, poses: &[Pose; 2]) -> Result<[f64; 12], ContactError> {
        let (radius, modal) = (self.radius, self.modal.as_ref());
        let motion_from =
            |contact: &PoseContact| contact.bin.is_some().then(|| contact.motion_to(poses, radius, modal)).flatten();
        if let Some(motion) = motion_from(&self.contact) {
            return Ok(motion);
        }
        if let Some(motion) = self.cache.last().and_then(motion_from) {
            self.cache.swap_back(&mut self.contact);
            self.solver.restore(&self.contact.saved);
            return Ok(motion);
        }
        let bin = PoseBin::of(poses, radius, modal);
        if self.cache.recall(&bin, &mut self.contact) {
            self.solver.restore(&self.contact.saved);
        } else {
            self.stash();
            self.fill(bin)?;
        }
        // The middle of a cell is next to all of it, if numbers are numbers.
        Ok(self.contact.motion_to(poses, radius, self.modal.as_ref()).unwrap_or([f64::NAN; 12]))
    }

    /// Finds the rows of a cell and solves their contact in its middle.
    fn fill(&mut self, bin: PoseBin) -> Result<(), ContactError> {
        let poses = bin.middle(self.radius);
        self.search_from_ends(&poses);
        let reach = self.reach(bin.reach());
        self.rows_within(&poses, reach + 2.0 * LINEAR_RANGE, Some(&bin));
        if let Some(modal) = &mut self.modal {
            let amplitudes = bin.amplitudes(modal);
            self.contact.follow(&[0.0; 12]);
            modal.bend_by(&self.contact.modal, &amplitudes, &mut self.contact.rows);
            self.gaps.clear();
            self.gaps.extend(self.contact.rows.iter().map(|r| r.gap));
        }
        self.levers.clear();
        self.levers.resize(self.contact.rows.len(), 0.0);
        let Self { contact, gaps, levers, solver, friction, .. } = self;
        let held = problem(contact, gaps, [levers, levers], friction.is_none(), Balance::Held);
        solver.solve(&held, local(contact), |_| 0.0)?;
        solver.save(&mut contact.saved);
        self.contact.bin = Some(bin);
        Ok(())
    }

    fn solve_near(&mut self, accuracy: f64) -> Result<(), ContactError> {
        self.levers.clear();
        self.levers.resize(self.contact.rows.len(), 0.0);
        let Self { contact, gaps, levers, solver, friction, .. } = self;
        let problem = problem(contact, gaps, [levers, levers], friction.is_none(), Balance::Held);
        solver.solve_near(&problem, local(contact), accuracy)
    }

    /// The tangent in the middle of the cell, unless rows have come or gone since.
    fn tangent_near(&mut self) {
        let of_middle = self.solver.has_saved_factor();
        if of_middle && let Some(known) = &self.contact.tangent {
            self.force.tangent = known.rigid;
            if let Some(modal) = &mut self.modal {
                modal.take_tangent(&known.all);
            }
            return;
        }
        self.find_tangent();
        if of_middle {
            let all = self.modal.as_ref().map_or(Vec::new(), |modal| modal.forces().tangent.clone());
            self.contact.tangent = Some(Box::new(Tangent { rigid: self.force.tangent, all }));
        }
    }
}
