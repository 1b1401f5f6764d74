//! Rows beside the histories of motions as tables.

use analysis::{
    lumped::{
        Attractor, BasinResult, BranchPoint, ContinuationResult, LossName, LumpedCampbell, SweepOptions, SweepPoint,
    },
    motion::{CampbellDiagram, MotionSpectrum, Passage, SWEEP_ORDERS, SweepRow, SweepStatus, WaterfallLine},
};
use answer::Table;
use study::Campbell;

use crate::motion_files::{SPECTRA, spectra};

/// `spectrum`: lines of a motion at constant speed.
pub(super) fn spectrum(of: &MotionSpectrum) -> Table {
    let mut table = Table::new("spectrum")
        .numbers("mesh_order", "order of the mesh frequency", of.orders.iter().copied())
        .numbers("frequency_hz", "its frequency", of.frequencies.iter().copied());
    for (name, amplitudes) in SPECTRA.into_iter().zip(spectra(of)) {
        table.push_numbers(name, "amplitude", amplitudes[..of.orders.len()].iter().copied());
    }
    table
}

/// `waterfall`: spectra of a ramp, stretch by stretch.
pub(super) fn waterfall(lines: &[WaterfallLine], per_cycle: usize) -> Table {
    let all: Vec<(&WaterfallLine, f64, f64)> = lines
        .iter()
        .flat_map(|line| {
            // So many bins to half of the rows in a cycle.
            let bins = line.amplitudes.len().saturating_sub(1).max(1) as f64;
            let order = move |k: usize| k as f64 / bins * 0.5 * per_cycle as f64;
            line.amplitudes.iter().enumerate().map(move |(k, amplitude)| (line, order(k), *amplitude))
        })
        .collect();
    Table::new("waterfall")
        .numbers("time_s", "middle of the stretch", all.iter().map(|r| r.0.time))
        .numbers("pinion_speed_rpm", "mean speed of the pinion", all.iter().map(|r| r.0.speed_rpm))
        .numbers("mesh_order", "order of the mesh frequency", all.iter().map(|r| r.1))
        .numbers("frequency_hz", "its frequency", all.iter().map(|r| r.1 * r.0.mesh_frequency_hz))
        .numbers("dte_um", "amplitude of the DTE", all.iter().map(|r| r.2))
}

/// `cycles`: one row a mesh cycle of a ramp.
pub(super) fn cycles(of: &Passage) -> Table {
    let all = &of.cycles;
    let mut table = Table::new("cycles")
        .numbers("time_s", "middle of the mesh cycle", all.iter().map(|c| c.time_s))
        .numbers("driver_speed_rpm", "speed of the driver", all.iter().map(|c| c.driver_speed_rpm))
        .numbers("mesh_frequency_hz", "mesh frequency", all.iter().map(|c| c.mesh_frequency_hz))
        .numbers("mean_dte_um", "mean DTE", all.iter().map(|c| c.mean_dte_um))
        .numbers("peak_to_peak_dte_um", "peak to peak of the DTE", all.iter().map(|c| c.peak_to_peak_dte_um))
        .numbers("min_normal_force_n", "least sum of normal forces", all.iter().map(|c| c.min_normal_force_n))
        .numbers("max_normal_force_n", "largest sum of normal forces", all.iter().map(|c| c.max_normal_force_n))
        .numbers("dynamic_factor", "largest over static force", all.iter().map(|c| c.dynamic_factor));
    if all.iter().all(|c| c.max_pair_normal_force_n.is_some()) {
        let forces = all.iter().filter_map(|c| c.max_pair_normal_force_n);
        table.push_numbers("max_pair_normal_force_n", "largest force of one pair", forces);
    }
    table
}

