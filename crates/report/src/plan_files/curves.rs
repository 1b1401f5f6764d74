//! An output over one axis.

use answer::label_of;
use cases::Axis;
use scene::plan::Plan;

use super::spread::{QUANTILES, Spread};
use crate::charts::{Curve, dot_chart, line_chart, words};
use plan::{Column, KnownCases};

/// Curves of a chart at the most; more of them are a cloud of dots.
const CURVES: usize = 12;

/// Each output over each axis.
///
/// Over an axis that is gone through (a Harris map over the torque): a curve for each combination of the others, or,
/// where others are drawn, quantiles of the samples. Else a dot a case.
pub(super) fn over_axes(plan: &Plan, known: &KnownCases, output: &Column) -> Vec<String> {
    let chart = |axis: usize| {
        let (x, y) = (&label_of(&known.axes[axis].name), &label_of(&output.name));
        let title = format!("{} over {}", plain(y), plain(x));
        let gone_through = matches!(&plan.cases.axes()[axis], Axis::Each(values) if values.len() > 1);
        match curves(plan, known, output, axis).filter(|_| gone_through) {
            Some(curves) => line_chart(&title, x, y, &curves, false),
            None => dot_chart(&title, x, y, &[Curve { label: String::new(), points: points(known, output, axis) }]),
        }
    };
    (0..known.axes.len()).filter_map(chart).collect()
}

/// A label without its unit, for a title.
pub(crate) fn plain(label: &str) -> &str {
    label.split(" [").next().unwrap_or_default()
}

fn points(known: &KnownCases, output: &Column, axis: usize) -> Vec<(f64, f64)> {
    known.axes[axis].values.iter().copied().zip(output.values.iter().copied()).collect()
}

/// Curves over an axis; none where they would be too many.
fn curves(plan: &Plan, known: &KnownCases, output: &Column, axis: usize) -> Option<Vec<Curve>> {
    let others = |drawn: bool| {
        let is = move |k: &usize| matches!(plan.cases.axes()[*k], Axis::Drawn(_)) == drawn;
        (0..known.axes.len()).filter(move |k| *k != axis && known.axes[*k].varies()).filter(is).collect::<Vec<_>>()
    };
    let (gone_through, drawn) = (others(false), others(true));
    if !drawn.is_empty() {
        return gone_through.is_empty().then(|| quantiles(known, output, axis));
    }
    // The last axis is the fastest: cases of one curve come in the order of the axis.
    let mut found: Vec<(Vec<u64>, Curve)> = Vec::new();
    for (case, point) in points(known, output, axis).into_iter().enumerate() {
        let key: Vec<u64> = gone_through.iter().map(|&k| known.axes[k].values[case].to_bits()).collect();
        let at = found.iter().position(|(known, _)| *known == key);
        let at = at.unwrap_or_else(|| {
            found.push((key, Curve { label: label(known, &gone_through, case), points: Vec::new() }));
            found.len() - 1
        });
        if found.len() > CURVES {
            return None;
        }
        found[at].1.points.push(point);
    }
    let mut curves: Vec<Curve> = found.into_iter().map(|(_, curve)| curve).collect();
    curves.iter_mut().for_each(|curve| curve.points.sort_by(|a, b| a.0.total_cmp(&b.0)));
    Some(curves)
}

/// Values of the other axes, which distinguish a curve: `tip relief 6 µm`.
fn label(known: &KnownCases, axes: &[usize], case: usize) -> String {
    let one = |&k: &usize| {
        let name = label_of(&known.axes[k].name);
        let name = name.rsplit(", ").next().unwrap_or_default();
        let unit = name.split_once(" [").map_or(String::new(), |(_, unit)| format!(" {}", unit.trim_end_matches(']')));
        format!("{} {}{unit}", plain(name), words(known.axes[k].values[case]))
    };
    axes.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// Quantiles of the samples at each value.
fn quantiles(known: &KnownCases, output: &Column, axis: usize) -> Vec<Curve> {
    let mut all = points(known, output, axis);
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let groups: Vec<(f64, Spread)> =
        all.chunk_by(|a, b| a.0 == b.0).map(|group| (group[0].0, Spread::of(group.iter().map(|p| p.1)))).collect();
    let names = ["10 % of samples", "median", "90 % of samples"];
    let curve = |(name, share): (&str, f64)| Curve {
        label: name.to_owned(),
        points: groups.iter().filter_map(|(at, spread)| Some((*at, spread.quantile(share)?))).collect(),
    };
    names.into_iter().zip(QUANTILES).map(curve).collect()
}
