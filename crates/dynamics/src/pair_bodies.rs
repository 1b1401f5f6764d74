//! The bodies of a pair: two rigid gears on bearings, with a drive and a load. What acts between their flanks is no matter
//! here.

use geometry::GearPair;
use nalgebra::{DMatrix, DVector, Matrix6, SMatrix};

use crate::{
    Bearing, COORDINATES, Coordinates, Displacement, Drive, MotionOptions, Nominal, NominalState, Speed, Torque,
    equivalent_mass::{equivalent_mass_of, masses_on_base_circles},
};

/// Two rigid gears on bearings, with a drive and a load.
///
/// ```text
/// M q'' = T' [flanks - K_b d - C_b d' - G d' + load + drive - M a_nominal],   d = T q
/// ```
/// Coordinates are deviations from the nominal motion, in which rigid gears turn in the ratio of their teeth.
#[derive(Debug, Clone)]
pub struct PairBodies {
    pub(crate) pair: GearPair,
    pub(crate) options: MotionOptions,
    pub(crate) coordinates: Coordinates,
    pub(crate) nominal: Nominal,
    /// Stiffness and damping of the bearings.
    pub(crate) bearing: [SMatrix<f64, 12, 12>; 2],
}

impl PairBodies {
    /// Bodies of a pair.
    pub fn new(pair: GearPair, options: MotionOptions) -> Self {
        let mut free = options.free;
        let driver = 1 - options.statics.driven();
        let (speed, by_torque) = match &options.drive {
            Drive::Speed(speed) | Drive::Balanced(speed) => (*speed, false),
            Drive::Torque { start, .. } => (Speed::Constant(*start), true),
        };
        free[driver][COORDINATES - 1] = by_torque;
        let mut coordinates = Coordinates::new(&pair, &options.statics, free);
        if matches!(options.drive, Drive::Balanced(_)) {
            coordinates = coordinates.sharing_the_lag(&pair, &options.statics, &options.bodies);
        }
        let nominal = Nominal { speed, start: options.start_cycles };
        let both = |part: fn(&Bearing) -> Matrix6<f64>| {
            let mut all = SMatrix::<f64, 12, 12>::zeros();
            for (g, b) in options.bearings.iter().enumerate() {
                all.fixed_view_mut::<6, 6>(6 * g, 6 * g).copy_from(&part(b));
            }
            all
        };
        let bearing = [both(|b| b.stiffness), both(|b| b.damping)];
        Self { pair, options, coordinates, nominal, bearing }
    }

    /// The pair.
    pub fn pair(&self) -> &GearPair {
        &self.pair
    }

    /// Options of the motion.
    pub fn options(&self) -> &MotionOptions {
        &self.options
    }

    /// Free coordinates.
    pub fn coordinates(&self) -> &Coordinates {
        &self.coordinates
    }

    /// Nominal motion.
    pub fn nominal(&self) -> &Nominal {
        &self.nominal
    }

    /// Mass matrix of the free coordinates.
    pub fn mass_matrix(&self) -> DMatrix<f64> {
        self.coordinates.mass(&self.options.bodies)
    }

    /// Stiffness and damping of the bearings on the twelve coordinates.
    pub fn bearings(&self) -> [SMatrix<f64, 12, 12>; 2] {
        self.bearing
    }

    /// Inertias of pinion and wheel on their base circles, J / r_b^2, t.
    pub fn base_circle_masses(&self) -> [f64; 2] {
        masses_on_base_circles(&self.pair, &self.options.bodies)
    }

    /// Inertia that vibrates on the mesh, t: of both gears, or of the driven one alone where the driver's angle is
    /// prescribed.
    pub fn equivalent_mass(&self) -> f64 {
        equivalent_mass_of(&self.pair, &self.options)
    }

    /// Time (s) at which the nominal motion has turned so many mesh cycles since the start.
    pub(crate) fn time_of_cycles(&self, cycles: f64) -> Option<f64> {
        self.nominal.time_at(&self.pair, &self.options.statics, cycles)
    }

    /// Mesh cycles a second at time `t` (s), of the nominal motion.
    pub(crate) fn cycles_per_second(&self, t: f64) -> f64 {
        self.nominal.cycles_per_second(&self.pair, &self.options.statics, t)
    }

    /// Mesh cycles of the nominal motion at time `t` (s).
    pub fn cycles(&self, t: f64) -> f64 {
        self.nominal.cycles(&self.pair, &self.options.statics, t)
    }

    /// Nominal motion at time `t` (s).
    pub fn nominal_state(&self, t: f64) -> NominalState {
        self.nominal.at(&self.pair, &self.options.statics, t)
    }

    /// Velocities of both gears in the nominal motion, on the twelve coordinates.
    pub fn turning(nominal: &NominalState) -> Displacement {
        let mut all = Displacement::zeros();
        for (g, velocity) in nominal.velocity.iter().enumerate() {
            all[COORDINATES * (g + 1) - 1] = *velocity;
        }
        all
    }

