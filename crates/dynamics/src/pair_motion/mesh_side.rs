//! Contact of the flanks on one side of the teeth, in motion. Theory (46), (47).

use std::sync::Arc;

use ale::ToothWindow;
use contact::{ContactError, Pose};
use geometry::GearPair;
use nalgebra::{DMatrix, DVector, SMatrix, Translation3, UnitQuaternion, Vector3};
use reduction::GearModes;
use serde::{Deserialize, Serialize};

use super::{COORDINATES, Displacement, PressedSlice, modal::Posture};
use crate::{
    ContactSet, ElasticGear, FilletStress, MeshContact, StaticError, StaticOptions, Station, Wrench,
    equilibrium::frames, line::Standing, loads::slice_result, mesh_contact::Want, modal_flanks::ModalFlanks,
    parts::Parts, pose, root_stress::RootStress,
};

/// One side of the teeth: the flanks that drive, or those that touch when torque reverses.
#[derive(Debug)]
pub(super) struct MeshSide {
    options: StaticOptions,
    gears: Arc<[ElasticGear; 2]>,
    window: ToothWindow,
    contact: MeshContact,
    /// Flanks and matrices that the first window had: where one set serves all windows, its frames are counted from there.
    home: (ToothWindow, ContactSet),
    /// Mesh cycles that this side is ahead of the pair's counting.
    ahead: f64,
    /// Turn of the wheel from where these flanks touch to where the driving ones do, rad: backlash on the coast side.
    slack: f64,
    changes: Changes,
    /// Normal modes of both gears that are coordinates of their own.
    modes: Option<[Arc<GearModes>; 2]>,
}

/// Tooth changes of one side so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Changes {
    /// How many.
    pub count: u64,
    /// Largest force that an outgoing tooth carried when it left, N: 0, or a force was dropped.
    pub dropped: f64,
    /// Largest difference of the sum of normal forces before and after a change at the same place, N.
    pub jump: f64,
}

/// Where the window of one side stands; all that contact remembers from step to step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SidePlace {
    /// First running number of the window.
    pub first: i64,
    /// Tooth changes so far.
    pub changes: Changes,
}

/// Forces of one side on the twelve coordinates.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SideForce {
    /// Normal forces: N, N mm.
    pub normal: Displacement,
    /// Friction.
    pub friction: Displacement,
    /// -d(normal + friction)/dd.
    pub stiffness: SMatrix<f64, 12, 12>,
    /// The same with the modes.
    pub modal: Option<ModalForce>,
}

/// Forces of one side on the modes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ModalForce {
    /// Normal forces, m.
    pub normal: DVector<f64>,
    /// Friction, m.
    pub friction: DVector<f64>,
    /// -d(forces)/d(d, q), (12 + m) x (12 + m), where it was asked for.
    pub stiffness: Option<DMatrix<f64>>,
}

/// A slice that carries force.
struct Pressed {
    /// Normal force, N.
    force: f64,
    /// Damping, N s/mm.
    damping: f64,
    /// dg/dd.
    j: Displacement,
    /// dg/dt by the rigid bodies, mm/s.
    opening: f64,
}

impl Pressed {
    /// Force against the approach (N, positive where flanks part), its slope, and its power.
    fn resisted(&self) -> [f64; 3] {
        let Self { force, damping, opening, .. } = *self;
        let damped = limited(damping * opening, force);
        [damped, if damped == damping * opening { damping } else { 0.0 }, damped * opening]
    }
}

