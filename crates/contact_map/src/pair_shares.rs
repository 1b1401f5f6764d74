//! Shares of tooth pairs in the force of a map. Theory (74a).

use serde::{Deserialize, Serialize};

use crate::{
    column::Node,
    spline::{Axis, Splines, periodic_coefficients},
};

/// Share of each tooth pair in the force of a map.
///
/// ```text
/// s(u, tilt, F),   u = c - m: mesh cycles since pair m began its own;   sum over m of s(c - m) = 1
/// ```
/// Pairs are identical, so one table over a pair's passage through the mesh serves all. It is periodic over the number
/// of cycles of this passage, and the splines of all pairs add up to 1 as the shares do.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairShares {
    /// Cycles of the way.
    pub(crate) count: usize,
    /// Number of the last pair that carries in the cycle from 0 to 1: its way begins there.
    pub(crate) last: i64,
    /// Coefficients over the way, tilts and loads.
    table: Vec<f64>,
    /// Whether a pair carries at all between two places of the way.
    carries: Vec<bool>,
}

/// A pair at a place of the map: where it is on its way.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct PairPlace {
    /// Number of the pair, counted from the cycle of the place.
    pub pair: i64,
    way: Splines,
}

/// Parts of one pair or of several together in an interval of the load's axis: coefficients of the part, of its slope over
/// the phase, and of its first and second slopes over the tilt, per unit of the spacings.
pub(crate) type CellParts = [[f64; 4]; 4];

/// Part of the force below which a pair carries nothing: splines ring before and after its way, ever less.
const NOTHING: f64 = 1e-13;

impl PairShares {
    /// Table of what pairs have at the nodes of a map, by their place among those of a node: phase by phase, tilt by tilt,
    /// load by load; `interpolate` gives the coefficients over tilts and loads of a place of the way.
    pub(crate) fn new(
        columns: &[&Vec<Vec<Node>>],
        of: impl Fn(&Node, usize) -> f64,
        interpolate: impl Fn(Vec<f64>) -> Vec<f64>,
    ) -> Self {
        let numbers = || columns.iter().flat_map(|c| c.iter().flatten()).flat_map(|n| n.parts.iter().map(|p| p.0));
        let (first, last) = (numbers().min().unwrap_or(0), numbers().max().unwrap_or(0));
        let count = (last - first) as usize + 1;
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for pair in (first..=last).rev() {
            for nodes in columns {
                let part = |node: &Node| node.parts.iter().position(|p| p.0 == pair).map_or(0.0, |i| of(node, i));
                rows.push(interpolate(nodes.iter().flatten().map(part).collect()));
            }
        }
        let coefficients = periodic_coefficients(&rows);
        let any = |rows: &[Vec<f64>]| rows.iter().flatten().any(|k| k.abs() > NOTHING);
        Self { count, last, carries: coefficients.windows(4).map(any).collect(), table: coefficients.concat() }
    }

    /// Splines over the way of a pair at a phase, 0 .. 1.
    fn way(&self, phases: usize, phase: f64, pair: i64) -> Splines {
        let place = (phase + (self.last - pair) as f64) * phases as f64;
        Axis::Periodic(phases * self.count).splines_at(place)
    }

    /// Pairs that carry at a phase (mesh cycles) of a map of so many phases, in place of those before.
    pub(crate) fn places(&self, phases: usize, phase: f64, pairs: &mut Vec<PairPlace>) {
        pairs.clear();
        for pair in (0..self.count as i64).map(|i| self.last - i) {
            let way = self.way(phases, phase - phase.floor(), pair);
            if self.carries[way.first] {
                pairs.push(PairPlace { pair, way });
            }
        }
    }

    /// Parts of a pair in an interval of the load's axis, with the splines over the tilt and the numbers of coefficients
    /// over tilts and loads; slopes over the tilt where the map has one.
    pub(crate) fn parts(
        &self,
        own: &PairPlace,
        (tilt, cell): (&Splines, usize),
        [tilts, loads]: [usize; 2],
        wanted: PartsWanted,
    ) -> CellParts {
        let mut parts = CellParts::default();
        for j in 0..tilt.count {
            // Over the way: value, and slope where it is wanted.
            let [mut value, mut slope] = [[0.0; 4]; 2];
            for i in 0..4 {
                let at = ((own.way.first + i) * tilts + tilt.first + j) * loads + cell;
                let row = &self.table[at..at + 4];
                value.iter_mut().zip(row).for_each(|(sum, k)| *sum += own.way.values[i] * k);
                if wanted.phase {
                    slope.iter_mut().zip(row).for_each(|(sum, k)| *sum += own.way.slopes[i] * k);
                }
            }
            let mut add = |kind: usize, weight: f64, row: &[f64; 4]| {
                parts[kind].iter_mut().zip(row).for_each(|(sum, k)| *sum += weight * k);
            };
            add(0, tilt.values[j], &value);
            if wanted.phase {
                add(1, tilt.values[j], &slope);
            }
            if wanted.tilt && tilt.count > 1 {
                add(2, tilt.slopes[j], &value);
                add(3, tilt.curvatures[j], &value);
            }
        }
        parts
    }
}

/// Which slopes of parts are wanted.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PartsWanted {
    pub phase: bool,
    pub tilt: bool,
}
