//! Equations of motion of a pair.

use geometry::GearPair;
use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector3};

use super::{
    COORDINATES, Coordinates, Displacement, Drive, MeshDamping, Moment, MotionOptions, Nominal, RigidBody, Speed,
    mesh_side::{MeshSide, SideForce},
};
use crate::{
    ElasticGear, StaticError, StaticOptions,
    motion::{Forces, Mechanism},
};

/// A pair of gears as an integrator sees it.
///
/// ```text
/// M q'' = T' [w(d) + w_f(d) + w_d(d, d') - K_b d - C_b d' + gyroscopic + load + drive - M a_nominal],   d = T q
/// V = strain energy of teeth and bodies + d' K_b d / 2
/// ```
/// w normal contact forces on both gears and w_f, w_d friction and mesh damping; all elasticity is quasi-static in w. Coordinates are
/// deviations from the nominal motion, in which rigid gears turn in the ratio of their teeth.
#[derive(Debug)]
pub struct PairMechanism {
    pair: GearPair,
    options: MotionOptions,
    coordinates: Coordinates,
    mass: DMatrix<f64>,
    nominal: Nominal,
    drive_side: MeshSide,
    coast_side: Option<MeshSide>,
    bearing: [SMatrix<f64, 12, 12>; 2],
    /// Mesh damping per length of contact line, N s/mm^2.
    damping: f64,
}

/// What the results hold of one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Instant {
    /// Time, s.
    pub time: f64,
    /// Nominal motion.
    pub nominal: Moment,
    /// Mesh cycles since the start of counting.
    pub cycles: f64,
    /// Lag of the driven gear behind the nominal motion on its base circle, mm: the dynamic transmission error.
    pub transmission_error: f64,
    /// Displacements of both gears.
    pub displacement: Displacement,
    /// Forces (N) and moments (N mm) of the mesh on both gears: normal, friction and damping.
    pub mesh: Displacement,
    /// Forces of the bearings on both gears.
    pub bearing: Displacement,
    /// Normal force of each pair of the window on the driving side, N, by running number from `first_pair` on; elastic part.
    pub pair_forces: Vec<f64>,
    /// Running number of the first pair of the window.
    pub first_pair: i64,
    /// Sum of normal forces on driving and coast flanks, N.
    pub normal_forces: [f64; 2],
    /// Length of loaded slices, driving side, mm.
    pub contact_line_length: f64,
    /// Largest pressure, MPa.
    pub max_pressure: f64,
    /// Tooth changes so far.
    pub tooth_changes: u64,
}

