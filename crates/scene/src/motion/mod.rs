//! Tables of a scene for motion: bodies, bearings, drive, load, integration and analyses in time.

mod bearing;
mod check;
mod modes;
mod torque;

use integrate::Scheme;
use serde::Serialize;

use crate::schema::{BasinScene, BearingScene, DriveBy, MotionScene, SweepScene};

pub(super) use bearing::{bearing, body};
pub(super) use check::motion;
pub(super) use modes::modes;
pub(super) use torque::{begins_unloaded, beside_mean, drive, load};

impl BearingScene {
    /// Whether nothing is given.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Stiffnesses along x, y, z and about rx, ry, in that order.
    pub fn stiffnesses(&self) -> [Option<f64>; 5] {
        [
            self.stiffness_x_n_per_mm,
            self.stiffness_y_n_per_mm,
            self.stiffness_z_n_per_mm,
            self.stiffness_rx_nmm_per_rad,
            self.stiffness_ry_nmm_per_rad,
        ]
    }

    /// Damping in the same order.
    pub fn dampings(&self) -> [Option<f64>; 5] {
        [
            self.damping_x_ns_per_mm,
            self.damping_y_ns_per_mm,
            self.damping_z_ns_per_mm,
            self.damping_rx_nmms_per_rad,
            self.damping_ry_nmms_per_rad,
        ]
    }
}

/// Drive of the driver.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DriveScene {
    /// Prescribed quantity of the driver: its speed or its torque.
    pub by: DriveBy,
    /// Torque of the driver in the running sense; empty if its speed is given.
    #[serde(flatten)]
    pub torque: TorqueScene,
}

/// A torque over time. A table replaces mean, amplitude, frequency and phase.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct TorqueScene {
    /// Mean, N m; `None`: the torque that follows from the rest of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_nm: Option<f64>,
    /// Amplitude of a harmonic part, N m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub amplitude_nm: Option<f64>,
    /// Frequency of the harmonic part, Hz.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Phase of the cosine at t = 0, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phase_deg: Option<f64>,
    /// Times (s, ascending) with torques (N m), interpolated linearly, constant before and after.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table_s_nm: Option<Vec<[f64; 2]>>,
}

impl TorqueScene {
    /// Whether nothing is given.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

impl BasinScene {
    /// Initial transmission errors (um) and rates (mm/s) of all starts, rate by rate.
    pub fn places(&self) -> Vec<[f64; 2]> {
        let at = |[low, high]: [f64; 2], count: u32, i: u32| {
            if count < 2 { 0.5 * (low + high) } else { low + (high - low) * f64::from(i) / f64::from(count - 1) }
        };
        let column = |i| at([self.from_um, self.to_um], self.columns, i);
        let row = |k| at([self.from_mm_s, self.to_mm_s], self.rows, k);
        (0..self.rows).flat_map(|k| (0..self.columns).map(move |i| [column(i), row(k)])).collect()
    }
}

impl MotionScene {
    /// The method with its parameters.
    pub fn scheme(&self) -> Scheme {
        self.method.scheme(self.spectral_radius)
    }
}

impl SweepScene {
    /// All speeds, 1/min, ascending.
    pub fn all_rpm(&self) -> Vec<f64> {
        let last = self.speeds.max(2) - 1;
        let at = |i: u32| self.from_rpm + (self.to_rpm - self.from_rpm) * f64::from(i) / f64::from(last);
        (0..self.speeds).map(at).collect()
    }
}
