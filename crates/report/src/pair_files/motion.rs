//! A motion of reduced gears, and steady states over speed: rows beside the history, page, closing table.

use analysis::{
    facts::RunInfo,
    motion::{MotionHeadline, MotionResult, RunUpHeadline, SweepHeadline, SweepResult, speed},
};
use scene::{Scene, SweepWay};

use super::{
    common::{
        Shown, cycles, elasticity, errors, harmonics, inertia, iso_root_stress, key, pair_answer, pair_page, pressure,
    },
    rows,
};
use crate::{
    Cost, ReportError, Written,
    contact_files::{pattern_figure, write_patterns},
    motion_files::{MotionPictures, SweepPictures, motion_charts, sweep_charts},
    page::{Line, Part},
    tables::fixed,
    write_result,
};
use columns::{ENERGY, MOTION_HISTORY};
use export::view::View;
use store::folder::ResultDirectory;

/// Writes all files of a motion of reduced gears but its rows, which come one by one; what comes back is the closing
/// table. `view`: the gears in space.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub(super) fn write_motion_result(
    scene: &Scene,
    result: &MotionResult,
    cost: &Cost,
    view: Option<&View>,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let MotionResult { rows: all, layout, headline: h, spectrum, ramp, patterns, facts, remarks, .. } = result;
    let per_cycle = h.rows_per_cycle as usize;
    let pairs: Vec<i64> = layout.pairs().collect();
    let (history, energy) = (MOTION_HISTORY.sheet(layout, &pairs), ENERGY.sheet(&(), &[]));
    let mut tables = vec![
        history.kept("history", layout, all, |row| row).written(),
        energy.kept("energy", &(), all, |row| &row.energy).written(),
    ];
    tables.extend(spectrum.as_ref().map(|own| rows::spectrum(own, &result.flank_waves)));
    if let Some(ramp) = ramp {
        tables.extend([
            rows::waterfall(&ramp.waterfall),
            rows::cycles(&ramp.run_up),
            rows::order_cuts(&ramp.run_up),
            rows::campbell(&ramp.campbell),
        ]);
    }
    tables.extend(write_patterns(scene, patterns, results)?);
    let pictures = MotionPictures {
        rows: &tables[0],
        energy: &tables[1],
        spectrum: spectrum.as_ref(),
        waterfall: ramp.as_ref().map(|r| &r.waterfall),
        ramp: ramp.as_ref().map(|r| (speed(scene), scene.driver_teeth(), &r.run_up)),
        campbell: ramp.as_ref().map(|r| &r.campbell),
        per_cycle,
        quasi_static: Some(&result.quasi_static.transmission_error),
    };
    let charts = motion_charts(&pictures)?;
    let answer = pair_answer(scene, (facts, cost), h, remarks, tables);
    let pattern = Part::new("Contact pattern").figures(pattern_figure(patterns));
    let shown = Shown {
        subtitle: format!(
            " in motion ({}), {} rows a mesh cycle, {} cycle(s)",
            h.run.word(),
            h.rows_per_cycle,
            h.cycles
        ),
        key: keys(h),
        over: if h.ramp.is_some() { "Over speed" } else { "Over time" }.into(),
        charts,
        after: vec![pattern],
        headline: lines(h, facts),
        solved: solved(h),
        view,
        again: None,
    };
    let page = pair_page(scene, facts, &answer, shown)?;
    write_result(answer, &page, scene.output.parquet, results)
}

fn keys(h: &MotionHeadline) -> Vec<[String; 2]> {
    let frequencies = format!("{}, {} Hz", fixed(h.mesh_frequency_hz, 0), fixed(h.mesh_resonance_hz, 0));
    let mut all = vec![
        key("peak-to-peak DTE", h.peak_to_peak_dte_um, 3, "um"),
        key("dynamic factor", h.dynamic_factor, 3, ""),
        ["mesh frequency, resonance".to_owned(), frequencies],
    ];
    if let Some(ramp) = &h.ramp {
        all[0] = key("largest peak-to-peak DTE", ramp.peak_to_peak_dte_um.value, 3, "um");
        all[0][1] += &format!(" {}", ramp.peak_to_peak_dte_um.place());
        all[1][1] += &ramp.dynamic_factor.map_or(String::new(), |at| at.place());
    }
    all
}

