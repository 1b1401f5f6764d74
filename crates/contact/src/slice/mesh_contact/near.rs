//! Contact at poses that move in steps and by small changes within a step. Theory (46a).
//!
//! The contact rows are found and solved at the centre of the [`PoseBin`] of the first pose of a step. From there gaps
//! follow the motion to first order, and forces follow from the tangent at the centre, iterated until they are exact. A
//! periodic motion returns to the same bins and finds their contact in the cache.

use crate::{ContactError, MeshForce, Pose, complementarity::Balance};

use super::{MeshContact, PoseContact, pose_bin::PoseBin, pose_contact::Tangent, problem};

/// Level of an evaluation: how much it computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum EvaluationLevel {
    /// Only the strain energy ([`MeshContact::strain_energy`]).
    Energy,
    /// The forces as well.
    Forces,
    /// The forces and their tangent, which is that at the centre of the bin.
    Tangent,
}

/// Largest violation of the contact conditions, relative to the largest approach, with which the energy is exact to
/// 1e-12.
const ENERGY_ACCURACY: f64 = 1e-6;

impl MeshContact {
    /// Evaluates the contact as [`MeshContact::evaluate`], for poses that move in steps and by small changes within a
    /// step. Rows found at poses up to a um away keep their contact points and their compliance; gaps follow the motion
    /// to first order.
    ///
    /// Forces are the exact derivative of the strain energy; the tangent is that of the forces at the centre of the
    /// bin. The result depends only on the poses since the last `MeshContact::start_anew`.
    ///
    /// # Errors
    /// [`ContactError`] if the contact problem cannot be solved.
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

    /// Lower bound of the gap (mm) of the neighbouring pairs outside the window, with the gears' frames at `poses`.
    /// `gap` gives their gap at given poses. The bound is the gap at the centre of the bin minus the amount that the
    /// motion from there can close.
    pub fn gap_of_neighbours(&mut self, poses: &[Pose; 2], gap: impl FnOnce(&[Pose; 2]) -> f64) -> f64 {
        let motion =
            self.contact.bin.as_ref().and_then(|_| self.contact.motion_to(poses, &self.sizes, self.modal.as_ref()));
        let (Some(motion), Some(at)) = (motion, self.contact.at) else { return gap(poses) };
        let way = |m: &[f64]| {
            let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            size(&m[..3]) + self.sizes.radius * size(&m[3..])
        };
        let gone = way(&motion[..6]) + way(&motion[6..]);
        *self.contact.neighbour_gap.get_or_insert_with(|| gap(&at)) - gone
    }

    /// Starts a new history: later results do not depend on earlier poses. The cache keeps its bins, because they do
    /// not depend on history.
    pub(super) fn start_anew(&mut self) {
        self.stash();
        self.cache.start();
    }

    /// Empties the cache.
    pub(super) fn clear_cache(&mut self) {
        (self.contact.at, self.contact.bin) = (None, None);
        self.cache.clear();
    }

    /// Stores the current contact in the cache, if it belongs to a bin.
    pub(super) fn stash(&mut self) {
        if self.contact.bin.is_some() {
            self.cache.put_away(&mut self.contact);
        }
        (self.contact.at, self.contact.bin) = (None, None);
    }

    /// Makes the rows current that serve `poses`; returns the motion from where they were found.
    fn select_rows(&mut self, poses: &[Pose; 2]) -> Result<[f64; 12], ContactError> {
        let (sizes, modal) = (self.sizes, self.modal.as_ref());
        let motion_from =
            |contact: &PoseContact| contact.bin.is_some().then(|| contact.motion_to(poses, &sizes, modal)).flatten();
        if let Some(motion) = motion_from(&self.contact) {
            return Ok(motion);
        }
        if let Some(motion) = self.cache.last().and_then(motion_from) {
            self.cache.swap_back(&mut self.contact);
            self.solver.restore(&self.contact.saved);
            return Ok(motion);
        }
        let bin = PoseBin::of(poses, &sizes, modal);
        if self.cache.recall(&bin, &mut self.contact) {
            self.solver.restore(&self.contact.saved);
        } else {
            self.stash();
            self.fill(bin)?;
        }
        // Every pose in a bin is within the linear range of its centre, unless it is no number.
        Ok(self.contact.motion_to(poses, &self.sizes, self.modal.as_ref()).unwrap_or([f64::NAN; 12]))
    }

    /// Finds the rows of a bin and solves their contact at its centre.
    fn fill(&mut self, bin: PoseBin) -> Result<(), ContactError> {
        let poses = bin.middle(&self.sizes);
        self.search_from_ends(&poses);
        let reach = self.reach(bin.reach(&self.sizes));
        self.rows_within(&poses, reach + 2.0 * self.sizes.linear_range, Some(&bin));
        if let Some(modal) = &mut self.modal {
            let amplitudes = bin.amplitudes(&self.sizes, modal);
            self.contact.follow(&[0.0; 12]);
            modal.bend_by(&self.contact.modal, &amplitudes, &mut self.contact.rows);
            self.gaps.clear();
            self.gaps.extend(self.contact.rows.iter().map(|r| r.gap));
        }
        self.levers.clear();
        self.levers.resize(self.contact.rows.len(), 0.0);
        let Self { contact, gaps, levers, solver, friction, .. } = self;
        let held = problem(contact, gaps, [levers, levers], friction.is_none(), Balance::Held);
        solver.solve(&held, &contact.laws, |_| 0.0)?;
        solver.save(&mut contact.saved);
        self.contact.bin = Some(bin);
        Ok(())
    }

    fn solve_near(&mut self, accuracy: f64) -> Result<(), ContactError> {
        self.levers.clear();
        self.levers.resize(self.contact.rows.len(), 0.0);
        let Self { contact, gaps, levers, solver, friction, .. } = self;
        let problem = problem(contact, gaps, [levers, levers], friction.is_none(), Balance::Held);
        solver.solve_near(&problem, &contact.laws, accuracy)
    }

    /// The tangent at the centre of the bin, unless the set of active rows has changed since.
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
