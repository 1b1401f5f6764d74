//! Values of a scene in the units of the solvers: mm, N, MPa, t, s, rad. All conversions are here, each once.

use std::f64::consts::PI;

use geometry::Side;

use crate::{
    BodyScene, DiscScene, Lumped8Scene, Lumped12Scene, Material, MeshScene, MisalignmentScene, Operation, PairScene,
    RampScene, Shaft18Scene, ShaftScene, TorqueScene,
};

/// 1/min in rad/s.
pub const RPM: f64 = PI / 30.0;
/// N m in N mm; kg m^2 in t mm^2; m/s^2 in mm/s^2.
const THOUSAND: f64 = 1e3;
/// um in mm; kg in t.
const THOUSANDTH: f64 = 1e-3;

impl Operation {
    /// Torque on the driven gear, N mm.
    pub fn torque(&self) -> f64 {
        self.torque_nm * THOUSAND
    }

    /// Speed of the driver, rad/s.
    pub fn speed(&self) -> f64 {
        self.speed_rpm * RPM
    }

    /// The side of the pinion's teeth that the torque loads: the left flanks if it drives counter-clockwise.
    pub fn side(&self) -> Side {
        self.driver.loaded_side(self.rotation)
    }
}

impl Material {
    /// Density, t/mm^3.
    pub fn density(&self) -> f64 {
        self.density_kg_m3 * 1e-12
    }
}

impl PairScene {
    /// Normal pressure angle, rad.
    pub fn normal_pressure_angle(&self) -> f64 {
        self.normal_pressure_angle_deg.to_radians()
    }
}

impl MisalignmentScene {
    /// Deviation and inclination of the axes, then their components in the plane of action and perpendicular to it, mm
    /// over the face width.
    pub fn in_mm(&self) -> [f64; 4] {
        self.all_um().map(|um| THOUSANDTH * um)
    }

    /// Largest motion of the flanks that all of them together may cause, mm.
    pub fn size_mm(&self) -> f64 {
        THOUSANDTH * self.all_um().iter().map(|um| um.abs()).sum::<f64>()
    }

    fn all_um(&self) -> [f64; 4] {
        let Self { deviation_um, inclination_um, in_plane_of_action_um, across_plane_of_action_um } = *self;
        [deviation_um, inclination_um, in_plane_of_action_um, across_plane_of_action_um]
    }
}

impl RampScene {
    /// First and last speed of the driver, rad/s.
    pub fn speeds(&self) -> [f64; 2] {
        [self.from_rpm, self.to_rpm].map(|rpm| rpm * RPM)
    }
}

impl TorqueScene {
    /// Mean torque, N mm; `None` if the scene gives none.
    pub fn mean(&self) -> Option<f64> {
        self.torque_nm.map(|nm| THOUSAND * nm)
    }

    /// Amplitude (N mm), frequency (Hz) and phase (rad) of the harmonic part; `None` without one.
    pub fn harmonic(&self) -> Option<[f64; 3]> {
        Some([THOUSAND * self.amplitude_nm?, self.frequency_hz?, self.phase_deg.unwrap_or(0.0).to_radians()])
    }

    /// Torque at t = 0 beside a mean, N m.
    pub(crate) fn at_start(&self, mean_nm: f64) -> f64 {
        if let Some(rows) = &self.table_s_nm {
            let behind = rows.iter().position(|row| row[0] > 0.0);
            return match behind {
                Some(0) => rows[0][1],
                Some(next) => {
                    let ([t0, a], [t1, b]) = (rows[next - 1], rows[next]);
                    a + (b - a) * (0.0 - t0) / (t1 - t0)
                }
                None => rows.last().map_or(mean_nm, |row| row[1]),
            };
        }
        let [amplitude, _, phase] = self.harmonic().unwrap_or_default();
        mean_nm + amplitude / THOUSAND * phase.cos()
    }

    /// Times (s) and torques (N mm) of a table; `None` without one.
    pub fn table(&self) -> Option<[Vec<f64>; 2]> {
        let rows = self.table_s_nm.as_ref()?;
        Some([rows.iter().map(|row| row[0]).collect(), rows.iter().map(|row| THOUSAND * row[1]).collect()])
    }
}

impl BodyScene {
    /// Mass, t, if given.
    pub fn mass(&self) -> Option<f64> {
        self.mass_kg.map(|kg| THOUSANDTH * kg)
    }

    /// Inertia about an axis perpendicular to the gear's own, and about its own, t mm^2, if given.
    pub fn inertias(&self) -> [Option<f64>; 2] {
        [self.transverse_inertia_kg_m2, self.polar_inertia_kg_m2].map(|own| own.map(|kg_m2| THOUSAND * kg_m2))
    }

    /// Added inertia of engine, load or shaft on the gear's axis, t mm^2.
    pub fn added_inertia(&self) -> f64 {
        THOUSAND * self.added_inertia_kg_m2
    }
}

impl MeshScene {
    /// Half of the backlash along the normal, mm; `None`: that of the geometry.
    pub fn half_backlash(&self) -> Option<f64> {
        self.half_backlash_um.map(|um| THOUSANDTH * um)
    }

    /// Cosine and sine amplitudes of the unloaded transmission error, mm.
    pub fn error(&self) -> [Vec<f64>; 2] {
        [&self.error_cos_um, &self.error_sin_um].map(|all| all.iter().map(|um| THOUSANDTH * um).collect())
    }
}

impl ShaftScene {
    /// Eccentricity of the gear's teeth (mm) and its angle before the line of action at the start (rad).
    pub fn run_out(&self) -> [f64; 2] {
        [THOUSANDTH * self.run_out_um, self.run_out_phase_deg.to_radians()]
    }
}

impl DiscScene {
    /// Mass, t.
    pub fn mass(&self) -> f64 {
        THOUSANDTH * self.mass_kg
    }

    /// Inertia about an axis perpendicular to the shaft's, and about the shaft's, t mm^2.
    pub fn inertias(&self) -> [f64; 2] {
        [self.transverse_inertia_kg_m2, self.polar_inertia_kg_m2].map(|kg_m2| THOUSAND * kg_m2)
    }
}

impl Shaft18Scene {
    /// Acceleration of gravity along x, y, z, mm/s^2.
    pub fn gravity(&self) -> [f64; 3] {
        self.gravity_m_per_s2.map(|own| THOUSAND * own)
    }
}

impl Lumped8Scene {
    /// Amplitude of the driver's speed about its mean, rad/s.
    pub fn speed_fluctuation(&self) -> f64 {
        self.speed_fluctuation_rpm * RPM
    }
}

impl Lumped12Scene {
    /// Direction from the driver's centre to the driven gear's, rad; `None`: that of the pair.
    pub fn orientation(&self) -> Option<f64> {
        self.orientation_deg.map(f64::to_radians)
    }
}
