//! Files of a search for basins: starts, motions that they end in; picture, page, closing table.

use analysis::{
    facts::Facts,
    lumped::{Attractor, BasinHeadline, BasinResult},
};
use scene::Scene;

use crate::{
    Cost, ReportError, ResultFiles,
    charts::{Curve, dot_chart, dot_picture},
    csv::push_row,
    page::render_run,
    tables::Lines,
};

/// One row a start.
pub const BASINS_FILE: &str = "basins.csv";
/// One row a motion that starts end in.
pub const ATTRACTORS_FILE: &str = "attractors.csv";

const TITLE: &str = "Basins of attraction";
const X: &str = "initial DTE beside that of rest [um]";
const Y: &str = "initial rate of the DTE [mm/s]";

/// `basins.csv`; nothing stands where no motion comes out.
pub fn basins_csv(found: &BasinResult) -> String {
    let mut csv = String::from("initial_dte_um,initial_dte_rate_mm_s,attractor,warm_up_cycles\n");
    for start in &found.starts {
        let end = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let settled = start.attractor.map(|_| start.warm_up_cycles as f64);
        let row =
            [start.initial_dte_um, start.initial_dte_rate_mm_s, end(start.attractor.map(|n| n as f64)), end(settled)];
        push_row(&mut csv, row);
    }
    csv
}

/// `attractors.csv`; a motion that does not come back has no period.
pub fn attractors_csv(all: &[Attractor]) -> String {
    let mut csv = String::from(
        "attractor,period_cycles,starts,share_pct,mean_dte_um,min_dte_um,max_dte_um,min_normal_force_n,max_normal_force_n,\
         most_warm_up_cycles\n",
    );
    for a in all {
        push_row(
            &mut csv,
            [
                a.attractor as f64,
                a.period_cycles.map_or(f64::NAN, |p| p as f64),
                a.starts as f64,
                a.share_pct,
                a.mean_dte_um,
                a.min_dte_um,
                a.max_dte_um,
                a.min_normal_force_n,
                a.max_normal_force_n,
                a.most_warm_up_cycles as f64,
            ],
        );
    }
    csv
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

/// Starts, attractors, the plane as SVG, and page.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_basins(
    scene: &Scene,
    found: &BasinResult,
    cost: &Cost,
    files: &dyn ResultFiles,
) -> Result<(), ReportError> {
    let BasinResult { facts, attractors, headline, warnings, .. } = found;
    files.write(BASINS_FILE, basins_csv(found).as_bytes())?;
    files.write(ATTRACTORS_FILE, attractors_csv(attractors).as_bytes())?;
    let curves = curves(found);
    if let Some(picture) = dot_picture(TITLE, X, Y, &curves) {
        files.write("basins.svg", picture.as_bytes())?;
    }
    let charts = dot_chart(TITLE, X, Y, &curves).into_iter().collect();
    render_run(scene, facts, cost, headline, "basins.html", charts, warnings)?.write(files)
}

/// The table at the end of a search for basins.
pub fn basins_table(scene: &Scene, facts: &Facts, cost: &Cost, h: &BasinHeadline, warnings: &[String]) -> String {
    let mut t = Lines::new(facts);
    let range = |[low, high]: [f64; 2]| format!("{low:.6} .. {high:.6}");
    t.text("initial DTE beside rest", range(h.initial_dte_um), "um");
    t.text("initial rate of the DTE", range(h.initial_dte_rate_mm_s), "mm/s");
    t.number("mesh resonance (mean stiffness)", h.mesh_resonance_hz, 1, "Hz");
    t.text("starts", h.starts, &format!("{} without a motion", h.failed));
    for a in &h.attractors {
        t.text(&format!("attractor {}", name(a)), a.starts, &format!("starts, {:.2} %", a.share_pct));
    }
    t.framed(scene, cost, warnings)
}