impl MeshSide {
    /// The side on which `options` has the load, at the beginning of a motion; `reference` are the options of the pair's counting.
    pub fn new(
        pair: &GearPair,
        gears: Arc<[ElasticGear; 2]>,
        options: StaticOptions,
        reference: &StaticOptions,
        cycles: f64,
    ) -> Result<Self, StaticError> {
        let pitch = pair.pinion.pitch_angle();
        let apart = pair.middle_angle(reference.side()) - pair.middle_angle(options.side());
        let ahead = reference.sense.sign() as f64 * apart / pitch;
        let own = Station::at_cycles(cycles + ahead);
        let theta = [(own, &options), (Station::at_cycles(cycles), reference)]
            .map(|(station, options)| pose::reference_angle(pair, options, station.pinion_angle(pair, options)));
        // Whole teeth apart is the same place.
        let of_wheel = pair.wheel.pitch_angle();
        let slack = (theta[1] - theta[0]) - ((theta[1] - theta[0]) / of_wheel).round() * of_wheel;
        let count = crate::StaticModel::window_teeth(pair, &options);
        let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
        let first = ToothWindow::nominal_first(own.centre(&options), count);
        let window = ToothWindow::new(first, count, teeth)?;
        let set = ContactSet::new(pair, &gears, &window, &options)?;
        let contact = MeshContact::new(pair, set.clone(), &options)?;
        let home = (window, set);
        Ok(Self { options, gears, window, contact, home, ahead, slack, changes: Changes::default(), modes: None })
    }

    /// Takes normal modes of both gears for coordinates of their own.
    pub fn keep_modes(&mut self, modes: [Arc<GearModes>; 2]) -> Result<(), StaticError> {
        self.modes = Some(modes);
        self.enter_modes()
    }

    /// The modes on the flanks of the window as it is.
    fn enter_modes(&mut self) -> Result<(), StaticError> {
        let Some([a, b]) = &self.modes else { return Ok(()) };
        let modal = ModalFlanks::new(&self.gears, [a, b], self.contact.contact_set())?;
        self.contact.keep_modes(modal);
        Ok(())
    }

    /// The same side at its beginning, with the same gears and tables.
    pub fn again(&self, pair: &GearPair) -> Result<Self, StaticError> {
        let (window, set) = self.home.clone();
        let mut again = Self {
            options: self.options.clone(),
            gears: Arc::clone(&self.gears),
            contact: MeshContact::new(pair, set.clone(), &self.options)?,
            window,
            home: (window, set),
            ahead: self.ahead,
            slack: self.slack,
            changes: Changes::default(),
            modes: self.modes.clone(),
        };
        again.enter_modes()?;
        Ok(again)
    }

    /// Forgets forces and places of the last solution: what comes then depends on the state alone.
    pub fn forget(&mut self) {
        self.contact.enter(self.contact.contact_set().clone());
    }

    /// Where the window stands.
    pub fn place(&self) -> SidePlace {
        SidePlace { first: self.window.first(), changes: self.changes }
    }

    /// Puts the window where it stood.
    pub fn stand(&mut self, pair: &GearPair, place: SidePlace) -> Result<(), StaticError> {
        let teeth = [pair.pinion.teeth(), pair.wheel.teeth()];
        let window = ToothWindow::new(place.first, self.window.count(), teeth)?;
        self.enter(pair, window, self.home.1.clone())?;
        self.changes = place.changes;
        Ok(())
    }

    /// The fillets of both gears, for [`MeshSide::root_stress`].
    pub fn root_fillets(&self, pair: &GearPair) -> RootStress {
        RootStress::new(pair, &self.gears)
    }

    /// Slices that carried load in the last evaluation.
    pub fn pressed_slices(&self) -> Vec<PressedSlice> {
        let (contact, set) = (&self.contact, self.contact.contact_set());
        let loaded = contact.rows().iter().zip(contact.slices()).zip(contact.solver().forces());
        loaded
            .filter(|(_, f)| **f > 0.0)
            .map(|((row, slice), &f)| PressedSlice {
                pair: self.window.first() + set.pair_of(row.patches.0) as i64,
                slice: slice_result(slice, set.side(row.patches.0), f),
            })
            .collect()
    }

    /// Stress in the root fillets of the window under the forces of the last evaluation, which was at these poses.
    pub fn root_stress(
        &mut self,
        pair: &GearPair,
        poses: &[Pose; 2],
        roots: &RootStress,
    ) -> Result<[Vec<FilletStress>; 2], StaticError> {
        let rows = self.contact.supported_rows(poses);
        let set = self.contact.contact_set();
        let displacements =
            (!rows.is_empty()).then(|| set.displacements_under(&rows, self.contact.solver().forces())).flatten();
        let parts = Parts { pair, gears: &self.gears, set, window: &self.window, options: &self.options };
        roots.of(&parts, displacements.as_ref())
    }

