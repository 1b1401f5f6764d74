//! What a scene says of motion: bodies, bearings, drive, load, integration and analyses in time.

mod bearing;
mod check;
mod modes;
mod torque;

use integrate::Scheme;
use serde::Serialize;

use crate::schema::{Axis, BasinScene, ContinuationScene, DriveBy, Integration, RampScene, Run, SteadyBy, SweepWay};

pub(super) use bearing::{bearing, body};
pub(super) use check::motion;
pub use modes::ModesScene;
pub(super) use modes::modes;
pub(super) use torque::{drive, load};

/// Rigid body of a gear with what turns with it.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct BodyScene {
    /// Mass, kg; `None`: of the mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
    /// Inertia about an axis across the gear's own, through its centre at mid-face, kg m^2; `None`: of the mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub transverse_inertia_kg_m2: Option<f64>,
    /// Inertia about the gear's own axis, kg m^2; `None`: of the mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub polar_inertia_kg_m2: Option<f64>,
    /// Inertia of engine, load or shaft on the same axis, kg m^2.
    pub added_inertia_kg_m2: f64,
    /// Coordinates that are free beside the turn.
    pub free: Vec<Axis>,
}

/// Support of a gear's centre; `None`: none in that direction.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[allow(missing_docs)] // the keys say direction and unit, `docs/scene.md` the rest
pub struct BearingScene {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_x_n_per_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_y_n_per_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_z_n_per_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_rx_nmm_per_rad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_ry_nmm_per_rad: Option<f64>,
    /// Against the turn off the nominal one, of lumped gears.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_rz_nmm_per_rad: Option<f64>,
    /// Of each direction that is free and has no damping of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_ratio: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_x_ns_per_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_y_ns_per_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_z_ns_per_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_rx_nmms_per_rad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_ry_nmms_per_rad: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_rz_nmms_per_rad: Option<f64>,
    /// Whole matrices, 5 x 5 in the order x, y, z, rx, ry; N/mm, N/rad, N mm/rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness_matrix_n_mm_rad: Option<[[f64; 5]; 5]>,
    /// The same in N s/mm, N s/rad, N mm s/rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping_matrix_ns_mm_rad: Option<[[f64; 5]; 5]>,
}

impl BearingScene {
    /// Whether nothing is said.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Stiffnesses along and about x, y, z, rx, ry.
    pub fn stiffnesses(&self) -> [Option<f64>; 5] {
        [
            self.stiffness_x_n_per_mm,
            self.stiffness_y_n_per_mm,
            self.stiffness_z_n_per_mm,
            self.stiffness_rx_nmm_per_rad,
            self.stiffness_ry_nmm_per_rad,
        ]
    }

    /// Damping likewise.
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

/// What drives the driver.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DriveScene {
    /// Its speed or its torque.
    pub by: DriveBy,
    /// Torque of the driver in the running sense; nothing where its speed is given.
    #[serde(flatten)]
    pub torque: TorqueScene,
}

/// A torque over time. A table replaces mean, amplitude, frequency and phase.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct TorqueScene {
    /// Mean, N m; `None`: the one that the rest of the scene asks for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_nm: Option<f64>,
    /// Amplitude of a harmonic part, N m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub amplitude_nm: Option<f64>,
    /// Its frequency, Hz.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Phase of the cosine at t = 0, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub phase_deg: Option<f64>,
    /// Times (s, ascending) with torques (N m), straight lines between, held before and after.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub table_s_nm: Option<Vec<[f64; 2]>>,
}

impl TorqueScene {
    /// Whether nothing is said.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

/// Integration and analysis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MotionScene {
    /// What is run.
    pub run: Run,
    /// Method of integration.
    pub method: Integration,
    /// Spectral radius at infinite frequency of the generalised-alpha method.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spectral_radius: Option<f64>,
    /// Rows in a mesh cycle, and least number of steps.
    pub steps_per_mesh_cycle: u32,
    /// Least number of steps in a period of the mesh resonance; 0: rows are the steps.
    pub steps_per_resonance: u32,
    /// Local error of a step over the static deflection; `None`: steps of equal length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_tolerance: Option<f64>,
    /// Ends a step wherever contact is lost or gained.
    pub stop_at_events: bool,
    /// Damping ratio of the mesh; exactly one of the two is there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_damping_ratio: Option<f64>,
    /// Damping of a mm of contact line, N s/mm^2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_damping_ns_per_mm2: Option<f64>,
    /// Difference after a period over the peak to peak that counts as none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub periodic_tolerance: Option<f64>,
    /// Mesh cycles to wait for the periodic state at the most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub warm_up_cycles: Option<u32>,
    /// Length of a span, s; `None`: `cycles` mesh cycles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// A checkpoint every so many mesh cycles; 0: none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub checkpoint_every_cycles: Option<u32>,
    /// Run-up or run-down.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ramp: Option<RampScene>,
    /// Sweep.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweep: Option<SweepScene>,
    /// Continuation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub continuation: Option<ContinuationScene>,
    /// Basins of attraction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub basins: Option<BasinScene>,
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

/// Speeds of the driver.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepScene {
    /// Lowest, 1/min.
    pub from_rpm: f64,
    /// Highest, 1/min.
    pub to_rpm: f64,
    /// How many, evenly spaced.
    pub speeds: u32,
    /// Which way they are gone through.
    pub ways: Vec<SweepWay>,
    /// How each steady state is found.
    pub steady_by: SteadyBy,
}

impl SweepScene {
    /// All speeds, 1/min, ascending.
    pub fn all_rpm(&self) -> Vec<f64> {
        let last = self.speeds.max(2) - 1;
        let at = |i: u32| self.from_rpm + (self.to_rpm - self.from_rpm) * f64::from(i) / f64::from(last);
        (0..self.speeds).map(at).collect()
    }
}
