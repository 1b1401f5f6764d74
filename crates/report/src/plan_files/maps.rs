//! An output over two axes: contours where both are gone through, coloured dots where both are drawn.

use answer::label_of;
use cases::Axis;
use scene::plan::Plan;

use super::curves::plain;
use crate::charts::{GridValues, MapWords, coloured_dots, contour_map};
use plan::{Column, KnownCases};

/// Axes of either kind that are mapped against each other, the first ones.
const AXES: usize = 4;

/// Maps of an output over every two axes, its least value marked.
///
/// Over two axes that are gone through all others are as in the case with the least value: the map is a section through
/// the optimum.
pub(super) fn maps(plan: &Plan, known: &KnownCases, output: &Column) -> Vec<String> {
    let Some(&best) = output.ascending().first() else { return Vec::new() };
    let of_kind = |drawn: bool| -> Vec<usize> {
        let is = |k: &usize| matches!(plan.cases.axes()[*k], Axis::Drawn(_)) == drawn && known.axes[*k].varies();
        (0..known.axes.len()).filter(is).take(AXES).collect()
    };
    let (grid, drawn) = (of_kind(false), of_kind(true));
    let contours = pairs(&grid).into_iter().filter_map(|pair| section(known, output, pair, best));
    contours.chain(pairs(&drawn).into_iter().filter_map(|pair| scatter(known, output, pair))).collect()
}

/// Every two of some axes.
fn pairs(axes: &[usize]) -> Vec<[usize; 2]> {
    axes.iter().enumerate().flat_map(|(i, &a)| axes[i + 1..].iter().map(move |&b| [a, b])).collect()
}

fn section(known: &KnownCases, output: &Column, [a, b]: [usize; 2], best: usize) -> Option<String> {
    let places = [a, b].map(|axis| known.axes[axis].distinct());
    let others: Vec<usize> = (0..known.axes.len()).filter(|k| *k != a && *k != b).collect();
    let in_it = |case: usize| others.iter().all(|&k| known.axes[k].values[case] == known.axes[k].values[best]);
    let mut values = vec![f64::NAN; places[0].len() * places[1].len()];
    for case in (0..known.count()).filter(|&case| in_it(case)) {
        let [i, j] = [(0, a), (1, b)].map(|(side, axis)| {
            let at = known.axes[axis].values[case];
            places[side].partition_point(|p| *p < at)
        });
        values[j * places[0].len() + i] = output.values[case];
    }
    let fixed = others.iter().filter(|&&k| known.axes[k].varies()).map(|&k| label_of(&known.axes[k].name));
    let fixed: Vec<String> = fixed.map(|label| plain(&label).to_owned()).collect();
    let rest = if fixed.is_empty() { String::new() } else { format!(" ({} as where it is least)", fixed.join(", ")) };
    let (sides, quantity) = labels(known, output, [a, b]);
    let title = format!("{}{rest}", plain(&quantity));
    contour_map(says(&sides, &quantity, &title), &GridValues { places, values })
}

fn scatter(known: &KnownCases, output: &Column, [a, b]: [usize; 2]) -> Option<String> {
    let dots: Vec<[f64; 3]> = (0..known.count())
        .map(|case| [known.axes[a].values[case], known.axes[b].values[case], output.values[case]])
        .collect();
    let (sides, quantity) = labels(known, output, [a, b]);
    coloured_dots(says(&sides, &quantity, plain(&quantity)), &dots)
}

/// Two axes and an output in words.
fn labels(known: &KnownCases, output: &Column, pair: [usize; 2]) -> ([String; 2], String) {
    (pair.map(|axis| label_of(&known.axes[axis].name)), label_of(&output.name))
}

fn says<'a>([x, y]: &'a [String; 2], quantity: &'a str, title: &'a str) -> MapWords<'a> {
    MapWords { title, sides: [x, y], quantity }
}
