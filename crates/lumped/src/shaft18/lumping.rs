//! One shaft after Prohl and Myklestad: masses at its stations, elasticity between them. Theory (50), (52).

use fem::{
    Condensation, FemError,
    beam::{BeamPiece, BeamTheory},
};
use nalgebra::{Cholesky, DMatrix};

use super::{Influence, Shaft, bending_influence, equivalent_torsional_stiffness};
use crate::LumpedError;

/// Coordinates of a point of the shaft: displacements and turns.
const AXES: usize = 6;
/// x and turn about y; y and turn about x, whose sign is that of a slope reversed.
const PLANES: [[(usize, f64); 2]; 2] = [[(0, 1.0), (4, 1.0)], [(1, 1.0), (3, -1.0)]];

/// Matrices of one shaft in its kept coordinates, units mm, rad, t, s, N.
#[derive(Debug, Clone, PartialEq)]
pub struct LumpedShaft {
    /// Stiffness of shaft and supports.
    pub stiffness: DMatrix<f64>,
    /// Mass.
    pub mass: DMatrix<f64>,
    /// Damping of the supports.
    pub damping: DMatrix<f64>,
    /// Forces by rates, per rad/s of the shaft about +z: gyroscopic, skew.
    pub gyroscopic: DMatrix<f64>,
    /// Displacements and turns of the stations (six each, in order) by the kept coordinates.
    pub stations: DMatrix<f64>,
    /// Forces by gravity along x, y, z: three columns, N per mm/s^2.
    pub gravity: DMatrix<f64>,
    /// Inertia about the axis at each station with its share of the shaft, t mm^2.
    pub polar_inertia: Vec<f64>,
    /// Station and coordinate (0 .. 5) of each kept coordinate.
    pub kept: Vec<(usize, usize)>,
}

/// A shaft cut at stations and supports.
struct Points {
    /// Positions, mm, ascending.
    at: Vec<f64>,
    stations: Vec<usize>,
    supports: Vec<usize>,
}

impl LumpedShaft {
    /// The shaft, bending with shear or without; `number` names it in complaints.
    ///
    /// Mass and polar inertia of each piece of shaft go to the stations on either side by the law of the lever, which
    /// keeps mass and centre of mass, with its rotary inertia in the same shares; what lies beyond the outermost
    /// stations turns with them rigidly. Coordinates that are not kept follow statically.
    ///
    /// # Errors
    /// [`LumpedError`] when data have no meaning, stations coincide, or what is left out could move freely.
    pub fn new(shaft: &Shaft, theory: BeamTheory, number: usize) -> Result<Self, LumpedError> {
        shaft.check()?;
        let pieces = shaft.pieces()?;
        let points = Points::new(shaft, number)?;
        let n = AXES * points.at.len();
        let mut stiffness = DMatrix::zeros(n, n);
        points.add_bending(&pieces, theory, &mut stiffness, number)?;
        for (axis, along) in [(2, true), (5, false)] {
            points.add_chain(&pieces, axis, along, &mut stiffness);
        }
        let mut damping = DMatrix::zeros(n, n);
        for (support, &point) in shaft.supports.iter().zip(&points.supports) {
            for axis in 0..AXES {
                stiffness[(AXES * point + axis, AXES * point + axis)] += support.stiffness[axis];
                damping[(AXES * point + axis, AXES * point + axis)] += support.damping[axis];
            }
        }
        let (mass, polar_inertia) = points.masses(shaft, &pieces);
        let mut gyroscopic = DMatrix::zeros(n, n);
        let mut weight = DMatrix::zeros(n, 3);
        for (&point, inertia) in points.stations.iter().zip(&polar_inertia) {
            let (x, y) = (AXES * point + 3, AXES * point + 4);
            gyroscopic[(x, y)] = *inertia;
            gyroscopic[(y, x)] = -inertia;
        }
        for axis in 0..3 {
            let uniform = DMatrix::from_fn(n, 1, |i, _| f64::from(u8::from(i % AXES == axis)));
            weight.set_column(axis, &(&mass * uniform).column(0));
        }
        let mut kept = Vec::new();
        for (i, station) in shaft.stations.iter().enumerate() {
            kept.extend((0..AXES).filter(|&axis| station.kept[axis]).map(|axis| (i, axis)));
        }
        let numbers: Vec<usize> = kept.iter().map(|&(i, axis)| AXES * points.stations[i] + axis).collect();
        let by = Condensation::new(&stiffness, &numbers).map_err(|e| match e {
            FemError::NotPositiveDefinite { .. } => LumpedError::Free { shaft: number },
            other => other.into(),
        })?;
        let rows = shaft.stations.len() * AXES;
        let stations =
            DMatrix::from_fn(rows, kept.len(), |i, j| by.map[(AXES * points.stations[i / AXES] + i % AXES, j)]);
        Ok(Self {
            stiffness: by.of(&stiffness),
            mass: by.of(&mass),
            damping: by.of(&damping),
            gyroscopic: by.of(&gyroscopic),
            stations,
            gravity: by.map.transpose() * weight,
            polar_inertia,
            kept,
        })
    }
}

