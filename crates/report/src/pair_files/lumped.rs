//! A motion of a reduced-order model: rows, page, closing table.

use analysis::{
    lumped::{LumpedHeadline, LumpedResult},
    motion::speed,
};
use scene::Scene;

use super::{
    common::{Shown, cycles, errors, harmonics, key, pair_answer, pair_page},
    rows,
};
use crate::{
    Cost, ReportError, Written,
    charts::{Curve, campbell_chart, line_chart},
    motion_files::{MotionPictures, SHOWN_CYCLES, motion_charts, portrait, section},
    page::Line,
    tables::fixed,
    write_result,
};
use columns::{ENERGY, LumpedLayout, lumped_history::TIME};
use store::folder::ResultDirectory;

/// Displacements that have a phase portrait where the model has them; their rates are named alike.
const PORTRAITS: [(&str, &str); 6] = [
    ("pinion_along", "the pinion along the line of action"),
    ("wheel_along", "the wheel along the line of action"),
    ("pinion_y", "the pinion along y"),
    ("wheel_y", "the wheel along y"),
    ("pinion_z", "the pinion along its axis"),
    ("wheel_z", "the wheel along its axis"),
];

/// Writes all files of a motion of a reduced-order model; what comes back is the closing table.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub(super) fn write_lumped_result(
    scene: &Scene,
    result: &LumpedResult,
    cost: &Cost,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let LumpedResult { facts, spectrum, run_up, campbell, headline: h, remarks, .. } = result;
    let layout = LumpedLayout::of(scene);
    let (history, energy) = (layout.sheet(), ENERGY.sheet(&(), &[]));
    let mut tables = vec![
        history.kept("history", &layout, &result.rows, |row| row),
        energy.kept("energy", &(), &result.energy, |row| row),
        rows::spectrum(spectrum, &result.flank_waves),
    ];
    let places: Vec<f64> = (0..result.rows.len()).map(|i| i as f64 / h.rows_per_cycle as f64).collect();
    tables.insert(2, section(&tables[0], &places, 1.0)?);
    tables.extend(campbell.as_ref().map(rows::lumped_campbell));
    tables.extend(run_up.as_ref().map(rows::cycles));
    let static_errors: Option<Vec<f64>> = result.static_cycle.as_ref().map(|all| all.iter().map(|p| p.error).collect());
    let pictures = MotionPictures {
        rows: &tables[0],
        energy: &tables[1],
        spectrum: Some(spectrum),
        waterfall: None,
        ramp: run_up.as_ref().map(|p| (speed(scene), scene.driver_teeth(), p)),
        campbell: None,
        per_cycle: h.rows_per_cycle as usize,
        quasi_static: static_errors.as_deref(),
    };
    let mut charts = motion_charts(&pictures)?;
    for (name, whose) in PORTRAITS {
        charts.extend(displacement(&pictures, name, whose)?);
        charts.extend(portrait([&tables[0], &tables[2]], name, [whose, "once a mesh cycle"])?);
    }
    charts.extend(campbell.as_ref().and_then(|c| campbell_chart(&c.diagram, &c.names, &[])));
    let frequencies = Line::number("", h.mesh_resonance_hz, 0, "").value;
    let answer = pair_answer(scene, (facts, cost), h, remarks, tables);
    let shown = Shown {
        subtitle: format!(
            " in motion ({}), {} coordinates, {} rows a mesh cycle, {} cycle(s)",
            h.run.word(),
            h.coordinates,
            h.rows_per_cycle,
            h.cycles
        ),
        key: vec![
            key("peak-to-peak DTE", h.peak_to_peak_dte_um, 3, "um"),
            key("dynamic factor", h.dynamic_factor, 3, ""),
            ["mesh frequency, resonance".to_owned(), format!("{}, {frequencies} Hz", fixed(h.mesh_frequency_hz, 0))],
        ],
        over: "Over time".into(),
        charts,
        headline: lines(h),
        solved: vec![
            Line::science(
                "energy that does not close, over all work that changed the motion",
                h.certificate.ledger_residual_over_turnover,
                "",
            ),
            Line::text("steps taken back", h.certificate.refused_steps, ""),
        ],
        ..Shown::default()
    };
    let page = pair_page(scene, facts, &answer, shown)?;
    write_result(answer, &page, scene.output.parquet, results)
}

fn lines(h: &LumpedHeadline) -> Vec<Line> {
    let c = &h.certificate;
    let mut all = vec![
        Line::text("coordinates", h.coordinates, ""),
        Line::number("speed of the driver", h.speed_rpm, 2, "1/min"),
        Line::number("mesh frequency", h.mesh_frequency_hz, 1, "Hz"),
        Line::number("mesh resonance (mean stiffness)", h.mesh_resonance_hz, 1, "Hz"),
    ];
    all.extend(errors([h.mean_dte_um, h.peak_to_peak_dte_um], [h.mean_ste_um, h.peak_to_peak_ste_um]));
    match &h.ramp {
        Some(ramp) => {
            let largest = &ramp.peak_to_peak_dte_um;
            let at = format!("um {}", largest.place());
            all.push(Line::number("largest peak-to-peak DTE of the ramp", largest.value, 4, at));
            let factor = ramp.dynamic_factor.as_ref();
            all.extend(factor.map(|f| Line::number("  dynamic factor", f.value, 4, f.place())));
        }
        None => all.extend(harmonics("DTE", &h.dte_harmonics_um)),
    }
    let ends = format!("N ({} .. {})", fixed(h.min_normal_force_n, 1), fixed(h.max_normal_force_n, 1));
    all.extend([
        Line::number("mean mesh stiffness", h.mean_mesh_stiffness_n_per_um, 2, "N/um"),
        Line::number("mean contact-line length", h.mean_contact_line_length_mm, 3, "mm"),
        Line::number("normal force of the mean load", h.static_normal_force_n, 1, "N"),
        Line::number("mean normal force", h.mean_normal_force_n, 1, ends),
        Line::number("dynamic factor", h.dynamic_factor, 4, ""),
        Line::number("mean axial force on the wheel", h.mean_wheel_force_n[2], 1, "N"),
        Line::number("mean tilting moment on the pinion", h.mean_pinion_tilting_moment_nmm, 0, "N mm"),
    ]);
    all.extend(cycles([c.warm_up_cycles, h.cycles], c.periodicity, c.period_cycles));
    all.extend([
        Line::science("energy open, over that of the vibration", c.energy_open_over_vibration, ""),
        Line::text("rows without contact", c.rows_without_contact, ""),
        Line::text("steps", c.steps, ""),
    ]);
    all
}

/// Displacement over time, the last mesh cycles.
fn displacement(of: &MotionPictures<'_>, name: &str, whose: &str) -> Result<Option<String>, ReportError> {
    let (rows, own) = (of.rows.rows(), format!("{name}_um"));
    let first = rows.saturating_sub(SHOWN_CYCLES * of.per_cycle);
    let part = of.rows.part(first..rows, |name| name == TIME.name || name == own)?;
    let (Some(time), Some(x)) = (part.find(TIME.name), part.find(&own)) else { return Ok(None) };
    let begin = time.first().copied().unwrap_or(0.0);
    let points: Vec<(f64, f64)> = time.iter().zip(x).map(|(t, x)| (1e3 * (t - begin), *x)).collect();
    let curve = Curve { label: name.replace('_', " "), points };
    let title = format!("Motion of {whose}");
    Ok(line_chart(&title, "time [ms], last mesh cycles", "displacement [um]", &[curve], false))
}
