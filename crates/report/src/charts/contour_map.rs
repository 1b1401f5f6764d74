//! A quantity over two others: known on a grid, as a map with lines of equal value, or at places here and there, as
//! coloured dots.

use std::ops::Range;

use super::{
    curves::figure,
    field_map::{FieldMap, Side},
    overlay::{LevelLine, Mark, Overlay, words},
    plot_data::embedded,
};

/// Cells of the map.
const CELLS: [usize; 2] = [60, 40];
/// Lines of equal value, about.
const LINES: f64 = 8.0;
/// Dots at most.
const DOTS: usize = 2000;
/// Room around dots, over their range.
const ROOM: f64 = 0.05;

/// What stands around a map.
#[derive(Debug, Clone, Copy)]
pub struct MapWords<'a> {
    /// Title of the map.
    pub title: &'a str,
    /// Quantities across and up, with their units.
    pub sides: [&'a str; 2],
    /// What the colours stand for.
    pub quantity: &'a str,
}

/// A quantity on a grid.
#[derive(Debug, Clone)]
pub struct GridValues {
    /// Places of the columns and of the rows, ascending, at least two of each.
    pub places: [Vec<f64>; 2],
    /// Row by row; NaN where it is not known.
    pub values: Vec<f64>,
}

impl GridValues {
    /// Between the nodes, bilinear: NaN where one of the four around is not known.
    fn at(&self, x: f64, y: f64) -> f64 {
        let [(i, s), (j, t)] = [(0, x), (1, y)].map(|(side, at)| share_of(&self.places[side], at));
        let columns = self.places[0].len();
        let node = |i: usize, j: usize| self.values.get(j * columns + i).copied().unwrap_or(f64::NAN);
        // A node that counts nothing need not be known.
        let between = |a: f64, b: f64, share: f64| match share {
            0.0 => a,
            1.0 => b,
            _ => a + share * (b - a),
        };
        between(between(node(i, j), node(i + 1, j), s), between(node(i, j + 1), node(i + 1, j + 1), s), t)
    }
}

/// The stretch in which a place lies, and the share of it that lies below.
fn share_of(places: &[f64], at: f64) -> (usize, f64) {
    let i = places.partition_point(|p| *p <= at).saturating_sub(1).min(places.len() - 2);
    (i, ((at - places[i]) / (places[i + 1] - places[i])).clamp(0.0, 1.0))
}

/// The map of a quantity on a grid with its least value marked; `None` where there is nothing to draw.
pub fn contour_map(says: MapWords<'_>, grid: &GridValues) -> Option<String> {
    let [least, largest] = range(grid.values.iter().copied())?;
    let ends = grid.places.each_ref().map(|p| p[0]..p[p.len() - 1]);
    let lattice = [0, 1].map(|side| {
        let Range { start, end } = ends[side].clone();
        let n = CELLS[side];
        (0..=n).map(|i| if i == n { end } else { start + (end - start) * i as f64 / n as f64 }).collect::<Vec<f64>>()
    });
    let values: Vec<f64> =
        lattice[1].iter().flat_map(|&y| lattice[0].iter().map(move |&x| (x, y))).map(|(x, y)| grid.at(x, y)).collect();
    let middle = |side: usize, i: usize| 0.5 * (lattice[side][i] + lattice[side][i + 1]);
    let cells = (0..CELLS[1]).flat_map(|j| (0..CELLS[0]).map(move |i| (i, j)));
    let shares = cells.map(|(i, j)| share(grid.at(middle(0, i), middle(1, j)), [least, largest])).collect();
    let line = |level: f64| LevelLine::new(level, &pieces([&lattice[0], &lattice[1]], &values, level));
    let best = (0..grid.values.len()).find(|&k| grid.values[k] == least)?;
    let columns = grid.places[0].len();
    let over = Overlay {
        lines: levels([least, largest]).into_iter().map(line).collect(),
        dots: Vec::new(),
        mark: Some(mark([grid.places[0][best % columns], grid.places[1][best / columns]], least)),
    };
    drawn(says, lattice, [least, largest], shares, over)
}

