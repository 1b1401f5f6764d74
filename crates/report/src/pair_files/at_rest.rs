//! A run at rest: rows, contact, page, closing table.

use analysis::{
    Derivatives,
    accuracy::Quantity,
    facts::RunInfo,
    flank_orders::FlankOrders,
    results::{Place, StaticHeadline, static_headline},
};
use ltca::StaticHistory;
use scene::Scene;

use super::common::{Shown, harmonics, iso_root_stress, key, pair_answer, pair_page, pressure};
use super::rating;
use crate::{
    Cost, ReportError, Written,
    charts::{Curve, LineChart, banded_chart},
    contact_files::{contact_lines, flank_orders, pattern_figure, write_patterns},
    page::{Content, Line, Part},
    write_result, write_rows,
};
use columns::{
    At, StaticCurves, history_table,
    static_history::{
        FORCE_X, FORCE_Y, FORCE_Z, GEOMETRIC_LENGTH, LINE_LENGTH, PAIR_FORCE, SECANT_STIFFNESS, STE, TANGENT_STIFFNESS,
        TOOTH_TENSION,
    },
};
use export::view::View;
use store::folder::ResultDirectory;

/// Writes all files of a run at rest but the fields for ParaView, which come position by position; what comes back is
/// the closing table. `view`: the gears in space.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_static_result(
    scene: &Scene,
    (history, derivatives): (&StaticHistory, Option<&Derivatives>),
    (facts, cost): (&RunInfo, &Cost),
    view: Option<&View>,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let headline = static_headline(scene, history)?;
    let mut tables = vec![history_table(scene, history, derivatives)];
    let mut pattern = None;
    if scene.has_slices() {
        let pair = scene.gear_pair()?;
        if scene.output.contact_lines {
            tables.push(contact_lines(scene, &pair, history));
        }
        if scene.output.flank_orders {
            tables.extend(flank_orders(&FlankOrders::of(scene, &pair, history)?));
        }
        let patterns = analysis::results::patterns(scene, &pair, &history.positions)?;
        tables.extend(rating::with_safeties(write_patterns(scene, &patterns, results)?, headline.rating.as_ref()));
        pattern = pattern_figure(&patterns);
    }
    if let Some(roots) = &history.roots {
        tables.extend(rating::root_patterns(roots, headline.rating.as_ref()));
    }
    let answer = pair_answer(scene, (facts, cost), &headline, &history.remarks, tables);
    let mut after = after(&headline, facts, pattern);
    after.extend(headline.rating.iter().flat_map(|rating| rating::parts(rating, None)));
    let shown = Shown {
        subtitle: format!(", {} positions a mesh cycle, {} cycle(s)", headline.samples_per_cycle, headline.cycles),
        key: [
            key("peak-to-peak STE", headline.peak_to_peak_ste_um, 3, "um"),
            key("mean mesh stiffness", headline.mean_mesh_stiffness_n_per_um, 1, "N/um"),
            key("maximum pressure", headline.max_pressure_mpa, 0, "MPa"),
        ]
        .into_iter()
        .chain(headline.rating.iter().flat_map(rating::safeties))
        .collect(),
        over: "Over the mesh cycle".into(),
        charts: charts(scene, (history, &headline), facts),
        after,
        headline: lines(&headline, facts),
        solved: solved(&headline),
        view,
        again: None,
    };
    let page = pair_page(scene, facts, &answer, shown)?;
    write_result(answer, &page, scene.output.parquet, results)
}

/// Writes rows and summary of a run at rest, without a page.
///
/// # Errors
/// When the system refuses.
pub fn write_static_rows(
    scene: &Scene,
    (history, derivatives): (&StaticHistory, Option<&Derivatives>),
    (facts, cost): (&RunInfo, &Cost),
    results: &ResultDirectory,
) -> Result<(), ReportError> {
    let tables = vec![history_table(scene, history, derivatives)];
    let headline = static_headline(scene, history)?;
    write_rows(&pair_answer(scene, (facts, cost), &headline, &history.remarks, tables), results)
}

