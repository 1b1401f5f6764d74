//! A mesh as a spring in the plane of action that is compressed and tilted, valid near the load at which it was made.
//! Theory (94a).

use std::f64::consts::TAU;

use contact::FlankProjection;
use dynamics::FlankInstant;
use lumped::Fourier;

use super::{MeshLosses, MovingMesh, SpringMesh, normal_damper::NormalDamper};
use crate::{GearboxError, MeshElement, MeshForces, Vector12, mesh_element::finite_cycles};

/// Change of the stiffness by the tilt, over the stiffness, up to which the spring stands for the contact.
const MOST: f64 = 0.5;

/// Coefficients of the spring over the phase, 2 pi a mesh cycle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TiltingCoefficients {
    /// k: N/mm.
    pub stiffness: Fourier,
    /// e: mm along the normal.
    pub excess: Fourier,
    /// s: place across the normal, mm from the pitch point, at which a tilt counts as approach.
    pub place: Fourier,
    /// m: N/(mm rad), and n: N/(mm rad^2).
    pub by_tilt: [Fourier; 2],
    /// gamma_0: tilt at which they hold, rad.
    pub tilt: f64,
}

/// The driving flanks as one energy of approach and tilt; the coast flanks as a [`SpringMesh`].
///
/// ```text
/// V = delta^2 B/2  (delta > 0),   delta = x + s g + e,   B = k + 2 m g + n g^2,   g = gamma - gamma_0
/// ```
/// x = a . d, gamma = b . d ([`FlankProjection`]). Near the load, force, tilting moment and all stiffnesses of the two
/// equal those of the contact at every phase. If the flanks separate, force and moment become 0 together. A spring
/// along one line of action has no tilting moment of its own; shafts then tilt differently, and the transmission error
/// is wrong by tens of per cent.
#[derive(Debug, Clone)]
pub struct TiltingSpring {
    projection: FlankProjection,
    coefficients: TiltingCoefficients,
    coast: SpringMesh,
    damping: f64,
    cycles: f64,
    at: Place,
}

/// Where the driving flanks are, and the coefficients there with their slopes by the phase (a cycle).
#[derive(Debug, Clone, Copy, Default)]
struct Place {
    delta: f64,
    tilt: f64,
    stiffness: [f64; 2],
    excess_rate: f64,
    place: [f64; 2],
    by_tilt: [[f64; 2]; 2],
}

impl Place {
    /// B.
    fn pressed(&self) -> f64 {
        let [[m, _], [n, _]] = self.by_tilt;
        self.stiffness[0] + self.tilt * (2.0 * m + self.tilt * n)
    }

    /// dB/dg over 2: m + n g.
    fn half_slope(&self) -> f64 {
        self.by_tilt[0][0] + self.by_tilt[1][0] * self.tilt
    }

    fn force(&self) -> f64 {
        self.delta.max(0.0) * self.pressed()
    }

    /// ddelta/dc with the gears held, mm a cycle.
    fn delta_rate(&self) -> f64 {
        self.excess_rate + self.place[1] * self.tilt
    }

    /// The damper (N s/mm) of the flanks along their lever, where they press.
    fn damper<'a>(&self, lever: &'a Vector12, damping: f64) -> Option<NormalDamper<'a>> {
        let (force, stiffness, by_cycles) = (self.force(), self.pressed(), self.delta_rate());
        (force > 0.0).then_some(NormalDamper { lever, damping, force, stiffness, by_cycles })
    }
}

impl TiltingSpring {
    pub(super) fn new(projection: FlankProjection, coefficients: TiltingCoefficients, coast: SpringMesh) -> Self {
        Self { projection, coefficients, coast, damping: 0.0, cycles: 0.0, at: Place::default() }
    }

    /// Mesh with a damper along the normal, N s/mm, limited by the force of the flanks.
    #[must_use]
    pub fn with_damping(self, damping: f64) -> Self {
        Self { damping, coast: self.coast.with_damping(damping), ..self }
    }

    /// a + s b: what displacements press the flanks by.
    fn lever(&self) -> Vector12 {
        self.projection.approach + self.at.place[0] * self.projection.tilt
    }
}

impl MeshElement for TiltingSpring {
    fn go_to(&mut self, cycles: f64) -> Result<(), GearboxError> {
        self.cycles = finite_cycles(cycles)?;
        self.coast.go_to(cycles)
    }

    fn evaluate(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError> {
        let phase = TAU * (self.cycles - self.cycles.floor());
        let of = |series: &Fourier| {
            let [value, slope] = series.with_slope(phase);
            [value, TAU * slope]
        };
        let c = &self.coefficients;
        let ([excess, excess_rate], place) = (of(&c.excess), of(&c.place));
        let [x, gamma] = [&self.projection.approach, &self.projection.tilt].map(|a| a.dot(displacements));
        let tilt = gamma - c.tilt;
        let (delta, by_tilt) = (x + place[0] * tilt + excess, c.by_tilt.each_ref().map(of));
        self.at = Place { delta, tilt, stiffness: of(&c.stiffness), excess_rate, place, by_tilt };
        let mut reply = self.coast.evaluate(displacements)?;
        if delta > 0.0 {
            let (b, half, lever) = (self.at.pressed(), self.at.half_slope(), self.lever());
            let tilting = &self.projection.tilt;
            let mixed = lever * tilting.transpose();
            reply.force -= delta * b * lever + delta * delta * half * tilting;
            reply.tangent -= b * lever * lever.transpose()
                + 2.0 * delta * half * (mixed + mixed.transpose())
                + delta * delta * by_tilt[1][0] * tilting * tilting.transpose();
            reply.normal_force += delta * b;
        }
        Ok(reply)
    }
}

impl MovingMesh for TiltingSpring {
    fn energy(&self) -> f64 {
        0.5 * self.at.delta.max(0.0).powi(2) * self.at.pressed() + self.coast.energy()
    }

    fn energy_rate(&self) -> f64 {
        let at = &self.at;
        let [[_, m], [_, n]] = at.by_tilt;
        let pressed_rate = at.stiffness[1] + at.tilt * (2.0 * m + at.tilt * n);
        let own = 0.5 * at.delta.max(0.0).powi(2) * pressed_rate + at.force() * at.delta_rate();
        own + self.coast.energy_rate()
    }

    fn losses(&mut self, rates: &Vector12, cycles: f64) -> MeshLosses {
        let mut all = self.coast.losses(rates, cycles);
        let lever = self.lever();
        if let Some(damper) = self.at.damper(&lever, self.damping) {
            damper.add(rates, cycles, &mut all);
        }
        all
    }

    fn by_side(&mut self, rates: &Vector12, cycles: f64) -> Result<[FlankInstant; 2], GearboxError> {
        let ([_, coast], lever) = (self.coast.by_side(rates, cycles)?, self.lever());
        let driving = self.at.damper(&lever, self.damping);
        Ok([driving.map_or_else(FlankInstant::default, |own| own.instant(rates, cycles)), coast])
    }

    fn overlaps(&mut self) -> Result<[f64; 2], GearboxError> {
        let [_, coast] = self.coast.overlaps()?;
        Ok([self.at.delta, coast])
    }

    fn levers(&self) -> Option<Vec<Vector12>> {
        let own = [self.projection.approach, self.projection.tilt];
        Some(own.into_iter().chain(self.coast.levers().into_iter().flatten()).collect())
    }

    fn reach(&self) -> f64 {
        let change = (self.at.pressed() / self.at.stiffness[0] - 1.0).abs() / MOST;
        // Without contact a tilt does nothing.
        if self.at.delta > 0.0 { change } else { 0.0 }
    }
}
