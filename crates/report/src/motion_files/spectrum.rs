//! Quantities that have a spectrum.

use analysis::motion::MotionSpectrum;

/// Quantities that have a spectrum, as the columns of `spectrum.csv` name them.
pub const SPECTRA: [&str; 5] =
    ["dte_um", "normal_force_n", "wheel_force_z_n", "pinion_moment_y_nmm", "wheel_moment_y_nmm"];

/// Amplitudes, quantity by quantity as in [`SPECTRA`].
pub fn spectra(of: &MotionSpectrum) -> [&[f64]; 5] {
    let [pinion, wheel] = &of.moment_y_nmm;
    [&of.dte_um, &of.normal_force_n, &of.wheel_force_z_n, pinion, wheel]
}
