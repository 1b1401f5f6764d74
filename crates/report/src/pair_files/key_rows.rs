//! Rows of many motions of a reduced-order model as tables: over a key, along a branch, from many starts.

use analysis::{
    branch::{BranchPoint, BranchTurn, LossName, TimePoint},
    lumped::{Attractor, BasinStart, SweepOptions, SweepPoint},
};
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

/// Columns of motions along a branch.
fn of_branch(mut table: Table, key: &'static str, points: &[&BranchPoint]) -> Table {
    let mut push = |name: String, meaning: &'static str, of: &dyn Fn(&BranchPoint) -> f64| {
        table.push_numbers(name, meaning, points.iter().map(|p| of(p)));
    };
    push(key.into(), "value of the key", &|p| p.value);
    push("stable".into(), "stability: 1 disturbances fade; 0 they grow, and no run in time shows this motion", &|p| {
        f64::from(u8::from(p.is_stable))
    });
    push(
        "largest_multiplier".into(),
        "size of the largest Floquet multiplier, the growth of a disturbance in a period; the free rotation of the gears is left out",
        &|p| p.largest_multiplier,
    );
    push("mean_dte_um".into(), "mean dynamic transmission error of the period", &|p| p.mean_dte_um);
    push("peak_to_peak_dte_um".into(), "peak to peak of the dynamic transmission error of the period", &|p| {
        p.peak_to_peak_dte_um
    });
    push("rms_dte_um".into(), "root mean square of the dynamic transmission error about its mean", &|p| p.rms_dte_um);
    for k in 0..5 {
        push(
            format!("dte_harmonic_{}_um", k + 1),
            "amplitude of a mesh harmonic of the dynamic transmission error, 1 to 5",
            &|p| p.dte_harmonics_um[k],
        );
    }
    push("min_normal_force_n".into(), "smallest normal force on the driving flanks", &|p| p.min_normal_force_n);
    push("max_normal_force_n".into(), "largest normal force on the driving flanks", &|p| p.max_normal_force_n);
    push("share_apart".into(), "share of the period in which the driving flanks do not press", &|p| p.share_apart);
    push("harmonics".into(), "harmonics of the period that the motion is made of", &|p| p.harmonics as f64);
    push("newton_steps".into(), "Newton steps of the motion", &|p| p.newton_steps as f64);
    push("residual".into(), "residual of the balance of forces, over the forces", &|p| p.residual);
    push("tail".into(), "bound of the vibration that further harmonics would add, over the vibration", &|p| p.tail);
    table
}

/// `branch`: one row a motion, in the order of the branch.
pub(crate) fn branch(key: &'static str, points: &[BranchPoint]) -> Table {
    of_branch(Table::new("branch"), key, &points.iter().collect::<Vec<_>>())
}

/// `bifurcations`: one row a fold, period doubling or torus bifurcation.
pub(crate) fn turns(key: &'static str, turns: &[BranchTurn]) -> Table {
    let name = |loss: LossName| match loss {
        LossName::Fold => "fold",
        LossName::PeriodDoubling => "period-doubling",
        LossName::Torus => "torus",
    };
    let kinds = turns.iter().map(|turn| name(turn.loss));
    let table = Table::new("bifurcations").texts(
        "bifurcation",
        "kind of bifurcation: `fold`, `period-doubling` or `torus`",
        kinds,
    );
    of_branch(table, key, &turns.iter().map(|turn| &turn.point).collect::<Vec<_>>())
}

/// `in_time`: one row a motion that was integrated in time.
pub(crate) fn in_time(key: &'static str, all: &[TimePoint]) -> Table {
    Table::new("in_time")
        .numbers(key, "value of the key", all.iter().map(|p| p.value))
        .numbers(
            "peak_to_peak_dte_um",
            "peak to peak of the dynamic transmission error, integrated in time",
            all.iter().map(|p| p.peak_to_peak_dte_um),
        )
        .numbers(
            "branch_peak_to_peak_dte_um",
            "peak to peak of the dynamic transmission error of the motion of the branch",
            all.iter().map(|p| p.branch_peak_to_peak_dte_um),
        )
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
