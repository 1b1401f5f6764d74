//! Spectra of a motion at constant speed.

use analysis::motion::MotionSpectrum;
use answer::Table;

use super::waterfall::SHOWN_ORDERS;
use crate::charts::{Curve, stick_chart};

/// Quantities of a pair that have a spectrum, as the columns of `spectrum.csv` name them.
pub const SPECTRA: [&str; 5] =
    ["dte_um", "normal_force_n", "wheel_force_z_n", "pinion_moment_y_nmm", "wheel_moment_y_nmm"];

/// `spectrum`: lines of a motion at constant speed; `quantities`: names and meanings of its columns.
pub fn spectrum(of: &MotionSpectrum, quantities: impl IntoIterator<Item = (String, &'static str)>) -> Table {
    let mut table = Table::new("spectrum")
        .numbers("mesh_order", "order of the mesh frequency", of.orders.iter().copied())
        .numbers("frequency_hz", "frequency of the order", of.frequencies.iter().copied());
    for (i, (name, meaning)) in quantities.into_iter().enumerate() {
        let amplitudes = of.amplitudes.get(i).map_or(&[][..], Vec::as_slice);
        table.push_numbers(name, meaning, amplitudes.iter().copied());
    }
    table
}

/// Lines of one quantity as sticks.
pub fn spectrum_chart(of: &MotionSpectrum, quantity: usize, [title, unit]: [&str; 2]) -> Option<String> {
    let lines = of.orders.iter().copied().zip(of.amplitudes.get(quantity)?.iter().copied()).skip(1);
    let points = lines.take_while(|(order, _)| *order <= SHOWN_ORDERS).collect();
    stick_chart(title, "mesh order", unit, Curve { label: "amplitude".into(), points })
}
