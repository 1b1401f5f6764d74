//! Spectra of a motion at constant speed, and the waterfall of one with changing speed.

use integrate::Periodicity;
use study::{MotionSpectrum, Stretches, StudyError, Waterfall, Window, waterfall};

use super::MotionSeries;

/// Tolerance below which what does not come back shows in no line.
const LEAST: f64 = 1e-9;

/// Window over a record of so many cycles of a motion that was to repeat itself to a tolerance: none where it does, and the record
/// is whole periods.
pub(crate) fn window(found: Option<Periodicity>, tolerance: f64, cycles: u64) -> Window {
    let whole = |p: Periodicity| p.residual <= 10.0 * tolerance.max(LEAST) && cycles.is_multiple_of(p.period as u64);
    if found.is_some_and(whole) { Window::Rectangular } else { Window::Hann }
}

impl MotionSeries {
    /// Spectra of the whole record of a number of mesh cycles: transmission error (um), sum of the normal forces of the
    /// driving flanks (N), axial force on the wheel (N), tilting moments about y on pinion and wheel (N mm).
    ///
    /// # Errors
    /// [`StudyError`] for a record with a value that is not a finite number.
    pub fn spectrum(&self, of: (f64, f64), window: Window) -> Result<MotionSpectrum, StudyError> {
        let [pinion, wheel] = &self.moment_y_nmm;
        let all = [&self.dte_um, &self.normal_force_n, &self.wheel_force_z_n, pinion, wheel];
        MotionSpectrum::of(&all.map(|own| vec![own.as_slice()]), of, window)
    }

    /// Order spectra of the transmission error over sections of `cycles` mesh cycles with `per_cycle` values in each,
    /// for a pair whose pinion has a given number of teeth.
    ///
    /// # Errors
    /// [`StudyError`] for a record with a value that is not a finite number, and for series of different lengths.
    pub fn waterfall(&self, per_cycle: usize, cycles: usize, pinion_teeth: u32) -> Result<Waterfall, StudyError> {
        let stretches = Stretches::of_cycles(self.len(), (per_cycle, cycles), pinion_teeth);
        waterfall(&[vec![&self.dte_um]], (&self.time_s, &self.pinion_speed_rpm), stretches)
    }
}
