//! Amplitudes at one frequency. Theory (89).

use nalgebra::{Complex, DMatrix, DVector};

use crate::{GearboxError, Rotors, whirl::Spin};

/// Loads, spin and damping of one search for amplitudes.
pub(crate) struct Spinning<'a> {
    rotors: &'a Rotors,
    /// Phi'(C + G) Phi + diag(2 zeta W), 1/s.
    rates: DMatrix<f64>,
    /// What a frame that turns adds to W^2, 1/s^2.
    frame: Option<DMatrix<f64>>,
}

impl<'a> Spinning<'a> {
    /// Shafts that spin at `speeds`, rad/s about +z.
    pub(crate) fn new(rotors: &'a Rotors, speeds: &[f64], damping_ratio: f64) -> Result<Self, GearboxError> {
        if !(damping_ratio.is_finite() && damping_ratio >= 0.0) {
            let part = "the modes".into();
            return Err(GearboxError::OutOfRange { part, quantity: "damping ratio", value: damping_ratio });
        }
        let Spin { rates, frame } = rotors.spin(speeds)?;
        let rates = &rotors.damping + rates + damping_ratio * &rotors.unit_damping;
        Ok(Self { rotors, rates, frame: frame.map(|[stiffness, circulating]| stiffness + circulating) })
    }

    /// Amplitudes of all coordinates.
    pub(crate) fn amplitudes(
        &self,
        frequency: f64,
        force: &DVector<Complex<f64>>,
    ) -> Result<DVector<Complex<f64>>, GearboxError> {
        let out = |quantity, value| GearboxError::OutOfRange { part: "the response".into(), quantity, value };
        if !frequency.is_finite() || frequency < 0.0 {
            return Err(out("angular frequency, rad/s", frequency));
        }
        let size = self.rotors.assembly.size();
        if force.len() != size {
            return Err(GearboxError::Count { what: "coordinates of a load", found: force.len(), wanted: size });
        }
        let Rotors { rest, .. } = self.rotors;
        let modal = times(&rest.shapes.transpose(), force);
        let matrix = DMatrix::from_fn(rest.frequencies.len(), rest.frequencies.len(), |i, j| {
            let own = if i == j { rest.frequencies[i].powi(2) - frequency * frequency } else { 0.0 };
            let by_frame = self.frame.as_ref().map_or(0.0, |frame| frame[(i, j)]);
            Complex::new(own + by_frame, frequency * self.rates[(i, j)])
        });
        let eta = matrix.lu().solve(&modal).filter(|eta| eta.iter().all(|x| x.re.is_finite() && x.im.is_finite()));
        Ok(times(
            &rest.shapes,
            &eta.ok_or_else(|| out("undamped resonance at an angular frequency, rad/s", frequency))?,
        ))
    }
}

impl Rotors {
    /// Steady amplitudes q = Re(x exp(i w t)) under forces Re(f exp(i w t)), with the shafts spinning at `speeds`.
    ///
    /// ```text
    /// (W^2 - w^2 + i w (2 zeta W + Phi'(C + G) Phi)) eta = Phi' f,   x = Phi eta
    /// ```
    /// Computed in all modes without spin: (K - w^2 M + i w (C + G + C_zeta)) x = f, where C_zeta gives every mode
    /// without spin the damping ratio zeta. It does not damp rigid motions. In the frame of a carrier that turns theory (86b)
    /// stands in their place.
    ///
    /// # Errors
    /// [`GearboxError::OutOfRange`], also if a static force acts on a rigid motion, or an undamped mode is excited at
    /// its own frequency; [`GearboxError::Count`].
    pub fn response(
        &self,
        speeds: &[f64],
        frequency: f64,
        damping_ratio: f64,
        force: &DVector<Complex<f64>>,
    ) -> Result<DVector<Complex<f64>>, GearboxError> {
        Spinning::new(self, speeds, damping_ratio)?.amplitudes(frequency, force)
    }
}

/// A real matrix times complex values, part by part.
fn times(matrix: &DMatrix<f64>, values: &DVector<Complex<f64>>) -> DVector<Complex<f64>> {
    let [re, im] = [values.map(|x| x.re), values.map(|x| x.im)].map(|part| matrix * part);
    DVector::from_fn(re.len(), |i, _| Complex::new(re[i], im[i]))
}
