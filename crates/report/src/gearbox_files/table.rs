//! The table at the end of a gearbox.

use std::fmt::Write;

use analysis::gearbox_at_rest::{BearingLoad, GearboxResult, GearboxSwings};
use scene::gearbox::Gearbox;

use super::swing_words::{bearing_peaks, first_modes, holders, mesh_peaks};
use crate::{Cost, tables::fixed};

/// Meshes, bearings and outputs, a line each.
pub fn gearbox_table(file: &Gearbox, result: &GearboxResult, cost: &Cost) -> String {
    let mut t = format!("{}\n\n", file.name);
    // Writing to a String cannot fail.
    let _ = writeln!(
        t,
        "  {:<24} {:>10} {:>10} {:>10} {:>9} {:>9} {:>9}",
        "mesh", "force N", "STE um", "p-p um", "f_in um", "K_Hbeta", "MPa"
    );
    for m in &result.meshes {
        let factor = m.face_load_factor.map_or_else(|| "-".to_owned(), |k| fixed(k, 3));
        let _ = writeln!(
            t,
            "  {:<24} {:>10} {:>10} {:>10} {:>9} {:>9} {:>9}",
            m.name,
            fixed(m.normal_force, 0),
            fixed(1e3 * m.transmission_error[0], 3),
            fixed(1e3 * m.transmission_error[1], 3),
            fixed(1e3 * m.misalignment[0], 2),
            factor,
            fixed(m.max_pressure, 0),
        );
    }
    bearings(&mut t, &result.bearings);
    let _ = writeln!(t, "\n  input torque {} N m", fixed(1e-3 * result.input_torque, 2));
    for (i, o) in result.outputs.iter().enumerate() {
        let (mean, range) = (fixed(1e6 * o.mean, 1), fixed(1e6 * o.peak_to_peak, 2));
        let _ = writeln!(t, "  output {} lags by {mean} urad, {range} urad peak to peak", i + 1);
    }
    let [residual, balance] = result.certificate;
    let _ = writeln!(t, "  worst residual {residual:.0e}, bodies in balance to {balance:.0e}");
    super::motion::table(&mut t, file, result);
    let _ = writeln!(t, "  {} positions in {:.2} s", result.positions.len(), cost.wall_s);
    if let Some(swings) = &result.vibration {
        t += &vibration(file, swings);
    }
    for warning in &result.warnings {
        let _ = writeln!(t, "\nwarning: {warning}");
    }
    t
}

/// Forces and tilts; where there are rolling elements, what the hardest pressed one carries.
fn bearings(t: &mut String, all: &[BearingLoad]) {
    let rolls = all.iter().any(|b| b.rolling.is_some());
    let _ = write!(t, "\n  {:<24} {:>10} {:>10} {:>10}", "bearing", "radial N", "axial N", "tilt mrad");
    let _ = if rolls { writeln!(t, " {:>10} {:>9} {:>9}", "element N", "MPa", "loaded") } else { writeln!(t) };
    for b in all {
        let radial = fixed(b.force[0].hypot(b.force[1]), 0);
        let (axial, tilt) = (fixed(b.force[2], 0), fixed(1e3 * b.tilt, 3));
        let _ = write!(t, "  {:<24} {radial:>10} {axial:>10} {tilt:>10}", b.name);
        let _ = match &b.rolling {
            Some(own) => {
                let loaded = format!("{}/{}", own.loaded[1], own.count);
                let (force, pressure) = (fixed(own.element_force, 0), fixed(own.pressure, 0));
                writeln!(t, " {force:>10} {pressure:>9} {loaded:>9}")
            }
            None if rolls => writeln!(t, " {:>10} {:>9} {:>9}", "-", "-", "-"),
            None => writeln!(t),
        };
    }
}

/// Modes that are listed.
const LISTED: usize = 8;

/// Lowest natural frequencies, and where meshes and bearings are loaded most.
fn vibration(file: &Gearbox, swings: &GearboxSwings) -> String {
    let mut t = format!("\n  {:<6} {:>10}  {:<44}\n", "mode", "Hz", "strain energy in");
    for (i, mode) in first_modes(swings).iter().take(LISTED).enumerate() {
        let frequency = fixed(mode.frequency / std::f64::consts::TAU, 1);
        let _ = writeln!(t, "  {:<6} {frequency:>10}  {}", i + 1, holders(file, &mode.energy.strain));
    }
    let _ = writeln!(t, "\n  {:<24} {:>12} {:>14}", "vibration", "rms N, most", "at input 1/min");
    for peak in mesh_peaks(file, swings).iter().chain(&bearing_peaks(file, swings)) {
        let _ = writeln!(t, "  {:<24} {:>12} {:>14}", peak.name, fixed(peak.force_n, 2), fixed(peak.input_rpm, 0));
    }
    t
}