impl PairMechanism {
    /// A pair whose driving flanks' gears are `driving`, and, for contact on the coast flanks, `coast`. `mesh_stiffness` (N/mm on the base circle)
    /// and `line_length` (mm) are means that a damping ratio refers to.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn new(
        pair: GearPair,
        driving: [ElasticGear; 2],
        coast: Option<[ElasticGear; 2]>,
        options: MotionOptions,
        [mesh_stiffness, line_length]: [f64; 2],
    ) -> Result<Self, StaticError> {
        let mut free = options.free;
        let driver = 1 - options.contact.driven();
        let (speed, by_torque) = match &options.drive {
            Drive::Speed(speed) => (*speed, false),
            Drive::Torque { start, .. } => (Speed::Constant(*start), true),
        };
        free[driver][COORDINATES - 1] = by_torque;
        let coordinates = Coordinates::new(&pair, &options.contact, free);
        let mass = coordinates.mass(&options.bodies);
        let nominal = Nominal { speed, start: options.start_cycles };
        let cycles = options.start_cycles;
        let drive_side = MeshSide::new(&pair, driving, options.contact.clone(), &options.contact, cycles)?;
        let coast_side = coast
            .map(|gears| {
                let driver = match options.contact.driver {
                    crate::Driver::Pinion => crate::Driver::Wheel,
                    crate::Driver::Wheel => crate::Driver::Pinion,
                };
                let own = StaticOptions { driver, ..options.contact.clone() };
                MeshSide::new(&pair, gears, own, &options.contact, cycles)
            })
            .transpose()?;
        let both = |part: fn(&super::Bearing) -> nalgebra::Matrix6<f64>| {
            let mut all = SMatrix::<f64, 12, 12>::zeros();
            for (g, b) in options.bearings.iter().enumerate() {
                all.fixed_view_mut::<6, 6>(6 * g, 6 * g).copy_from(&part(b));
            }
            all
        };
        let bearing = [both(|b| b.stiffness), both(|b| b.damping)];
        let damping = match options.damping {
            MeshDamping::PerLength(c) => c,
            MeshDamping::Ratio(zeta) => {
                let base = [pair.pinion.base_radius(), pair.wheel.base_radius()];
                let inertia = [0, 1].map(|i| options.bodies[i].polar_inertia / (base[i] * base[i]));
                let held = !free[driver][COORDINATES - 1];
                let equivalent = equivalent_mass(inertia, held.then_some(driver));
                // c of the base circle; a slice moves by cos(b_b) of it, and so does its force.
                let cos = pair.base_helix_angle().cos();
                2.0 * zeta * (mesh_stiffness * equivalent).sqrt() / (line_length * cos * cos)
            }
        };
        Ok(Self { pair, options, coordinates, mass, nominal, drive_side, coast_side, bearing, damping })
    }

    /// Free coordinates.
    pub fn coordinates(&self) -> &Coordinates {
        &self.coordinates
    }

    /// Nominal motion.
    pub fn nominal(&self) -> &Nominal {
        &self.nominal
    }

    /// The pair.
    pub fn pair(&self) -> &GearPair {
        &self.pair
    }

    fn cycles(&self, t: f64) -> f64 {
        self.nominal.cycles(&self.pair, &self.options.contact, t)
    }

    fn moment(&self, t: f64) -> Moment {
        self.nominal.at(&self.pair, &self.options.contact, t)
    }

    /// Contact of both sides.
    fn contact(&mut self, t: f64, d: &Displacement) -> Result<(SideForce, Option<SideForce>), StaticError> {
        let cycles = self.cycles(t);
        let Self { pair, drive_side, coast_side, .. } = self;
        let station = crate::Station::at_cycles(cycles);
        let fail = |source| StaticError::Contact { cycle: station.cycle, phase: station.phase, source };
        let driving = drive_side.evaluate(pair, cycles, d).map_err(fail)?;
        let coast = coast_side.as_mut().map(|side| side.evaluate(pair, cycles, d)).transpose().map_err(fail)?;
        Ok((driving, coast))
    }

    /// Loads and drive torque as forces on the twelve coordinates, and inertia of a nominal motion that is not steady.
    fn external(&self, t: f64, moment: &Moment) -> Displacement {
        let contact = &self.options.contact;
        let driven = contact.driven();
        let turn = |g: usize| COORDINATES * (g + 1) - 1;
        let mut f = Displacement::zeros();
        // The load lets the driven gear lag; its turn is positive when it lags towards the side's sign.
        f[turn(driven)] += contact.side().sign() * self.options.load.at(t);
        if let Drive::Torque { torque, .. } = &self.options.drive {
            f[turn(1 - driven)] += moment.velocity[1 - driven].signum() * torque.at(t);
        }
        for (g, body) in self.options.bodies.iter().enumerate() {
            f[turn(g)] -= body.polar_inertia * moment.acceleration[g];
        }
        f
    }

    fn gyroscopic(&self, moment: &Moment) -> SMatrix<f64, 12, 12> {
        let mut g = SMatrix::<f64, 12, 12>::zeros();
        for (i, body) in self.options.bodies.iter().enumerate() {
            let at = COORDINATES * i + 3;
            let block: Matrix3<f64> = RigidBody::gyroscopic(body, moment.velocity[i]);
            g.fixed_view_mut::<3, 3>(at, at).copy_from(&block);
        }
        g
    }

    /// Everything the results hold of a state.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn instant(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<Instant, StaticError> {
        let (d, rate) = (self.coordinates.displacement(q), self.coordinates.displacement(v));
        let (driving, coast) = self.contact(t, &d)?;
        let cycles = self.cycles(t);
        let poses = self.drive_side.poses(&self.pair, cycles, &d);
        let mut mesh = driving.normal + driving.friction + self.drive_side.damping(&poses, &rate, self.damping).0;
        if let (Some(side), Some(force)) = (&self.coast_side, &coast) {
            let poses = side.poses(&self.pair, cycles, &d);
            mesh += force.normal + force.friction + side.damping(&poses, &rate, self.damping).0;
        }
        let sum = |side: &MeshSide| side.contact().solver().forces().iter().sum::<f64>();
        let contact = self.drive_side.contact();
        let loaded = contact.slices().iter().zip(contact.solver().forces()).filter(|(_, f)| **f > 0.0);
        let (mut length, mut pressure) = (0.0, 0.0f64);
        for (slice, f) in loaded {
            length += slice.length;
            pressure = pressure.max(slice.local.under(f / slice.length).pressure);
        }
        let (window, tooth_changes) = self.drive_side.window();
        Ok(Instant {
            time: t,
            nominal: self.moment(t),
            cycles,
            transmission_error: q[self.coordinates.lag()],
            displacement: d,
            mesh,
            bearing: -(self.bearing[0] * d + self.bearing[1] * rate),
            pair_forces: contact.force().pair_forces.clone(),
            first_pair: window.first(),
            normal_forces: [sum(&self.drive_side), self.coast_side.as_ref().map_or(0.0, sum)],
            contact_line_length: length,
            max_pressure: pressure,
            tooth_changes,
        })
    }
}

