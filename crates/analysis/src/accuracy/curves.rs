//! Curves over the mesh cycle from which static headline values are computed.

use ltca::{StaticHistory, StaticPosition};
use scene::Quantity;
use serde::{Deserialize, Serialize};
use study::{Between, cycle_statistics, mesh_harmonics};

use crate::results::largest_tensions;

/// Values at all positions of a static run, in the units of the headline.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Curves {
    /// Number of whole mesh cycles.
    pub cycles: usize,
    /// Transmission error, um.
    pub ste_um: Vec<f64>,
    /// Transmission error without load, um.
    pub kinematic_um: Vec<f64>,
    /// Largest normal force of a tooth pair, N.
    pub pair_force_n: Vec<f64>,
    /// Largest contact pressure, MPa.
    pub pressure_mpa: Vec<f64>,
    /// Length of all contact lines, mm.
    pub line_length_mm: Vec<f64>,
    /// Secant and tangent stiffness of the mesh, N/um.
    pub stiffness_n_per_um: [Vec<f64>; 2],
    /// Largest tension in the fillets of pinion and wheel, MPa; empty if not requested.
    pub root_stress_mpa: [Vec<f64>; 2],
}

impl Curves {
    /// Curves of a run over a number of whole mesh cycles.
    pub fn of(history: &StaticHistory, cycles: usize) -> Self {
        let positions = &history.positions;
        let all = |of: &dyn Fn(&StaticPosition) -> f64| positions.iter().map(of).collect::<Vec<f64>>();
        let force = |p: &StaticPosition| p.pairs.iter().map(|pair| pair.normal_force).fold(0.0, crate::worse);
        let tensions = positions.iter().map(|p| largest_tensions(std::iter::once(&p.root_stress)));
        let tensions: Option<Vec<[f64; 2]>> = tensions.collect();
        let tension = |gear: usize| tensions.iter().flatten().map(|both| both[gear]).collect::<Vec<f64>>();
        Self {
            cycles,
            ste_um: all(&|p| 1e3 * p.transmission_error),
            kinematic_um: all(&|p| 1e3 * p.kinematic_transmission_error),
            pair_force_n: all(&force),
            pressure_mpa: all(&|p| p.max_pressure),
            line_length_mm: all(&|p| p.contact_line_length),
            stiffness_n_per_um: [all(&|p| 1e-3 * p.secant_stiffness), all(&|p| 1e-3 * p.tangent_stiffness)],
            root_stress_mpa: [tension(0), tension(1)],
        }
    }

    /// Every `stride`-th position of the curves.
    #[must_use]
    pub fn every(&self, stride: usize) -> Self {
        let of = |curve: &Vec<f64>| curve.iter().step_by(stride.max(1)).copied().collect::<Vec<f64>>();
        Self {
            cycles: self.cycles,
            ste_um: of(&self.ste_um),
            kinematic_um: of(&self.kinematic_um),
            pair_force_n: of(&self.pair_force_n),
            pressure_mpa: of(&self.pressure_mpa),
            line_length_mm: of(&self.line_length_mm),
            stiffness_n_per_um: self.stiffness_n_per_um.each_ref().map(of),
            root_stress_mpa: self.root_stress_mpa.each_ref().map(of),
        }
    }

    /// The value of a quantity, as in the headline; `None` if the curves do not contain it.
    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        let curve = self.curve(quantity)?;
        match Kind::of(quantity)? {
            Kind::Mean => Some(curve.iter().sum::<f64>() / curve.len() as f64),
            Kind::Largest => curve.iter().copied().reduce(f64::max),
            Kind::PeakToPeak => Some(cycle_statistics(curve, self.cycles).ok()?.peak_to_peak),
            Kind::Harmonic(order) => {
                let all = mesh_harmonics(curve, self.cycles, order).ok()?;
                all.iter().find(|h| h.order == order).map(|h| h.amplitude)
            }
        }
    }

    /// Possible error of a quantity between the positions; `None` if the curves do not contain it.
    pub fn between(&self, quantity: Quantity) -> Option<Between> {
        let curve = self.curve(quantity)?;
        match Kind::of(quantity)? {
            Kind::Mean => Between::mean(curve, self.cycles),
            Kind::Largest => Between::largest(curve),
            Kind::PeakToPeak => Between::peak_to_peak(curve, self.cycles),
            Kind::Harmonic(order) => Between::harmonic(curve, self.cycles, order),
        }
    }

    /// Mean transmission error minus the unloaded transmission error of micro-geometry and misalignment, um.
    pub fn deflection(&self) -> f64 {
        let elastic = self.ste_um.iter().zip(&self.kinematic_um).map(|(loaded, free)| loaded - free);
        elastic.sum::<f64>() / self.ste_um.len() as f64
    }

    fn curve(&self, quantity: Quantity) -> Option<&[f64]> {
        let curve: &Vec<f64> = match quantity {
            Quantity::MeanSte
            | Quantity::PeakToPeakSte
            | Quantity::FirstSteHarmonic
            | Quantity::SecondSteHarmonic
            | Quantity::ThirdSteHarmonic => &self.ste_um,
            Quantity::MaxPairForce => &self.pair_force_n,
            Quantity::MaxPressure => &self.pressure_mpa,
            Quantity::ContactLineLength => &self.line_length_mm,
            Quantity::MeshStiffness => &self.stiffness_n_per_um[0],
            Quantity::MeshStiffnessTangent => &self.stiffness_n_per_um[1],
            Quantity::PinionRootStress => &self.root_stress_mpa[0],
            Quantity::WheelRootStress => &self.root_stress_mpa[1],
            Quantity::RmsDte
            | Quantity::PeakToPeakDte
            | Quantity::MisalignmentInPlane
            | Quantity::FaceLoadFactor
            | Quantity::BearingForce
            | Quantity::NaturalFrequency => return None,
        };
        (!curve.is_empty()).then_some(curve.as_slice())
    }
}

/// What of a curve a quantity is.
enum Kind {
    Mean,
    Largest,
    PeakToPeak,
    Harmonic(usize),
}

impl Kind {
    fn of(quantity: Quantity) -> Option<Self> {
        match quantity {
            Quantity::MeanSte
            | Quantity::ContactLineLength
            | Quantity::MeshStiffness
            | Quantity::MeshStiffnessTangent => Some(Self::Mean),
            Quantity::MaxPairForce | Quantity::MaxPressure | Quantity::PinionRootStress | Quantity::WheelRootStress => {
                Some(Self::Largest)
            }
            Quantity::PeakToPeakSte => Some(Self::PeakToPeak),
            Quantity::FirstSteHarmonic => Some(Self::Harmonic(1)),
            Quantity::SecondSteHarmonic => Some(Self::Harmonic(2)),
            Quantity::ThirdSteHarmonic => Some(Self::Harmonic(3)),
            Quantity::RmsDte
            | Quantity::PeakToPeakDte
            | Quantity::MisalignmentInPlane
            | Quantity::FaceLoadFactor
            | Quantity::BearingForce
            | Quantity::NaturalFrequency => None,
        }
    }
}
