//! Equations of motion of rigid gears on their true flanks.

use std::convert::Infallible;

use ale::Station;
use contact::Pose;
use dynamics::{COORDINATES, Displacement, Drive, Speed, Torque};
use geometry::{Driver, GearPair};
use integrate::{Forces, Mechanism};
use ltca::StaticOptions;
use nalgebra::{DMatrix, DVector, Translation3, UnitQuaternion, Vector3};

use super::{
    ImpactOptions, RigidCoordinates,
    flanks::{FlankSide, NominalPose},
    forces::{FlankForce, Square},
};
use crate::LumpedError;

/// A pair of rigid gears as an integrator sees it.
///
/// ```text
/// M q'' = T' [sum of slices (F J_n + R) - K_b d - C_b d' - G d' + loads - M a_nominal],   d = T q
/// F = w max(0, K delta^e + C s delta'),  delta = -g(d),  delta' = -J_n . (d' + v_nominal),   w = l_slice / (b / cos b_b)
/// R = -mu(|v_t|) F J_t' v_t / |v_t|,   v_t sliding velocity of the flanks in their tangent plane
/// V = sum of w K delta^(e+1) / (e+1) + d' K_b d / 2
/// ```
/// Flanks on both sides of the teeth; teeth may separate and strike either. A gap's change is J_n . dd exactly where
/// its place is one of least gap or on the pinion's tip edge, since slices stand on the pinion; at the wheel's edge,
/// which then slides along, to a thousandth of the largest force.
#[derive(Debug)]
pub struct ImpactMechanism {
    pair: GearPair,
    options: ImpactOptions,
    /// Driver and sense, as the coordinates of pair motion want them.
    running: StaticOptions,
    coordinates: RigidCoordinates,
    mass: DMatrix<f64>,
    /// Nominal speed of the driver.
    speed: Speed,
    /// Turns of pinion and wheel about +z by one of the driver.
    turns: [f64; 2],
    sides: [FlankSide; 2],
    bearing: [Square; 2],
    share: f64,
}

impl ImpactMechanism {
    /// A pair with its line of centres along +x.
    ///
    /// # Errors
    /// [`LumpedError`] when an option has no meaning.
    pub fn new(pair: GearPair, options: ImpactOptions) -> Result<Self, LumpedError> {
        options.check()?;
        let running = StaticOptions::new(0.0, &pair).with_contact(|c| {
            c.driver = options.driver;
            c.sense = options.sense
        });
        let speed = options.drive.nominal();
        let mut free = options.free;
        free[1 - running.driven()][COORDINATES - 1] = matches!(options.drive, Drive::Torque { .. });
        let coordinates = RigidCoordinates::new(&pair, &running, &free);
        // A ring turns the same way as its pinion.
        let ratio = -pair.pinion.signed_teeth() / pair.wheel.signed_teeth();
        let turns = match options.driver {
            Driver::Pinion => [1.0, ratio],
            Driver::Wheel => [1.0 / ratio.abs(), ratio.signum()],
        };
        let turns = turns.map(|turns| options.sense.sign() as f64 * turns);
        let mut bodies = Square::zeros();
        let sides = [running.side(), running.side().opposite()].map(|s| FlankSide::new(&pair, s, options.slices));
        let mut bearing = [Square::zeros(); 2];
        for (g, b) in options.bearings.iter().enumerate() {
            let at = COORDINATES * g;
            bodies.fixed_view_mut::<6, 6>(at, at).copy_from(&options.bodies[g].matrix());
            bearing[0].fixed_view_mut::<6, 6>(at, at).copy_from(&b.stiffness);
            bearing[1].fixed_view_mut::<6, 6>(at, at).copy_from(&b.damping);
        }
        let share = 1.0 / options.slices as f64;
        let mass = coordinates.map().tr_mul(&(bodies * coordinates.map()));
        Ok(Self { pair, options, running, coordinates, mass, speed, turns, sides, bearing, share })
    }

