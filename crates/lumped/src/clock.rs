//! Where in its mesh cycle a pair is at a time.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::{
    LumpedError,
    error::{finite, not_negative, positive},
};

/// Speed of the driver and the mesh cycles that go by with it.
///
/// ```text
/// omega(t) = omega_0 + omega_a sin(nu t)
/// c(t)     = c_0 + z / (2 pi) [omega_0 t + omega_a (1 - cos(nu t)) / nu]
/// ```
/// The phase is the *integral* of the speed. Seed 004 prints e_a sin(2 pi omega_h(t) t), the speed of now times all the
/// time gone by: its frequency would swing wider and wider as time goes on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeshClock {
    /// Teeth z of the driver.
    pub driver_teeth: u32,
    /// Mean speed omega_0 of the driver, rad/s, > 0; the sense is the frame's.
    pub speed: f64,
    /// Amplitude omega_a of the speed's fluctuation, rad/s, 0 .. omega_0.
    #[serde(default)]
    pub fluctuation: f64,
    /// Angular frequency nu of the fluctuation, rad/s; > 0 where there is one.
    #[serde(default)]
    pub fluctuation_frequency: f64,
    /// Mesh cycles c_0 at t = 0.
    #[serde(default)]
    pub start: f64,
}

impl MeshClock {
    /// Clock at constant speed (rad/s), from phase 0 on.
    pub fn steady(driver_teeth: u32, speed: f64) -> Self {
        Self { driver_teeth, speed, fluctuation: 0.0, fluctuation_frequency: 0.0, start: 0.0 }
    }

    /// Mesh cycles c at time `t` (s).
    pub fn cycles(&self, t: f64) -> f64 {
        self.start + self.turned(t) * f64::from(self.driver_teeth) / TAU
    }

    /// Angle that the driver has turned since t = 0, rad.
    pub fn turned(&self, t: f64) -> f64 {
        let nu = self.fluctuation_frequency;
        let swing = if nu == 0.0 { 0.0 } else { self.fluctuation * (1.0 - (nu * t).cos()) / nu };
        self.speed * t + swing
    }

    /// Mesh angle 2 pi c at time `t` (s) and its rate in rad/s; whole cycles are taken off, so that no digits are lost
    /// in long runs.
    pub fn angle(&self, t: f64) -> [f64; 2] {
        let omega = self.speed + self.fluctuation * (self.fluctuation_frequency * t).sin();
        [TAU * self.cycles(t).rem_euclid(1.0), omega * f64::from(self.driver_teeth)]
    }

    /// Mean mesh frequency, Hz.
    pub fn mesh_frequency(&self) -> f64 {
        self.speed * f64::from(self.driver_teeth) / TAU
    }

    /// Clock at another mean speed (rad/s).
    #[must_use]
    pub fn at_speed(self, speed: f64) -> Self {
        Self { speed, ..self }
    }

    pub(crate) fn check(&self) -> Result<(), LumpedError> {
        positive("teeth of the driver", f64::from(self.driver_teeth))?;
        positive("speed in rad/s", self.speed)?;
        finite("start of the mesh cycle", self.start)?;
        not_negative("speed fluctuation in rad/s", self.fluctuation)?;
        not_negative("frequency of the speed fluctuation in rad/s", self.fluctuation_frequency)?;
        if self.fluctuation > 0.0 {
            positive("frequency of the speed fluctuation in rad/s", self.fluctuation_frequency)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rate is the slope of the angle, however long it has run.
    #[test]
    fn rate_is_the_slope_of_the_angle() {
        let clock =
            MeshClock { fluctuation: 20.0, fluctuation_frequency: 31.0, start: 0.2, ..MeshClock::steady(30, 104.7) };
        for t in [0.0, 0.37, 12.0, 500.0] {
            let h = 1e-6;
            let slope = TAU * (clock.cycles(t + h) - clock.cycles(t - h)) / (2.0 * h);
            let [_, rate] = clock.angle(t);
            assert!((slope / rate - 1.0).abs() < 1e-4, "{t} s: {rate}, not {slope}");
        }
    }
}
