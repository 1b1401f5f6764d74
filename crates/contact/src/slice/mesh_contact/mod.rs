//! Slice contact of two gears at given poses: forces and their tangent. Theory (38).

mod compliance;
mod joined;
mod moved;
mod near;
mod pose_bin;
mod pose_cache;
mod pose_contact;
mod search;
mod work;

use ale::ToothWindow;
use faer::MatRef;
use geometry::GearPair;
use pose_bin::BinSizes;
use pose_cache::PoseCache;
use pose_contact::PoseContact;
use reduction::{ElasticGear, GearModes};
use std::sync::Arc;

use crate::{
    ContactError, ContactOptions, ContactSet, Friction, MeshForce, ModalFlanks, Pose, SlicePoint, SliceState,
    TablePoint, TableWork,
    complementarity::{Balance, DenseProblem, DenseSolver, LocalApproach},
    line::{covered, line_station, slice_line},
    local::LocalLaws,
    nodal::ContactRow,
    opening_by_motion,
    slice::{Slice, SliceHint},
    wrenches,
};

pub(super) use compliance::{mirror, places};
pub use joined::{Approach, CommonGear, FlanksOfBore, JoinedContacts, PressedBore};
pub use near::EvaluationLevel;
pub use work::ContactWork;

/// Motion over the deepest overlap up to which the tangent changes by little.
const SMALL_MOTION: f64 = 0.03;

/// The slice contact of a window: search, compliance and solution. Memory is allocated once and reused.
///
/// Poses are those of the frames of the window's matrices (`ltca::Equilibrium::poses`). The search starts from the last
/// contact points and the solution from the last forces. Neither changes the result by more than round-off.
#[derive(Debug)]
pub struct MeshContact {
    set: ContactSet,
    friction: Option<Friction>,
    /// Sizes of the bins of poses.
    sizes: BinSizes,
    pairs: Vec<(usize, usize)>,
    hints: Vec<SliceHint>,
    /// Pose of body 1 at the last search.
    last_pose: Option<Pose>,
    /// Force of each station of each pair at the last solution, N.
    last_forces: Vec<f64>,
    /// Those with which the search before the last one ended.
    older_forces: Vec<f64>,
    nearest: Vec<(usize, SlicePoint)>,
    /// Contact at the current poses, and in the pose bins visited before.
    contact: PoseContact,
    cache: PoseCache,
    gaps: Vec<f64>,
    levers: Vec<f64>,
    torque_levers: Vec<f64>,
    /// Positions of the rows in the compliance table of a gear: for gap openings, and for loads where friction turns
    /// these away from the normal.
    openings: Vec<TablePoint>,
    loads: Vec<TablePoint>,
    work: [TableWork; 2],
    solver: DenseSolver,
    force: MeshForce,
    /// Normal modes that are coordinates of their own, and their shapes on the flanks of the window.
    modes: Option<[Arc<GearModes>; 2]>,
    modal: Option<ModalFlanks>,
}

impl MeshContact {
    /// The slice contact of a window on reduced gears.
    ///
    /// # Errors
    /// [`ContactError::NotSliced`] for points ([`crate::Method::Nodal`]) or gears with all their degrees of freedom.
    pub fn new(pair: &GearPair, set: ContactSet, options: &ContactOptions) -> Result<Self, ContactError> {
        let (Some(slices), Some(_)) = (set.slices(), set.windows()) else {
            return Err(ContactError::NotSliced);
        };
        let pairs = set.pairs();
        let most = pairs.len() * slices.stations().len();
        let work = slices.bulk().map(|_| [0, 1].map(|_| TableWork::new(most))).unwrap_or_default();
        let friction = Friction::new(pair, options);
        let force = MeshForce::none(vec![0.0; pairs.len()]);
        Ok(Self {
            friction,
            sizes: BinSizes::of(pair),
            hints: vec![SliceHint::default(); most],
            last_pose: None,
            last_forces: vec![0.0; most],
            older_forces: vec![0.0; most],
            nearest: Vec::with_capacity(most),
            contact: PoseContact::with_capacity(most),
            cache: PoseCache::default(),
            gaps: Vec::with_capacity(most),
            levers: Vec::with_capacity(most),
            torque_levers: Vec::with_capacity(most),
            openings: Vec::with_capacity(most),
            loads: Vec::with_capacity(if friction.is_some() { most } else { 0 }),
            work,
            solver: DenseSolver::new(most),
            force,
            modes: None,
            modal: None,
            pairs,
            set,
        })
    }