/// Dots at places, coloured by a quantity, the least of them marked; `None` where there is nothing to draw.
pub fn coloured_dots(says: MapWords<'_>, dots: &[[f64; 3]]) -> Option<String> {
    let known: Vec<[f64; 3]> = dots.iter().copied().filter(|dot| dot.iter().all(|v| v.is_finite())).collect();
    let [least, largest] = range(known.iter().map(|dot| dot[2]))?;
    let side = |k: usize| {
        let [low, high] = range(known.iter().map(|dot| dot[k]))?;
        let room = ROOM * (high - low);
        (high > low).then(|| vec![low - room, high + room])
    };
    let edges = [side(0)?, side(1)?];
    let best = known.iter().find(|dot| dot[2] == least)?;
    let mut over = Overlay { mark: Some(mark([best[0], best[1]], least)), ..Overlay::default() };
    for [x, y, value] in known.iter().step_by(known.len().div_ceil(DOTS)) {
        over.dot(*x, *y, share(*value, [least, largest]));
    }
    drawn(says, edges, [least, largest], vec![0.0], over)
}

fn mark(at: [f64; 2], least: f64) -> Mark {
    Mark { at, text: format!("least: {}", words(least)) }
}

fn drawn(
    says: MapWords<'_>,
    [across, up]: [Vec<f64>; 2],
    [least, largest]: [f64; 2],
    shares: Vec<f64>,
    over: Overlay,
) -> Option<String> {
    let MapWords { title, sides, quantity } = says;
    let map = FieldMap {
        title: title.to_owned(),
        sides: [Side { label: sides[0], edges: across }, Side { label: sides[1], edges: up }],
        quantity,
        least,
        largest,
        decades: None,
        beside: None,
        shares,
        over,
    };
    Some(figure(&map.picture()?, &[embedded("map", &map)]))
}

/// Least and largest finite value; `None` where they are the same.
fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let ends = |[low, high]: [f64; 2], v: f64| [low.min(v), high.max(v)];
    let [low, high] = values.filter(|v| v.is_finite()).fold([f64::INFINITY, f64::NEG_INFINITY], ends);
    (high > low).then_some([low, high])
}

/// Place on the scale, above 0; 0 where there is no value.
fn share(value: f64, [least, largest]: [f64; 2]) -> f64 {
    if value.is_finite() { ((value - least) / (largest - least)).clamp(f64::MIN_POSITIVE, 1.0) } else { 0.0 }
}

/// Round values between two others, about [`LINES`] of them.
fn levels([least, largest]: [f64; 2]) -> Vec<f64> {
    let wanted = (largest - least) / LINES;
    let decade = 10f64.powf(wanted.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|k| k * decade).into_iter().find(|s| *s >= wanted).unwrap_or(wanted);
    let (first, last) = ((least / step).ceil(), (largest / step).floor());
    (0..=(last - first).max(0.0) as usize).map(|i| (first + i as f64) * step).filter(|l| *l > least).collect()
}