    /// The pair with another start, in mesh cycles, whole and part.
    ///
    /// # Errors
    /// As of [`Self::new`].
    pub fn beginning_at(&self, cycles: f64) -> Result<Self, LumpedError> {
        Self::new(self.pair.clone(), ImpactOptions { start_cycles: cycles, ..self.options.clone() })
    }

    /// The pair at its start, nominal motion stopped, under the mean of its load.
    ///
    /// # Errors
    /// As of [`Self::new`].
    pub(super) fn standing_still(&self) -> Result<Self, LumpedError> {
        let drive = self.options.drive.clone().at_speed(0.0);
        // A table has no mean: the torque that it begins with.
        let load = Torque::Constant(self.options.load.mean().unwrap_or_else(|| self.options.load.at(0.0)));
        Self::new(self.pair.clone(), ImpactOptions { drive, load, ..self.options.clone() })
    }

    /// The pair.
    pub fn pair(&self) -> &GearPair {
        &self.pair
    }

    /// Free coordinates.
    pub fn coordinates(&self) -> &RigidCoordinates {
        &self.coordinates
    }

    /// Speeds of both gears about +z in the nominal motion at a time (s), rad/s: they turn in the ratio of their teeth.
    pub fn speeds(&self, t: f64) -> [f64; 2] {
        self.turns.map(|turns| turns * self.speed.at(t))
    }

    /// Mesh cycles, whole and part, at a time, s.
    pub fn cycles(&self, t: f64) -> f64 {
        let driver = [&self.pair.pinion, &self.pair.wheel][1 - self.running.driven()];
        self.options.start_cycles + self.speed.angle(t) / driver.pitch_angle().abs()
    }

    fn standing(&self, t: f64) -> NominalPose {
        let station = Station::at_cycles(self.cycles(t));
        let sign = self.running.contact.sense.sign();
        let side = self.running.side();
        let pinion_angle =
            self.pair.middle_angle(side) + sign as f64 * (station.phase - 0.5) * self.pair.pinion.pitch_angle();
        NominalPose {
            pinion_angle,
            shift: -sign * station.cycle,
            wheel_angle: self.pair.wheel_angle(side, pinion_angle),
        }
    }

    fn poses(&self, at: &NominalPose, d: &Displacement) -> [Pose; 2] {
        let angles = at.frame_angles(&self.pair);
        [0, 1].map(|g| {
            let i = COORDINATES * g;
            let [x, z] = [[0.0, 0.0], [self.pair.centre_distance(), self.pair.mid_face_offset()]][g];
            let place = Vector3::new(x + d[i], d[i + 1], z + d[i + 2]);
            let tilt = UnitQuaternion::from_scaled_axis(Vector3::new(d[i + 3], d[i + 4], 0.0));
            let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angles[g] + d[i + 5]);
            Pose::from_parts(Translation3::from(place), tilt * turn)
        })
    }

    /// Forces of driving and coast flanks with the gears displaced by `d` and moving by `rate` from their nominal
    /// motion.
    pub fn flank_forces(&mut self, t: f64, d: &Displacement, rate: &Displacement) -> [FlankForce; 2] {
        let at = self.standing(t);
        let poses = self.poses(&at, d);
        let nominal = turning(self.speeds(t));
        let velocity = rate + nominal;
        let Self { pair, options, sides, share, .. } = self;
        let whole = pair.face_width() / pair.base_helix_angle().cos();
        sides.each_mut().map(|side| {
            let mut sum = FlankForce::none();
            side.search(pair, &at, &poses, |slice| {
                sum.add(&slice, &poses, options, *share, [&velocity, &nominal]);
                if slice.place.gap < 0.0 {
                    sum.length += *share * whole;
                }
            });
            sum
        })
    }

    /// Lag (mm on the base circle) at which two pairs over their whole width would carry the load at t = 0; below zero
    /// when the load drives.
    pub(super) fn guessed_lag(&self) -> f64 {
        let driven = self.running.driven();
        let radius = [&self.pair.pinion, &self.pair.wheel][driven].base_radius();
        let cos = self.pair.base_helix_angle().cos();
        let force = self.options.load.at(0.0) / (radius * cos);
        let overlap = (0.5 * force.abs() / self.options.law.stiffness).powf(self.options.law.exponent.recip()) / cos;
        // The coast flanks begin where the backlash ends.
        if force < 0.0 { -overlap - self.pair.backlash() } else { overlap }
    }

    /// Loads and drive torque on the twelve coordinates, and inertia of a nominal motion that is not steady.
    fn external(&self, t: f64) -> Displacement {
        let driven = self.running.driven();
        let turn = |g: usize| COORDINATES * (g + 1) - 1;
        let mut f = Displacement::zeros();
        f[turn(driven)] += self.running.side().sign() * self.options.load.at(t);
        if let Drive::Torque { torque, .. } = &self.options.drive {
            f[turn(1 - driven)] += self.turns[1 - driven].signum() * torque.at(t);
        }
        for (g, body) in self.options.bodies.iter().enumerate() {
            f[turn(g)] -= body.polar_inertia * self.turns[g] * self.speed.acceleration(t);
        }
        f
    }

    fn gyroscopic(&self, speeds: [f64; 2]) -> Square {
        let mut g = Square::zeros();
        for (i, body) in self.options.bodies.iter().enumerate() {
            let at = COORDINATES * i + 3;
            g.fixed_view_mut::<3, 3>(at, at).copy_from(&body.gyroscopic(speeds[i]));
        }
        g
    }
}

