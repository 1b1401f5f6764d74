//! Equations of motion of a pair. Theory (45).

use std::sync::Arc;

use geometry::GearPair;
use nalgebra::{DMatrix, DVector, Matrix3, SMatrix, Vector3};
use serde::{Deserialize, Serialize};

use super::{
    COORDINATES, Changes, Coordinates, Displacement, Drive, Instant, MeshDamping, Moment, MotionOptions, Nominal,
    RigidBody, SidePlace, Speed, contact_line,
    mesh_side::{MeshSide, SideForce},
    modal::{GearVibration, Modal, ModalBalance, Posture, expansion},
};
use crate::{
    ElasticGear, StaticError,
    motion::{Forces, Mechanism},
};

/// A pair of gears as an integrator sees it.
///
/// ```text
/// M q'' = T' [w(d) + w_f(d) + w_d(d, d') - K_b d - C_b d' + gyroscopic + load + drive - M a_nominal],   d = T q
/// V = strain energy of teeth and bodies + d' K_b d / 2
/// ```
/// w normal contact forces on both gears and w_f, w_d friction and mesh damping; all elasticity is quasi-static in w. Coordinates are
/// deviations from the nominal motion, in which rigid gears turn in the ratio of their teeth. With [`PairMechanism::with_modes`] coordinates of
/// normal modes of both gears come behind the rigid ones.
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
    /// Stiffness (N/mm) and length of contact lines (mm) that damping refers to.
    means: [f64; 2],
    modal: Option<Modal>,
    last: Option<Touching>,
    extremes: Extremes,
}

/// Contact of both sides at one time and displacement.
#[derive(Debug, Clone)]
struct Touching {
    at: (f64, Posture),
    driving: SideForce,
    coast: Option<SideForce>,
}

/// What is worth knowing of a whole motion, gathered step by step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Extremes {
    /// Least normal force of a slice in contact, damping included, N; none before the first step in contact. Below 0 a flank would pull.
    pub least_force: Option<f64>,
    /// Largest sum of normal forces on the driving flanks, damping included, N.
    pub largest_force: f64,
    /// Largest gap between the driving flanks of all pairs, mm; 0 when contact was never lost at the end of a step.
    pub largest_gap: f64,
    /// Steps whose end has no contact on the driving flanks.
    pub steps_apart: u64,
    /// Steps whose end has contact on the coast flanks.
    pub steps_on_coast: u64,
}

/// Where both windows stand and what has been gathered: with a [`crate::motion::State`] all that a motion is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// Driving flanks.
    pub driving: SidePlace,
    /// Coast flanks.
    pub coast: Option<SidePlace>,
    /// Gathered so far.
    pub extremes: Extremes,
}

