//! Contact of the flanks on one side of the teeth, in motion.

use ale::ToothWindow;
use contact::{ContactError, Pose};
use geometry::GearPair;
use nalgebra::{SMatrix, Translation3, UnitQuaternion, Vector3};

use super::{COORDINATES, Displacement};
use crate::{
    ContactSet, ElasticGear, MeshContact, StaticError, StaticOptions, Station, Wrench, equilibrium::frames, pose,
};

/// One side of the teeth: the flanks that drive, or those that touch when torque reverses.
#[derive(Debug)]
pub(super) struct MeshSide {
    options: StaticOptions,
    gears: [ElasticGear; 2],
    window: ToothWindow,
    contact: MeshContact,
    /// Mesh cycles that this side is ahead of the pair's counting.
    ahead: f64,
    /// Turn of the wheel from where these flanks touch to where the driving ones do, rad: backlash on the coast side.
    slack: f64,
    changes: u64,
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
        gears: [ElasticGear; 2],
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
        let contact = MeshContact::new(pair, set, &options)?;
        Ok(Self { options, gears, window, contact, ahead, slack, changes: 0 })
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
        let force = self.contact.evaluate(&poses)?;
        let all = vector(&force.wrench);
        let stiffness = SMatrix::from_fn(|i, j| -force.tangent[i][j]);
        let friction = self.friction(&poses);
        Ok(SideForce { normal: all - friction, friction, stiffness })
    }

    /// Deepest overlap of the undeformed flanks, mm; negative where they are apart.
    pub fn overlap(&mut self, pair: &GearPair, cycles: f64, d: &Displacement) -> f64 {
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

    /// Damping of the slices that carry force: force on the coordinates, -df/d(velocity), and power taken.
    ///
    /// ```text
    /// F_d = -c h dg/dt,  F + F_d >= 0
    /// ```
    pub fn damping(
        &self,
        poses: &[Pose; 2],
        velocity: &Displacement,
        per_length: f64,
    ) -> (Displacement, SMatrix<f64, 12, 12>, f64) {
        let (mut force, mut matrix, mut power) = (Displacement::zeros(), SMatrix::<f64, 12, 12>::zeros(), 0.0);
        let rows = self.contact.rows().iter().zip(self.contact.slices()).zip(self.contact.solver().forces());
        for ((row, slice), &f) in rows.filter(|(_, f)| **f > 0.0) {
            let mut j = Displacement::zeros();
            for (g, sign) in [1.0, -1.0].into_iter().enumerate() {
                let moment = (row.position - poses[g].translation.vector).cross(&row.normal);
                for i in 0..3 {
                    j[COORDINATES * g + i] = sign * row.normal[i];
                    j[COORDINATES * g + 3 + i] = sign * moment[i];
                }
            }
            let c = per_length * slice.length;
            let opening = j.dot(velocity);
            // Parting flanks let go at most as much as they press.
            if c * opening <= f {
                force -= c * opening * j;
                matrix += c * j * j.transpose();
                power += c * opening * opening;
            } else {
                force -= f * j;
                power += f * opening;
            }
        }
        (force, matrix, power)
    }

    /// The last evaluation.
    pub fn contact(&self) -> &MeshContact {
        &self.contact
    }

    /// The window, and how often it has moved.
    pub fn window(&self) -> (&ToothWindow, u64) {
        (&self.window, self.changes)
    }

    /// Moves the window where that is due and the outgoing tooth carries nothing, by the forces of the last evaluation.
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
        if forces.get(index).is_some_and(|f| *f != 0.0) {
            return Ok(false);
        }
        let next = self.window.change(going, &forces)?;
        let mut set = self.contact.contact_set().clone();
        if set.move_to(&self.gears, &next)? {
            self.contact.enter(set);
        } else {
            let set = ContactSet::new(pair, &self.gears, &next, &self.options)?;
            self.contact = MeshContact::new(pair, set, &self.options)?;
        }
        self.window = next;
        self.changes += 1;
        Ok(true)
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
