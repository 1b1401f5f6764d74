//! Campbell diagram of a reduced pair: its frequencies and mesh orders.

use serde::Serialize;
use study::{Campbell, StudyError, campbell};

/// Mesh orders that may meet a frequency.
const ORDERS: usize = 6;
/// Speeds of the diagram, standstill among them.
const SPEEDS: u32 = 25;
/// The diagram ends a little beyond the highest speed of the run.
pub(crate) const CAMPBELL_BEYOND: f64 = 1.05;

/// Frequencies that a mesh order may meet over the speeds of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct CampbellDiagram {
    /// Frequencies and resonances; its speeds are those of the driver in revolutions per second.
    pub diagram: Campbell,
    /// Names of the orders.
    pub orders: Vec<String>,
    /// Names of the frequencies, ascending as in the diagram.
    pub names: Vec<String>,
}

described::described! {
    /// A mesh order that meets a frequency within the speeds of the run.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct CriticalSpeed {
        /// mesh order that excites
        pub excitation: String,
        /// natural frequency that it meets
        pub meets: String,
        /// speed of the driver
        pub driver_speed_rpm: f64,
        /// frequency of both
        pub frequency_hz: f64,
    }
}

impl CampbellDiagram {
    /// Diagram of named frequencies (Hz), for a pair whose driver has a given number of teeth, up to its highest mesh
    /// frequency, Hz.
    ///
    /// Frequencies that are not finite are omitted.
    ///
    /// # Errors
    /// [`StudyError`] for an invalid frequency.
    pub fn of(
        frequencies: impl IntoIterator<Item = (f64, String)>,
        teeth: u32,
        highest_mesh_hz: f64,
    ) -> Result<Self, StudyError> {
        let mut lines: Vec<_> = frequencies.into_iter().filter(|(hz, _)| hz.is_finite()).collect();
        lines.sort_by(|a, b| a.0.total_cmp(&b.0));
        let teeth = f64::from(teeth);
        let last = CAMPBELL_BEYOND * highest_mesh_hz / teeth;
        let speeds: Vec<f64> = (0..SPEEDS).map(|i| last * f64::from(i) / f64::from(SPEEDS - 1)).collect();
        let orders: Vec<f64> = (1..=ORDERS).map(|k| k as f64 * teeth).collect();
        let diagram = campbell(&speeds, &orders, |_| lines.iter().map(|(hz, _)| *hz).collect())?;
        let names = lines.into_iter().map(|(_, name)| name).collect();
        Ok(Self { diagram, orders: (1..=ORDERS).map(|k| format!("mesh order {k}")).collect(), names })
    }

    /// Intersections of orders and frequencies, ascending in speed.
    pub fn critical_speeds(&self) -> Vec<CriticalSpeed> {
        let mut all: Vec<_> = self.diagram.resonances.iter().collect();
        all.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        let one = |r: &study::Resonance| CriticalSpeed {
            excitation: self
                .diagram
                .orders
                .iter()
                .position(|o| *o == r.order)
                .map_or(String::new(), |i| self.orders[i].clone()),
            meets: self.names[r.mode].clone(),
            driver_speed_rpm: 60.0 * r.speed,
            frequency_hz: r.frequency,
        };
        all.into_iter().map(one).collect()
    }
}
