//! Columns of derivatives behind those of `history.csv` of a run at rest.

use analysis::{Derivatives, results::pairs};
use ltca::{PositionRates, Sensitivity, StaticPosition};

/// A derivative by a key: what it is of, its meaning, and its number, per unit of the key.
type Rate = (&'static str, &'static str, fn(&Sensitivity) -> f64);

/// Columns that occur once.
const RATES: [Rate; 6] = [
    (
        "d_ste_um",
        "derivative of the static transmission error by a key; where a slice is about to touch or to leave, or presses on a kink of the relief, the mean of the two one-sided derivatives",
        |s| 1e3 * s.rates().transmission_error,
    ),
    (
        "d_ste_um_falling",
        "derivative of the static transmission error as the key falls, with the sign of its growth",
        |s| 1e3 * s.sides[0].transmission_error,
    ),
    ("d_ste_um_growing", "derivative of the static transmission error as the key grows", |s| {
        1e3 * s.sides[1].transmission_error
    }),
    ("d_kinematic_te_um", "derivative of the no-load transmission error", |s| {
        1e3 * s.rates().kinematic_transmission_error
    }),
    ("d_mesh_stiffness_n_per_um", "derivative of the secant mesh stiffness", |s| 1e-3 * s.rates().secant_stiffness),
    ("d_max_pressure_mpa", "derivative of the largest pressure", |s| s.rates().max_pressure),
];
/// Meaning of the derivative of a pair's force.
const OF_PAIR: &str = "derivative of the normal force of a tooth pair, numbered as `normal_force_pair_<k>_n`";

/// A key as a part of a name.
fn word(key: &str) -> String {
    key.replace('.', "_")
}

/// Names and meanings of all columns, with pairs of these numbers.
pub(super) fn named(keys: &[String], pairs: &[i64]) -> Vec<(String, &'static str)> {
    let of_pairs = || pairs.iter().map(|k| (format!("d_normal_force_pair_{k}_n"), OF_PAIR));
    let of = |key: &String| {
        let names = RATES.iter().map(|(name, meaning, _)| ((*name).to_owned(), *meaning)).chain(of_pairs());
        names.map(|(name, meaning)| (format!("{name}_per_{}", word(key)), meaning)).collect::<Vec<_>>()
    };
    keys.iter().flat_map(of).collect()
}

/// Names of all columns, with pairs of these numbers.
pub(super) fn names(keys: &[String], pairs: &[i64]) -> Vec<String> {
    named(keys, pairs).into_iter().map(|(name, _)| name).collect()
}

/// Columns of derivatives by `<key>` without rows, for `docs/outputs.md`.
pub fn derivative_columns() -> answer::Table {
    let mut table = answer::Table::new("history");
    for (name, meaning) in named(&["<key>".to_owned()], &[0]) {
        table.push_numbers(name, meaning, []);
    }
    table
}

/// The numbers of a position, in the same order; `pitch` angle of the pinion, rad.
pub(super) fn row(of: &Derivatives, index: usize, position: &StaticPosition, numbers: &[i64], pitch: f64) -> Vec<f64> {
    let none = Vec::new();
    let by_key = |s: &Sensitivity| {
        let rates = s.rates();
        let of_pairs = numbers.iter().map(|&k| pair_force(&rates, position, k, pitch)).collect::<Vec<f64>>();
        RATES.iter().map(|(_, _, rate)| rate(s)).chain(of_pairs).collect::<Vec<f64>>()
    };
    of.rates.get(index).unwrap_or(&none).iter().flat_map(by_key).collect()
}

/// Derivative of the normal force of the pair of that column, N; 0 when it is not in the window.
fn pair_force(rates: &PositionRates, position: &StaticPosition, column: i64, pitch: f64) -> f64 {
    let own = position.pairs.iter().zip(&rates.pair_forces);
    let own = own.filter(|(pair, _)| pairs::in_cycle(position, pair.pair, pitch) == column);
    0.0 + own.map(|(_, rate)| rate).sum::<f64>()
}
