//! What is in a vibration record: lines of the mesh frequency with sidebands at shaft frequency, read with their true
//! amplitudes.
//!
//! `cargo run -p study --example spectrum`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::f64::consts::TAU;

use study::{StudyError, Window, spectrum};

fn main() -> Result<(), StudyError> {
    // 2 s at 8 kHz: 23 teeth at 17.3 turns a second; run-out modulates the mesh by 5 % once a turn; a second harmonic.
    let (rate, shaft) = (8000.0, 17.3);
    let mesh = 23.0 * shaft;
    let record: Vec<f64> = (0..16_000)
        .map(|k| f64::from(k) / rate)
        .map(|t| (1.0 + 0.05 * (TAU * shaft * t).cos()) * (TAU * mesh * t).sin() + 0.2 * (TAU * 2.0 * mesh * t).sin())
        .collect();

    for window in [Window::Rectangular, Window::Hann, Window::BlackmanHarris] {
        let spectrum = spectrum(&record, rate, window)?;
        println!("{window:?}: resolution {} Hz", spectrum.resolution);
        for order in [1.0, 2.0] {
            let line = spectrum.near(order * mesh);
            println!("  mesh order {order}: {:.4} at {:.3} Hz", line.amplitude, line.frequency);
        }
        let bands = spectrum.sidebands(mesh, shaft, 1)?;
        for [below, above] in &bands.pairs {
            println!(
                "  sidebands: {:.4} at {:.3} Hz, {:.4} at {:.3} Hz; floor {:.1e}",
                below.amplitude, below.frequency, above.amplitude, above.frequency, bands.floor
            );
        }
    }
    println!(
        "put in: 1 and 0.2 at {mesh:.3} and {:.3} Hz, sidebands of 0.025 at {:.3} and {:.3} Hz",
        2.0 * mesh,
        mesh - shaft,
        mesh + shaft
    );
    Ok(())
}
