//! Where a pair would stand if its flanks were rigid and just touched.

use geometry::GearPair;
use serde::{Deserialize, Serialize};

use super::Speed;
use crate::{Driver, StaticOptions, Station};

/// Nominal motion of a pair: both gears turn in the ratio of their teeth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Nominal {
    /// Speed of the driver, rad/s, in the running sense.
    pub speed: Speed,
    /// Mesh cycles, whole and part, at t = 0.
    pub start: f64,
}

/// Nominal motion at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Station.
    pub station: Station,
    /// Angular velocity of both gears about +z, rad/s.
    pub velocity: [f64; 2],
    /// Angular acceleration of both gears about +z, rad/s^2.
    pub acceleration: [f64; 2],
}

impl Nominal {
    /// Mesh cycles since the start of counting at time `t` (s).
    pub fn cycles(&self, pair: &GearPair, options: &StaticOptions, t: f64) -> f64 {
        let driver = match options.driver {
            Driver::Pinion => pair.pinion.pitch_angle(),
            Driver::Wheel => pair.wheel.pitch_angle(),
        };
        self.start + self.speed.angle(t) / driver
    }

    /// The moment at time `t` (s).
    pub fn at(&self, pair: &GearPair, options: &StaticOptions, t: f64) -> Moment {
        let cycles = self.cycles(pair, options, t);
        let whole = cycles.floor();
        // Within round-off of a whole cycle, it is one: phase is below 1.
        let phase = (cycles - whole).min(1.0 - f64::EPSILON);
        let ratio = f64::from(pair.pinion.teeth()) / f64::from(pair.wheel.teeth());
        let sense = options.sense.sign() as f64;
        let of_pinion = match options.driver {
            Driver::Pinion => sense,
            Driver::Wheel => sense / ratio,
        };
        let both = |x: f64| [of_pinion * x, -of_pinion * ratio * x];
        Moment {
            station: Station { cycle: whole as i64, phase },
            velocity: both(self.speed.at(t)),
            acceleration: both(self.speed.acceleration(t)),
        }
    }
}
