//! What the mesh of a pair is over a mesh cycle: stiffness, unloaded error, length of contact lines.

use serde::{Deserialize, Serialize};

use crate::{
    Fourier, LumpedError, PlaneOfAction,
    error::finite,
    iso::{IsoPair, stiffness},
};

/// Phases and orders at which a stiffness in proportion to the contact lines is developed.
const PHASES: usize = 128;
const ORDERS: usize = 24;

/// Excitation of a pair over the mesh angle 2 pi c (rad), on the transverse line of action.
///
/// ```text
/// F_bt = k(phi) (te - e(phi))
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeshCycle {
    /// Mesh stiffness k, N/mm, > 0 at every phase.
    pub stiffness: Fourier,
    /// Transmission error e without load, mm; positive when the driven gear lags.
    pub error: Fourier,
    /// Length of the contact lines, mm; `None`: that of the unloaded pair.
    pub length: Option<Fourier>,
}

impl MeshCycle {
    /// Given series: k (N/mm) and e (mm).
    pub fn new(stiffness: Fourier, error: Fourier) -> Self {
        Self { stiffness, error, length: None }
    }

    /// Fed by a quasi-static analysis at evenly spaced phases k/n: stiffness (N/mm), contact-line length (mm),
    /// transmission error under load (mm), and the force on the transverse line of action (N) it was found with.
    ///
    /// ```text
    /// e = STE - F_bt / k
    /// ```
    /// so that this model, run slowly under the same force, gives the same STE, with the secant stiffness as with the
    /// tangent one. The tangent one is the stiffness that vibration about that load feels.
    ///
    /// # Errors
    /// [`LumpedError`] for samples that are none, not numbers, of different lengths, or a stiffness that is not
    /// positive between them.
    pub fn fed(stiffness: &[f64], length: &[f64], ste: &[f64], force: f64) -> Result<Self, LumpedError> {
        let wanted = stiffness.len();
        for (quantity, found) in [("contact-line length in mm", length.len()), ("transmission error in mm", ste.len())]
        {
            if found != wanted {
                return Err(LumpedError::Lengths { quantity, found, wanted });
            }
        }
        finite("force on the line of action in N", force)?;
        let error: Vec<f64> = ste.iter().zip(stiffness).map(|(te, k)| te - force / k).collect();
        let cycle = Self {
            stiffness: Fourier::of_samples("mesh stiffness in N/mm", stiffness, wanted)?,
            error: Fourier::of_samples("unloaded transmission error in mm", &error, wanted)?,
            length: Some(Fourier::of_samples("contact-line length in mm", length, wanted)?),
        };
        cycle.check()?;
        Ok(cycle)
    }

    /// k in proportion to the total length of the contact lines, with this mean (N/mm); no error.
    ///
    /// # Errors
    /// [`LumpedError`] for a mean that is not positive.
    pub fn by_contact_lines(plane: &PlaneOfAction, mean: f64) -> Result<Self, LumpedError> {
        plane.check()?;
        let samples: Vec<f64> =
            (0..PHASES).map(|k| mean * plane.at(k as f64 / PHASES as f64).length / plane.mean_length()).collect();
        let stiffness = Fourier::of_samples("mesh stiffness in N/mm", &samples, ORDERS)?;
        let cycle = Self::new(stiffness, Fourier::default());
        cycle.check()?;
        Ok(cycle)
    }

    /// k in proportion to the total length of the contact lines, with the mean stiffness c_gamma_alpha b of ISO 6336-1;
    /// no error.
    ///
    /// # Errors
    /// Those of [`crate::iso::stiffness`] and [`Self::by_contact_lines`].
    pub fn iso(pair: &IsoPair, plane: &PlaneOfAction) -> Result<Self, LumpedError> {
        // N/(mm um) per mm of face width to N/mm.
        Self::by_contact_lines(plane, 1000.0 * stiffness(pair)?.c_mesh * plane.face_width)
    }

    pub(crate) fn check(&self) -> Result<(), LumpedError> {
        self.stiffness.check_positive("mesh stiffness in N/mm")?;
        self.error.check("unloaded transmission error in mm")?;
        match &self.length {
            Some(length) => length.check("contact-line length in mm"),
            None => Ok(()),
        }
    }
}
