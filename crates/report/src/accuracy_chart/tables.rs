//! Tables of a work-precision chart as Markdown.

use std::fmt::Write;

use study::{AnswerError, Work, power_law};

use analysis::accuracy_chart::{CALCULIX, Density, FED, FULL, MotionPoint, Outcome, OwnBound, REDUCED, WorkPrecision};

/// All tables of a chart.
pub(super) fn chart_tables(chart: &WorkPrecision, command: &str, threads: usize) -> String {
    let mut t = format!("Made by `{command}` on {} with {threads} threads.\n", machine());
    let reference = chart.reference_density.profile;
    let _ = writeln!(
        t,
        "Reference: slices, twice as many as the scene's, {reference} quadratic elements along the profile; mean STE {:.4} um. Errors \
         are relative to it.\n",
        mean(&chart.reference.ste_um)
    );
    if let Ok(own) = &chart.reference_bounds {
        let _ = writeln!(t, "By its own bounds its mean STE may be off by {} %.\n", off_by(Some(&own.mean_ste)));
    }
    t.push_str(&bounds_that_hold(chart));
    if !chart.reference_note.is_empty() {
        let _ = writeln!(t, "It was {}.\n", chart.reference_note);
    }
    t.push_str(&points(chart));
    t.push_str(&speed_ups(chart));
    t.push_str(&scaling(chart));
    t.push_str(&in_motion(chart));
    t
}

/// How many of the points' own bounds hold.
fn bounds_that_hold(chart: &WorkPrecision) -> String {
    let known = || {
        chart.rows.iter().filter_map(|r| match &r.outcome {
            Outcome::Measured { bounds: Ok(own), .. } => Some(&**own),
            _ => None,
        })
    };
    let of = |name: &str, bounds: Vec<&OwnBound>| {
        let held = bounds.iter().filter(|b| b.holds).count();
        format!("{held} of {} bounds of the {name}", bounds.len())
    };
    let mean = of("mean STE", known().map(|own| &own.mean_ste).collect());
    let swing = of("peak to peak", known().filter_map(|own| own.peak_to_peak_ste.as_ref()).collect());
    format!(
        "*May be off by*: the bounds that `[accuracy]` gives of the point, estimated apart from all times here. The reference \
         lies inside of {mean} and {swing}.\n\n"
    )
}

/// The models in motion, compared with the reduced one.
fn in_motion(chart: &WorkPrecision) -> String {
    let Some(reduced) = chart.motion.iter().find(|r| r.way == REDUCED) else { return String::new() };
    let reference = reduced.outcome.as_ref().ok();
    let mut t = "\nIn motion at the scene's torque and speed (driver at constant speed, axes held or as stiff as makes no difference, mesh damping 5 %): \
                 dynamic transmission error against the reduced model's.\n\n\
                 | model | rigid coordinates | before the first step, s | a mesh cycle, ms | mean DTE, um | rms about it, um | p-p, um | mean, % | rms, % | \
                 p-p, % |\n|---|---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for row in &chart.motion {
        // Writing to a String cannot fail.
        let _ = match &row.outcome {
            Err(why) => writeln!(t, "| {} |{} not run: {why} |", row.way, " |".repeat(8)),
            Ok(p) => {
                let off = |pick: fn(&MotionPoint) -> f64| percent(reference.map(|r| pick(p) / pick(r) - 1.0));
                writeln!(
                    t,
                    "| {} | {} | {} | {} | {:.4} | {:.4} | {:.4} | {} | {} | {} |",
                    row.way,
                    p.coordinates,
                    seconds(p.offline_s),
                    seconds(1e3 * p.cycle_s),
                    p.mean_um,
                    p.rms_um,
                    p.peak_to_peak_um,
                    off(|p| p.mean_um),
                    off(|p| p.rms_um),
                    off(|p| p.peak_to_peak_um)
                )
            }
        };
    }
    t
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Processor of this machine as the system names it.
fn machine() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|l| l.strip_prefix("model name")?.trim_start().strip_prefix(": "));
    model.unwrap_or("a machine that does not tell its processor").to_owned()
}

/// Measured points with way and mesh.
fn measured(chart: &WorkPrecision) -> impl Iterator<Item = (&'static str, Option<Density>, &Work, &AnswerError)> {
    chart.rows.iter().filter_map(|r| match &r.outcome {
        Outcome::Measured { work, error, .. } => Some((r.way, r.density, work, error)),
        Outcome::Skipped(_) => None,
    })
}