/// Velocities of both gears in the nominal motion.
fn turning(speeds: [f64; 2]) -> Displacement {
    let mut all = Displacement::zeros();
    (all[COORDINATES - 1], all[2 * COORDINATES - 1]) = speeds.into();
    all
}

impl Mechanism for ImpactMechanism {
    type Error = Infallible;

    fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    fn forces(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>, out: &mut Forces) -> Result<(), Infallible> {
        let (d, rate) = (self.coordinates.displacement(q), self.coordinates.displacement(v));
        let speeds = self.speeds(t);
        let [driving, coast] = self.flank_forces(t, &d, &rate);
        let external = self.external(t);
        let gyroscopic = self.gyroscopic(speeds);
        let flanks = driving.damping + driving.friction + coast.damping + coast.friction;
        let lossy = flanks - self.bearing[1] * rate;
        // Dampers and friction go against the whole motion of the flanks; what they take of the nominal part of it the
        // drive replaces.
        let replaced = -flanks.dot(&turning(speeds));
        out.supplied = external.dot(&rate) + replaced;
        out.dissipated = replaced - lossy.dot(&rate);
        out.parametric = driving.parametric + coast.parametric;
        let conservative = driving.elastic + coast.elastic - self.bearing[0] * d;
        let map = self.coordinates.map();
        out.conservative.gemv_tr(1.0, map, &conservative, 1.0);
        out.other.gemv_tr(1.0, map, &(external + lossy - gyroscopic * rate), 1.0);
        if out.tangents {
            let stiffness = driving.stiffness + coast.stiffness + self.bearing[0];
            let rates = driving.rates + coast.rates + self.bearing[1] + gyroscopic;
            out.stiffness += map.tr_mul(&(stiffness * map));
            out.damping += map.tr_mul(&(rates * map));
        }
        Ok(())
    }

    fn potential(&mut self, t: f64, q: &DVector<f64>) -> Result<f64, Infallible> {
        let d = self.coordinates.displacement(q);
        let flanks: f64 = self.flank_forces(t, &d, &Displacement::zeros()).iter().map(|f| f.potential).sum();
        Ok(flanks + 0.5 * d.dot(&(self.bearing[0] * d)))
    }

    fn events(&self) -> usize {
        2
    }

    /// Deepest overlap of the driving and of the coast flanks, mm: positive in contact.
    fn event_values(&mut self, t: f64, q: &DVector<f64>, _: &DVector<f64>, out: &mut [f64]) -> Result<(), Infallible> {
        let d = self.coordinates.displacement(q);
        for (force, value) in self.flank_forces(t, &d, &Displacement::zeros()).iter().zip(out) {
            // Teeth so far apart that no slice faces another are a whole module away.
            *value = force.overlap.max(-self.pair.pinion.data().normal_module);
        }
        Ok(())
    }
}
