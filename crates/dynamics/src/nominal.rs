//! Where a pair would stand if its flanks were rigid and just touched.

use ale::Station;
use geometry::{Driver, GearPair};
use ltca::StaticOptions;
use serde::{Deserialize, Serialize};

use crate::Speed;

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
pub struct NominalState {
    /// Station.
    pub station: Station,
    /// Angular velocity of both gears about +z, rad/s.
    pub velocity: [f64; 2],
    /// Angular acceleration of both gears about +z, rad/s^2.
    pub acceleration: [f64; 2],
    /// Sense in which each gear runs, +1 counter-clockwise; also where it stands still.
    pub senses: [f64; 2],
}

impl Nominal {
    /// Mesh cycles a second at time `t` (s).
    pub fn cycles_per_second(&self, pair: &GearPair, options: &StaticOptions, t: f64) -> f64 {
        self.speed.at(t) / driver_pitch(pair, options)
    }

    /// Time (s, >= 0) at which `cycles` mesh cycles have passed since t = 0; `None` where the gears stop before that.
    pub fn time_at(&self, pair: &GearPair, options: &StaticOptions, cycles: f64) -> Option<f64> {
        self.speed.time_at(cycles * driver_pitch(pair, options))
    }

    /// Mesh cycles since the start of counting at time `t` (s).
    pub fn cycles(&self, pair: &GearPair, options: &StaticOptions, t: f64) -> f64 {
        self.start + self.speed.angle(t) / driver_pitch(pair, options)
    }

    /// The moment at time `t` (s).
    pub fn at(&self, pair: &GearPair, options: &StaticOptions, t: f64) -> NominalState {
        let cycles = self.cycles(pair, options, t);
        let ratio = wheel_turns(pair);
        let senses = running_senses(pair, options);
        let of_pinion = match options.contact.driver {
            Driver::Pinion => senses[0],
            Driver::Wheel => senses[1] / ratio,
        };
        let both = |x: f64| [of_pinion * x, of_pinion * ratio * x];
        NominalState {
            station: Station::at_cycles(cycles),
            velocity: both(self.speed.at(t)),
            acceleration: both(self.speed.acceleration(t)),
            senses,
        }
    }
}

/// Turn of the wheel by one of the pinion, -z_1 / z_2: a ring (z_2 < 0) turns the same way.
pub(crate) fn wheel_turns(pair: &GearPair) -> f64 {
    -pair.pinion.signed_teeth() / pair.wheel.signed_teeth()
}

/// Sense in which pinion and wheel run, +1 counter-clockwise.
pub(crate) fn running_senses(pair: &GearPair, options: &StaticOptions) -> [f64; 2] {
    let of_pinion = options.contact.sense.sign() as f64;
    [of_pinion, of_pinion * wheel_turns(pair).signum()]
}

fn driver_pitch(pair: &GearPair, options: &StaticOptions) -> f64 {
    match options.contact.driver {
        Driver::Pinion => pair.pinion.pitch_angle(),
        Driver::Wheel => pair.wheel.pitch_angle().abs(),
    }
}