impl Points {
    fn new(shaft: &Shaft, number: usize) -> Result<Self, LumpedError> {
        let near = shaft.coincidence();
        let mut at: Vec<f64> = shaft.stations.iter().map(|s| s.position).collect();
        at.extend(shaft.supports.iter().map(|s| s.position));
        at.sort_by(f64::total_cmp);
        at.dedup_by(|a, b| (*a - *b).abs() <= near);
        let find = |position: f64| {
            let off = |i: &usize| (at[*i] - position).abs();
            (0..at.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0)
        };
        let stations: Vec<usize> = shaft.stations.iter().map(|s| find(s.position)).collect();
        let supports = shaft.supports.iter().map(|s| find(s.position)).collect();
        if let Some(w) = (1..stations.len()).find(|&i| stations[..i].contains(&stations[i])) {
            return Err(LumpedError::SameStation { shaft: number, position_mm: shaft.stations[w].position });
        }
        if at.len() < 2 || stations.is_empty() {
            return Err(LumpedError::Free { shaft: number });
        }
        Ok(Self { at, stations, supports })
    }

    /// Stiffness of the free shaft in bending, from its flexibility pinned at the outermost points.
    ///
    /// ```text
    /// E = (u - T r)' A^-1 (u - T r) / 2      r: displacements of the two pins, T: what they do rigidly to all the others u
    /// ```
    fn add_bending(
        &self,
        pieces: &[BeamPiece],
        theory: BeamTheory,
        stiffness: &mut DMatrix<f64>,
        shaft: usize,
    ) -> Result<(), LumpedError> {
        let last = self.at.len() - 1;
        let pins = [self.at[0], self.at[last]];
        let span = pins[1] - pins[0];
        // Point, and whether displacement (0) or turn (1).
        let mut order: Vec<(usize, usize)> = (1..last).map(|i| (i, 0)).collect();
        order.extend((0..=last).map(|i| (i, 1)));
        let places: Vec<Influence> = order
            .iter()
            .map(|&(i, kind)| if kind == 0 { Influence::Shift(self.at[i]) } else { Influence::Turn(self.at[i]) })
            .collect();
        let a = bending_influence(pieces, pins, &places, theory);
        let inverse = Cholesky::new(a).ok_or(LumpedError::Free { shaft })?.inverse();
        let n = order.len();
        // u - T r as a matrix on (u, r).
        let mut strain = DMatrix::zeros(n, n + 2);
        for (row, &(i, kind)) in order.iter().enumerate() {
            strain[(row, row)] = 1.0;
            let share = (self.at[i] - pins[0]) / span;
            let rigid = if kind == 0 { [1.0 - share, share] } else { [-1.0 / span, 1.0 / span] };
            strain[(row, n)] = -rigid[0];
            strain[(row, n + 1)] = -rigid[1];
        }
        order.extend([(0, 0), (last, 0)]);
        let k = strain.transpose() * inverse * strain;
        for plane in PLANES {
            for (i, &(p, kind_p)) in order.iter().enumerate() {
                for (j, &(q, kind_q)) in order.iter().enumerate() {
                    let ((row, s), (column, t)) = (plane[kind_p], plane[kind_q]);
                    stiffness[(AXES * p + row, AXES * q + column)] += s * t * k[(i, j)];
                }
            }
        }
        Ok(())
    }

