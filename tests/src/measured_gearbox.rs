//! Bounds of the numbers of a gearbox beside their errors, and the lines of JSON that `accuracy measure gearbox` writes of them.

use std::{error::Error, f64::consts::TAU};

use analysis::{
    Context, NoObserver,
    accuracy::{Accuracy, Bound, Quantity, Rung},
    gearbox::GearboxResult,
};
use scene::{AccuracyScene, Tolerance, gearbox::Gearbox};
use serde_json::{Value, json};

type Failure = Box<dyn Error + Send + Sync>;

/// Elements along the profile, slices, positions in a cycle and elements of a shaft of the reference.
const FINE: (u32, u32, u32, u32) = (6, 64, 64, 48);
/// Numbers that have bounds.
pub const QUANTITIES: [Quantity; 7] = [
    Quantity::MeanSte,
    Quantity::PeakToPeakSte,
    Quantity::MaxPressure,
    Quantity::MisalignmentInPlane,
    Quantity::FaceLoadFactor,
    Quantity::BearingForce,
    Quantity::NaturalFrequency,
];
/// Errors below this share of a number are round-off.
pub const LEAST_ERROR: f64 = 1e-6;

/// A gearbox of one mesh on fine settings.
#[derive(Debug)]
pub struct Exact(GearboxResult);

impl Exact {
    /// The reference of a gearbox.
    ///
    /// # Errors
    /// Why it has none.
    pub fn of(file: &Gearbox) -> Result<Self, Failure> {
        let mut file = file.clone();
        let (elements, slices, positions, shaft_elements) = FINE;
        let rung = Rung::ALL.into_iter().find(|rung| rung.elements_profile == elements).ok_or("no such rung")?;
        for mesh in &mut file.meshes {
            mesh.scene = rung.scene(&mesh.scene);
            mesh.scene.contact.slices = Some(slices);
        }
        (file.positions_per_cycle, file.shaft_elements) = (positions, shaft_elements);
        Ok(Self(solved(&file)?))
    }

    /// Bounds of a run that is asked for a share of all numbers, each with the number of the reference.
    ///
    /// # Errors
    /// Why it has none.
    pub fn beside(&self, file: &Gearbox, share: f64) -> Result<Vec<(Bound, f64)>, Failure> {
        let mut file = file.clone();
        file.accuracy = AccuracyScene::new(QUANTITIES.map(|q| (q, Tolerance::Relative(share))));
        let found = solved(&file)?;
        let Accuracy { bounds, .. } = found.accuracy.ok_or("no bounds")?;
        let mut bearings = 0..self.0.bearings.len();
        let exact = |bound: &Bound| self.number(bound.quantity, &mut bearings).ok_or(bound.quantity.key());
        let exact = bounds.iter().map(exact).collect::<Result<Vec<_>, _>>()?;
        Ok(bounds.into_iter().zip(exact).collect())
    }

    /// A number of the only mesh, of the next bearing, or of the whole.
    fn number(&self, quantity: Quantity, bearings: &mut impl Iterator<Item = usize>) -> Option<f64> {
        let result = &self.0;
        let mesh = result.meshes.first()?;
        match quantity {
            Quantity::MeanSte => Some(1e3 * mesh.transmission_error[0]),
            Quantity::PeakToPeakSte => Some(1e3 * mesh.transmission_error[1]),
            Quantity::MaxPressure => Some(mesh.max_pressure),
            Quantity::MisalignmentInPlane => Some(1e3 * mesh.misalignment[0]),
            Quantity::FaceLoadFactor => mesh.face_load_factor,
            Quantity::BearingForce => {
                let [x, y, z] = result.bearings.get(bearings.next()?)?.force;
                Some(x.hypot(y).hypot(z))
            }
            Quantity::NaturalFrequency => {
                Some(result.vibration.as_ref()?.modes.first()?.modes.first()?.frequency / TAU)
            }
            _ => None,
        }
    }
}

fn solved(file: &Gearbox) -> Result<GearboxResult, Failure> {
    Ok(analysis::solve(file, Context::new(&mut NoObserver)).and_then(|own| own.finished())?)
}

/// A number of a run beside its bound.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredBound {
    /// Key of the quantity.
    pub key: String,
    /// Exact value less that of the run.
    pub error: f64,
    /// Known part of it, and the bound of the rest before the factor of the calibration.
    pub known: f64,
    pub within: f64,
    /// Size of the number.
    pub scale: f64,
}

impl MeasuredBound {
    /// Of a bound and the exact number.
    fn new((bound, exact): &(Bound, f64)) -> Self {
        let (above, below) = (bound.above, bound.below);
        Self {
            key: bound.quantity.key().to_owned(),
            error: exact - bound.value,
            known: 0.5 * (above - below),
            within: bound.uncalibrated,
            scale: exact.abs(),
        }
    }

    fn to_json(&self) -> Value {
        let Self { key, error, known, within, scale } = self;
        json!({ "key": key, "error": error, "known": known, "within": within, "scale": scale })
    }

    fn of_json(line: &Value) -> Option<Self> {
        let of = |key: &str| line[key].as_f64();
        let key = line["key"].as_str()?.to_owned();
        Some(Self { key, error: of("error")?, known: of("known")?, within: of("within")?, scale: of("scale")? })
    }

    /// What the error is of the bound beyond its known part.
    pub fn filled(&self) -> f64 {
        (self.error - self.known).abs() / self.within.max(LEAST_ERROR * self.scale)
    }

    /// Bound over error, with a factor on the bound.
    pub fn sharpness(&self, factor: f64) -> f64 {
        (self.known.abs() + factor * self.within) / self.error.abs().max(LEAST_ERROR * self.scale)
    }
}

/// The line of a gearbox that is asked for several shares.
///
/// # Errors
/// Why it has none.
pub fn measured(file: &Gearbox, shares: &[f64]) -> Result<Value, Failure> {
    let exact = Exact::of(file)?;
    let run = |share: &f64| -> Result<Value, Failure> {
        let all = exact.beside(file, *share)?;
        let bounds = all.iter().map(|own| MeasuredBound::new(own).to_json());
        Ok(json!({ "asked": share, "bounds": bounds.collect::<Vec<_>>() }))
    };
    Ok(json!({ "runs": shares.iter().map(run).collect::<Result<Vec<_>, _>>()? }))
}

/// All bounds of a line; none of a gearbox that could not be measured.
pub fn bounds_of(line: &Value) -> Vec<MeasuredBound> {
    let runs = line["runs"].as_array().into_iter().flatten();
    runs.filter_map(|run| run["bounds"].as_array()).flatten().filter_map(MeasuredBound::of_json).collect()
}