    /// Flanks and matrices of the window.
    pub fn contact_set(&self) -> &ContactSet {
        &self.set
    }

    /// Enters another window. If `set`, made for any window of these gears, serves it, flanks and matrices are
    /// renumbered; otherwise they are set up again. Forces of the last solution are discarded, because they belong to
    /// other pairs. Kept modes are evaluated on the new flanks.
    ///
    /// # Errors
    /// [`ContactError`] if the window cannot be set up.
    pub fn enter_window(
        &mut self,
        pair: &GearPair,
        gears: &[ElasticGear; 2],
        window: &ToothWindow,
        set: ContactSet,
        options: &ContactOptions,
    ) -> Result<(), ContactError> {
        if let Some(set) = set.in_window(pair, gears, window, options)? {
            self.enter(set);
        } else {
            let modes = self.modes.take();
            *self = Self::new(pair, ContactSet::new(pair, gears, window, options)?, options)?;
            self.modes = modes;
        }
        self.enter_modes(gears)
    }

    /// Discards forces and contact points of the last solution.
    pub fn forget_places(&mut self) {
        self.enter(self.set.clone());
    }

    /// Enters another window with the same flanks.
    fn enter(&mut self, set: ContactSet) {
        self.forget();
        self.hints.fill(SliceHint::default());
        self.last_pose = None;
        if self.set.shares_flanks(&set) {
            self.start_anew();
        } else {
            self.clear_cache();
        }
        self.set = set;
    }

    /// Removes the normal modes of both gears from the compliance. The gears are then deformed by the amplitudes that
    /// are set.
    ///
    /// # Errors
    /// [`ContactError`] for modes of other gears.
    pub fn keep_modes(&mut self, gears: &[ElasticGear; 2], modes: [Arc<GearModes>; 2]) -> Result<(), ContactError> {
        self.modes = Some(modes);
        self.enter_modes(gears)
    }

    /// The kept modes.
    pub fn modes(&self) -> Option<&[Arc<GearModes>; 2]> {
        self.modes.as_ref()
    }

    /// Evaluates the modes on the flanks of the current window: each tooth has its own part of a mode.
    fn enter_modes(&mut self, gears: &[ElasticGear; 2]) -> Result<(), ContactError> {
        let Some([a, b]) = &self.modes else { return Ok(()) };
        let modal = ModalFlanks::new(gears, [a, b], &self.set)?;
        self.clear_cache();
        self.modal = Some(modal);
        Ok(())
    }

    /// Sets the amplitudes of the modes, first those of the pinion, then those of the wheel.
    pub fn deform(&mut self, amplitudes: &[f64]) {
        if let Some(modal) = &mut self.modal {
            modal.deform(amplitudes);
        }
    }

    /// The kept modes on the flanks, and the forces on them at the last evaluation.
    pub fn modal(&self) -> Option<&ModalFlanks> {
        self.modal.as_ref()
    }

    /// Discards the forces of the last solution.
    pub fn forget(&mut self) {
        self.last_forces.fill(0.0);
        self.older_forces.fill(0.0);
    }

    /// Forces with the gears' frames at `poses`.
    ///
    /// # Errors
    /// [`ContactError`] if the contact problem cannot be solved.
    pub fn evaluate(&mut self, poses: &[Pose; 2]) -> Result<&MeshForce, ContactError> {
        self.prepare(poses, None);
        self.solve(Balance::Held, 0)?;
        self.sum_forces();
        if let Some(modal) = &mut self.modal {
            modal.sum_forces(&self.contact.modal, &self.solver);
        }
        self.find_tangent();
        Ok(&self.force)
    }