    /// Springs in a row between the points: twist, or stretch where `along`.
    fn add_chain(&self, pieces: &[BeamPiece], axis: usize, along: bool, stiffness: &mut DMatrix<f64>) {
        for i in 1..self.at.len() {
            let parts: Vec<(f64, f64)> = self
                .parts(pieces, i)
                .map(|(length, piece)| {
                    let s = &piece.section;
                    (length, if along { s.axial_stiffness() } else { s.torsional_stiffness() })
                })
                .collect();
            let k = equivalent_torsional_stiffness(&parts) / (self.at[i] - self.at[i - 1]);
            let (a, b) = (AXES * (i - 1) + axis, AXES * i + axis);
            stiffness[(a, a)] += k;
            stiffness[(b, b)] += k;
            stiffness[(a, b)] -= k;
            stiffness[(b, a)] -= k;
        }
    }

    /// Lengths of the pieces between points i - 1 and i.
    fn parts<'a>(&self, pieces: &'a [BeamPiece], i: usize) -> impl Iterator<Item = (f64, &'a BeamPiece)> {
        let (from, to) = (self.at[i - 1], self.at[i]);
        let mut start = 0.0;
        pieces.iter().filter_map(move |piece| {
            let (low, high) = (f64::max(start, from), f64::min(start + piece.length, to));
            start += piece.length;
            (high > low).then_some((high - low, piece))
        })
    }

    /// Mass matrix of all coordinates, and polar inertia at each station.
    fn masses(&self, shaft: &Shaft, pieces: &[BeamPiece]) -> (DMatrix<f64>, Vec<f64>) {
        let n = AXES * self.at.len();
        let mut mass = DMatrix::zeros(n, n);
        let mut polar: Vec<f64> = shaft.stations.iter().map(|s| s.polar_inertia).collect();
        // Rigid mass with its centre `offset` along the axis from station i.
        let mut add = |i: usize, m: f64, transverse: f64, offset: f64| {
            let at = AXES * self.stations[i];
            (0..3).for_each(|axis| mass[(at + axis, at + axis)] += m);
            for plane in PLANES {
                let [(shift, _), (turn, sign)] = plane;
                mass[(at + turn, at + turn)] += transverse + m * offset * offset;
                mass[(at + shift, at + turn)] += sign * m * offset;
                mass[(at + turn, at + shift)] += sign * m * offset;
            }
        };
        for (i, station) in shaft.stations.iter().enumerate() {
            add(i, station.mass, station.transverse_inertia, 0.0);
        }
        let mut order: Vec<usize> = (0..shaft.stations.len()).collect();
        order.sort_by(|&i, &j| shaft.stations[i].position.total_cmp(&shaft.stations[j].position));
        let place = |i: usize| shaft.stations[order[i]].position;
        let last = order.len() - 1;
        let mut start = 0.0;
        for (piece, given) in pieces.iter().zip(&shaft.segments) {
            let end = start + piece.length;
            if given.density > 0.0 {
                let (per_length, rotary) = (piece.section.mass_per_length(), piece.section.inertia_per_length());
                let mut cuts: Vec<f64> = (0..=last).map(place).filter(|&p| p > start && p < end).collect();
                cuts.extend([start, end]);
                cuts.sort_by(f64::total_cmp);
                for cut in cuts.windows(2) {
                    let (length, centre) = (cut[1] - cut[0], 0.5 * (cut[0] + cut[1]));
                    let (m, across, about) = (per_length * length, rotary * length, 2.0 * rotary * length);
                    let after = (0..=last).find(|&i| place(i) > centre);
                    let shares = match after {
                        Some(i) if i > 0 => {
                            let share = (centre - place(i - 1)) / (place(i) - place(i - 1));
                            [Some((i - 1, 1.0 - share, 0.0)), Some((i, share, 0.0))]
                        }
                        outermost => {
                            let i = outermost.unwrap_or(last);
                            [Some((i, 1.0, centre - place(i))), None]
                        }
                    };
                    for (i, share, offset) in shares.into_iter().flatten() {
                        // Beyond the stations the piece is a rigid rod about its own middle.
                        let rod = if offset == 0.0 { 0.0 } else { m * length * length / 12.0 };
                        add(order[i], share * m, share * across + rod, offset);
                        polar[order[i]] += share * about;
                    }
                }
            }
            start = end;
        }
        for (i, &inertia) in polar.iter().enumerate() {
            let at = AXES * self.stations[i] + 5;
            mass[(at, at)] += inertia;
        }
        (mass, polar)
    }
}
