//! `spectrum.csv` of a motion at constant speed, `waterfall.csv` of one whose speed changes.

use study::{Columns, StudyError, Window, spectrum as record_spectrum};

use report::columns::motion_history::{DTE, PINION_SPEED, TIME};

use crate::output::push_row;

/// Quantities that have a spectrum.
pub(crate) const SPECTRA: [&str; 5] =
    ["dte_um", "normal_force_n", "wheel_force_z_n", "pinion_moment_y_nmm", "wheel_moment_y_nmm"];

/// Lines of a record.
#[derive(Debug, Clone)]
pub(crate) struct Spectrum {
    /// Orders of the mesh frequency.
    pub orders: Vec<f64>,
    /// Frequencies, Hz.
    pub frequencies: Vec<f64>,
    /// Amplitudes, quantity by quantity as in [`SPECTRA`].
    pub amplitudes: Vec<Vec<f64>>,
}

/// Spectra of the whole record of `cycles` mesh cycles; line 0 is the mean.
///
/// # Errors
/// [`StudyError`] for a record that holds what is no number.
pub(crate) fn spectrum(
    rows: &Columns,
    cycles: u64,
    mesh_frequency_hz: f64,
    window: Window,
) -> Result<Spectrum, StudyError> {
    let amplitudes: Vec<Vec<f64>> =
        SPECTRA.iter().map(|n| amplitudes(rows.series(n)?, window)).collect::<Result<_, _>>()?;
    let orders: Vec<f64> = (0..amplitudes[0].len()).map(|k| k as f64 / cycles as f64).collect();
    let frequencies = orders.iter().map(|o| o * mesh_frequency_hz).collect();
    Ok(Spectrum { orders, frequencies, amplitudes })
}

/// Amplitudes at 0 (the mean), 1, 2, ... periods a record.
fn amplitudes(samples: &[f64], window: Window) -> Result<Vec<f64>, StudyError> {
    let mut of = record_spectrum(samples, samples.len() as f64, window)?;
    if let Some(first) = of.amplitudes.first_mut() {
        *first = of.mean.abs();
    }
    Ok(of.amplitudes)
}

/// `spectrum.csv`.
pub(crate) fn write_spectrum(of: &Spectrum) -> String {
    let mut csv = format!("mesh_order,frequency_hz,{}\n", SPECTRA.join(","));
    for (k, order) in of.orders.iter().enumerate() {
        let lines = of.amplitudes.iter().map(|a| a[k]);
        push_row(&mut csv, [*order, of.frequencies[k]].into_iter().chain(lines));
    }
    csv
}

/// One spectrum of a waterfall.
#[derive(Debug, Clone)]
pub(crate) struct WaterfallLine {
    /// Middle of its stretch, s.
    pub time: f64,
    /// Mean speed of the pinion, 1/min.
    pub speed_rpm: f64,
    /// Mean mesh frequency, Hz.
    pub mesh_frequency_hz: f64,
    /// Amplitudes of the DTE, um, at multiples of 1/cycles of the mesh order.
    pub amplitudes: Vec<f64>,
}

/// Order spectra of the DTE over stretches of `stretch` mesh cycles, each half over the one before, with a window of Hann.
///
/// Rows are evenly spaced in time within each mesh cycle and equally many in all of them, so orders stay in their bins as the speed changes.
///
/// # Errors
/// [`StudyError`] for a record that holds what is no number.
pub(crate) fn waterfall(
    rows: &Columns,
    per_cycle: usize,
    stretch: usize,
    pinion_teeth: u32,
) -> Result<Vec<WaterfallLine>, StudyError> {
    let (dte, time, speed) = (rows.series(DTE.name)?, rows.series(TIME.name)?, rows.series(PINION_SPEED.name)?);
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

/// `waterfall.csv`.
pub(crate) fn write_waterfall(lines: &[WaterfallLine], per_cycle: usize) -> String {
    let mut csv = "time_s,pinion_speed_rpm,mesh_order,frequency_hz,dte_um\n".to_owned();
    for line in lines {
        // So many bins to half of the rows in a cycle.
        let bins = (line.amplitudes.len() - 1).max(1) as f64;
        for (k, amplitude) in line.amplitudes.iter().enumerate() {
            let order = k as f64 / bins * 0.5 * per_cycle as f64;
            push_row(&mut csv, [line.time, line.speed_rpm, order, order * line.mesh_frequency_hz, *amplitude]);
        }
    }
    csv
}
