//! The headline values of a static cycle for which bounds are given.

use ltca::{StaticHistory, StaticPosition};
use scene::{Quantity, Scene};
use study::StudyError;

use crate::results::{RootStressHeadline, StaticHeadline, static_headline};

/// The value of a quantity in a run of a static pair; `None` if the run does not contain it.
pub fn value_of(quantity: Quantity, headline: &StaticHeadline) -> Option<f64> {
    let root = |of: fn(&RootStressHeadline) -> f64| headline.root_stress.as_ref().map(of);
    let harmonic = |order: usize| headline.ste_harmonics_um.get(order - 1).copied();
    match quantity {
        Quantity::MeanSte => Some(headline.mean_ste_um),
        Quantity::PeakToPeakSte => Some(headline.peak_to_peak_ste_um),
        Quantity::FirstSteHarmonic => harmonic(1),
        Quantity::SecondSteHarmonic => harmonic(2),
        Quantity::ThirdSteHarmonic => harmonic(3),
        Quantity::MaxPairForce => Some(headline.max_pair_force_n),
        Quantity::MaxPressure => Some(headline.max_pressure_mpa),
        Quantity::PinionRootStress => root(|r| r.pinion.max_principal.stress_mpa),
        Quantity::WheelRootStress => root(|r| r.wheel.max_principal.stress_mpa),
        Quantity::ContactLineLength => Some(headline.mean_contact_line_length_mm),
        Quantity::MeshStiffness => Some(headline.mean_mesh_stiffness_n_per_um),
        Quantity::MeshStiffnessTangent => Some(headline.mean_mesh_stiffness_tangent_n_per_um),
        Quantity::RmsDte
        | Quantity::PeakToPeakDte
        | Quantity::MisalignmentInPlane
        | Quantity::FaceLoadFactor
        | Quantity::BearingForce
        | Quantity::NaturalFrequency => None,
    }
}

/// Values of all quantities of one cycle; NaN for a quantity that the run does not contain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    values: [f64; Quantity::ALL.len()],
    /// Mean transmission error without what micro-geometry and misalignment make of it unloaded, um.
    deflection: f64,
}

/// Whether errors of a quantity are proportional to the deflection of the pair instead of the quantity itself.
/// Transmission errors may be small because the micro-geometry cancels the deflection, or because they hardly vary.
pub fn goes_with_deflection(quantity: Quantity) -> bool {
    matches!(
        quantity,
        Quantity::MeanSte
            | Quantity::PeakToPeakSte
            | Quantity::FirstSteHarmonic
            | Quantity::SecondSteHarmonic
            | Quantity::ThirdSteHarmonic
    )
}

impl Sample {
    /// Sample of values and the mean deflection, um; NaN for missing values.
    pub fn new(value: impl Fn(Quantity) -> Option<f64>, deflection: f64) -> Self {
        Self { values: std::array::from_fn(|i| value(Quantity::ALL[i]).unwrap_or(f64::NAN)), deflection }
    }

    /// Mean transmission error minus the unloaded transmission error of micro-geometry and misalignment, um.
    pub fn deflection(&self) -> f64 {
        self.deflection
    }

    /// Value of the quantity from every `stride`-th position of a history. The stride divides the number of positions of a
    /// cycle.
    ///
    /// # Errors
    /// [`StudyError`] if the history does not match the scene.
    pub fn of(scene: &Scene, history: &StaticHistory, stride: usize) -> Result<Self, StudyError> {
        let positions = history.positions.iter().step_by(stride).cloned().collect();
        let headline = static_headline(scene, &StaticHistory { positions, ..StaticHistory::default() })?;
        let values = std::array::from_fn(|i| value_of(Quantity::ALL[i], &headline).unwrap_or(f64::NAN));
        let elastic = |p: &StaticPosition| 1e3 * (p.transmission_error - p.kinematic_transmission_error);
        let all = history.positions.iter().step_by(stride).map(elastic);
        Ok(Self { values, deflection: all.sum::<f64>() / history.positions.len().div_ceil(stride) as f64 })
    }

    /// The value of a quantity; `None` if the run does not contain it.
    pub fn get(&self, quantity: Quantity) -> Option<f64> {
        self.values.get(quantity as usize).copied().filter(|v| v.is_finite())
    }

    /// The value to which errors of a quantity are relative; `None` if the run does not contain it.
    pub fn scale(&self, quantity: Quantity) -> Option<f64> {
        let own = self.get(quantity)?;
        Some(if goes_with_deflection(quantity) { self.deflection } else { own.abs() })
    }
}