/// Where a lattice, each cell two triangles on which values are linear, has a value; no piece beside a place without
/// one.
fn pieces([xs, ys]: [&[f64]; 2], values: &[f64], level: f64) -> Vec<[(f64, f64); 2]> {
    let node = |i: usize, j: usize| (xs[i], ys[j], values[j * xs.len() + i] - level);
    let mut all = Vec::new();
    for (i, j) in (0..ys.len() - 1).flat_map(|j| (0..xs.len() - 1).map(move |i| (i, j))) {
        for third in [(i + 1, j), (i, j + 1)] {
            let corners = [node(i, j), node(i + 1, j + 1), node(third.0, third.1)];
            if corners.iter().any(|c| !c.2.is_finite()) {
                continue;
            }
            let crossing = |(a, b): (usize, usize)| {
                let ((x, y, v), (u, w, z)) = (corners[a], corners[b]);
                // 0 counts as above, so that a line through a node is drawn once.
                ((v < 0.0) != (z < 0.0)).then(|| (x + v / (v - z) * (u - x), y + v / (v - z) * (w - y)))
            };
            let found: Vec<(f64, f64)> = [(0, 1), (1, 2), (2, 0)].into_iter().filter_map(crossing).collect();
            if let [a, b] = found[..] {
                all.push([a, b]);
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(of: impl Fn(f64, f64) -> f64) -> GridValues {
        let places = [vec![0.0, 1.0, 2.0, 4.0], vec![0.0, 10.0, 20.0]];
        let values = places[1].iter().flat_map(|&y| places[0].iter().map(move |&x| (x, y))).map(|(x, y)| of(x, y));
        GridValues { values: values.collect(), places }
    }

    #[test]
    fn lines_of_a_plane_are_straight_and_lie_where_it_has_their_value() {
        let xs = [0.0, 1.0, 2.0, 3.0];
        let ys = [0.0, 1.0, 2.0];
        let plane = |x: f64, y: f64| 2.0 * x - y;
        let values: Vec<f64> = ys.iter().flat_map(|&y| xs.map(|x| plane(x, y))).collect();
        let found = pieces([&xs, &ys], &values, 1.5);
        let off = found.iter().flatten().map(|&(x, y)| (plane(x, y) - 1.5).abs()).fold(0.0, f64::max);
        assert!(off < 1e-14, "off by {off}");
        // From (0.75, 0) to (1.75, 2).
        let length: f64 = found.iter().map(|[a, b]| (a.0 - b.0).hypot(a.1 - b.1)).sum();
        assert!((length - 5f64.sqrt()).abs() < 1e-12, "length {length}");
    }

    #[test]
    fn the_least_value_is_marked_and_what_is_not_known_stays_blank() {
        let says = MapWords { title: "t", sides: ["x_um", "y_nm"], quantity: "q" };
        let bowl = |x: f64, y: f64| {
            if x == 4.0 && y == 20.0 { f64::NAN } else { (x - 2.0).powi(2) + 0.01 * (y - 10.0).powi(2) + 0.25 }
        };
        let figure = contour_map(says, &grid(bowl)).unwrap();
        assert!(figure.contains(r#""mark":{"at":[2.0,10.0],"text":"least: 0.25"}"#), "{figure}");
        assert!(figure.contains("least: 0.25</text>") && figure.contains("<path d=\"M"), "{figure}");
        let unknown = grid(bowl);
        assert!(unknown.at(3.9, 19.0).is_nan() && unknown.at(1.0, 10.0) == bowl(1.0, 10.0));
        assert_eq!(unknown.at(4.0, 10.0), bowl(4.0, 10.0), "an unknown neighbour that counts nothing");
        assert!(contour_map(says, &grid(|_, _| 1.0)).is_none(), "a constant has no lines");
    }

    #[test]
    fn dots_have_the_colours_of_their_values() {
        let says = MapWords { title: "t", sides: ["x", "y"], quantity: "q" };
        let figure = coloured_dots(says, &[[0.0, 0.0, 1.0], [1.0, 2.0, 3.0], [0.5, 1.0, f64::NAN]]).unwrap();
        assert!(figure.contains(r#""dots":[[0,0,"#) && figure.contains("[1,2,1]]"), "{figure}");
        // Two dots and the mark.
        assert_eq!(figure.matches("<circle").count(), 3, "{figure}");
    }

    #[test]
    fn levels_are_round_numbers() {
        assert_eq!(levels([0.3, 4.2]), [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]);
        assert_eq!(["0.16", "1200", "12.3", "0"], [0.16, 1200.0, 12.34, 0.0].map(words));
    }
}