/// Definitions, and the contact pattern.
fn after(h: &StaticHeadline, facts: &RunInfo, pattern: Option<String>) -> Vec<Part> {
    let mut notes = Vec::new();
    if let Some(root) = &h.root_stress {
        notes.push(format!("Root stress: {}; {}.", root.definition, root.averaging));
    } else if !facts.meshes.is_empty() {
        notes.push("Root stress of the meshes was not asked for: `--set output.root_stress=true`.".to_owned());
    }
    notes.extend(facts.iso_root_stress.as_ref().map(|iso| format!("Nominal root stress: {}.", iso.method)));
    notes.push(
        "Pair 0 passes the middle of its path during the cycle shown; pair 1 is one pitch ahead of it in the sense of \
         rotation, pair -1 one behind."
            .to_owned(),
    );
    let pattern = Part::new("Contact pattern").with(Content::Figures(pattern.into_iter().collect()));
    let has_pattern = !pattern.is_empty();
    let words =
        "Largest pressure over the whole mesh on the driving flank of one tooth; grey: no contact line came there.";
    std::iter::once(Part::more().note(notes.join(" "))).chain(has_pattern.then(|| pattern.note(words))).collect()
}

fn lines(h: &StaticHeadline, facts: &RunInfo) -> Vec<Line> {
    let mut all = vec![
        Line::number("mean STE", h.mean_ste_um, 4, "um"),
        Line::number(format!("peak-to-peak STE ({} positions)", h.samples_per_cycle), h.peak_to_peak_ste_um, 4, "um"),
    ];
    all.extend(harmonics("STE", &h.ste_harmonics_um));
    all.extend([
        Line::number("mean mesh stiffness, secant", h.mean_mesh_stiffness_n_per_um, 2, "N/um"),
        Line::number("mean mesh stiffness, tangent", h.mean_mesh_stiffness_tangent_n_per_um, 2, "N/um"),
        Line::number("mean contact-line length", h.mean_contact_line_length_mm, 3, "mm"),
        Line::number("  unloaded, analytic", h.mean_geometric_line_length_mm, 3, "mm"),
        Line::number("mean sum of normal forces", h.mean_normal_force_n, 1, "N"),
        Line::number("mean axial force on the wheel", h.mean_wheel_force_n[2], 1, "N"),
        Line::number("mean tilting moment on the pinion", h.mean_pinion_tilting_moment_nmm, 0, "N mm"),
        Line::number("mean tilting moment on the wheel", h.mean_wheel_tilting_moment_nmm, 0, "N mm"),
        Line::number("largest force of one pair", h.max_pair_force_n, 1, "N"),
    ]);
    if h.mean_friction_power_loss_w != 0.0 {
        all.push(Line::number("mean power lost to friction", h.mean_friction_power_loss_w, 2, "W"));
        all.push(Line::text("efficiency of the contact", format!("{:.3}", 100.0 * h.efficiency), "%"));
    }
    let factors = [
        ("tooth loss factor H_VL", h.tooth_loss_factor),
        ("transverse load factor K_Halpha", h.transverse_load_factor),
        ("load sharing ratio", h.load_sharing_ratio),
        ("face load factor K_Hbeta", h.face_load_factor),
    ];
    all.extend(factors.into_iter().filter_map(|(what, value)| Some(Line::number(what, value?, 3, ""))));
    all.push(pressure(h.max_pressure_mpa, h.max_pressure_at.as_ref()));
    for (name, gear) in h.root_stress.iter().flat_map(|root| [("pinion", &root.pinion), ("wheel", &root.wheel)]) {
        let (tension, compression) = (&gear.max_principal, &gear.min_principal);
        all.extend([
            Line::number(format!("largest root tension, {name}"), tension.stress_mpa, 1, place(tension)),
            Line::number(format!("largest root compression, {name}"), compression.stress_mpa, 1, "MPa"),
            Line::number(format!("largest root von Mises, {name}"), gear.von_mises.stress_mpa, 1, "MPa"),
        ]);
    }
    all.extend(iso_root_stress(facts));
    if h.root_stress.is_none() && !facts.meshes.is_empty() {
        let why = "(not asked for: `--set output.root_stress=true`)";
        all.push(Line::text("root stress of the meshes", "-", why));
    }
    let first = h.tooth_change.as_ref().map_or(String::new(), |change| change.words());
    all.push(Line::text("tooth changes", h.tooth_changes, first));
    all.push(Line::science("worst torque residual", h.worst_torque_residual, ""));
    all
}

/// Unit, tooth and place of a root stress.
fn place(at: &Place) -> String {
    let Place { tooth, radius_mm, z_mm, estimated_error_percent, .. } = at;
    let side = at.side.name();
    format!(
        "MPa, within about {estimated_error_percent:.1} % (tooth {tooth}, {side} fillet, r {radius_mm:.3} mm, z {z_mm:.2} mm)"
    )
}

