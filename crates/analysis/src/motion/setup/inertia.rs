//! The inertia that vibrates on the teeth, and its frequency.

use dynamics::Drive;
use gearbox::motion::PairModel;
use serde::Serialize;

/// t in kg.
const TONNE_KG: f64 = 1e3;

described::described! {
    /// Inertia that carries the mesh resonance; units are in the names, pinion first.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct InertiaHeadline {
        /// gears whose inertia vibrates on the teeth: both, or the driven one where the driver's speed is prescribed
        pub moving_gears: Vec<&'static str>,
        /// J / r_b^2 of pinion and wheel
        pub base_circle_masses_kg: [f64; 2],
        /// m_e of the mesh resonance: m_1 m_2 / (m_1 + m_2), or the mass of the driven gear alone
        pub equivalent_mass_kg: f64,
        /// mesh resonance with both gears free
        pub mesh_resonance_both_free_hz: f64,
        /// mesh resonance with the driver held
        pub mesh_resonance_driver_held_hz: f64,
    }
}

impl InertiaHeadline {
    /// Values of a pair.
    pub fn of(system: &PairModel) -> Self {
        let driven = system.options().statics.driven();
        let moving_gears = match system.options().drive {
            Drive::Speed(_) => vec![["pinion", "wheel"][driven]],
            Drive::Balanced(_) | Drive::Torque { .. } => vec!["pinion", "wheel"],
        };
        let [both_free, driver_held] = system.mesh_resonances_hz();
        Self {
            moving_gears,
            base_circle_masses_kg: system.base_circle_masses().map(|m| TONNE_KG * m),
            equivalent_mass_kg: TONNE_KG * system.equivalent_mass(),
            mesh_resonance_both_free_hz: both_free,
            mesh_resonance_driver_held_hz: driver_held,
        }
    }

    /// One line: whose inertia it is, and the alternative.
    pub fn describe(&self) -> String {
        match self.moving_gears.as_slice() {
            [one] => format!("the {one} alone, both free {:.1} Hz", self.mesh_resonance_both_free_hz),
            _ => format!("both gears, driver held {:.1} Hz", self.mesh_resonance_driver_held_hz),
        }
    }
}
