//! `cycles.csv` and `order_cuts.csv` of a ramp over speed.

use analysis::motion::Passage;
use study::Columns;

use crate::columns_to_csv;

/// `cycles.csv`: one row a mesh cycle.
pub fn cycles_csv(of: &Passage) -> String {
    let pairs = of.cycles.iter().all(|c| c.max_pair_normal_force_n.is_some());
    let names = [
        "time_s",
        "driver_speed_rpm",
        "mesh_frequency_hz",
        "mean_dte_um",
        "peak_to_peak_dte_um",
        "min_normal_force_n",
        "max_normal_force_n",
        "dynamic_factor",
    ];
    let mut rows = Columns::named(names.into_iter().chain(pairs.then_some("max_pair_normal_force_n")));
    for c in &of.cycles {
        let [a, b] = [
            [c.time_s, c.driver_speed_rpm, c.mesh_frequency_hz, c.mean_dte_um],
            [c.peak_to_peak_dte_um, c.min_normal_force_n, c.max_normal_force_n, c.dynamic_factor],
        ];
        rows.push(a.into_iter().chain(b).chain(c.max_pair_normal_force_n.filter(|_| pairs)));
    }
    columns_to_csv(&rows)
}

/// `order_cuts.csv`: one row a stretch of the waterfall.
pub fn order_cuts_csv(of: &Passage) -> String {
    let orders = of.cuts.iter().map(|c| c.amplitudes_um.len()).min().unwrap_or(0);
    let names = ["time_s", "driver_speed_rpm", "mesh_frequency_hz"].into_iter().map(str::to_owned);
    let mut rows = Columns::named(names.chain((1..=orders).map(|n| format!("dte_order_{n}_um"))));
    for cut in &of.cuts {
        let place = [cut.time_s, cut.driver_speed_rpm, cut.mesh_frequency_hz];
        rows.push(place.into_iter().chain(cut.amplitudes_um[..orders].iter().copied()));
    }
    columns_to_csv(&rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use analysis::motion::{OrderCut, PassageCycle};

    /// Both files have a row a place, and their speeds go with their frequencies.
    #[test]
    fn files_have_speed_and_frequency() {
        let place = |k: u32| [0.01 * f64::from(k), 1000.0 + 7.0 * f64::from(k), 0.5 * (1000.0 + 7.0 * f64::from(k))];
        let cycle = |[time_s, driver_speed_rpm, mesh_frequency_hz]: [f64; 3]| PassageCycle {
            time_s,
            driver_speed_rpm,
            mesh_frequency_hz,
            mean_dte_um: 5.0,
            peak_to_peak_dte_um: 1.0 / 3.0,
            min_normal_force_n: 900.0,
            max_normal_force_n: 1e3 * driver_speed_rpm.sqrt(),
            max_pair_normal_force_n: Some(600.0),
            dynamic_factor: 1.2,
        };
        let cut = |[time_s, driver_speed_rpm, mesh_frequency_hz]: [f64; 3]| OrderCut {
            time_s,
            driver_speed_rpm,
            mesh_frequency_hz,
            amplitudes_um: vec![3.0, 0.5],
        };
        let passage =
            Passage { cycles: (0..80).map(place).map(cycle).collect(), cuts: (0..60).map(place).map(cut).collect() };
        for (text, count) in [(cycles_csv(&passage), 80), (order_cuts_csv(&passage), 60)] {
            let table = crate::parse_columns(&text).unwrap();
            assert!(table.is_finite() && table.len() == count, "{} rows", table.len());
            let both = table.series("driver_speed_rpm").unwrap().iter().zip(table.series("mesh_frequency_hz").unwrap());
            both.for_each(|(n, f)| assert!((n * 0.5 - f).abs() < 1e-9 * f, "{n}/min, {f} Hz"));
        }
    }
}