    /// Goes over to a window, with the matrices of `set` where they serve it.
    fn enter(&mut self, pair: &GearPair, window: ToothWindow, mut set: ContactSet) -> Result<(), StaticError> {
        if set.move_to(&self.gears, &window)? {
            self.contact.enter(set);
        } else {
            let set = ContactSet::new(pair, &self.gears, &window, &self.options)?;
            self.contact = MeshContact::new(pair, set, &self.options)?;
        }
        self.window = window;
        self.enter_modes()
    }

    /// Angles of the gears' own frames against the common one in their nominal motion, rad.
    pub fn angles(&self, pair: &GearPair, cycles: f64) -> [f64; 2] {
        let poses = self.poses(pair, cycles, &Displacement::zeros());
        let pitches = [pair.pinion.pitch_angle(), pair.wheel.pitch_angle()];
        [0, 1].map(|g| {
            let turn = poses[g].rotation.into_inner();
            let shift = self.contact.contact_set().windows().map_or(0, |w| w[g].shift);
            2.0 * turn.k.atan2(turn.w) - f64::from(shift) * pitches[g]
        })
    }

    /// Frames of the matrices with the gears displaced by `d` from their nominal places.
    pub fn poses(&self, pair: &GearPair, cycles: f64, d: &Displacement) -> [Pose; 2] {
        let station = Station::at_cycles(cycles + self.ahead);
        let turns = [d[COORDINATES - 1], d[2 * COORDINATES - 1] + self.slack];
        let set = self.contact.contact_set();
        let nominal = frames(pair, set, &self.window, &self.options, station, turns);
        [0, 1].map(|g| {
            let at = COORDINATES * g;
            let moved = Vector3::new(d[at], d[at + 1], d[at + 2]);
            let tilt = UnitQuaternion::from_scaled_axis(Vector3::new(d[at + 3], d[at + 4], 0.0));
            let place = nominal[g].translation.vector + moved;
            Pose::from_parts(Translation3::from(place), tilt * nominal[g].rotation)
        })
    }

    /// Strain energy of contact with the gears displaced and deformed, N mm; the last evaluation is lost.
    pub fn energy(&mut self, pair: &GearPair, cycles: f64, at: &Posture) -> Result<f64, ContactError> {
        let poses = self.poses(pair, cycles, &at.d);
        self.contact.deform(at.q.as_slice());
        self.contact.evaluate_near(&poses, Want::Energy)?;
        Ok(self.contact.strain_energy())
    }

    /// Contact with the gears displaced and deformed; without `tangents` stiffness is any.
    pub fn evaluate(
        &mut self,
        pair: &GearPair,
        cycles: f64,
        at: &Posture,
        tangents: bool,
    ) -> Result<SideForce, ContactError> {
        let poses = self.poses(pair, cycles, &at.d);
        self.contact.deform(at.q.as_slice());
        let force = self.contact.evaluate_near(&poses, if tangents { Want::Tangent } else { Want::Forces })?;
        let all = vector(&force.wrench);
        let stiffness = SMatrix::from_fn(|i, j| -force.tangent[i][j]);
        let friction = self.friction(&poses);
        let modal = self.contact.modal().map(|modal| {
            let (forces, n) = (modal.forces(), 2 * COORDINATES + modal.count());
            ModalForce {
                normal: DVector::from_column_slice(&forces.normal),
                friction: DVector::from_column_slice(&forces.friction),
                stiffness: tangents.then(|| -DMatrix::from_row_slice(n, n, &forces.tangent)),
            }
        });
        Ok(SideForce { normal: all - friction, friction, stiffness, modal })
    }