impl PairMechanism {
    /// A pair whose driving flanks' gears are `driving`, and, for contact on the coast flanks, `coast`. `means`: mesh stiffness (N/mm on the base
    /// circle) and length of contact lines (mm) that a damping ratio refers to.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn new(
        pair: GearPair,
        driving: impl Into<Arc<[ElasticGear; 2]>>,
        coast: Option<Arc<[ElasticGear; 2]>>,
        options: MotionOptions,
        means: [f64; 2],
    ) -> Result<Self, StaticError> {
        let cycles = options.start_cycles;
        let drive_side = MeshSide::new(&pair, driving.into(), options.contact.clone(), &options.contact, cycles)?;
        let coast_side = coast
            .map(|gears| MeshSide::new(&pair, gears, options.contact.driven_backwards(), &options.contact, cycles))
            .transpose()?;
        Ok(Self::of(pair, drive_side, coast_side, options, means))
    }

    /// The same pair at its beginning with another drive; gears and tables are shared.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn with_drive(&self, drive: Drive) -> Result<Self, StaticError> {
        let options = MotionOptions { drive, ..self.options.clone() };
        let drive_side = self.drive_side.again(&self.pair)?;
        let coast_side = self.coast_side.as_ref().map(|side| side.again(&self.pair)).transpose()?;
        let mut other = Self::of(self.pair.clone(), drive_side, coast_side, options, self.means);
        if let Some(modal) = self.modal.clone() {
            other.add_modes(modal);
        }
        Ok(other)
    }

    /// The same pair with normal modes of both gears as coordinates of their own: what they share of the teeth's and bodies' compliance gets its inertia, the rest stays quasi-static.
    ///
    /// The coordinates are p = q + L D d, amplitudes with what rigid motion shares of them: so mass is constant and without coupling, and a gear that moves as
    /// a rigid body for a moment keeps its p. Neither they nor their velocities change with the window.
    ///
    /// # Errors
    /// [`StaticError::Reduction`] for modes of another gear; [`StaticError::OutOfRange`] where a damping ratio is no number >= 0, and where the bodies' inertia
    /// is less than what the modes share of it: given for other gears than were meshed.
    pub fn with_modes(mut self, gears: [GearVibration; 2]) -> Result<Self, StaticError> {
        if let Some(value) = gears.iter().map(|g| g.damping_ratio).find(|z| !z.is_finite() || *z < 0.0) {
            return Err(StaticError::OutOfRange { name: "modal damping ratio", value, expected: "a number >= 0" });
        }
        let modes = gears.each_ref().map(|g| Arc::clone(&g.modes));
        self.drive_side.keep_modes(modes.clone())?;
        if let Some(side) = &mut self.coast_side {
            side.keep_modes(modes)?;
        }
        self.add_modes(Modal::new(gears));
        if nalgebra::Cholesky::new(self.mass.clone()).is_none() {
            let least = self.mass.diagonal().min();
            let expected = "more than the normal modes share of it: are mass and inertia those of the mesh?";
            return Err(StaticError::OutOfRange { name: "inertia of a gear's body", value: least, expected });
        }
        Ok(self)
    }

    fn add_modes(&mut self, modal: Modal) {
        let (n, m) = (self.coordinates.count(), modal.count());
        let mut rigid = self.coordinates.mass(&self.options.bodies);
        self.coordinates.add_matrix(&modal.shared_inertia(), -1.0, &mut rigid);
        self.mass = DMatrix::identity(n + m, n + m);
        self.mass.view_mut((0, 0), (n, n)).copy_from(&rigid);
        self.modal = Some(modal);
        self.last = None;
    }

    fn of(
        pair: GearPair,
        drive_side: MeshSide,
        coast_side: Option<MeshSide>,
        options: MotionOptions,
        means: [f64; 2],
    ) -> Self {
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
        let both = |part: fn(&super::Bearing) -> nalgebra::Matrix6<f64>| {
            let mut all = SMatrix::<f64, 12, 12>::zeros();
            for (g, b) in options.bearings.iter().enumerate() {
                all.fixed_view_mut::<6, 6>(6 * g, 6 * g).copy_from(&part(b));
            }
            all
        };
        let bearing = [both(|b| b.stiffness), both(|b| b.damping)];
        let equivalent = equivalent_mass_of(&pair, &options);
        let damping = match options.damping {
            MeshDamping::PerLength(c) => c,
            MeshDamping::Ratio(zeta) => {
                // c of the base circle; a slice moves by cos(b_b) of it, and so does its force.
                let cos = pair.base_helix_angle().cos();
                2.0 * zeta * (means[0] * equivalent).sqrt() / (means[1] * cos * cos)
            }
        };
        let (last, extremes) = (None, Extremes::default());
        Self {
            pair,
            options,
            coordinates,
            mass,
            nominal,
            drive_side,
            coast_side,
            bearing,
            damping,
            means,
            modal: None,
            last,
            extremes,
        }
    }

    /// Forgets what contact remembers of its last solution: what comes then depends on state and place alone, bit by bit.
    pub fn forget(&mut self) {
        self.drive_side.forget();
        if let Some(side) = &mut self.coast_side {
            side.forget();
        }
        self.last = None;
    }

    /// Where the windows stand.
    pub fn place(&self) -> Place {
        let coast = self.coast_side.as_ref().map(MeshSide::place);
        Place { driving: self.drive_side.place(), coast, extremes: self.extremes }
    }

    /// Puts the windows where they stood; what contact remembers is forgotten.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn stand(&mut self, place: &Place) -> Result<(), StaticError> {
        self.drive_side.stand(&self.pair, place.driving)?;
        if let (Some(side), Some(place)) = (&mut self.coast_side, place.coast) {
            side.stand(&self.pair, place)?;
        }
        (self.last, self.extremes) = (None, place.extremes);
        Ok(())
    }

    /// What has been gathered since the start.
    pub fn extremes(&self) -> &Extremes {
        &self.extremes
    }

    /// Whether the coast flanks may touch.
    pub fn has_coast_flanks(&self) -> bool {
        self.coast_side.is_some()
    }

    /// Tooth changes of the driving flanks.
    pub fn changes(&self) -> Changes {
        self.drive_side.place().changes
    }

    /// What is asked of the motion.
    pub fn options(&self) -> &MotionOptions {
        &self.options
    }

    /// Frequency of the two gears turning against each other on their teeth, Hz: sqrt(k_m / m_e) / 2 pi with the mean tangent stiffness.
    pub fn mesh_resonance_hz(&self) -> f64 {
        (self.means[0] / equivalent_mass_of(&self.pair, &self.options)).sqrt() / std::f64::consts::TAU
    }

    /// Free coordinates.
    pub fn coordinates(&self) -> &Coordinates {
        &self.coordinates
    }

    /// Number of all coordinates: free rigid ones, then normal modes of pinion and wheel.
    pub fn count(&self) -> usize {
        self.mass.nrows()
    }

    /// Frequencies of the kept modes with the bores held, Hz, pinion's first; empty without modes.
    pub fn mode_frequencies_hz(&self) -> Vec<f64> {
        self.modal.as_ref().map_or(Vec::new(), Modal::frequencies_hz)
    }

    /// Sizes of all coordinates from those of the rigid ones: a mode's is what moves a flank by `length` (mm).
    pub fn scales(&self, rigid: &DVector<f64>, length: f64) -> DVector<f64> {
        let sizes = self.drive_side.contact().modal().map_or(Vec::new(), |modal| modal.sizes());
        // A mode that leaves the flanks of this window where they are must not be measured by them.
        let largest = sizes.iter().fold(f64::MIN_POSITIVE, |m, s| m.max(*s));
        let modes = sizes.iter().map(|s| length / s.max(0.1 * largest));
        DVector::from_iterator(rigid.len() + sizes.len(), rigid.iter().copied().chain(modes))
    }

    /// Nominal motion.
    pub fn nominal(&self) -> &Nominal {
        &self.nominal
    }

    /// The pair.
    pub fn pair(&self) -> &GearPair {
        &self.pair
    }

    /// Force of the load torque along the driven gear's lag, N.
    pub(super) fn load_on_lag(&self, t: f64) -> f64 {
        let driven = self.options.contact.driven();
        self.options.load.at(t) / [self.pair.pinion.base_radius(), self.pair.wheel.base_radius()][driven]
    }

    fn cycles(&self, t: f64) -> f64 {
        self.nominal.cycles(&self.pair, &self.options.contact, t)
    }

    fn moment(&self, t: f64) -> Moment {
        self.nominal.at(&self.pair, &self.options.contact, t)
    }

    /// Mesh cycles that the gears have turned, a driver's own deviation from its nominal turn included.
    fn turned_cycles(&self, t: f64, d: &Displacement) -> f64 {
        let contact = &self.options.contact;
        if self.coordinates.driver_turn().is_none() {
            return self.cycles(t);
        }
        let driver = 1 - contact.driven();
        let gear = [&self.pair.pinion, &self.pair.wheel][driver];
        // The wheel turns against the pinion's sense.
        let sense = contact.sense.sign() as f64 * [1.0, -1.0][driver];
        self.cycles(t) + sense * d[COORDINATES * (driver + 1) - 1] / gear.pitch_angle()
    }

    /// L D of the modes at time `t`; no rows without modes.
    fn coupling(&self, t: f64) -> DMatrix<f64> {
        match &self.modal {
            None => DMatrix::zeros(0, 2 * COORDINATES),
            Some(modal) => modal.coupling(self.drive_side.angles(&self.pair, self.cycles(t))),
        }
    }

    /// Displacements and amplitudes of the modes from coordinates, and the same for velocities.
    fn posture(&self, t: f64, q: &DVector<f64>) -> Posture {
        let d = self.coordinates.displacement(q);
        let q = match &self.modal {
            None => DVector::zeros(0),
            Some(modal) => modal.amplitudes(&self.coupling(t), &d, &q.as_slice()[self.coordinates.count()..]),
        };
        Posture { d, q }
    }

    /// Contact of both sides; the last one is kept, since a step ends where several look.
    fn contact(&mut self, t: f64, d: &Posture) -> Result<Touching, StaticError> {
        if let Some(last) = self.last.as_ref().filter(|last| last.at.0 == t && last.at.1 == *d) {
            return Ok(last.clone());
        }
        let cycles = self.cycles(t);
        let Self { pair, drive_side, coast_side, last, .. } = self;
        let station = crate::Station::at_cycles(cycles);
        let fail = |source| StaticError::Contact { cycle: station.cycle, phase: station.phase, source };
        *last = None;
        let driving = drive_side.evaluate(pair, cycles, d).map_err(fail)?;
        let coast = coast_side.as_mut().map(|side| side.evaluate(pair, cycles, d)).transpose().map_err(fail)?;
        let touching = Touching { at: (t, d.clone()), driving, coast };
        *last = Some(touching.clone());
        Ok(touching)
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
            f[turn(1 - driven)] += moment.running_sense(1 - driven) * torque.at(t);
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
        let (at, rate) = (self.posture(t, q), self.coordinates.displacement(v));
        let d = at.d;
        let Touching { driving, coast, .. } = self.contact(t, &at)?;
        let cycles = self.cycles(t);
        let poses = self.drive_side.poses(&self.pair, cycles, &d);
        let mut mesh = driving.normal + driving.friction + self.drive_side.damping(&poses, &rate, self.damping).0;
        let mut normal_forces = [self.drive_side.normal_forces(&poses, &rate, self.damping)[0], 0.0];
        if let (Some(side), Some(force)) = (&self.coast_side, &coast) {
            let poses = side.poses(&self.pair, cycles, &d);
            mesh += force.normal + force.friction + side.damping(&poses, &rate, self.damping).0;
            normal_forces[1] = side.normal_forces(&poses, &rate, self.damping)[0];
        }
        let contact = self.drive_side.contact();
        let loaded = contact.slices().iter().zip(contact.solver().forces()).filter(|(_, f)| **f > 0.0);
        let pressure = loaded.fold(0.0, |m: f64, (slice, f)| m.max(slice.local.under(f / slice.length).pressure));
        let (window, tooth_changes) = self.drive_side.window();
        let moment = self.moment(t);
        let shared = self.modal_reaction(t, &at, v, [Some(&driving), coast.as_ref()], &moment);
        let of_turn = |g: usize| COORDINATES * (g + 1) - 1;
        let speeds = [0, 1].map(|g| moment.velocity[g] + rate[of_turn(g)]);
        Ok(Instant {
            time: t,
            cycles: self.turned_cycles(t, &d),
            speeds,
            transmission_error: q[self.coordinates.lag()],
            transmission_error_rate: v[self.coordinates.lag()],
            displacement: d,
            drive_torque: self.drive_torque(t, &moment, &(mesh - shared)),
            load_torque: self.options.load.at(t),
            bearing: -(self.bearing[0] * d + self.bearing[1] * rate),
            pair_forces: contact.force().pair_forces.clone(),
            first_pair: window.first(),
            normal_forces,
            contact_line_length: contact_line::length(&self.pair, contact),
            max_pressure: pressure,
            tooth_changes,
            mesh,
        })
    }

    /// What the inertia of the modes takes of the forces on the rigid bodies, D' L' p''; nothing without modes.
    fn modal_reaction(
        &self,
        t: f64,
        at: &Posture,
        v: &DVector<f64>,
        sides: [Option<&SideForce>; 2],
        moment: &Moment,
    ) -> Displacement {
        let Some(modal) = &self.modal else { return Displacement::zeros() };
        let (coupling, rate) = (self.coupling(t), self.posture(t, v).q);
        let mut balance = ModalBalance::new(modal, &at.q, &rate);
        sides.into_iter().flatten().for_each(|side| {
            balance.add(side, &rate);
        });
        balance.accelerate(&coupling, moment);
        let all = coupling.tr_mul(&(balance.conservative + balance.other));
        Displacement::from_fn(|i, _| all[i])
    }

    /// Torque of the driver in the running sense, N mm: the one given, or the one that keeps its speed.
    fn drive_torque(&self, t: f64, moment: &Moment, mesh: &Displacement) -> f64 {
        let driver = 1 - self.options.contact.driven();
        let running = moment.running_sense(driver);
        match &self.options.drive {
            Drive::Torque { torque, .. } => torque.at(t),
            Drive::Speed(_) => {
                let inertia = self.options.bodies[driver].polar_inertia * moment.acceleration[driver];
                running * (inertia - mesh[COORDINATES * (driver + 1) - 1])
            }
        }
    }
}

