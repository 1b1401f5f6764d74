//! Files of a continuation: motions along the branch, where it turns, motions in time; pictures, page, closing table.

use analysis::{
    facts::Facts,
    lumped::{BranchPoint, ContinuationHeadline, ContinuationResult, LossName, TimePoint},
};
use scene::Scene;

use crate::{
    Cost, ReportError, ResultFiles,
    charts::{Curve, dot_chart, dot_picture},
    csv::push_row,
    page::render_run,
    tables::Lines,
};

/// One row a motion, in the order of the branch.
pub const BRANCH_FILE: &str = "branch.csv";
/// One row a fold, period doubling or torus bifurcation.
pub const TURNS_FILE: &str = "bifurcations.csv";
/// One row a motion that was integrated in time.
pub const IN_TIME_FILE: &str = "in_time.csv";

const TITLE: &str = "Periodic motions";
const DTE: &str = "peak-to-peak DTE [um]";

/// Dots between two motions: stable parts look like a line, unstable ones like a dotted one.
const DENSE: usize = 40;
const LOOSE: usize = 4;

fn loss_name(loss: LossName) -> &'static str {
    match loss {
        LossName::Fold => "fold",
        LossName::PeriodDoubling => "period-doubling",
        LossName::Torus => "torus",
    }
}

fn columns(key: &str) -> String {
    let orders: Vec<String> = (1..=5).map(|k| format!("dte_harmonic_{k}_um")).collect();
    format!(
        "{key},stable,largest_multiplier,mean_dte_um,peak_to_peak_dte_um,rms_dte_um,{},min_normal_force_n,max_normal_force_n,share_apart,\
         harmonics,newton_steps,residual,tail",
        orders.join(",")
    )
}

fn numbers(p: &BranchPoint) -> Vec<f64> {
    let first = [
        p.value,
        f64::from(u8::from(p.is_stable)),
        p.largest_multiplier,
        p.mean_dte_um,
        p.peak_to_peak_dte_um,
        p.rms_dte_um,
    ];
    let last = [
        p.min_normal_force_n,
        p.max_normal_force_n,
        p.share_apart,
        p.harmonics as f64,
        p.newton_steps as f64,
        p.residual,
        p.tail,
    ];
    first.into_iter().chain(p.dte_harmonics_um).chain(last).collect()
}

/// `branch.csv`.
pub fn branch_csv(key: &str, points: &[BranchPoint]) -> String {
    let mut csv = format!("{}\n", columns(key));
    points.iter().for_each(|p| push_row(&mut csv, numbers(p)));
    csv
}

fn turns_csv(key: &str, found: &ContinuationResult) -> String {
    let mut csv = format!("bifurcation,{}\n", columns(key));
    for turn in &found.turns {
        csv.push_str(loss_name(turn.loss));
        csv.push(',');
        push_row(&mut csv, numbers(&turn.point));
    }
    csv
}

fn in_time_csv(key: &str, all: &[TimePoint]) -> String {
    let mut csv = format!("{key},peak_to_peak_dte_um,branch_peak_to_peak_dte_um\n");
    all.iter().for_each(|p| push_row(&mut csv, [p.value, p.peak_to_peak_dte_um, p.branch_peak_to_peak_dte_um]));
    csv
}

/// Both parts of the branch as rows of dots, bifurcations, and motions in time.
fn curves(found: &ContinuationResult, value: fn(&BranchPoint) -> f64, in_time: &[(f64, f64)]) -> Vec<Curve> {
    let part = |stable: bool, count: usize| -> Vec<(f64, f64)> {
        let own = found.points.windows(2).filter(|w| w[0].is_stable == stable);
        let between = |w: &[BranchPoint], k: usize| {
            let share = k as f64 / count as f64;
            let of = |f: fn(&BranchPoint) -> f64| f(&w[0]) + share * (f(&w[1]) - f(&w[0]));
            (of(|p| p.value), of(value))
        };
        own.flat_map(|w| (0..count).map(move |k| between(w, k))).collect()
    };
    let turns = |loss: LossName| {
        found.turns.iter().filter(|t| t.loss == loss).map(|t| (t.point.value, value(&t.point))).collect::<Vec<_>>()
    };
    let all = [
        ("stable", part(true, DENSE)),
        ("unstable", part(false, LOOSE)),
        ("folds", turns(LossName::Fold)),
        ("period doublings", turns(LossName::PeriodDoubling)),
        ("torus bifurcations", turns(LossName::Torus)),
        ("integrated in time", in_time.to_vec()),
    ];
    all.into_iter().map(|(label, points)| Curve { label: label.into(), points }).collect()
}

