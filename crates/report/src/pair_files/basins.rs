//! Motions that many starts end in: the plane of starts, page, closing table.

use analysis::lumped::{Attractor, BasinHeadline, BasinResult};
use scene::Scene;

use super::{
    common::{Shown, pair_answer, pair_page},
    key_rows,
};
use crate::{
    Cost, ReportError, Written,
    charts::{Curve, dot_chart, dot_picture},
    page::{Cell, Grid, Line, Part},
    write_result,
};
use store::folder::ResultDirectory;

const TITLE: &str = "Basins of attraction";
const X: &str = "initial DTE beside that of rest [um]";
const Y: &str = "initial rate of the DTE [mm/s]";

/// Writes all files of a search for basins of attraction; what comes back is the closing table.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub(super) fn write_basin_result(
    scene: &Scene,
    found: &BasinResult,
    cost: &Cost,
    results: &ResultDirectory,
) -> Result<Written, ReportError> {
    let BasinResult { facts, attractors, headline: h, remarks, .. } = found;
    let tables = vec![key_rows::basins(&found.starts), key_rows::attractors(attractors)];
    let curves = curves(found);
    if let Some(picture) = dot_picture(TITLE, X, Y, &curves) {
        results.write("basins.svg", picture.as_bytes())?;
    }
    let answer = pair_answer(scene, (facts, cost), h, remarks, tables);
    let shown = Shown {
        subtitle: ", basins of attraction".into(),
        key: vec![
            ["starts".to_owned(), h.starts.to_string()],
            ["motions that they end in".to_owned(), h.attractors.len().to_string()],
        ],
        over: "The plane of initial states".into(),
        charts: dot_chart(TITLE, X, Y, &curves).into_iter().collect(),
        after: vec![table(&h.attractors)],
        headline: lines(h),
        ..Shown::default()
    };
    let page = pair_page(scene, facts, &answer, shown)?;
    write_result(answer, &page, scene.output.parquet, results)
}

fn name(a: &Attractor) -> String {
    let period = a.period_cycles.map_or("does not come back".to_owned(), |p| format!("period {p}"));
    format!("{}: {period}, peak to peak {:.3} um", a.attractor, a.peak_to_peak_dte_um())
}

fn curves(found: &BasinResult) -> Vec<Curve> {
    let of = |number: Option<usize>| -> Vec<(f64, f64)> {
        let own = found.starts.iter().filter(|s| s.attractor == number);
        own.map(|s| (s.initial_dte_um, s.initial_dte_rate_mm_s)).collect()
    };
    let attractors = found.attractors.iter().map(|a| Curve { label: name(a), points: of(Some(a.attractor)) });
    attractors.chain([Curve { label: "no motion".into(), points: of(None) }]).collect()
}

fn table(all: &[Attractor]) -> Part {
    let head = [
        "motion",
        "mesh cycles of a period",
        "starts",
        "share %",
        "peak-to-peak DTE um",
        "least normal force N",
        "largest N",
    ];
    let rows = all.iter().map(|a| {
        vec![
            Cell::count(a.attractor),
            Cell::count(a.period_cycles.map_or_else(|| "does not come back".to_owned(), |p| p.to_string())),
            Cell::count(a.starts),
            Cell::number(a.share_pct, 2),
            Cell::number(a.peak_to_peak_dte_um(), 4),
            Cell::number(a.min_normal_force_n, 1),
            Cell::number(a.max_normal_force_n, 1),
        ]
    });
    let note = "Each start displaces the gears, and sets them moving, as an impulse in the mesh would.";
    Part::new("Motions").grid(Grid::new(head).rows(rows)).note(note)
}

fn lines(h: &BasinHeadline) -> Vec<Line> {
    let range = |[low, high]: [f64; 2]| format!("{low:.6} .. {high:.6}");
    let mut all = vec![
        Line::text("initial DTE beside rest", range(h.initial_dte_um), "um"),
        Line::text("initial rate of the DTE", range(h.initial_dte_rate_mm_s), "mm/s"),
        Line::number("mesh resonance (mean stiffness)", h.mesh_resonance_hz, 1, "Hz"),
        Line::text("starts", h.starts, format!("{} without a motion", h.failed)),
    ];
    all.extend(
        h.attractors
            .iter()
            .map(|a| Line::text(format!("attractor {}", name(a)), a.starts, format!("starts, {:.2} %", a.share_pct))),
    );
    all
}
