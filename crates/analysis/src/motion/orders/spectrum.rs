//! Spectra of a motion at constant speed, and a waterfall of one whose speed changes.

use study::{StudyError, Window, spectrum as record_spectrum};

use super::MotionSeries;

/// Lines of a record; line 0 is the mean.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionSpectrum {
    /// Orders of the mesh frequency.
    pub orders: Vec<f64>,
    /// Frequencies, Hz.
    pub frequencies: Vec<f64>,
    /// Amplitudes of the dynamic transmission error, um.
    pub dte_um: Vec<f64>,
    /// Of the sum of the normal forces of the driving flanks, N.
    pub normal_force_n: Vec<f64>,
    /// Of the axial force on the wheel, N.
    pub wheel_force_z_n: Vec<f64>,
    /// Of the tilting moments about y on pinion and wheel, N mm.
    pub moment_y_nmm: [Vec<f64>; 2],
}

impl MotionSpectrum {
    /// Spectra of the whole record of `cycles` mesh cycles.
    ///
    /// # Errors
    /// [`StudyError`] for a record that contains a value that is not a number.
    pub fn of(series: &MotionSeries, cycles: u64, mesh_frequency_hz: f64, window: Window) -> Result<Self, StudyError> {
        let of = |samples: &[f64]| amplitudes(samples, window);
        let dte_um = of(&series.dte_um)?;
        let orders: Vec<f64> = (0..dte_um.len()).map(|k| k as f64 / cycles as f64).collect();
        let [pinion, wheel] = &series.moment_y_nmm;
        Ok(Self {
            frequencies: orders.iter().map(|o| o * mesh_frequency_hz).collect(),
            orders,
            dte_um,
            normal_force_n: of(&series.normal_force_n)?,
            wheel_force_z_n: of(&series.wheel_force_z_n)?,
            moment_y_nmm: [of(pinion)?, of(wheel)?],
        })
    }
}

/// Amplitudes at 0 (the mean), 1, 2, ... periods a record.
fn amplitudes(samples: &[f64], window: Window) -> Result<Vec<f64>, StudyError> {
    let mut of = record_spectrum(samples, samples.len() as f64, window)?;
    if let Some(first) = of.amplitudes.first_mut() {
        *first = of.mean.abs();
    }
    Ok(of.amplitudes)
}

/// One spectrum of a waterfall.
#[derive(Debug, Clone, PartialEq)]
pub struct WaterfallLine {
    /// Middle of its stretch, s.
    pub time: f64,
    /// Mean speed of the pinion, 1/min.
    pub speed_rpm: f64,
    /// Mean mesh frequency, Hz.
    pub mesh_frequency_hz: f64,
    /// Amplitudes of the DTE, um, at multiples of 1/cycles of the mesh order.
    pub amplitudes: Vec<f64>,
}

/// Order spectra of the DTE over stretches of `stretch` mesh cycles, each half over the one before, with a window of
/// Hann.
///
/// Values are evenly spaced in time within each mesh cycle, `per_cycle` in all of them, so orders stay in their bins as
/// the speed changes.
///
/// # Errors
/// [`StudyError`] for a record that contains a value that is not a number, and for series of different lengths.
pub fn waterfall(
    series: &MotionSeries,
    per_cycle: usize,
    stretch: usize,
    pinion_teeth: u32,
) -> Result<Vec<WaterfallLine>, StudyError> {
    let MotionSeries { dte_um: dte, time_s: time, pinion_speed_rpm: speed, .. } = series;
    series.check(&[time, speed], per_cycle)?;
    let length = per_cycle * stretch.max(1).min((dte.len() / per_cycle).max(1));
    let mut lines = Vec::new();
    let mut from = 0;
    while from + length <= dte.len() {
        let part = from..from + length;
        let speed_rpm = speed[part.clone()].iter().sum::<f64>().abs() / length as f64;
        lines.push(WaterfallLine {
            time: 0.5 * (time[from] + time[from + length - 1]),
            speed_rpm,
            mesh_frequency_hz: speed_rpm * f64::from(pinion_teeth) / 60.0,
            amplitudes: amplitudes(&dte[part], Window::Hann)?,
        });
        from += (length / 2 / per_cycle).max(1) * per_cycle;
    }
    Ok(lines)
}
