//! Files of a sweep over a key.

use analysis::lumped::{SweepHeadline, SweepOptions, SweepPoint};
use serde::Serialize;

use crate::csv::{push_row, quoted};

/// One row a value and way.
pub const SWEEP_FILE: &str = "sweep.csv";
/// One row a point of a section.
pub const BIFURCATION_FILE: &str = "bifurcation.csv";

/// The headline of a sweep with the words that make it again.
#[derive(Debug, Serialize)]
pub struct SweepPage<'a> {
    /// What was read off the points.
    #[serde(flatten)]
    pub headline: &'a SweepHeadline,
    /// Words of `ale-gear sweep` that make it again, behind the scene's file; `None` where the scene says it all.
    pub again: Option<&'a str>,
}

/// `sweep.csv`: one row a point.
pub fn sweep_csv(options: &SweepOptions, points: &[SweepPoint]) -> String {
    let of = &options.quantity.name;
    let mut csv = format!(
        "way,{},mean_{of},peak_to_peak_{of},min_{of},max_{of},section_period,periodicity,warm_up_cycles,lyapunov_per_s,lyapunov_error_per_s,\
         min_normal_force_n,max_normal_force_n,rows_without_driving_force,status,reason\n",
        options.key
    );
    for p in points {
        csv.push_str(p.way.word());
        csv.push(',');
        let none = f64::NAN;
        push_row(
            &mut csv,
            [
                p.value,
                p.mean,
                p.peak_to_peak(),
                p.extent[0],
                p.extent[1],
                p.period.map_or(none, |n| n as f64),
                p.periodicity.unwrap_or(none),
                p.warm_up_cycles as f64,
                p.lyapunov.map_or(none, |l| l.exponent),
                p.lyapunov.map_or(none, |l| l.error),
                p.normal_force_n[0],
                p.normal_force_n[1],
                p.rows_apart as f64,
            ],
        );
        csv.pop();
        let reason = p.failed.as_ref().map_or(String::new(), |e| quoted(&e.to_string()));
        csv.push_str(&format!(",{},{reason}\n", if p.failed.is_some() { "failed" } else { "solved" }));
    }
    csv
}

/// `bifurcation.csv`: one row a point of a section.
pub fn bifurcation_csv(options: &SweepOptions, points: &[SweepPoint]) -> String {
    let mut csv = format!("way,{},point,{}\n", options.key, options.quantity.name);
    for p in points {
        for (k, x) in p.points.iter().enumerate() {
            csv.push_str(p.way.word());
            csv.push(',');
            push_row(&mut csv, [p.value, k as f64, *x]);
        }
    }
    csv
}
