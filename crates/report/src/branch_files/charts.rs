//! Charts of a branch: its stable and its unstable parts, bifurcations, and motions in time.

use analysis::branch::{BranchPoint, LossName};
use answer::label_of;

use super::{MeshOnBranch, ShownBranch};
use crate::charts::{Curve, dot_chart, dot_picture};

const TITLE: &str = "Periodic motions";
const DTE: &str = "peak-to-peak DTE [um]";

/// Dots between two motions: stable parts look like a line, unstable ones like a dotted one.
const DENSE: usize = 40;
const LOOSE: usize = 4;

/// The transmission error along the branch of a pair, for a file of its own.
pub(crate) fn picture(branch: &ShownBranch<'_>) -> Option<String> {
    let mesh = branch.meshes.first()?;
    dot_picture(TITLE, &label_of(branch.key), DTE, &transmission_errors(mesh))
}

/// Charts of a page: transmission error and forces of each mesh, multipliers.
pub(crate) fn charts(branch: &ShownBranch<'_>) -> Vec<String> {
    let key = &label_of(branch.key);
    let of_mesh = |mesh: &MeshOnBranch<'_>| {
        let title = |what: &str| match mesh.names[1].as_str() {
            "" => what.to_owned(),
            name => format!("{what}, mesh {name}"),
        };
        [
            dot_chart(&title(TITLE), key, DTE, &transmission_errors(mesh)),
            dot_chart(&title("Largest normal force"), key, "force [N]", &curves(mesh, |p| p.max_normal_force_n, &[])),
            dot_chart(&title("Smallest normal force"), key, "force [N]", &curves(mesh, |p| p.min_normal_force_n, &[])),
        ]
    };
    let growth = branch.meshes.first().and_then(|mesh| {
        let title = "Largest Floquet multiplier: below 1 disturbances fade";
        dot_chart(title, key, "size", &curves(mesh, |p| p.largest_multiplier, &[]))
    });
    branch.meshes.iter().flat_map(of_mesh).chain([growth]).flatten().collect()
}

fn transmission_errors(mesh: &MeshOnBranch<'_>) -> Vec<Curve> {
    let in_time: Vec<(f64, f64)> = mesh.in_time.iter().map(|p| (p.value, p.peak_to_peak_dte_um)).collect();
    curves(mesh, |p| p.peak_to_peak_dte_um, &in_time)
}

/// Both parts of the branch as rows of dots, bifurcations, and motions in time.
fn curves(mesh: &MeshOnBranch<'_>, value: fn(&BranchPoint) -> f64, in_time: &[(f64, f64)]) -> Vec<Curve> {
    let part = |stable: bool, count: usize| -> Vec<(f64, f64)> {
        let own = mesh.points.windows(2).filter(|w| w[0].is_stable == stable);
        let between = |w: &[&BranchPoint], k: usize| {
            let share = k as f64 / count as f64;
            let of = |f: fn(&BranchPoint) -> f64| f(w[0]) + share * (f(w[1]) - f(w[0]));
            (of(|p| p.value), of(value))
        };
        own.flat_map(|w| (0..count).map(move |k| between(w, k))).collect()
    };
    let turns = |loss: LossName| {
        mesh.turns.iter().filter(|t| t.loss == loss).map(|t| (t.point.value, value(&t.point))).collect::<Vec<_>>()
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