/// `order_cuts`: amplitudes of mesh orders over speed, one row a stretch of the waterfall.
pub(super) fn order_cuts(of: &Passage) -> Table {
    let orders = of.cuts.iter().map(|c| c.amplitudes_um.len()).min().unwrap_or(0);
    let mut table = Table::new("order_cuts")
        .numbers("time_s", "middle of the stretch", of.cuts.iter().map(|c| c.time_s))
        .numbers("driver_speed_rpm", "speed of the driver", of.cuts.iter().map(|c| c.driver_speed_rpm))
        .numbers("mesh_frequency_hz", "mesh frequency", of.cuts.iter().map(|c| c.mesh_frequency_hz));
    for n in 0..orders {
        let amplitudes = of.cuts.iter().map(|c| c.amplitudes_um[n]);
        table.push_numbers(format!("dte_order_{}_um", n + 1), "amplitude of the order in the DTE", amplitudes);
    }
    table
}

/// `campbell` of a reduced pair: one row a speed.
pub(super) fn campbell(of: &CampbellDiagram) -> Table {
    let column = |name: &String| name.replace(' ', "_") + "_hz";
    frequencies(&of.diagram, of.names.iter().map(column), of.orders.iter().map(column))
}

/// `campbell` of a linear model: one row a speed of the driver.
pub(super) fn lumped_campbell(of: &LumpedCampbell) -> Table {
    let modes = (1..=of.diagram.frequencies.len()).map(|m| format!("elastic_mode_{m}_hz"));
    frequencies(&of.diagram, modes, of.names.iter().map(|n| n.replace([' ', '\''], "_") + "_hz"))
}

fn frequencies(diagram: &Campbell, modes: impl Iterator<Item = String>, lines: impl Iterator<Item = String>) -> Table {
    let speeds = &diagram.speeds;
    let mut table = Table::new("campbell").numbers("speed_rpm", "speed", speeds.iter().map(|s| 60.0 * s));
    for (name, mode) in modes.zip(&diagram.frequencies) {
        table.push_numbers(name, "natural frequency", mode[..speeds.len()].iter().copied());
    }
    for (name, order) in lines.zip(&diagram.orders) {
        table.push_numbers(name, "line of excitation", speeds.iter().map(|speed| order * speed));
    }
    table
}

/// `resonance`: a row a way and speed.
pub(super) fn resonance(rows: &[SweepRow]) -> Table {
    let status = |row: &SweepRow| match row.status {
        SweepStatus::Periodic => "periodic",
        SweepStatus::NotPeriodic => "not-periodic",
        SweepStatus::Failed => "failed",
    };
    let mut table = Table::new("resonance")
        .texts("way", "how the speed was reached", rows.iter().map(|r| r.way.word()))
        .numbers("speed_rpm", "speed of the driver", rows.iter().map(|r| r.speed_rpm))
        .numbers("mesh_frequency_hz", "mesh frequency", rows.iter().map(|r| r.mesh_frequency_hz))
        .numbers("mean_dte_um", "mean DTE", rows.iter().map(|r| r.mean_dte_um))
        .numbers("peak_to_peak_dte_um", "peak to peak of the DTE", rows.iter().map(|r| r.peak_to_peak_dte_um));
    for h in 0..SWEEP_ORDERS {
        let amplitudes = rows.iter().map(|r| r.dte_harmonics_um.get(h).copied().unwrap_or(f64::NAN));
        table.push_numbers(format!("dte_harmonic_{}_um", h + 1), "amplitude of the mesh harmonic", amplitudes);
    }
    table
        .numbers("min_normal_force_n", "least sum of normal forces", rows.iter().map(|r| r.min_normal_force_n))
        .numbers("max_normal_force_n", "largest sum of normal forces", rows.iter().map(|r| r.max_normal_force_n))
        .numbers("dynamic_factor", "largest over static force", rows.iter().map(|r| r.dynamic_factor))
        .numbers(
            "max_coast_normal_force_n",
            "largest force on the coast flanks",
            rows.iter().map(|r| r.max_coast_normal_force_n),
        )
        .numbers("max_bearing_force_n", "largest force of a bearing", rows.iter().map(|r| r.max_bearing_force_n))
        .numbers("period_cycles", "mesh cycles of a period", rows.iter().map(|r| r.period_cycles as f64))
        .numbers("periodicity", "how nearly it repeats itself", rows.iter().map(|r| r.periodicity))
        .numbers("warm_up_cycles", "mesh cycles before", rows.iter().map(|r| r.warm_up_cycles as f64))
        .texts(
            "start",
            "what it starts from",
            rows.iter().map(|r| if r.own_start { "quasi-static" } else { "neighbour" }),
        )
        .texts("status", "whether it repeats itself", rows.iter().map(status))
        .texts("reason", "why there is no solution", rows.iter().map(|r| r.reason.as_str()))
}

