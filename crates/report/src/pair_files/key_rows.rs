//! Rows of many motions of a reduced-order model as tables: over a key, from many starts.

use analysis::lumped::{Attractor, BasinStart, SweepOptions, SweepPoint};
use answer::Table;

use super::rows::{PERIODICITY, STATUS};

/// `sweep`: one row a value and way.
pub(crate) fn sweep(options: &SweepOptions, points: &[SweepPoint]) -> Table {
    let (of, none) = (&options.quantity.name, f64::NAN);
    let all = || points.iter();
    Table::new("sweep")
        .texts("way", "direction: `up`, `down` (from the motion of the value before) or `apart` (from rest under the load)", all().map(|p| p.way.word()))
        .numbers(options.key.clone(), "value of the key", all().map(|p| p.value))
        .numbers(format!("mean_{of}"), "mean of the section's column over all rows between its points", all().map(|p| p.mean))
        .numbers(format!("peak_to_peak_{of}"), "largest minus smallest value of the section's column", all().map(SweepPoint::peak_to_peak))
        .numbers(format!("min_{of}"), "smallest value of the section's column", all().map(|p| p.extent[0]))
        .numbers(format!("max_{of}"), "largest value of the section's column", all().map(|p| p.extent[1]))
        .numbers("section_period", "points after which the section comes back within 1e-3 of the peak to peak; `NaN`: after none up to a third of them", all().map(|p| p.period.map_or(none, |n| n as f64)))
        .numbers("periodicity", PERIODICITY, all().map(|p| p.periodicity.unwrap_or(none)))
        .numbers("warm_up_cycles", "mesh cycles before the section", all().map(|p| p.warm_up_cycles as f64))
        .numbers(
            "lyapunov_per_s",
            "largest Lyapunov exponent",
            all().map(|p| p.lyapunov.as_ref().map_or(none, |l| l.exponent)),
        )
        .numbers(
            "lyapunov_error_per_s",
            "standard error of the exponent",
            all().map(|p| p.lyapunov.as_ref().map_or(none, |l| l.error)),
        )
        .numbers("min_normal_force_n", "smallest normal force", all().map(|p| p.normal_force_n[0]))
        .numbers("max_normal_force_n", "largest normal force", all().map(|p| p.normal_force_n[1]))
        .numbers("rows_without_driving_force", "rows in which the driving flanks do not press", all().map(|p| p.rows_apart as f64))
        .texts("status", STATUS, all().map(|p| p.status.word()))
        .texts("reason", "reason why there is no motion; empty where there is one", all().map(|p| p.failed.as_ref().map_or(String::new(), ToString::to_string)))
}

/// `bifurcation`: one row a point of a section.
pub(crate) fn bifurcation(options: &SweepOptions, points: &[SweepPoint]) -> Table {
    let all = || points.iter().flat_map(|p| p.points.iter().enumerate().map(move |(k, x)| (p, k, *x)));
    Table::new("bifurcation")
        .texts("way", "direction from which the value was reached", all().map(|r| r.0.way.word()))
        .numbers(options.key.clone(), "value of the key", all().map(|r| r.0.value))
        .numbers("point", "number of the point, from 0", all().map(|r| r.1 as f64))
        .numbers(options.quantity.name.clone(), "value of the section's column", all().map(|r| r.2))
}

/// `basins`: one row a start; NaN where no motion comes out.
pub(crate) fn basins(all: &[BasinStart]) -> Table {
    Table::new("basins")
        .numbers(
            "initial_dte_um",
            "initial dynamic transmission error, relative to rest under the load",
            all.iter().map(|s| s.initial_dte_um),
        )
        .numbers(
            "initial_dte_rate_mm_s",
            "initial rate of the dynamic transmission error, relative to rest under the load",
            all.iter().map(|s| s.initial_dte_rate_mm_s),
        )
        .numbers(
            "attractor",
            "number of the motion that it ends in; `NaN` where no motion comes out",
            all.iter().map(|s| s.attractor.map_or(f64::NAN, |n| n as f64)),
        )
        .numbers(
            "warm_up_cycles",
            "mesh cycles until the motion is reached",
            all.iter().map(|s| s.attractor.map_or(f64::NAN, |_| s.warm_up_cycles as f64)),
        )
}

/// `attractors`: one row a motion that starts end in; one that does not come back has no period.
pub(crate) fn attractors(all: &[Attractor]) -> Table {
    Table::new("attractors")
        .numbers("attractor", "number of the motion, from 1, by peak to peak ascending; motions are one when period, mean and extremes differ by less than a hundredth of the peak to peak", all.iter().map(|a| a.attractor as f64))
        .numbers(
            "period_cycles",
            "mesh cycles after which the motion comes back; `NaN` for all that do not within eight, which count as one",
            all.iter().map(|a| a.period_cycles.map_or(f64::NAN, |p| p as f64)),
        )
        .numbers("starts", "starts that end in it", all.iter().map(|a| a.starts as f64))
        .numbers("share_pct", "share of all starts that end in it", all.iter().map(|a| a.share_pct))
        .numbers("mean_dte_um", "mean dynamic transmission error of the last mesh cycles, eight at the least", all.iter().map(|a| a.mean_dte_um))
        .numbers("min_dte_um", "smallest dynamic transmission error", all.iter().map(|a| a.min_dte_um))
        .numbers("max_dte_um", "largest dynamic transmission error", all.iter().map(|a| a.max_dte_um))
        .numbers("min_normal_force_n", "smallest normal force on the driving flanks", all.iter().map(|a| a.min_normal_force_n))
        .numbers("max_normal_force_n", "largest normal force on the driving flanks", all.iter().map(|a| a.max_normal_force_n))
        .numbers(
            "most_warm_up_cycles",
            "largest number of mesh cycles that a start took to get there",
            all.iter().map(|a| a.most_warm_up_cycles as f64),
        )
}