fn charts(found: &ContinuationResult) -> Vec<String> {
    let key = found.headline.key;
    let in_time: Vec<(f64, f64)> = found.in_time.iter().map(|p| (p.value, p.peak_to_peak_dte_um)).collect();
    [
        dot_chart(TITLE, key, DTE, &curves(found, |p| p.peak_to_peak_dte_um, &in_time)),
        dot_chart("Largest normal force", key, "force [N]", &curves(found, |p| p.max_normal_force_n, &[])),
        dot_chart("Smallest normal force", key, "force [N]", &curves(found, |p| p.min_normal_force_n, &[])),
        dot_chart(
            "Largest Floquet multiplier: below 1 disturbances fade",
            key,
            "size",
            &curves(found, |p| p.largest_multiplier, &[]),
        ),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Branch, bifurcations, motions in time, the curve as SVG, and page.
///
/// # Errors
/// When the system refuses, or a page does not come out.
pub fn write_branch(
    scene: &Scene,
    found: &ContinuationResult,
    cost: &Cost,
    files: &dyn ResultFiles,
) -> Result<(), ReportError> {
    let ContinuationResult { facts, points, in_time, headline, warnings, .. } = found;
    let key = headline.key;
    files.write(BRANCH_FILE, branch_csv(key, points).as_bytes())?;
    files.write(TURNS_FILE, turns_csv(key, found).as_bytes())?;
    files.write(IN_TIME_FILE, in_time_csv(key, in_time).as_bytes())?;
    let dots: Vec<(f64, f64)> = in_time.iter().map(|p| (p.value, p.peak_to_peak_dte_um)).collect();
    if let Some(picture) = dot_picture(TITLE, key, DTE, &curves(found, |p| p.peak_to_peak_dte_um, &dots)) {
        files.write("branch.svg", picture.as_bytes())?;
    }
    render_run(scene, facts, cost, headline, "branch.html", charts(found), warnings)?.write(files)
}

/// The table at the end of a continuation.
pub fn branch_table(
    scene: &Scene,
    facts: &Facts,
    cost: &Cost,
    h: &ContinuationHeadline,
    warnings: &[String],
) -> String {
    let mut t = Lines::new(facts);
    let listed = |values: &[f64]| values.iter().map(|v| format!("{v:.6}")).collect::<Vec<_>>().join(", ");
    t.text(h.key, format_args!("{:.6} .. {:.6}", h.range[0], h.range[1]), "");
    t.number("mesh resonance (mean stiffness)", h.mesh_resonance_hz, 1, "Hz");
    t.text("motions", h.motions, &format!("{} unstable", h.unstable));
    t.number("largest peak-to-peak DTE", h.largest.peak_to_peak_dte_um, 4, &format!("um at {:.6}", h.largest.value));
    t.text("folds", h.folds.len(), &listed(&h.folds));
    t.text("period doublings", h.period_doublings.len(), &listed(&h.period_doublings));
    t.text("torus bifurcations", h.torus_bifurcations.len(), &listed(&h.torus_bifurcations));
    t.text("motions in which flanks part", h.parting, "");
    t.text("most harmonics", h.most_harmonics, "");
    t.text("Newton steps", h.newton_steps, "");
    t.science("largest difference of a motion in time", h.difference_in_time, "");
    t.framed(scene, cost, warnings)
}