    /// Evaluates the contact as [`MeshContact::evaluate`], if the deepest overlap is expected to be similar to the last
    /// one. Rows with gaps above `reach` (mm) are not searched, which saves most of the search. If teeth overlap by
    /// more than `reach`, all rows are searched.
    ///
    /// # Errors
    /// [`ContactError`] if the contact problem cannot be solved.
    pub fn evaluate_within(&mut self, poses: &[Pose; 2], reach: f64) -> Result<&MeshForce, ContactError> {
        self.prepare(poses, Some(reach));
        if self.modal.is_some() || self.deepest().is_nan() || self.deepest() > reach {
            return self.evaluate(poses);
        }
        self.solve(Balance::Held, 0)?;
        self.sum_forces();
        self.find_tangent();
        Ok(&self.force)
    }

    /// Forces after a small motion from the last evaluation, with its rows and its tangent. `None` if the motion is not
    /// small, if the rows do not give a solution, or if rows enter or leave the active set. `within` (mm) is the gap
    /// below which the last evaluation has all rows ([`MeshContact::evaluate_within`]); the motion reduces it.
    ///
    /// Forces are as accurate as those of [`MeshContact::evaluate`]; the tangent is that of the earlier poses.
    pub fn evaluate_moved(&mut self, poses: &[Pose; 2], within: &mut f64) -> Option<&MeshForce> {
        let before = self.contact.at?;
        let way = |g: usize| {
            let moved = poses[g].translation.vector - before[g].translation.vector;
            moved.norm() + self.sizes.radius * (poses[g].rotation * before[g].rotation.inverse()).angle()
        };
        let (gone, overlap) = (way(0) + way(1), self.deepest_overlap());
        // No row that was left out may come nearer than the deepest overlap.
        let left = *within - gone;
        if gone.is_nan() || gone > SMALL_MOTION * overlap || overlap + gone > left {
            return None;
        }
        *within = left;
        if !self.solve_moved(poses, Balance::Held, 0) {
            return None;
        }
        self.sum_forces();
        Some(&self.force)
    }

    /// Deepest overlap of the flanks in the last evaluation, mm; 0 if they are apart.
    pub fn deepest_overlap(&self) -> f64 {
        self.rows().iter().fold(0.0, |m: f64, row| m.max(-row.gap))
    }

    /// Resultants of the current solution.
    fn sum_forces(&mut self) {
        let Self { force, contact: PoseContact { rows, at, .. }, solver, set, .. } = self;
        force.wrench = wrenches(&at.unwrap_or([Pose::identity(); 2]), rows, solver.forces());
        force.pair_forces.fill(0.0);
        for (row, f) in rows.iter().zip(solver.forces()) {
            force.pair_forces[set.pair_of(row.patches.0)] += f;
        }
        (force.iterations, force.residual) = (solver.iterations(), solver.residual());
    }

    /// Tangent from the current factor, and with it the forces on the modes.
    fn find_tangent(&mut self) {
        let Self { force, contact: PoseContact { rows, at, modal: modal_rows, .. }, solver, modal, .. } = self;
        let centres = at.unwrap_or([Pose::identity(); 2]).map(|p| p.translation.vector);
        let rigid = |i: usize| {
            let row = &rows[i];
            [row.normal, row.traction].map(|direction| opening_by_motion(row, &direction, &centres))
        };
        match modal {
            None => force.tangent = solver.tangent(rigid),
            Some(modal) => {
                modal.find_tangent(modal_rows, solver, rigid);
                let (all, n) = (&modal.forces().tangent, 12 + modal.count());
                force.tangent = std::array::from_fn(|i| std::array::from_fn(|j| all[i * n + j]));
            }
        }
    }

    /// Derivative, by the twelve displacements, of forces along the normals that are shares of the normal forces, N/mm,
    /// N, N mm; row i has the share `of(i)`. To be called after an evaluation with its tangent.
    pub fn tangent_of_shares(&mut self, of: impl Fn(usize) -> f64) -> [[f64; 12]; 12] {
        let Self { contact: PoseContact { rows, at, .. }, solver, .. } = self;
        let centres = at.unwrap_or([Pose::identity(); 2]).map(|p| p.translation.vector);
        solver.weighted_tangent(|i| {
            let opening = opening_by_motion(&rows[i], &rows[i].normal, &centres);
            [opening, opening.map(|j| of(i) * j)]
        })
    }