    /// Deepest overlap of the flanks at the place of the last evaluation, deformed by the kept modes alone, mm; negative where they are apart. Then, with modes, the last evaluation
    /// is lost.
    pub fn overlap(&mut self, pair: &GearPair, cycles: f64, at: &Posture) -> f64 {
        // Where flanks overlap the deepest place is among the rows.
        let deepest = self.contact.rows().iter().fold(f64::MIN, |m, row| m.max(-row.gap));
        if deepest > 0.0 {
            return deepest;
        }
        let poses = self.poses(pair, cycles, &at.d);
        self.contact.deform(at.q.as_slice());
        self.contact.overlap(&poses)
    }

    /// Friction alone, from the rows of the last evaluation.
    fn friction(&self, poses: &[Pose; 2]) -> Displacement {
        let mut sum = Displacement::zeros();
        if self.options.friction == 0.0 {
            return sum;
        }
        for (row, &f) in self.contact.rows().iter().zip(self.contact.solver().forces()) {
            let force = f * (row.traction - row.normal);
            for (g, sign) in [1.0, -1.0].into_iter().enumerate() {
                let arm = row.position - poses[g].translation.vector;
                let moment = arm.cross(&force);
                for i in 0..3 {
                    sum[COORDINATES * g + i] += sign * force[i];
                    sum[COORDINATES * g + 3 + i] += sign * moment[i];
                }
            }
        }
        sum
    }

