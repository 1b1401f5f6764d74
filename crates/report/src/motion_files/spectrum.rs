//! `spectrum.csv` of a motion at constant speed, `waterfall.csv` of one whose speed changes.

use analysis::motion::{MotionSpectrum, WaterfallLine};

use crate::csv::push_row;

/// Quantities that have a spectrum, as the columns of `spectrum.csv` name them.
pub const SPECTRA: [&str; 5] =
    ["dte_um", "normal_force_n", "wheel_force_z_n", "pinion_moment_y_nmm", "wheel_moment_y_nmm"];

/// Amplitudes, quantity by quantity as in [`SPECTRA`].
pub fn spectra(of: &MotionSpectrum) -> [&[f64]; 5] {
    let [pinion, wheel] = &of.moment_y_nmm;
    [&of.dte_um, &of.normal_force_n, &of.wheel_force_z_n, pinion, wheel]
}

/// `spectrum.csv`.
pub fn spectrum_csv(of: &MotionSpectrum) -> String {
    let mut csv = format!("mesh_order,frequency_hz,{}\n", SPECTRA.join(","));
    for (k, order) in of.orders.iter().enumerate() {
        let lines = spectra(of).into_iter().map(|a| a[k]);
        push_row(&mut csv, [*order, of.frequencies[k]].into_iter().chain(lines));
    }
    csv
}

/// `waterfall.csv`.
pub fn waterfall_csv(lines: &[WaterfallLine], per_cycle: usize) -> String {
    let mut csv = "time_s,pinion_speed_rpm,mesh_order,frequency_hz,dte_um\n".to_owned();
    for line in lines {
        // So many bins to half of the rows in a cycle.
        let bins = line.amplitudes.len().saturating_sub(1).max(1) as f64;
        for (k, amplitude) in line.amplitudes.iter().enumerate() {
            let order = k as f64 / bins * 0.5 * per_cycle as f64;
            push_row(&mut csv, [line.time, line.speed_rpm, order, order * line.mesh_frequency_hz, *amplitude]);
        }
    }
    csv
}
