//! F33: order spectra that leak.

use std::f64::consts::TAU;

use study::{Window, spectrum};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, largest},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 33,
    name: "leakage and invented sidebands",
    file: "F33-leakage",
    scene: scene_text!("F33-leakage"),
    fails: "A record of no whole number of turns spreads every line, and sidebands of the shaft drown or appear from nothing.",
    does: "Rows are evenly spaced in the angle, records hold whole mesh cycles, and the window is chosen and stated.",
    naive: &[],
    look,
};

const TEETH: usize = 30;
const ROWS: usize = 32;

/// A carrier of mesh order with sidebands of a thousandth of it at the shaft's order, over so many turns.
fn record(turns: f64) -> Vec<f64> {
    let rows = (turns * (TEETH * ROWS) as f64).round() as usize;
    let at = |i: usize| TAU * i as f64 / (TEETH * ROWS) as f64;
    (0..rows).map(|i| (1.0 + 0.002 * at(i).cos()) * (TEETH as f64 * at(i)).cos()).collect()
}

/// Largest line between the sidebands (order 30 +- 1) and the next ones, where there is nothing, over the carrier.
fn floor(turns: f64) -> Result<f64, EnvelopeError> {
    let found =
        spectrum(&record(turns), (TEETH * ROWS) as f64, Window::Rectangular).map_err(EnvelopeError::of("record"))?;
    Ok(found.amplitude_at(TEETH as f64 + 2.0).max(found.amplitude_at(TEETH as f64 - 2.0)))
}

/// Amplitude of an order of the shaft in evenly spaced rows of whole turns.
fn order(rows: &[f64], turns: usize, order: usize) -> f64 {
    let n = rows.len() as f64;
    let [re, im] = rows.iter().enumerate().fold([0.0; 2], |[re, im], (i, x)| {
        let (sin, cos) = (TAU * (order * turns) as f64 * i as f64 / n).sin_cos();
        [re + x * cos, im + x * sin]
    });
    2.0 / n * f64::hypot(re, im)
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let (whole, broken) = (floor(8.0)?, floor(8.37)?);
    let sideband = spectrum(&record(8.0), (TEETH * ROWS) as f64, Window::Rectangular)
        .map_err(EnvelopeError::of("record"))?
        .amplitude_at(TEETH as f64 + 1.0);
    // A sinusoidal index deviation of the pinion: one line of the shaft, and sidebands of the mesh at its distance alone.
    let result = bench.in_motion(&AS_IT_IS)?;
    let per_turn = TEETH * result.headline.rows_per_cycle as usize;
    let rows = result.rows.len();
    let last = result.rows.series(rows.saturating_sub(per_turn)..rows, |row| row.dte_um)?;
    let shaft = order(&last, 1, 1);
    let between = largest([7, 11, 13, 17, 19, 23].map(|k| order(&last, 1, k)));
    Ok(vec![
        Figure::new(
            "floor beside the sidebands over the carrier, whole turns; naive: 8.37 turns",
            Shown::at_most(whole, 1e-12),
        )
        .beside(Shown::at_least(broken, 1e-3)),
        Figure::new(
            "sideband of a thousandth of the carrier: its error, parts",
            Shown::at_most((sideband / 1e-3 - 1.0).abs(), 1e-9),
        ),
        Figure::new(
            "pair with an index deviation of 5 um over a turn: shaft's order in the transmission error, um",
            Shown::at_least(shaft, 3.0),
        ),
        Figure::new("orders between shaft and mesh over it", Shown::at_most(between / shaft, 0.02)),
    ])
}
