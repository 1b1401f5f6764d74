//! Natural frequencies over speed, their intersections with mesh and shaft orders, and those of a continuum for
//! comparison.

use ::lumped::{
    LumpedError,
    shaft18::{ShaftSystem, continuum_modes},
};
use answer::keyed;
use fem::beam::BeamTheory;
use scene::Driver;
use serde::Serialize;
use serde_json::{Map, Value};
use std::f64::consts::TAU;
use study::{Campbell, campbell as diagram};

use super::inputs::{LumpedInputs, LumpedSystem};
use crate::{AnalysisError, error::in_scene};

/// Speeds of the diagram, standstill among them.
const SPEEDS: u32 = 25;
/// The diagram ends at so many times the scene's speed, or where the first mesh order has passed the mesh resonance.
const BEYOND: f64 = 2.0;
/// Beam elements on each shaft, at least.
const ELEMENTS: u32 = 24;
/// Frequencies below this share of the highest are free turns.
const FREE: f64 = 1e-6;

/// Frequencies over speed.
#[derive(Debug, Clone, PartialEq)]
pub struct LumpedCampbell {
    /// Frequencies and resonances; its speeds are those of the driver in revolutions per second.
    pub diagram: Campbell,
    /// Name of each order.
    pub names: Vec<String>,
    /// Undamped natural frequencies without spin, Hz, including that of the free rotation.
    pub at_rest_hz: Vec<f64>,
    /// Frequencies of the shafts as Timoshenko beams, Hz.
    pub continuum_hz: Option<Vec<f64>>,
}

described::described! {
    /// An excitation that meets a mode.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub(crate) struct Meeting<'a> {
        /// mesh order or rotation of a gear that excites
        excitation: &'a str,
        /// number of the mode, from 1
        mode: usize,
        /// speed of the driver
        speed_rpm: f64,
        /// natural frequency there
        frequency_hz: f64,
    }

    /// Facts that only a linear model has.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub(crate) struct FrequencyFacts<'a> {
        /// undamped natural frequencies at rest, the free rotation among them
        natural_frequencies_hz: &'a [f64],
        /// natural frequencies of the same shafts in Timoshenko beam elements; model `shaft18`
        #[serde(skip_serializing_if = "Option::is_none")]
        continuum_frequencies_hz: Option<&'a [f64]>,
        /// speeds at which an order of excitation meets a natural frequency
        critical_speeds: Vec<Meeting<'a>>,
    }
}

/// Diagram of a linear model; `None` of one that is not.
///
/// # Errors
/// [`AnalysisError::Lumped`] for shafts that are none.
pub(super) fn campbell(inputs: &LumpedInputs, system: &LumpedSystem) -> Result<Option<LumpedCampbell>, AnalysisError> {
    let LumpedSystem { model, resonance_hz, shafts, .. } = system;
    let at_rest_hz = model.natural_frequencies_hz(0.0);
    let Some(&highest) = at_rest_hz.last() else { return Ok(None) };
    let elastic = |all: Vec<f64>| -> Vec<f64> { all.into_iter().filter(|f| *f > FREE * highest).collect() };
    let (names, orders): (Vec<String>, Vec<f64>) = orders(inputs).into_iter().unzip();
    let own = inputs.scene.operation.speed_rpm / 60.0;
    let last = (BEYOND * own).max(1.1 * resonance_hz / f64::from(inputs.scene.driver_teeth()));
    let speeds: Vec<f64> = (0..SPEEDS).map(|i| last * f64::from(i) / f64::from(SPEEDS - 1)).collect();
    let count = elastic(at_rest_hz.clone()).len();
    let of_speed = |speed: f64| {
        let all = elastic(model.natural_frequencies_hz(speed / own));
        // A free turn that round-off lifts above zero is the lowest.
        let surplus = all.len().saturating_sub(count);
        all[surplus..].to_vec()
    };
    let diagram = diagram(&speeds, &orders, of_speed)?;
    let continuum_hz = shafts.as_ref().map(continuum).transpose().map_err(in_scene(&inputs.scene))?;
    Ok(Some(LumpedCampbell { diagram, names, at_rest_hz, continuum_hz }))
}

/// Orders of excitation over the driver's turns: three of the mesh, and both shafts.
fn orders(inputs: &LumpedInputs) -> Vec<(String, f64)> {
    let teeth = [inputs.scene.pinion.teeth, inputs.scene.wheel.teeth].map(f64::from);
    let driver = f64::from(inputs.scene.driver_teeth());
    let mesh = (1..=3u32).map(|k| (format!("mesh order {k}"), f64::from(k) * driver));
    let name = |i: usize| match (i == 0) == (inputs.scene.operation.driver == Driver::Pinion) {
        true => "driver's turn".to_owned(),
        false => "driven gear's turn".to_owned(),
    };
    let shafts = (0..2).map(|i| (name(i), driver / teeth[i]));
    let mut all: Vec<(String, f64)> = mesh.chain(shafts).collect();
    // Gears with as many teeth turn alike.
    all.dedup_by(|b, a| a.1 == b.1);
    all
}

/// Frequencies of the shafts in Timoshenko beams, Hz, as many as are worth a comparison.
fn continuum(system: &ShaftSystem) -> Result<Vec<f64>, LumpedError> {
    let modes = continuum_modes(system, ELEMENTS, BeamTheory::Timoshenko)?;
    Ok(modes.frequencies.iter().map(|w| w / TAU).collect())
}

impl LumpedCampbell {
    /// The corresponding entries of the summary.
    pub fn facts(&self) -> Map<String, Value> {
        let free = self.at_rest_hz.len() - self.diagram.frequencies.len().min(self.at_rest_hz.len());
        let name = |order: f64| {
            let at = self.diagram.orders.iter().position(|o| *o == order);
            at.map_or("", |i| self.names[i].as_str())
        };
        let meetings = self
            .diagram
            .resonances
            .iter()
            .map(|r| Meeting {
                excitation: name(r.order),
                mode: free + r.mode + 1,
                speed_rpm: 60.0 * r.speed,
                frequency_hz: r.frequency,
            })
            .collect();
        keyed(&FrequencyFacts {
            natural_frequencies_hz: &self.at_rest_hz,
            continuum_frequencies_hz: self
                .continuum_hz
                .as_ref()
                .map(|all| &all[..self.at_rest_hz.len().min(all.len())]),
            critical_speeds: meetings,
        })
    }
}