fn lines(h: &MotionHeadline, facts: &RunInfo) -> Vec<Line> {
    let mut all = vec![
        Line::number("mean speed of the driver", h.speed_rpm, 2, "1/min"),
        Line::number("mesh frequency", h.mesh_frequency_hz, 1, "Hz"),
        Line::number("mesh resonance (mean stiffness)", h.mesh_resonance_hz, 1, "Hz"),
    ];
    all.extend(inertia(&h.inertia));
    all.extend(elasticity(&h.elasticity));
    let quasi_static = [Some(h.mean_ste_um), Some(h.peak_to_peak_ste_um)];
    all.extend(errors([h.mean_dte_um, h.peak_to_peak_dte_um], quasi_static));
    match &h.ramp {
        Some(ramp) => all.extend(over_speed(ramp)),
        None => all.extend(harmonics("DTE", &h.dte_harmonics_um)),
    }
    let there = h.ramp.as_ref().and_then(|r| r.dynamic_factor).map_or(String::new(), |at| at.place());
    let ends = format!("N ({} .. {})", fixed(h.min_normal_force_n, 1), fixed(h.max_normal_force_n, 1));
    all.extend([
        Line::number("mean contact-line length", h.mean_contact_line_length_mm, 3, "mm"),
        Line::number("mean sum of normal forces", h.mean_normal_force_n, 1, ends),
        Line::number("dynamic factor", h.dynamic_factor, 4, there),
        Line::number("largest force on the coast flanks", h.max_coast_normal_force_n, 1, "N"),
        Line::number("mean axial force on the wheel", h.mean_wheel_force_n[2], 1, "N"),
        Line::number("  peak to peak", h.peak_to_peak_wheel_axial_force_n, 1, "N"),
        Line::number("mean tilting moment on the pinion", h.mean_pinion_tilting_moment_nmm, 0, "N mm"),
        Line::number("  peak to peak", h.peak_to_peak_pinion_tilting_moment_nmm, 0, "N mm"),
    ]);
    if h.max_bearing_force_n > 0.0 {
        all.push(Line::number("largest force of a bearing", h.max_bearing_force_n, 1, "N"));
    }
    all.push(pressure(h.max_pressure_mpa, h.max_pressure_at.as_ref()));
    if let Some([pinion, wheel]) = h.root_tensions() {
        let unit = format!("MPa, within about {}, {} %", fixed(pinion.1, 1), fixed(wheel.1, 1));
        let value = format!("{}, {}", fixed(pinion.0, 1), fixed(wheel.0, 1));
        all.push(Line::text("largest root tension, pinion, wheel", value, unit));
        all.extend(iso_root_stress(facts));
    }
    let c = &h.certificate;
    all.extend(cycles([c.warm_up_cycles, h.cycles], c.periodicity, c.period_cycles));
    all.extend([
        Line::text("tooth changes", h.tooth_changes, ""),
        Line::text("contact lost, times", c.flanks.contact_losses, ""),
        Line::science("energy open, over that of the vibration", c.energy_open_over_vibration, ""),
        Line::science("least force of a slice in contact", c.flanks.least_contact_force_n, "N"),
        Line::science("largest jump of the force at a tooth change", c.flanks.force_jump_at_tooth_change_n, "N"),
        Line::text("steps", c.steps, ""),
    ]);
    all
}