    /// Elastic energy of both gears and the contact at the last evaluation, N mm.
    ///
    /// ```text
    /// V = -g F - U*(F),   U* = F' S F / 2 + sum of int_0^F delta dF
    /// ```
    /// This dual functional is stationary at the solution, so its error is of second order in the error of the forces.
    pub fn strain_energy(&self) -> f64 {
        let Self { contact: PoseContact { laws, .. }, gaps, solver, .. } = self;
        let (forces, openings) = (solver.forces(), solver.openings());
        let linear: f64 = solver.active().iter().map(|&i| forces[i] * (gaps[i] + 0.5 * openings[i])).sum();
        laws.curved_energy(forces) - linear
    }

    /// Forces of the last evaluation.
    pub fn force(&self) -> &MeshForce {
        &self.force
    }

    /// Adds what the modes open to the gaps of the rows.
    fn add_modal_openings(&mut self) {
        let Self { contact: PoseContact { rows, modal: modal_rows, .. }, modal, gaps, .. } = self;
        if let Some(modal) = modal {
            rows.iter_mut().enumerate().for_each(|(i, row)| row.gap += modal.shift(modal_rows, i));
        }
        gaps.clear();
        gaps.extend(rows.iter().map(|r| r.gap));
    }

    /// Gap opening of a row by the kept modes, mm; it is part of the row's gap.
    pub(crate) fn modal_opening(&self, row: usize) -> f64 {
        self.modal.as_ref().map_or(0.0, |modal| modal.shift(&self.contact.modal, row))
    }

    /// Solves the contact of the rows. If a moment is balanced, gear `body` rotates.
    ///
    /// # Errors
    /// [`ContactError`] if the contact problem cannot be solved.
    pub fn solve(&mut self, balance: Balance, body: usize) -> Result<(), ContactError> {
        self.solve_to(0.0, balance, body)
    }

    /// Solves the contact of the rows until the violation of the conditions, relative to the largest approach, is at
    /// most `accuracy`; a solution at a nearby pose compensates for it. The accuracy is never better than that of
    /// [`Self::solve`].
    ///
    /// # Errors
    /// [`ContactError`] if the contact problem cannot be solved.
    pub fn solve_to(&mut self, accuracy: f64, balance: Balance, body: usize) -> Result<(), ContactError> {
        self.take_levers(body);
        let Self { contact, gaps, levers, torque_levers, last_forces, older_forces, solver, .. } = self;
        let problem = problem(contact, gaps, [levers, torque_levers], self.friction.is_none(), balance);
        let keys = &contact.keys;
        // Forces go on as they went from station to station; of a row that has just come nothing is known yet.
        let foretold = |i: usize| match (last_forces[keys[i]], older_forces[keys[i]]) {
            (last, older) if older > 0.0 => 2.0 * last - older,
            (last, _) => last,
        };
        solver.solve_to(accuracy, &problem, &contact.laws, |i| foretold(i).max(0.0))?;
        older_forces.copy_from_slice(last_forces);
        self.keep_forces();
        Ok(())
    }

    /// Levers of the rows about the axis of gear `body`.
    fn take_levers(&mut self, body: usize) {
        let Self { contact, levers, torque_levers, .. } = self;
        levers.clear();
        torque_levers.clear();
        levers.extend(contact.rows.iter().map(|r| r.levers[body]));
        torque_levers.extend(contact.rows.iter().map(|r| r.torque_levers[body]));
    }

    /// Makes the stiffness of the last solution under a moment exact, if that solution was found with an earlier factor
    /// ([`MeshContact::solve_moved`]).
    pub fn refine_stiffness(&mut self, balance: Balance) {
        let Self { contact, gaps, levers, torque_levers, solver, friction, .. } = self;
        solver.refine_stiffness(&problem(contact, gaps, [levers, torque_levers], friction.is_none(), balance));
    }

