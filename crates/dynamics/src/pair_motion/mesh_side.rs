//! Contact of the flanks on one side of the teeth, in motion.

use std::sync::Arc;

use ale::ToothWindow;
use contact::{ContactError, Pose};
use geometry::GearPair;
use nalgebra::{SMatrix, Translation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::{COORDINATES, Displacement};
use crate::{
    ContactSet, ElasticGear, MeshContact, StaticError, StaticOptions, Station, Wrench, equilibrium::frames,
    line::Standing, pose,
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
        Ok(Self { options, gears, window, contact, home, ahead, slack, changes: Changes::default() })
    }

    /// The same side at its beginning, with the same gears and tables.
    pub fn again(&self, pair: &GearPair) -> Result<Self, StaticError> {
        let (window, set) = self.home.clone();
        Ok(Self {
            options: self.options.clone(),
            gears: Arc::clone(&self.gears),
            contact: MeshContact::new(pair, set.clone(), &self.options)?,
            window,
            home: (window, set),
            ahead: self.ahead,
            slack: self.slack,
            changes: Changes::default(),
        })
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

    /// Goes over to a window, with the matrices of `set` where they serve it.
    fn enter(&mut self, pair: &GearPair, window: ToothWindow, mut set: ContactSet) -> Result<(), StaticError> {
        if set.move_to(&self.gears, &window)? {
            self.contact.enter(set);
        } else {
            let set = ContactSet::new(pair, &self.gears, &window, &self.options)?;
            self.contact = MeshContact::new(pair, set, &self.options)?;
        }
        self.window = window;
        Ok(())
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

    /// Contact with the gears displaced by `d`.
    pub fn evaluate(&mut self, pair: &GearPair, cycles: f64, d: &Displacement) -> Result<SideForce, ContactError> {
        let poses = self.poses(pair, cycles, d);
        let force = self.contact.evaluate_near(&poses)?;
        let all = vector(&force.wrench);
        let stiffness = SMatrix::from_fn(|i, j| -force.tangent[i][j]);
        let friction = self.friction(&poses);
        Ok(SideForce { normal: all - friction, friction, stiffness })
    }

    /// Deepest overlap of the undeformed flanks at the place of the last evaluation, mm; negative where they are apart.
    pub fn overlap(&mut self, pair: &GearPair, cycles: f64, d: &Displacement) -> f64 {
        // Where flanks overlap the deepest place is among the rows.
        let deepest = self.contact.rows().iter().fold(f64::MIN, |m, row| m.max(-row.gap));
        if deepest > 0.0 {
            return deepest;
        }
        let poses = self.poses(pair, cycles, d);
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

    /// Slices that carry force: what it is, dg/dd, and how fast the gap opens.
    fn pressed<'a>(
        &'a self,
        poses: &'a [Pose; 2],
        velocity: &'a Displacement,
    ) -> impl Iterator<Item = (f64, f64, Displacement, f64)> + 'a {
        let rows = self.contact.rows().iter().zip(self.contact.slices()).zip(self.contact.solver().forces());
        rows.filter(|(_, f)| **f > 0.0).map(|((row, slice), &f)| {
            let mut j = Displacement::zeros();
            for (g, sign) in [1.0, -1.0].into_iter().enumerate() {
                let moment = (row.position - poses[g].translation.vector).cross(&row.normal);
                for i in 0..3 {
                    j[COORDINATES * g + i] = sign * row.normal[i];
                    j[COORDINATES * g + 3 + i] = sign * moment[i];
                }
            }
            (f, slice.length, j, j.dot(velocity))
        })
    }

    /// Damping of the slices that carry force: force on the coordinates, -df/d(velocity), and power taken.
    ///
    /// ```text
    /// F_d = -c h dg/dt,  |F_d| <= F
    /// ```
    /// Parting flanks let go at most as much as they press, so that none pulls; and flanks that approach begin without a jump, which no implicit step could
    /// settle on.
    pub fn damping(
        &self,
        poses: &[Pose; 2],
        velocity: &Displacement,
        per_length: f64,
    ) -> (Displacement, SMatrix<f64, 12, 12>, f64) {
        let (mut force, mut matrix, mut power) = (Displacement::zeros(), SMatrix::<f64, 12, 12>::zeros(), 0.0);
        for (f, length, j, opening) in self.pressed(poses, velocity) {
            let c = per_length * length;
            let taken = (c * opening).clamp(-f, f);
            force -= taken * j;
            power += taken * opening;
            if (c * opening).abs() <= f {
                matrix += c * j * j.transpose();
            }
        }
        (force, matrix, power)
    }

    /// -df/dd of the contact with its damping, where some slices' damping is as large as their force and goes with it; `None` where there are none.
    pub fn stiffness_where_limited(
        &mut self,
        poses: &[Pose; 2],
        velocity: &Displacement,
        per_length: f64,
    ) -> Option<SMatrix<f64, 12, 12>> {
        let mut limited = Vec::new();
        let mut pressed = self.pressed(poses, velocity);
        for (i, f) in self.contact.solver().forces().iter().enumerate().filter(|(_, f)| **f > 0.0) {
            if let Some((_, length, _, opening)) = pressed.next()
                && per_length * length * opening.abs() > *f
            {
                limited.push((i, if opening > 0.0 { 0.0 } else { 2.0 }));
            }
        }
        drop(pressed);
        if limited.is_empty() {
            return None;
        }
        let share = |i: usize| limited.binary_search_by_key(&i, |l| l.0).map_or(1.0, |at| limited[at].1);
        let tangent = self.contact.tangent_with(share);
        Some(SMatrix::from_fn(|i, j| -tangent[i][j]))
    }

    /// Sum and least value of the normal forces of the slices with their damping, N; the least one tells whether any flank pulls. Zeros without contact.
    pub fn normal_forces(&self, poses: &[Pose; 2], velocity: &Displacement, per_length: f64) -> [f64; 2] {
        let (mut sum, mut least) = (0.0, f64::INFINITY);
        for (f, length, _, opening) in self.pressed(poses, velocity) {
            let total = f - (per_length * length * opening).clamp(-f, f);
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
    pub fn check_beside(&self, pair: &GearPair, cycles: f64, poses: &[Pose; 2]) -> Result<(), StaticError> {
        // Nothing is pressed where nothing overlaps, and a pair beside the window comes last.
        let deepest = self.contact.rows().iter().fold(0.0, |m: f64, row| m.max(-row.gap));
        if deepest == 0.0 {
            return Ok(());
        }
        let Self { options, window, ahead, .. } = self;
        let (set, station) = (self.contact.contact_set(), Station::at_cycles(cycles + ahead));
        let standing = Standing { pair, options, set, window, station, poses };
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