    /// Slices that carry force, with the gears at `poses` moving at `rate`.
    fn pressed<'a>(
        &'a self,
        poses: &'a [Pose; 2],
        rate: &'a Displacement,
        per_length: f64,
    ) -> impl Iterator<Item = Pressed> + 'a {
        let rows = self.contact.rows().iter().zip(self.contact.slices()).zip(self.contact.solver().forces());
        rows.filter(|(_, f)| **f > 0.0).map(move |((row, slice), &force)| {
            let mut j = Displacement::zeros();
            for (g, sign) in [1.0, -1.0].into_iter().enumerate() {
                let moment = (row.position - poses[g].translation.vector).cross(&row.normal);
                for i in 0..3 {
                    j[COORDINATES * g + i] = sign * row.normal[i];
                    j[COORDINATES * g + 3 + i] = sign * moment[i];
                }
            }
            Pressed { force, damping: per_length * slice.length, j, opening: j.dot(rate) }
        })
    }

    /// Damping of the slices that carry force: force on the coordinates and power taken; -df/d(velocity) is added to `matrix`.
    ///
    /// ```text
    /// F_d = -c h dg/dt,  |F_d| <= F
    /// ```
    /// Parting flanks let go at most as much as they press, so that none pulls; and flanks that meet are damped no harder than they press, so that the force
    /// does not jump where contact begins.
    ///
    /// dg/dt is the approach of the rigid bodies, also where modes are kept: the damper stands beside the whole compliance of the mesh, and its ratio does not mean another
    /// thing with every mode that is taken out of it. Modes have dampers of their own.
    pub fn damping(
        &self,
        poses: &[Pose; 2],
        rate: &Displacement,
        per_length: f64,
        mut matrix: Option<&mut SMatrix<f64, 12, 12>>,
    ) -> (Displacement, f64) {
        let (mut total, mut taken) = (Displacement::zeros(), 0.0);
        for slice in self.pressed(poses, rate, per_length) {
            let [force, slope, power] = slice.resisted();
            total -= force * slice.j;
            taken += power;
            if let Some(matrix) = &mut matrix {
                **matrix += slope * slice.j * slice.j.transpose();
            }
        }
        (total, taken)
    }

    /// Sum and least value of the normal forces of the slices with their damping, N; the least one tells whether any flank pulls. Zeros without contact.
    pub fn normal_forces(&self, poses: &[Pose; 2], rate: &Displacement, per_length: f64) -> [f64; 2] {
        let (mut sum, mut least) = (0.0, f64::INFINITY);
        for slice in self.pressed(poses, rate, per_length) {
            let total = slice.force - slice.resisted()[0];
            sum += total;
            least = least.min(total);
        }
        [sum, if least.is_finite() { least } else { 0.0 }]
    }

    /// The last evaluation.
    pub fn contact(&self) -> &MeshContact {
        &self.contact
    }

    /// The window, and how often it has moved.
    pub fn window(&self) -> (&ToothWindow, u64) {
        (&self.window, self.changes.count)
    }

    /// A pair beside the window whose undeformed flanks overlap, by the poses of the last evaluation.
    ///
    /// # Errors
    /// [`StaticError::Starved`].
    pub fn check_beside(&mut self, pair: &GearPair, cycles: f64, poses: &[Pose; 2]) -> Result<(), StaticError> {
        // Nothing is pressed where nothing overlaps, and a pair beside the window comes last.
        let deepest = self.contact.rows().iter().fold(0.0, |m: f64, row| m.max(-row.gap));
        if deepest == 0.0 {
            return Ok(());
        }
        let Self { options, window, ahead, contact, .. } = self;
        let set = contact.contact_set().clone();
        let station = Station::at_cycles(cycles + *ahead);
        let gap = |poses: &[Pose; 2]| Standing { pair, options, set: &set, window, station, poses }.gap_beside();
        if contact.gap_beside(poses, gap) > -1e-3 * deepest {
            return Ok(());
        }
        let standing = Standing { pair, options, set: &set, window, station, poses };
        match standing.overlap_beside(1e-3 * deepest) {
            None => Ok(()),
            Some((running, overlap)) => Err(StaticError::Starved {
                cycle: station.cycle,
                phase: station.phase,
                pair: running,
                window: window.count(),
                overlap_um: 1e3 * overlap,
                torque_nm: 1e-3 * options.torque,
            }),
        }
    }

    /// Moves the window by one tooth where that is due and the outgoing tooth carries nothing, by the forces of the last evaluation; `cycles` are those that
    /// the gears have turned.
    ///
    /// The rigid coordinates and velocities do not depend on the window, and elastic ones follow from them: a change leaves no trace
    /// in the motion as long as no force is dropped.
    pub fn follow(&mut self, pair: &GearPair, cycles: f64) -> Result<bool, StaticError> {
        let station = Station::at_cycles(cycles + self.ahead);
        let due = ToothWindow::nominal_first(station.centre(&self.options), self.window.count());
        let sense = self.options.sense;
        if due == self.window.first() {
            return Ok(false);
        }
        let back = (due - self.window.first()) * sense.sign() > 0;
        let going = if back { opposite(sense) } else { sense };
        let outgoing = self.window.outgoing(going);
        let forces = self.contact.force().pair_forces.clone();
        let index = usize::try_from(outgoing - self.window.first()).unwrap_or(0);
        let carried = forces.get(index).copied().unwrap_or(0.0);
        if carried != 0.0 {
            return Ok(false);
        }
        let next = self.window.change(going, &forces)?;
        self.enter(pair, next, self.contact.contact_set().clone())?;
        self.changes.count += 1;
        self.changes.dropped = self.changes.dropped.max(carried.abs());
        Ok(true)
    }

    /// Books what a change has done to the sum of normal forces, N.
    pub fn book_jump(&mut self, before: f64) {
        let after = self.contact.force().pair_forces.iter().sum::<f64>();
        self.changes.jump = self.changes.jump.max((after - before).abs());
    }
}

/// Damping of a slice that carries `force`, between -force and force.
fn limited(damping: f64, force: f64) -> f64 {
    damping.clamp(-force, force)
}

fn opposite(sense: ale::Sense) -> ale::Sense {
    match sense {
        ale::Sense::Ccw => ale::Sense::Cw,
        ale::Sense::Cw => ale::Sense::Ccw,
    }
}

/// Forces and moments of both gears as one vector.
fn vector(wrench: &[Wrench; 2]) -> Displacement {
    Displacement::from_fn(|i, _| {
        let w = &wrench[i / COORDINATES];
        if i % COORDINATES < 3 { w.force[i % 3] } else { w.moment[i % 3] }
    })
}
