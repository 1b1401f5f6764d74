//! Drive and load of a pair: speed or torque of the driver, torque on the driven gear.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

/// Prescribed speed over time, with its angle in closed form.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Speed {
    /// Constant speed, rad/s.
    Constant(f64),
    /// Speed that changes between two times by the smooth step 3 x^2 - 2 x^3, rad/s and s.
    Ramp {
        /// Speed before the ramp, rad/s.
        from: f64,
        /// Speed after the ramp, rad/s.
        to: f64,
        /// Start of the ramp, s.
        start: f64,
        /// Duration of the ramp, s, > 0.
        duration: f64,
    },
}

impl Speed {
    /// Whether the speed is constant.
    pub fn is_constant(&self) -> bool {
        matches!(self, Self::Constant(_))
    }

    /// Start and end of its change, s; `None` if it is constant.
    pub fn change(&self) -> Option<[f64; 2]> {
        match *self {
            Self::Constant(_) => None,
            Self::Ramp { start, duration, .. } => Some([start, start + duration]),
        }
    }

    /// Speed at a time, rad/s.
    pub fn at(&self, t: f64) -> f64 {
        match *self {
            Self::Constant(omega) => omega,
            Self::Ramp { from, to, start, duration } => {
                let x = ((t - start) / duration).clamp(0.0, 1.0);
                from + (to - from) * x * x * (3.0 - 2.0 * x)
            }
        }
    }

    /// Acceleration at a time, rad/s^2.
    pub fn acceleration(&self, t: f64) -> f64 {
        match *self {
            Self::Constant(_) => 0.0,
            Self::Ramp { from, to, start, duration } => {
                let x = ((t - start) / duration).clamp(0.0, 1.0);
                (to - from) * 6.0 * x * (1.0 - x) / duration
            }
        }
    }

    /// Angle rotated since t = 0, rad: the integral of the speed, x^3 - x^4/2 for a step.
    pub fn angle(&self, t: f64) -> f64 {
        match *self {
            Self::Constant(omega) => omega * t,
            Self::Ramp { from, to, start, duration } => {
                let part = |t: f64| {
                    let x = ((t - start) / duration).clamp(0.0, 1.0);
                    let beyond = (t - start - duration).max(0.0);
                    duration * x * x * x * (1.0 - 0.5 * x) + beyond
                };
                from * t + (to - from) * (part(t) - part(0.0))
            }
        }
    }

    /// Time (s, >= 0) at which the rotation reaches `angle` (rad, >= 0); `None` if the motion stops before.
    pub fn time_at(&self, angle: f64) -> Option<f64> {
        let end = match *self {
            Self::Constant(omega) => return (omega > 0.0).then(|| angle / omega),
            Self::Ramp { start, duration, .. } => start + duration,
        };
        let beyond = angle - self.angle(end);
        if beyond >= 0.0 {
            let omega = self.at(end);
            return if omega > 0.0 { Some(end + beyond / omega) } else { (beyond == 0.0).then_some(end) };
        }
        // The angle never falls: bisect to the last bit.
        let (mut low, mut high) = (0.0, end);
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return Some(high);
            }
            if self.angle(middle) < angle { low = middle } else { high = middle }
        }
    }
}

/// Torque over time, N mm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Torque {
    /// Constant torque, N mm.
    Constant(f64),
    /// T_0 + T_1 cos(2 pi f t + phase).
    Harmonic {
        /// Mean torque T_0.
        mean: f64,
        /// Amplitude T_1.
        amplitude: f64,
        /// Frequency f, Hz.
        frequency_hz: f64,
        /// Phase, rad.
        phase: f64,
    },
    /// Linear interpolation between the given times (s, ascending), constant before and after.
    Table {
        /// Times, s.
        times: Vec<f64>,
        /// Torques, N mm.
        values: Vec<f64>,
    },
}

impl Torque {
    /// Mean over time, N mm; `None` for a table.
    pub fn mean(&self) -> Option<f64> {
        match self {
            Self::Constant(mean) | Self::Harmonic { mean, .. } => Some(*mean),
            Self::Table { .. } => None,
        }
    }

    /// The torque multiplied by a factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Constant(value) => Self::Constant(factor * value),
            Self::Harmonic { mean, amplitude, frequency_hz, phase } => {
                Self::Harmonic { mean: factor * mean, amplitude: factor * amplitude, frequency_hz, phase }
            }
            Self::Table { times, values } => {
                Self::Table { times, values: values.into_iter().map(|value| factor * value).collect() }
            }
        }
    }

    /// All parameters of the torque.
    pub fn numbers(&self) -> impl Iterator<Item = f64> {
        let (single, lists): (Vec<f64>, [&[f64]; 2]) = match self {
            Self::Constant(value) => (vec![*value], [&[]; 2]),
            Self::Harmonic { mean, amplitude, frequency_hz, phase } => {
                (vec![*mean, *amplitude, *frequency_hz, *phase], [&[]; 2])
            }
            Self::Table { times, values } => (Vec::new(), [times, values]),
        };
        single.into_iter().chain(lists.concat())
    }

    /// Torque at a time, N mm.
    pub fn at(&self, t: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Harmonic { mean, amplitude, frequency_hz, phase } => {
                mean + amplitude * (TAU * frequency_hz * t + phase).cos()
            }
            Self::Table { times, values } => {
                let i = times.partition_point(|&x| x <= t);
                match (i.checked_sub(1).map(|k| (times[k], values[k])), times.get(i).zip(values.get(i))) {
                    (Some((t0, a)), Some((&t1, &b))) => a + (b - a) * (t - t0) / (t1 - t0),
                    (Some((_, a)), None) => a,
                    (None, Some((_, &b))) => b,
                    (None, None) => 0.0,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::*;

    /// Speed is the slope of the angle, acceleration that of the speed; no jump where a ramp begins and ends.
    #[test]
    fn ramp_is_consistent() {
        let ramp = Speed::Ramp { from: 3.0, to: 104.0, start: 0.1, duration: 0.3 };
        for i in 0..60 {
            let (t, h) = (0.01 * f64::from(i) + 0.003, 1e-6);
            let speed = (ramp.angle(t + h) - ramp.angle(t - h)) / (2.0 * h);
            let acceleration = (ramp.at(t + h) - ramp.at(t - h)) / (2.0 * h);
            assert!((ramp.at(t) - speed).abs() < 1e-6, "{t} s: {}, not {speed}", ramp.at(t));
            assert!((ramp.acceleration(t) - acceleration).abs() < 1e-4, "{t} s: {acceleration}");
        }
        for angle in [0.0, 0.2, 5.0, 16.0, 20.0] {
            let found = ramp.time_at(angle).map_or(f64::NAN, |t| ramp.angle(t));
            assert!((found - angle).abs() < 1e-12, "{found} rad, not {angle}");
        }
        let stop = Speed::Ramp { from: 10.0, to: 0.0, start: 0.0, duration: 1.0 };
        assert_eq!(stop.time_at(5.1), None, "it stops after 5 rad");
        assert!((ramp.angle(0.4) - (0.1 * 3.0 + 0.3 * 0.5 * 107.0)).abs() < 1e-12);
    }

    #[test]
    fn tables_are_straight_between_and_held_beyond() {
        let table = Torque::Table { times: vec![0.0, 1.0, 3.0], values: vec![1.0, 2.0, -2.0] };
        assert_eq!([-1.0, 0.5, 1.0, 2.0, 5.0].map(|t| table.at(t)), [1.0, 1.5, 2.0, 0.0, -2.0]);
    }
}