/// `sweep`: one row a value and way.
pub(super) fn sweep(options: &SweepOptions, points: &[SweepPoint]) -> Table {
    let (of, none) = (&options.quantity.name, f64::NAN);
    let all = || points.iter();
    Table::new("sweep")
        .texts("way", "how the value was reached", all().map(|p| p.way.word()))
        .numbers(options.key.clone(), "value of the key", all().map(|p| p.value))
        .numbers(format!("mean_{of}"), "mean", all().map(|p| p.mean))
        .numbers(format!("peak_to_peak_{of}"), "peak to peak", all().map(SweepPoint::peak_to_peak))
        .numbers(format!("min_{of}"), "least", all().map(|p| p.extent[0]))
        .numbers(format!("max_{of}"), "largest", all().map(|p| p.extent[1]))
        .numbers("section_period", "points of the section", all().map(|p| p.period.map_or(none, |n| n as f64)))
        .numbers("periodicity", "how nearly it repeats itself", all().map(|p| p.periodicity.unwrap_or(none)))
        .numbers("warm_up_cycles", "mesh cycles before", all().map(|p| p.warm_up_cycles as f64))
        .numbers(
            "lyapunov_per_s",
            "largest Lyapunov exponent",
            all().map(|p| p.lyapunov.as_ref().map_or(none, |l| l.exponent)),
        )
        .numbers(
            "lyapunov_error_per_s",
            "its standard error",
            all().map(|p| p.lyapunov.as_ref().map_or(none, |l| l.error)),
        )
        .numbers("min_normal_force_n", "least normal force", all().map(|p| p.normal_force_n[0]))
        .numbers("max_normal_force_n", "largest normal force", all().map(|p| p.normal_force_n[1]))
        .numbers("rows_without_driving_force", "rows without contact", all().map(|p| p.rows_apart as f64))
        .texts("status", "whether it is solved", all().map(|p| if p.failed.is_some() { "failed" } else { "solved" }))
        .texts("reason", "why not", all().map(|p| p.failed.as_ref().map_or(String::new(), ToString::to_string)))
}

/// `bifurcation`: one row a point of a section.
pub(super) fn bifurcation(options: &SweepOptions, points: &[SweepPoint]) -> Table {
    let all = || points.iter().flat_map(|p| p.points.iter().enumerate().map(move |(k, x)| (p, k, *x)));
    Table::new("bifurcation")
        .texts("way", "how the value was reached", all().map(|r| r.0.way.word()))
        .numbers(options.key.clone(), "value of the key", all().map(|r| r.0.value))
        .numbers("point", "number of the point", all().map(|r| r.1 as f64))
        .numbers(options.quantity.name.clone(), "value at the point", all().map(|r| r.2))
}

/// Columns of motions along a branch.
fn of_branch(mut table: Table, key: &'static str, points: &[&BranchPoint]) -> Table {
    let mut push = |name: String, meaning: &'static str, of: &dyn Fn(&BranchPoint) -> f64| {
        table.push_numbers(name, meaning, points.iter().map(|p| of(p)));
    };
    push(key.into(), "value of the key", &|p| p.value);
    push("stable".into(), "1 where disturbances fade", &|p| f64::from(u8::from(p.is_stable)));
    push("largest_multiplier".into(), "size of the largest Floquet multiplier", &|p| p.largest_multiplier);
    push("mean_dte_um".into(), "mean DTE", &|p| p.mean_dte_um);
    push("peak_to_peak_dte_um".into(), "peak to peak of the DTE", &|p| p.peak_to_peak_dte_um);
    push("rms_dte_um".into(), "root mean square of the DTE about its mean", &|p| p.rms_dte_um);
    for k in 0..5 {
        push(format!("dte_harmonic_{}_um", k + 1), "amplitude of the mesh harmonic", &|p| p.dte_harmonics_um[k]);
    }
    push("min_normal_force_n".into(), "least normal force", &|p| p.min_normal_force_n);
    push("max_normal_force_n".into(), "largest normal force", &|p| p.max_normal_force_n);
    push("share_apart".into(), "share of the period without contact", &|p| p.share_apart);
    push("harmonics".into(), "harmonics of the motion", &|p| p.harmonics as f64);
    push("newton_steps".into(), "Newton steps", &|p| p.newton_steps as f64);
    push("residual".into(), "what is left over of the balance", &|p| p.residual);
    push("tail".into(), "share of the forces that the harmonics leave out", &|p| p.tail);
    table
}