/// Reduced mass on the base circles of two inertias, one of them perhaps held, t.
pub fn equivalent_mass([a, b]: [f64; 2], held: Option<usize>) -> f64 {
    match held {
        Some(0) => b,
        Some(_) => a,
        None => a * b / (a + b),
    }
}

/// The turn of a tilted gear is about its own axis.
fn about_own_axis(mut f: Displacement, d: &Displacement) -> Displacement {
    for g in 0..2 {
        let at = COORDINATES * g + 3;
        let tilt = nalgebra::UnitQuaternion::from_scaled_axis(Vector3::new(d[at], d[at + 1], 0.0));
        let moment = Vector3::new(f[at], f[at + 1], f[at + 2]);
        f[at + 2] = moment.dot(&(tilt * Vector3::z()));
    }
    f
}

impl Mechanism for PairMechanism {
    type Error = StaticError;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), StaticError> {
        let (d, rate) = (self.coordinates.displacement(q), self.coordinates.displacement(v));
        let moment = self.moment(t);
        let (driving, coast) = self.contact(t, &d)?;
        let cycles = self.cycles(t);
        let mut normal = Displacement::zeros();
        let mut other = self.external(t, &moment);
        out.supplied = other.dot(&rate);
        let mut stiffness = self.bearing[0];
        let mut damping = self.bearing[1];
        out.dissipated = rate.dot(&(self.bearing[1] * rate));
        for (side, force) in [(Some(&self.drive_side), Some(&driving)), (self.coast_side.as_ref(), coast.as_ref())] {
            let (Some(side), Some(force)) = (side, force) else { continue };
            normal += force.normal;
            other += force.friction;
            stiffness += force.stiffness;
            let poses = side.poses(&self.pair, cycles, &d);
            let (damped, matrix, power) = side.damping(&poses, &rate, self.damping);
            other += damped;
            damping += matrix;
            out.dissipated += power;
            // Friction takes its power from the nominal motion as well; in the ledger of deviations it is their part that counts.
            out.dissipated -= force.friction.dot(&rate);
        }
        let gyroscopic = self.gyroscopic(&moment);
        other -= self.bearing[1] * rate;
        other -= gyroscopic * rate;
        damping += gyroscopic;
        let conservative = normal - self.bearing[0] * d;
        self.coordinates.add_force(&about_own_axis(conservative, &d), &mut out.conservative);
        self.coordinates.add_force(&about_own_axis(other, &d), &mut out.other);
        if out.tangents {
            self.coordinates.add_matrix(&stiffness, 1.0, &mut out.stiffness);
            self.coordinates.add_matrix(&damping, 1.0, &mut out.damping);
        } else {
            // A ten-thousandth of a mesh cycle either way.
            let pitch = self.pair.pinion.pitch_angle();
            let step = 1e-4 * pitch / moment.velocity[0].abs().max(f64::MIN_POSITIVE);
            out.parametric = (self.potential(t + step, q)? - self.potential(t - step, q)?) / (2.0 * step);
        }
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, StaticError> {
        let d = self.coordinates.displacement(q);
        self.contact(t, &d)?;
        let of = |side: &MeshSide| side.contact().force().strain_energy;
        let contact = of(&self.drive_side) + self.coast_side.as_ref().map_or(0.0, of);
        Ok(contact + 0.5 * d.dot(&(self.bearing[0] * d)))
    }

    fn events(&self) -> usize {
        1 + usize::from(self.coast_side.is_some())
    }

    /// Least gap of the driving flanks and of the coast flanks, mm, with the sign turned: positive in contact.
    fn event_values(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut [f64]) -> Result<(), StaticError> {
        let d = self.coordinates.displacement(q);
        let cycles = self.cycles(t);
        let pair = &self.pair;
        for (side, value) in std::iter::once(&mut self.drive_side).chain(self.coast_side.as_mut()).zip(out) {
            *value = side.overlap(pair, cycles, &d);
        }
        Ok(())
    }

    fn accepted(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>) -> Result<(), StaticError> {
        let cycles = self.cycles(t);
        let d = self.coordinates.displacement(q);
        self.contact(t, &d)?;
        self.drive_side.follow(&self.pair, cycles)?;
        if let Some(side) = &mut self.coast_side {
            side.follow(&self.pair, cycles)?;
        }
        Ok(())
    }
}
