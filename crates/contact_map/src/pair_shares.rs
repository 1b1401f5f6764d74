//! Parts that pairs of teeth have of the force of a map. Theory (74a).

use serde::{Deserialize, Serialize};

use crate::{
    column::Node,
    load_axis::LoadCurve,
    map::ContactMap,
    spline::{Axis, Splines, periodic_coefficients},
};

/// Part of each pair of teeth in the force of a map.
///
/// ```text
/// s(u, tilt, F),   u = c - m: mesh cycles since pair m began its own;   sum over m of s(c - m) = 1
/// ```
/// Pairs are alike, so that one table over the way of a pair through the mesh serves all. It is periodic over so many
/// cycles as a pair needs for its way, and the splines of all pairs add up to 1 as the parts do.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairShares {
    /// Cycles of the way.
    pub(crate) count: usize,
    /// Number of the last pair that carries in the cycle from 0 to 1: its way begins there.
    pub(crate) last: i64,
    /// Coefficients over the way, tilts and loads.
    table: Vec<f64>,
}

/// Parts of a pair at a place of the map, over the load.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ShareCurves {
    /// Number of the pair, counted from the cycle of the place.
    pub pair: i64,
    /// Whether it carries at all at the place.
    pub carries: bool,
    pub value: LoadCurve,
    /// Slope over the phase, per unit of the spacing.
    pub by_phase: LoadCurve,
    /// First and second derivatives over tilt, per unit of the spacing.
    pub by_tilt: [LoadCurve; 2],
}

impl PairShares {
    /// Table of the parts at the nodes of a map: phase by phase, tilt by tilt, load by load; `interpolate` gives the
    /// coefficients over tilts and loads of a place of the way.
    pub(crate) fn new(columns: &[&Vec<Vec<Node>>], interpolate: impl Fn(Vec<f64>) -> Vec<f64>) -> Self {
        let numbers = || columns.iter().flat_map(|c| c.iter().flatten()).flat_map(|n| n.parts.iter().map(|p| p.0));
        let (first, last) = (numbers().min().unwrap_or(0), numbers().max().unwrap_or(0));
        let count = (last - first) as usize + 1;
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for pair in (first..=last).rev() {
            for nodes in columns {
                let part = |node: &Node| node.parts.iter().find(|p| p.0 == pair).map_or(0.0, |p| p.1);
                rows.push(interpolate(nodes.iter().flatten().map(part).collect()));
            }
        }
        Self { count, last, table: periodic_coefficients(&rows).concat() }
    }

    /// Splines over the way of a pair at a phase, 0 .. 1.
    fn way(&self, phases: usize, phase: f64, pair: i64) -> Splines {
        let place = (phase + (self.last - pair) as f64) * phases as f64;
        Axis::Periodic(phases * self.count).splines_at(place)
    }
}

/// Part of the force below which a pair carries nothing: splines ring before and after its way, ever less.
const NOTHING: f64 = 1e-13;

impl ShareCurves {
    /// Coefficients in an interval of the load's axis: of the part, of its slope over the phase, and of its first and
    /// second slopes over the tilt, 0 where the map has none.
    pub(crate) fn in_cell(&self, cell: usize) -> [[f64; 4]; 4] {
        [&self.value, &self.by_phase, &self.by_tilt[0], &self.by_tilt[1]].map(|curve| curve.in_cell(cell))
    }
}

impl ContactMap {
    /// Parts of all pairs at a phase (mesh cycles) and with the splines over the tilt there.
    pub(crate) fn shares_at(&self, curves: &mut Vec<ShareCurves>, phase: f64, tilt: &Splines) {
        let PairShares { count, last, table } = &self.pairs;
        curves.resize_with(*count, ShareCurves::default);
        for (own, pair) in curves.iter_mut().zip((0..*count as i64).map(|i| last - i)) {
            own.pair = pair;
            let way = self.pairs.way(self.phases, phase - phase.floor(), pair);
            let along = [&way, tilt];
            self.sum(&mut own.value, table, along, [&way.values, &tilt.values]);
            self.sum(&mut own.by_phase, table, along, [&way.slopes, &tilt.values]);
            own.carries = own.value.exceeds(NOTHING) || own.by_phase.exceeds(NOTHING);
            if self.tilts > 0 && own.carries {
                let [first, second] = &mut own.by_tilt;
                self.sum(first, table, along, [&way.values, &tilt.slopes]);
                self.sum(second, table, along, [&way.values, &tilt.curvatures]);
            }
        }
    }
}