/// What a ramp is made for.
fn over_speed(ramp: &RunUpHeadline) -> Vec<Line> {
    let mut all = vec![
        Line::text("  largest peak-to-peak DTE", ramp.peak_to_peak_dte_um.place(), ""),
        Line::number("  mean of all mesh cycles", ramp.mean_peak_to_peak_dte_um, 4, "um"),
    ];
    all.extend(ramp.dte_harmonics_um.iter().take(4).enumerate().map(|(k, order)| {
        let label = format!("largest mesh harmonic {} of DTE", k + 1);
        Line::number(label, order.value, 4, format!("um {}", order.place()))
    }));
    all.extend(
        ramp.pair_normal_force_n
            .as_ref()
            .map(|pair| Line::number("largest force of one pair", pair.value, 1, format!("N {}", pair.place()))),
    );
    all
}

fn solved(h: &MotionHeadline) -> Vec<Line> {
    let c = &h.certificate;
    vec![
        Line::science(
            "energy that does not close, over all work that changed the motion",
            c.ledger_residual_over_turnover,
            "",
        ),
        Line::science("  over the work through the pair", c.ledger_residual_over_work, ""),
        Line::text("steps without contact", c.flanks.steps_without_contact, ""),
        Line::number("largest gap", c.flanks.largest_gap_um, 3, "um"),
        Line::text("coast flanks touched, times", c.flanks.coast_contacts, ""),
        Line::text("steps taken back", c.refused_steps, ""),
        Line::text("free coordinates", h.free_coordinates.join(", "), ""),
    ]
}

/// Writes all files of steady states of reduced gears over speed; what comes back is the closing table.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub(super) fn write_sweep_result(
    scene: &Scene,
    result: &SweepResult,
    cost: &Cost,
    view: Option<&View>,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let SweepResult { rows: all, headline: h, campbell, facts, remarks, .. } = result;
    let tables = vec![rows::resonance(all), rows::campbell(campbell)];
    let answer = pair_answer(scene, (facts, cost), h, remarks, tables);
    let resonance = format!("{} Hz, {} 1/min", fixed(h.mesh_resonance_hz, 0), fixed(h.mesh_resonance_rpm, 0));
    let shown = Shown {
        subtitle: ", steady states over speed".into(),
        key: vec![["mesh resonance".to_owned(), resonance], key("peak-to-peak STE", h.peak_to_peak_ste_um, 3, "um")],
        over: "Over speed".into(),
        charts: sweep_charts(&SweepPictures { rows: all, campbell, teeth: scene.driver_teeth() }),
        headline: over_speeds(h),
        view,
        ..Shown::default()
    };
    let page = pair_page(scene, facts, &answer, shown)?;
    write_result(answer, &page, scene.output.parquet, results)
}

fn over_speeds(h: &SweepHeadline) -> Vec<Line> {
    let mut all = vec![
        Line::number("mesh resonance (mean stiffness)", h.mesh_resonance_hz, 1, "Hz"),
        Line::number("  at a speed of the driver of", h.mesh_resonance_rpm, 1, "1/min"),
    ];
    all.extend(inertia(&h.inertia));
    all.extend(elasticity(&h.elasticity));
    all.push(Line::number("mean STE", h.mean_ste_um, 4, "um"));
    all.push(Line::number("peak-to-peak STE", h.peak_to_peak_ste_um, 4, "um"));
    for row in &h.largest {
        let way = match row.way {
            SweepWay::Apart => "each by itself",
            SweepWay::Up => "upwards",
            SweepWay::Down => "downwards",
        };
        let at = format!("um at {:.1} rpm, {:.1} Hz", row.speed_rpm, row.mesh_frequency_hz);
        all.push(Line::number(format!("largest peak-to-peak DTE, {way}"), row.peak_to_peak_dte_um, 4, at));
        all.push(Line::number("  dynamic factor there", row.dynamic_factor, 4, ""));
    }
    if !h.failed.is_empty() {
        all.push(Line::text("speeds without a solution", h.failed.len(), ""));
    }
    all.extend(
        h.failed
            .iter()
            .map(|miss| Line::text(format!("  at {:.1} 1/min, {}", miss.speed_rpm, miss.way.word()), "", &miss.reason)),
    );
    all
}
