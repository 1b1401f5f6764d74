//! The pair with a map in place of its contact. Theory (75), pitch errors: (74a).

mod balance;
mod make;
mod sampler;

use contact::FlankProjection as Projection;
use contact_map::{ContactMap, MapContact, OffsetMap, SplineCache, Wanted};
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::{COORDINATES, Displacement, PairMechanism};

pub use make::MapRequest;

/// A pair of gears whose contact is a map of the contact of its elastic teeth.
///
/// ```text
/// M q'' = -dV/dq + T' [damping, bearings, loads, drive],   V = V_map(phase, a . d, b . d) + d' K_b d / 2,   d = T q
/// ```
/// Bodies, bearings, coordinates, drive and loads are those of the [`PairMechanism`] that it is made from. What is left
/// out of that: motions that move no flank along its normal, and moments of forces whose points move with the gears.
#[derive(Debug)]
pub struct MappedPair {
    system: PairMechanism,
    sides: Vec<MappedSide>,
    mass: DMatrix<f64>,
    /// T' K_b T; none without bearings that yield.
    bearing: Option<DMatrix<f64>>,
    /// T' P C_b T, P: with the torque of a driver that balances; likewise.
    damping: Option<DMatrix<f64>>,
    /// T' C_b T: what the dampers of the bearings take.
    taken: DMatrix<f64>,
    /// T' P G T at the unit speed of the pinion; none without gears that tilt.
    gyroscopic: Option<DMatrix<f64>>,
    /// T' P.
    loading: DMatrix<f64>,
    /// Mesh cycles a radian of the driver's turn, where that is a coordinate.
    phase_of_driver: Option<(usize, f64)>,
    kept: Vec<SplineCache>,
    excess: MapExcess,
}

/// How far a motion has gone beyond what its maps hold, at the ends of its steps; beyond them nothing was checked.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct MapExcess {
    /// Largest force over the largest of the map.
    pub force: f64,
    /// Largest distance of a tilt from the middle of the map's, over half their range.
    pub tilt: f64,
}

impl MapExcess {
    /// Whether all was within the maps.
    pub fn is_within(&self) -> bool {
        self.force <= 1.0 && self.tilt <= 1.0
    }
}

/// The flanks on one side.
#[derive(Debug, Clone)]
struct MappedSide {
    map: OffsetMap,
    projection: Projection,
    /// T' a and T' b.
    approach: DVector<f64>,
    tilt: DVector<f64>,
    /// T' P a and T' P b: what damping along them does.
    damped: [DVector<f64>; 2],
    /// T' (P - 1) a and T' (P - 1) b: what a driver that balances answers it with.
    answered: [DVector<f64>; 2],
}

impl MappedSide {
    /// Approach (mm) and tilt (rad), or their rates, of the free coordinates.
    #[inline]
    fn motion(&self, q: &DVector<f64>) -> [f64; 2] {
        // A product of nalgebra takes longer to call than so few coordinates to sum.
        let along = |of: &DVector<f64>| of.iter().zip(q).map(|(a, x)| a * x).sum();
        [along(&self.approach), if self.map.map().tilts().is_some() { along(&self.tilt) } else { 0.0 }]
    }

    /// Contact with the gears displaced: several states of a step are at one phase, and share what belongs to it.
    fn contact(&self, kept: &mut SplineCache, phase: f64, q: &DVector<f64>, wanted: Wanted) -> MapContact {
        let motion = self.motion(q);
        self.map.contact(kept.at(&self.map, phase, motion), motion[0], wanted)
    }
}

/// What the map says of one side at an instant.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MappedInstant {
    /// Normal force, N, without damping.
    pub force: f64,
    /// Damping along the approach, N.
    pub damping: f64,
    /// Approach of the flanks along their normal, mm.
    pub approach: f64,
    /// Their stiffness along it, N/mm.
    pub stiffness: f64,
    /// Length of the loaded contact lines, mm.
    pub line_length: f64,
    /// Forces (N) and moments (N mm) on both gears about their centres, damping included.
    pub wrench: Displacement,
}

impl MappedPair {
    /// Bodies, bearings, drive and loads.
    pub fn system(&self) -> &PairMechanism {
        &self.system
    }

    /// The maps of the driving flanks and, where these may touch, of the coast flanks.
    pub fn maps(&self) -> impl Iterator<Item = &ContactMap> {
        self.sides.iter().map(|side| side.map.map())
    }

    /// Mesh cycles a second of the nominal motion at a time (s).
    pub fn mesh_hz(&self, t: f64) -> f64 {
        self.system.cycles_per_second(t)
    }

    /// Mesh cycles that the gears have turned, and the speeds of both about +z, rad/s.
    pub fn turning(&self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> (f64, [f64; 2]) {
        let (nominal, rate) = (self.system.nominal_state(t), self.system.coordinates().displacement(v));
        let of_turn = |g: usize| rate[COORDINATES * (g + 1) - 1];
        (self.phase(t, q), [0, 1].map(|g| nominal.velocity[g] + of_turn(g)))
    }

    /// How far the motion has gone beyond the maps since it was made: a result beyond them holds no more.
    pub fn excess(&self) -> MapExcess {
        self.excess
    }

    /// Phase, in mesh cycles, with a driver's own deviation from its nominal turn.
    fn phase(&self, t: f64, q: &DVector<f64>) -> f64 {
        let own = self.phase_of_driver.map_or(0.0, |(i, per_turn)| per_turn * q[i]);
        self.system.cycles(t) + own
    }

    /// Instants of the driving and the coast flanks at a state; all zero for coast flanks that the pair does not have.
    pub fn instant(&mut self, t: f64, q: &DVector<f64>, v: &DVector<f64>) -> [MappedInstant; 2] {
        let mut all = [MappedInstant::default(); 2];
        let phase = self.phase(t, q);
        for ((side, kept), out) in self.sides.iter().zip(&mut self.kept).zip(&mut all) {
            let motion @ [approach, _] = side.motion(q);
            let place = kept.at(&side.map, phase, motion);
            let contact = side.map.contact(place, approach, Wanted::default());
            let damping = side.map.map().damping(place, &contact, side.motion(v), self.system.damping_per_length());
            let force = contact.force + damping.force[0];
            let moment = contact.moment - damping.force[1];
            *out = MappedInstant {
                force: contact.force,
                damping: damping.force[0],
                approach,
                stiffness: contact.stiffness[0][0],
                line_length: damping.length,
                wrench: side.projection.tilt * moment - side.projection.approach * force,
            };
        }
        all
    }
}