fn points(chart: &WorkPrecision) -> String {
    let mut t = "| way | elements along the profile | DOF | DOF kept | fewer by | before the first position, s | first cycle with all \
                 of that, s | a further cycle, s | one more position, ms | peak MB | mean STE, % | may be off by | p-p STE, % | may be off by | line length, % | remark |\n\
                 |---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for row in &chart.rows {
        let profile = row.density.map_or_else(|| "-".into(), |d| d.profile.to_string());
        // Writing to a String cannot fail.
        let _ = match &row.outcome {
            Outcome::Skipped(why) => writeln!(t, "| {} | {profile} |{} not run: {why} |", row.way, " |".repeat(13)),
            Outcome::Measured { work: w, error: e, bounds, note, .. } => {
                let own = bounds.as_ref().ok();
                let remark = [bounds.as_ref().err(), Some(note)].into_iter().flatten().filter(|s| !s.is_empty());
                let remark = remark.map(String::as_str).collect::<Vec<_>>().join("; ");
                let further = w.further_cycle_s.map_or_else(|| "-".into(), seconds);
                writeln!(
                    t,
                    "| {} | {profile} | {} | {} | {} | {} | {} | {further} | {} | {} | {} | {} | {} | {} | {} | {remark} |",
                    row.way,
                    w.dof_before,
                    w.dof_after,
                    w.dof_reduction().map_or_else(|| "-".into(), |r| format!("{r:.0}")),
                    seconds(w.offline_s),
                    seconds(w.first_cycle_s()),
                    seconds(1e3 * w.position_s()),
                    w.peak_memory_mb.map_or_else(|| "-".into(), |m| format!("{m:.0}")),
                    percent(Some(e.mean_ste)),
                    off_by(own.map(|b| &b.mean_ste)),
                    percent(e.peak_to_peak_ste),
                    off_by(own.and_then(|b| b.peak_to_peak_ste.as_ref())),
                    percent(e.mean_line_length),
                )
            }
        };
    }
    t
}

/// How much faster every reduced way is than a slow one on the same mesh.
fn speed_ups(chart: &WorkPrecision) -> String {
    let mut t = String::new();
    for (slow, title) in [(FULL, "every degree of freedom kept (`full`)"), (CALCULIX, "CalculiX on the same mesh")] {
        let _ = writeln!(t, "\nTimes faster than {title}:\n");
        let on: Vec<_> = measured(chart).filter(|(way, ..)| *way == slow).collect();
        if on.is_empty() {
            let why = chart.rows.iter().find_map(|r| match &r.outcome {
                Outcome::Skipped(why) if r.way == slow => Some(why.as_str()),
                _ => None,
            });
            let _ = writeln!(t, "not measured: {}", why.unwrap_or("no mesh for it"));
            continue;
        }
        t.push_str("| way | elements along the profile | DOF | cycle with reduction | a further cycle | position |\n|---|---|---|---|---|---|\n");
        for (_, density, slow_work, _) in on {
            for (way, _, w, _) in
                measured(chart).filter(|(way, d, ..)| *d == density && ![FULL, CALCULIX, FED].contains(way))
            {
                let _ = writeln!(
                    t,
                    "| {way} | {} | {} | {} | {} | {} |",
                    density.map_or(0, |d| d.profile),
                    w.dof_before,
                    times(slow_work.first_cycle_s() / w.first_cycle_s()),
                    times(slow_work.another_cycle_s() / w.another_cycle_s()),
                    times(slow_work.position_s() / w.position_s()),
                );
            }
        }
    }
    t
}

/// Exponents of time over degrees of freedom, way by way.
fn scaling(chart: &WorkPrecision) -> String {
    let mut t = "\nTime as a power of the degrees of freedom before reduction:\n\n| way | meshes | before the first position | a further cycle \
                 |\n|---|---|---|---|\n"
        .to_owned();
    let mut names: Vec<&str> = Vec::new();
    for (way, ..) in measured(chart) {
        // A fed model costs what its source costs, and then nothing.
        if way != FED && !names.contains(&way) {
            names.push(way);
        }
    }
    for name in names {
        let of = |pick: fn(&Work) -> f64| -> Vec<(f64, f64)> {
            let own = measured(chart).filter(|(way, ..)| *way == name);
            own.map(|(_, _, w, _)| (w.dof_before as f64, pick(w))).collect()
        };
        let exponent = |points: &[(f64, f64)]| {
            power_law(points).map_or_else(|_| "-".to_owned(), |law| format!("{:.2}", law.exponent))
        };
        let (offline, online) = (of(|w| w.offline_s), of(Work::another_cycle_s));
        let _ = writeln!(t, "| {name} | {} | {} | {} |", offline.len(), exponent(&offline), exponent(&online));
    }
    t
}

fn times(ratio: f64) -> String {
    if ratio.is_finite() { seconds(ratio) } else { "-".into() }
}

/// Three significant digits.
pub(super) fn seconds(value: f64) -> String {
    let digits = if value > 0.0 { (2.0 - value.log10().floor()).clamp(0.0, 9.0) as usize } else { 0 };
    format!("{value:.digits$}")
}

/// Where an error lies by the point's own bounds, in per cent; in bold where it does not.
fn off_by(bound: Option<&OwnBound>) -> String {
    bound.map_or_else(
        || "-".to_owned(),
        |b| {
            let range = format!("{:+.2} .. {:+.2}", 100.0 * b.least, 100.0 * b.most);
            if b.holds { range } else { format!("**{range}: not so**") }
        },
    )
}

fn percent(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or_else(|| "-".to_owned(), |v| format!("{:+.2}", 100.0 * v))
}