/// Reduced mass of the pair's turns on the base circles, t: the driven gear's alone where the driver's angle is prescribed.
fn equivalent_mass_of(pair: &GearPair, options: &MotionOptions) -> f64 {
    let base = [pair.pinion.base_radius(), pair.wheel.base_radius()];
    let inertia = [0, 1].map(|i| options.bodies[i].polar_inertia / (base[i] * base[i]));
    let driver = 1 - options.contact.driven();
    let held = matches!(options.drive, Drive::Speed(_));
    equivalent_mass(inertia, held.then_some(driver))
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
        let (at, moving) = (self.posture(t, q), self.posture(t, v));
        let (d, rate) = (at.d, moving.d);
        let moment = self.moment(t);
        let Touching { driving, coast, .. } = self.contact(t, &at)?;
        let cycles = self.cycles(t);
        let mut normal = Displacement::zeros();
        let mut other = self.external(t, &moment);
        out.supplied = other.dot(&rate);
        let mut stiffness = self.bearing[0];
        let mut damping = self.bearing[1];
        out.dissipated = rate.dot(&(self.bearing[1] * rate));
        let mut modal = self.modal.as_ref().map(|modal| ModalBalance::new(modal, &at.q, &moving.q));
        for (side, force) in [(Some(&self.drive_side), Some(&driving)), (self.coast_side.as_ref(), coast.as_ref())] {
            let (Some(side), Some(force)) = (side, force) else { continue };
            normal += force.normal;
            other += force.friction;
            let poses = side.poses(&self.pair, cycles, &d);
            let (damped, matrix, power) = side.damping(&poses, &rate, self.damping);
            other += damped;
            damping += matrix;
            out.dissipated += power;
            // Friction takes its power from the nominal motion as well; in the ledger of deviations it is their part that counts.
            out.dissipated -= force.friction.dot(&rate);
            match &mut modal {
                None => stiffness += force.stiffness,
                Some(modal) => out.dissipated += modal.add(force, &moving.q),
            }
        }
        let gyroscopic = self.gyroscopic(&moment);
        other -= self.bearing[1] * rate;
        other -= gyroscopic * rate;
        damping += gyroscopic;
        let mut conservative = about_own_axis(normal - self.bearing[0] * d, &d);
        let mut other = about_own_axis(other, &d);
        match modal {
            None if out.tangents => {
                self.coordinates.add_matrix(&stiffness, 1.0, &mut out.stiffness);
                self.coordinates.add_matrix(&damping, 1.0, &mut out.damping);
            }
            None => {}
            Some(mut modal) => {
                let coupling = self.coupling(t);
                out.supplied += modal.accelerate(&coupling, &moment).dot(&moving.q);
                out.dissipated += modal.dissipated;
                conservative -= coupling.tr_mul(&modal.conservative);
                other -= coupling.tr_mul(&modal.other);
                for (f, all) in [(&modal.conservative, &mut out.conservative), (&modal.other, &mut out.other)] {
                    let mut rows = all.rows_mut(self.coordinates.count(), f.len());
                    rows += f;
                }
                if out.tangents {
                    let y = expansion(self.coordinates.map(), &coupling);
                    modal.add_rigid(&stiffness, &damping);
                    out.stiffness += y.tr_mul(&modal.stiffness) * &y;
                    out.damping += y.tr_mul(&modal.damping) * &y;
                }
            }
        }
        self.coordinates.add_force(&conservative, &mut out.conservative);
        self.coordinates.add_force(&other, &mut out.other);
        if !out.tangents {
            // A ten-thousandth of a mesh cycle either way.
            let pitch = self.pair.pinion.pitch_angle();
            let step = 1e-4 * pitch / moment.velocity[0].abs().max(f64::MIN_POSITIVE);
            out.parametric = (self.potential(t + step, q)? - self.potential(t - step, q)?) / (2.0 * step);
        }
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, StaticError> {
        let at = self.posture(t, q);
        self.contact(t, &at)?;
        let of = |side: &MeshSide| side.contact().force().strain_energy;
        let contact = of(&self.drive_side) + self.coast_side.as_ref().map_or(0.0, of);
        let modes = self.modal.as_ref().map_or(0.0, |modal| at.q.dot(&modal.squares.component_mul(&at.q)));
        Ok(contact + 0.5 * (at.d.dot(&(self.bearing[0] * at.d)) + modes))
    }

    fn events(&self) -> usize {
        1 + usize::from(self.coast_side.is_some())
    }

    /// Least gap of the driving flanks and of the coast flanks, mm, with the sign turned: positive in contact.
    fn event_values(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut [f64]) -> Result<(), StaticError> {
        let at = self.posture(t, q);
        self.contact(t, &at)?;
        let cycles = self.cycles(t);
        let pair = &self.pair;
        for (side, value) in std::iter::once(&mut self.drive_side).chain(self.coast_side.as_mut()).zip(out) {
            *value = side.overlap(pair, cycles, &at);
        }
        if self.modal.is_some() {
            self.last = None;
        }
        Ok(())
    }

    fn accepted(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> Result<(), StaticError> {
        let (at, rate) = (self.posture(t, q), self.coordinates.displacement(v));
        let turned = self.turned_cycles(t, &at.d);
        // Several teeth may be due after a long step.
        loop {
            let before = self.contact(t, &at)?;
            let Self { pair, drive_side, coast_side, .. } = self;
            let loads = |side: &MeshSide| side.contact().force().pair_forces.iter().sum::<f64>();
            let sums = [Some(loads(drive_side)), coast_side.as_ref().map(loads)];
            let moved = [
                drive_side.follow(pair, turned)?,
                coast_side.as_mut().map_or(Ok(false), |side| side.follow(pair, turned))?,
            ];
            if moved == [false; 2] {
                self.gather(t, &before.at.1, &rate, turned)?;
                return Ok(());
            }
            self.last = None;
            self.contact(t, &at)?;
            for ((side, moved), sum) in
                [Some(&mut self.drive_side), self.coast_side.as_mut()].into_iter().zip(moved).zip(sums)
            {
                if let (Some(side), true, Some(sum)) = (side, moved, sum) {
                    side.book_jump(sum);
                }
            }
        }
    }
}

impl PairMechanism {
    /// Extremes of the step that has just been taken; and whether a pair beside a window ought to carry load.
    fn gather(&mut self, t: f64, at: &Posture, rate: &Displacement, turned: f64) -> Result<(), StaticError> {
        let (cycles, d) = (self.cycles(t), &at.d);
        let poses = self.drive_side.poses(&self.pair, cycles, d);
        self.drive_side.check_beside(&self.pair, turned, &poses)?;
        let touches = |side: &MeshSide| side.contact().solver().forces().iter().any(|f| *f > 0.0);
        let mut least = f64::INFINITY;
        if touches(&self.drive_side) {
            let [sum, smallest] = self.drive_side.normal_forces(&poses, rate, self.damping);
            self.extremes.largest_force = self.extremes.largest_force.max(sum);
            least = smallest;
        } else {
            self.extremes.steps_apart += 1;
            let gap = -self.drive_side.overlap(&self.pair, cycles, at);
            self.last = self.last.take().filter(|_| self.modal.is_none());
            self.extremes.largest_gap = self.extremes.largest_gap.max(gap);
        }
        if let Some(side) = &self.coast_side
            && touches(side)
        {
            let poses = side.poses(&self.pair, cycles, d);
            side.check_beside(&self.pair, turned, &poses)?;
            least = least.min(side.normal_forces(&poses, rate, self.damping)[1]);
            self.extremes.steps_on_coast += 1;
        }
        if least.is_finite() {
            self.extremes.least_force = Some(self.extremes.least_force.map_or(least, |f| f.min(least)));
        }
        Ok(())
    }
}
