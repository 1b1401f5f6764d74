//! Forces that do not come from the teeth: loads, drives, gyroscopic moments.

use geometry::Gear;
use nalgebra::{Matrix3, SMatrix};

use super::PairMechanism;
use crate::{COORDINATES, Displacement, Drive, NominalState, RigidBody};

impl PairMechanism {
    /// Force of the load torque along the driven gear's lag, N.
    pub(crate) fn load_on_lag(&self, t: f64) -> f64 {
        let driven = self.options.statics.driven();
        self.options.load.at(t) / [self.pair.pinion.base_radius(), self.pair.wheel.base_radius()][driven].abs()
    }

    /// Loads and drive torque as forces on the twelve coordinates, and inertia of a nominal motion that is not steady.
    pub(crate) fn external(&self, t: f64, nominal: &NominalState) -> Displacement {
        let contact = &self.options.statics;
        let driven = contact.driven();
        let turn = |g: usize| COORDINATES * (g + 1) - 1;
        let mut f = Displacement::zeros();
        // Against the driven gear's running sense.
        f[turn(driven)] -= nominal.senses[driven] * self.options.load.at(t);
        if let Drive::Torque { torque, .. } = &self.options.drive {
            f[turn(1 - driven)] += nominal.senses[1 - driven] * torque.at(t);
        }
        for (g, body) in self.options.bodies.iter().enumerate() {
            f[turn(g)] -= body.polar_inertia * nominal.acceleration[g];
        }
        f
    }

    pub(crate) fn gyroscopic(&self, nominal: &NominalState) -> SMatrix<f64, 12, 12> {
        let mut g = SMatrix::<f64, 12, 12>::zeros();
        for (i, body) in self.options.bodies.iter().enumerate() {
            let at = COORDINATES * i + 3;
            let block: Matrix3<f64> = RigidBody::gyroscopic(body, nominal.velocity[i]);
            g.fixed_view_mut::<3, 3>(at, at).copy_from(&block);
        }
        g
    }

    /// Torque of a driver that balances the load, about +z, N mm: no force is left along the turn of both gears in the
    /// ratio of their teeth; normal forces do no work there. Theory (45b).
    ///
    /// `other`: all forces but those, on the twelve coordinates. Nothing with another drive.
    pub(crate) fn balancing_torque(&self, other: &Displacement) -> f64 {
        if !matches!(self.options.drive, Drive::Balanced(_)) {
            return 0.0;
        }
        let driven = self.options.statics.driven();
        let turn = |g: usize| other[COORDINATES * (g + 1) - 1];
        let teeth = [&self.pair.pinion, &self.pair.wheel].map(Gear::signed_teeth);
        teeth[1 - driven] / teeth[driven] * turn(driven) - turn(1 - driven)
    }

    /// Torque of the driver in the running sense, N mm: the one given, or the one that keeps its speed. `mesh`: forces
    /// of the mesh, `losses` friction and damping among them.
    pub(super) fn drive_torque(
        &self,
        t: f64,
        nominal: &NominalState,
        mesh: &Displacement,
        losses: &Displacement,
    ) -> f64 {
        let driver = 1 - self.options.statics.driven();
        let running = nominal.senses[driver];
        match &self.options.drive {
            Drive::Torque { torque, .. } => torque.at(t),
            Drive::Balanced(_) => running * self.balancing_torque(&(self.external(t, nominal) + losses)),
            Drive::Speed(_) => {
                let inertia = self.options.bodies[driver].polar_inertia * nominal.acceleration[driver];
                running * (inertia - mesh[COORDINATES * (driver + 1) - 1])
            }
        }
    }
}