fn solved(h: &StaticHeadline) -> Vec<Line> {
    let usual = "(0.5 is usual with the least window)";
    vec![
        Line::science(
            "complementarity (gap, pressure), worst relative violation",
            h.worst_complementarity_residual,
            "",
        ),
        Line::science("action and reaction, worst relative difference", h.worst_action_reaction_residual, ""),
        Line::science("share of load on an end pair of the window, largest", h.worst_window_edge_load, usual),
        Line::science(
            "interpolated bulk compliance, largest error relative to the largest self-compliance of a slice",
            h.bulk_compliance_error,
            "(0: exact)",
        ),
        Line::text("iterations, all positions", h.iterations, ""),
    ]
}

const ANGLE: &str = "pinion angle [deg]";

/// What is drawn of positions at rest: static transmission error and its spectrum, load sharing, line load over the face
/// first. `harmonics`: amplitudes of the mesh harmonics, um.
pub fn static_charts(scene: &Scene, history: &StaticHistory, harmonics: &[f64]) -> Vec<LineChart> {
    let curves = StaticCurves::new(scene, history);
    let named = |label: &str, points| Curve { label: label.to_owned(), points };
    let of = |label, column| named(label, curves.of(column));
    let by_pair = |column, gear| -> Vec<Curve> {
        let pairs = curves.by_pair(column, gear).into_iter();
        pairs.map(|(pair, points)| named(&format!("pair {pair}"), points)).collect()
    };
    let forces = [("x", FORCE_X), ("y", FORCE_Y), ("z", FORCE_Z)]
        .map(|(axis, column)| named(axis, curves.at(column, At { gear: 1, pair: 0 })));
    let length = [of("under load", LINE_LENGTH), of("unloaded, analytic", GEOMETRIC_LENGTH)];
    let stiffness = [of("secant", SECANT_STIFFNESS), of("tangent", TANGENT_STIFFNESS)];
    // A pair's bending on either gear: the tension below the loaded flank of its teeth.
    let bending = |gear| by_pair(TOOTH_TENSION, gear);
    let chart = |title, y, curves: &[_], from_zero| LineChart::new(title, [ANGLE, y], curves, from_zero);
    let spectrum = harmonics.iter().zip(1u32..).map(|(amplitude, order)| (f64::from(order), *amplitude));
    let spectrum = named("amplitude", spectrum.collect());
    let slices = history.positions.iter().flat_map(|p| &p.pairs).flat_map(|pair| &pair.slices);
    let mut over_face = ltca::load_envelope(slices);
    over_face.sort_by(|a, b| a.0.total_cmp(&b.0));
    let face = ["height over the pinion's mid-face [mm]", "largest line load [N/mm]"];
    [
        chart("Static transmission error", "STE [um]", &[of("STE", STE)], false),
        LineChart::spectrum("Spectrum of the static transmission error", ["mesh order", "amplitude [um]"], spectrum),
        chart("Load sharing", "normal force [N]", &by_pair(PAIR_FORCE, 0), true),
        LineChart::new("Line load over the face", face, &[named("over the mesh cycle", over_face)], true),
        chart("Total contact-line length", "length [mm]", &length, false),
        chart("Mesh stiffness", "stiffness [N/um]", &stiffness, false),
        chart("Mesh force on the wheel", "force [N]", &forces, true),
        chart("Largest principal root stress, pinion", "stress [MPa]", &bending(0), true),
        chart("Largest principal root stress, wheel", "stress [MPa]", &bending(1), true),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn charts(scene: &Scene, (history, h): (&StaticHistory, &StaticHeadline), facts: &RunInfo) -> Vec<String> {
    let all = static_charts(scene, history, &h.ste_harmonics_um);
    all.iter()
        .enumerate()
        .filter_map(|(k, chart)| if k == 0 { in_its_bounds(chart, facts) } else { chart.figure() })
        .collect()
}

/// The transmission error; where its bounds are known, in the band of those of its mean.
fn in_its_bounds(chart: &LineChart, facts: &RunInfo) -> Option<String> {
    let bounds = facts.accuracy.as_ref().map(|accuracy| &accuracy.bounds[..]).unwrap_or_default();
    match bounds.iter().find(|b| b.quantity == Quantity::MeanSte) {
        Some(mean) => {
            let (name, [x, y]) = ("within the bounds of the mean", chart.axes);
            banded_chart(chart.title, x, y, chart.curves[0].clone(), name, [mean.below, mean.above])
        }
        None => chart.figure(),
    }
}