    /// Keeps the forces of a solution for the next one to start from.
    fn keep_forces(&mut self) {
        let Self { contact, last_forces, solver, .. } = self;
        last_forces.fill(0.0);
        contact.keys.iter().zip(solver.forces()).for_each(|(&key, &f)| last_forces[key] = f);
    }

    /// Rows of the last solution, in order of pair and height.
    pub fn rows(&self) -> &[ContactRow] {
        &self.contact.rows
    }

    /// Hands over rows and slices of the last solution; afterwards contact must be searched again.
    pub fn take_rows(&mut self) -> (Vec<ContactRow>, Vec<Slice>) {
        let PoseContact { at, bin, rows, slices, .. } = &mut self.contact;
        (*at, *bin) = (None, None);
        (std::mem::take(rows), std::mem::take(slices))
    }

    /// Slices of the rows.
    pub fn slices(&self) -> &[Slice] {
        &self.contact.slices
    }

    /// Local state of each row under forces (N): those of the last solution, or forces derived from them.
    pub fn states<'a>(&'a self, forces: &'a [f64]) -> impl Iterator<Item = SliceState> + 'a {
        let states = self.contact.laws.states(forces).into_iter();
        states.map(|(local, curved_energy)| SliceState { local, curved_energy })
    }

    /// Total length of the contact lines of the last evaluation on the driving side, with the gears' frames at `poses`,
    /// mm; computed as for static contact, theory (21b).
    pub fn line_length(&self, pair: &GearPair, poses: &[Pose; 2]) -> f64 {
        let face = pair.common_face();
        let (rows, slices) = (self.rows(), self.slices());
        let (forces, openings) = (self.solver.forces(), self.solver.openings());
        let mut length = 0.0;
        let mut from = 0;
        while from < rows.len() {
            let patches = rows[from].patches;
            let to = from + rows[from..].iter().take_while(|row| row.patches == patches).count();
            let stations = (from..to).map(|i| {
                let approach = if forces[i] > 0.0 { self.contact.laws.under(i, forces[i]).0 } else { 0.0 };
                let station = line_station(rows[i].gap, openings[i], approach, self.modal_opening(i));
                (rows[i].point, station, slices[i].at[0][0])
            });
            let displacements = || {
                let supported = self.set.supported_rows(poses, rows, slices, forces);
                self.set.displacements_under(&supported, forces).unwrap_or_default()
            };
            length += covered(&slice_line(&self.set, poses, patches, stations, face, displacements), face);
            from = to;
        }
        length / pair.base_helix_angle().cos()
    }

    /// Forces (N) of the last solution on both gears' boundary coordinates, in the frames of the matrices, with these at
    /// `poses`; `None` if there are no matrices of the flanks.
    pub fn boundary_forces(&self, poses: &[Pose; 2]) -> Option<[Vec<f64>; 2]> {
        let forces = self.solver.forces();
        let supported = self.set.supported_rows(poses, self.rows(), self.slices(), forces);
        self.set.forces_of(&supported, forces)
    }

    /// Forces, openings and active rows of the last solution.
    pub fn solver(&self) -> &DenseSolver {
        &self.solver
    }
}

/// The contact problem of the rows, with these gaps.
fn problem<'a>(
    contact: &'a PoseContact,
    gaps: &'a [f64],
    [levers, torque_levers]: [&'a [f64]; 2],
    symmetric: bool,
    balance: Balance,
) -> DenseProblem<'a> {
    let n = contact.rows.len();
    let compliance = MatRef::from_column_major_slice(&contact.compliance[..], n, n);
    DenseProblem { compliance, symmetric, gaps, levers, torque_levers, balance }
}

impl LocalApproach for &LocalLaws {
    fn under(&self, row: usize, force: f64) -> (f64, f64) {
        LocalLaws::under(self, row, force)
    }

    /// Of all rows: four at once cost as much as one.
    fn linearise(&self, _: &[usize], forces: &[f64], approach: &mut [f64], slopes: &mut [f64]) {
        LocalLaws::linearise(self, forces, approach, slopes);
    }
}