    /// Mesh cycles that the gears have turned, a driver's own deviation from its nominal turn included.
    pub(crate) fn turned_cycles(&self, t: f64, d: &Displacement) -> f64 {
        let contact = &self.options.statics;
        if self.coordinates.driver_turn().is_none() {
            return self.cycles(t);
        }
        let driver = 1 - contact.driven();
        let gear = [&self.pair.pinion, &self.pair.wheel][driver];
        // The wheel turns against the pinion's sense.
        let sense = contact.contact.sense.sign() as f64 * [1.0, -1.0][driver];
        self.cycles(t) + sense * d[COORDINATES * (driver + 1) - 1] / gear.pitch_angle()
    }

    /// Puts the mean of the load in its place; gives the load.
    pub(crate) fn hold_mean_load(&mut self) -> Torque {
        // Of a table the scene's torque is what scales are taken from.
        let mean = self.options.load.mean().unwrap_or(self.options.statics.torque);
        std::mem::replace(&mut self.options.load, Torque::Constant(mean))
    }

    /// Force of the load torque along the driven gear's lag, N.
    pub(crate) fn load_on_lag(&self, t: f64) -> f64 {
        let driven = self.options.statics.driven();
        self.options.load.at(t) / [self.pair.pinion.base_radius(), self.pair.wheel.base_radius()][driven]
    }

    /// Loads and drive torque as forces on the twelve coordinates, and inertia of a nominal motion that is not steady.
    pub fn external(&self, t: f64, nominal: &NominalState) -> Displacement {
        let contact = &self.options.statics;
        let driven = contact.driven();
        let turn = |g: usize| COORDINATES * (g + 1) - 1;
        let mut f = Displacement::zeros();
        // The load lets the driven gear lag; its turn is positive when it lags towards the side's sign.
        f[turn(driven)] += contact.side().sign() * self.options.load.at(t);
        if let Drive::Torque { torque, .. } = &self.options.drive {
            f[turn(1 - driven)] += nominal.running_sense(1 - driven) * torque.at(t);
        }
        for (g, body) in self.options.bodies.iter().enumerate() {
            f[turn(g)] -= body.polar_inertia * nominal.acceleration[g];
        }
        f
    }

    /// Gyroscopic matrix on the twelve coordinates.
    pub fn gyroscopic(&self, nominal: &NominalState) -> SMatrix<f64, 12, 12> {
        let mut g = SMatrix::<f64, 12, 12>::zeros();
        for (i, body) in self.options.bodies.iter().enumerate() {
            let at = COORDINATES * i + 3;
            g.fixed_view_mut::<3, 3>(at, at).copy_from(&body.gyroscopic(nominal.velocity[i]));
        }
        g
    }

    /// Gyroscopic matrix with the pinion at 1 rad/s.
    pub(crate) fn gyroscopic_at_unit_speed(&self) -> SMatrix<f64, 12, 12> {
        let ratio = f64::from(self.pair.pinion.teeth()) / f64::from(self.pair.wheel.teeth());
        let nominal = self.nominal_state(0.0);
        self.gyroscopic(&NominalState { velocity: [1.0, -ratio], ..nominal })
    }

    /// Torque of a driver that balances the load, about +z, N mm: no force is left along the turn of both gears in the
    /// ratio of their teeth; normal forces do no work there. Theory (45b).
    ///
    /// `other`: all forces but those, on the twelve coordinates. Nothing with another drive.
    pub fn balancing_torque(&self, other: &Displacement) -> f64 {
        if !matches!(self.options.drive, Drive::Balanced(_)) {
            return 0.0;
        }
        let driven = self.options.statics.driven();
        let turn = |g: usize| other[COORDINATES * (g + 1) - 1];
        let teeth = [self.pair.pinion.teeth(), self.pair.wheel.teeth()].map(f64::from);
        teeth[1 - driven] / teeth[driven] * turn(driven) - turn(1 - driven)
    }

    /// Velocity of the driver's turn beside the nominal one, rad/s, from those of the free coordinates.
    pub(crate) fn driver_rate(&self, v: &DVector<f64>) -> f64 {
        let driver = 1 - self.options.statics.driven();
        self.coordinates.map().row(COORDINATES * (driver + 1) - 1).tr_dot(&v.rows(0, self.coordinates.count()))
    }

    /// Torque of the driver in the running sense, N mm: the one given, or the one that keeps its speed. `mesh`: forces
    /// of the mesh, `losses` friction and damping among them.
    pub(crate) fn drive_torque(
        &self,
        t: f64,
        nominal: &NominalState,
        mesh: &Displacement,
        losses: &Displacement,
    ) -> f64 {
        let driver = 1 - self.options.statics.driven();
        let running = nominal.running_sense(driver);
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