/// `branch`: one row a motion, in the order of the branch.
pub(super) fn branch(found: &ContinuationResult) -> Table {
    of_branch(Table::new("branch"), found.headline.key, &found.points.iter().collect::<Vec<_>>())
}

/// `bifurcations`: one row a fold, period doubling or torus bifurcation.
pub(super) fn turns(found: &ContinuationResult) -> Table {
    let name = |loss: LossName| match loss {
        LossName::Fold => "fold",
        LossName::PeriodDoubling => "period-doubling",
        LossName::Torus => "torus",
    };
    let kinds = found.turns.iter().map(|turn| name(turn.loss));
    let table = Table::new("bifurcations").texts("bifurcation", "what becomes of the motion", kinds);
    of_branch(table, found.headline.key, &found.turns.iter().map(|turn| &turn.point).collect::<Vec<_>>())
}

/// `in_time`: one row a motion that was integrated in time.
pub(super) fn in_time(found: &ContinuationResult) -> Table {
    let all = &found.in_time;
    Table::new("in_time")
        .numbers(found.headline.key, "value of the key", all.iter().map(|p| p.value))
        .numbers("peak_to_peak_dte_um", "peak to peak in time", all.iter().map(|p| p.peak_to_peak_dte_um))
        .numbers(
            "branch_peak_to_peak_dte_um",
            "peak to peak of the branch",
            all.iter().map(|p| p.branch_peak_to_peak_dte_um),
        )
}

/// `basins`: one row a start; NaN where no motion comes out.
pub(super) fn basins(found: &BasinResult) -> Table {
    let all = &found.starts;
    Table::new("basins")
        .numbers("initial_dte_um", "initial DTE beside that of rest", all.iter().map(|s| s.initial_dte_um))
        .numbers("initial_dte_rate_mm_s", "its initial rate", all.iter().map(|s| s.initial_dte_rate_mm_s))
        .numbers(
            "attractor",
            "number of the motion that it ends in",
            all.iter().map(|s| s.attractor.map_or(f64::NAN, |n| n as f64)),
        )
        .numbers(
            "warm_up_cycles",
            "mesh cycles until there",
            all.iter().map(|s| s.attractor.map_or(f64::NAN, |_| s.warm_up_cycles as f64)),
        )
}

/// `attractors`: one row a motion that starts end in; one that does not come back has no period.
pub(super) fn attractors(all: &[Attractor]) -> Table {
    Table::new("attractors")
        .numbers("attractor", "number of the motion", all.iter().map(|a| a.attractor as f64))
        .numbers(
            "period_cycles",
            "mesh cycles of a period",
            all.iter().map(|a| a.period_cycles.map_or(f64::NAN, |p| p as f64)),
        )
        .numbers("starts", "starts that end in it", all.iter().map(|a| a.starts as f64))
        .numbers("share_pct", "their share of all starts, %", all.iter().map(|a| a.share_pct))
        .numbers("mean_dte_um", "mean DTE", all.iter().map(|a| a.mean_dte_um))
        .numbers("min_dte_um", "least DTE", all.iter().map(|a| a.min_dte_um))
        .numbers("max_dte_um", "largest DTE", all.iter().map(|a| a.max_dte_um))
        .numbers("min_normal_force_n", "least normal force", all.iter().map(|a| a.min_normal_force_n))
        .numbers("max_normal_force_n", "largest normal force", all.iter().map(|a| a.max_normal_force_n))
        .numbers(
            "most_warm_up_cycles",
            "most mesh cycles until there",
            all.iter().map(|a| a.most_warm_up_cycles as f64),
        )
}
