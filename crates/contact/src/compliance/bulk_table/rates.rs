//! Derivatives of the openings of rows under constant forces by motions of the rows over the flanks. Theory (77a).

use pulp::{Simd, WithSimd};

use super::{
    BulkTable, DIRECTIONS, Entries, RUN, RUNS, TablePoint,
    rows::{AT_ONCE, Group, Tile, group},
    whole::TilePoints,
};
use crate::lanes::{self, Four};

/// Rates of the weights of a row's points, along each direction.
pub(crate) type PointRate = [[[f64; RUN]; RUNS]; DIRECTIONS];

/// What of the openings is read as rows move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reading {
    /// At rows that move in the field of the held ones.
    Field,
    /// At the held rows, as the loads of the others move.
    Loads,
    /// Both, of rows that open along the directions that they are loaded along.
    Both,
}

/// Rows with their forces (N).
pub(crate) type Loaded<'a> = (&'a [TablePoint], &'a [f64]);

/// Memory for it, used again.
#[derive(Debug, Default)]
pub(crate) struct RateWork {
    held: Vec<Group>,
    moved: Vec<Group>,
    sums: Vec<PointRate>,
    arch: pulp::Arch,
}

impl BulkTable {
    /// Adds rates of openings (mm) to `out`, one list of rows for each of some motions. `rates`: of each motion the rates of
    /// the rows that move, row by row.
    ///
    /// ```text
    /// C f = sum_j a_i' T a_j f_j,   d(C f)_i = a_i'^. T sum_j a_j f_j + a_i' T sum_j a_j^. f_j
    /// ```
    /// T a_j is made once for all motions.
    pub(crate) fn add_rates(
        &self,
        (held, held_forces): Loaded<'_>,
        (moved, moved_forces): Loaded<'_>,
        rates: &[Vec<PointRate>],
        reading: Reading,
        work: &mut RateWork,
        out: &mut [Vec<f64>],
    ) {
        let RateWork { held: held_groups, moved: moved_groups, sums, arch } = work;
        group(held, held_groups);
        group(moved, moved_groups);
        sums.clear();
        for group in moved_groups.iter_mut() {
            group.along = [false; DIRECTIONS];
            for of_motion in rates {
                let mut sum = PointRate::default();
                for (rate, force) in of_motion[group.rows.clone()].iter().zip(&moved_forces[group.rows.clone()]) {
                    for (d, parts) in rate.iter().map(|of| of.as_flattened()).enumerate() {
                        group.along[d] |= parts.iter().any(|w| *w != 0.0);
                        sum[d].as_flattened_mut().iter_mut().zip(parts).for_each(|(s, w)| *s += force * w);
                    }
                }
                sums.push(sum);
            }
        }
        let (count, entries, arch) = (self.points() / DIRECTIONS, &self.entries, *arch);
        let groups = [&held_groups[..], &moved_groups[..]];
        lanes::run(arch, Moved { entries, count, held, held_forces, groups, rates, sums, reading, out });
    }
}

struct Moved<'a> {
    entries: &'a Entries,
    count: usize,
    held: &'a [TablePoint],
    held_forces: &'a [f64],
    /// Of the held rows and of those that move.
    groups: [&'a [Group]; 2],
    rates: &'a [Vec<PointRate>],
    /// Sums of rates times forces: of each group, motion by motion.
    sums: &'a [PointRate],
    reading: Reading,
    out: &'a mut [Vec<f64>],
}

/// Openings of the twelve points of a cell along each direction.
type Opened<S> = [[Four<S>; RUNS]; DIRECTIONS];

impl WithSimd for Moved<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let ([held_groups, moved_groups], sums) = (self.groups, self.sums);
        let motions = self.rates.len();
        for (number, moved) in moved_groups.iter().enumerate() {
            let sums = &sums[number * motions..(number + 1) * motions];
            let mut field: Opened<S> = [[Four::splat(simd, 0.0); RUNS]; DIRECTIONS];
            for held in held_groups {
                for start in held.rows.clone().step_by(AT_ONCE) {
                    let args = (held, moved, start, sums);
                    match held.rows.end - start {
                        1 => self.row::<S, 1>(simd, args, &mut field),
                        2 => self.row::<S, 2>(simd, args, &mut field),
                        3 => self.row::<S, 3>(simd, args, &mut field),
                        _ => self.row::<S, 4>(simd, args, &mut field),
                    }
                }
            }
            if self.reading != Reading::Loads {
                for (rates, out) in self.rates.iter().zip(self.out.iter_mut()) {
                    for i in moved.rows.clone() {
                        out[i] += product(simd, &rates[i], &field, moved.along);
                    }
                }
            }
        }
    }
}

impl Moved<'_> {
    /// What `K` held rows from number `start` on do at the points of a group that moves.
    #[inline(always)]
    fn row<S: Simd, const K: usize>(
        &mut self,
        simd: S,
        (held, moved, start, sums): (&Group, &Group, usize, &[PointRate]),
        field: &mut Opened<S>,
    ) {
        let Some(loads) = self.held[start..].first_chunk::<K>() else { return };
        let zero = Four::splat(simd, 0.0);
        let mut own = TilePoints::default();
        let mut opened: [Opened<S>; K] = [[[zero; RUNS]; DIRECTIONS]; K];
        for d in (0..DIRECTIONS).filter(|&d| held.along[d]) {
            let parts: [Four<S>; K] = std::array::from_fn(|k| Four::splat(simd, loads[k].parts[d]));
            for e in (0..DIRECTIONS).filter(|&e| moved.along[e]) {
                let tile = Tile::between(self.entries, self.count, [d, e], [held.runs, moved.runs], &mut own);
                let runs = tile.opened(simd, loads);
                for (k, (opened, part)) in opened.iter_mut().zip(parts).enumerate() {
                    for (sum, run) in opened[e].iter_mut().zip(&runs) {
                        *sum = part.mul_add(run[k], *sum);
                    }
                }
            }
        }
        for (k, opened) in opened.iter().enumerate() {
            let force = Four::splat(simd, self.held_forces[start + k]);
            for (sum, own) in field.as_flattened_mut().iter_mut().zip(opened.as_flattened()) {
                *sum = force.mul_add(*own, *sum);
            }
            if self.reading != Reading::Field {
                for (sum, out) in sums.iter().zip(self.out.iter_mut()) {
                    out[start + k] += product(simd, sum, opened, moved.along);
                }
            }
        }
    }
}

/// Sum over the directions of points times openings.
#[inline(always)]
fn product<S: Simd>(simd: S, rate: &PointRate, opened: &Opened<S>, along: [bool; DIRECTIONS]) -> f64 {
    let mut sum = Four::splat(simd, 0.0);
    for d in (0..DIRECTIONS).filter(|&d| along[d]) {
        for (weights, opened) in rate[d].iter().zip(&opened[d]) {
            sum = Four::new(simd, weights).mul_add(*opened, sum);
        }
    }
    sum.sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compliance::bulk_table::rows::tests::{places, table};

    /// Rates of openings are those of each row's own weights in the field of all loads, and of all loads at each row; with
    /// the same bits in plain instructions and the processor's own.
    #[test]
    fn rates_are_those_of_their_entries() {
        let table = table();
        let (held, moved) = (places(3), places(1));
        let n = held.len();
        let forces: Vec<f64> = (0..n).map(|i| 1.0 + 0.1 * i as f64).collect();
        let rate = |motion: usize, i: usize| -> PointRate {
            let weight = |d: usize, b: usize, a: usize| ((motion + i * 36 + d * 12 + b * 4 + a) as f64).sin();
            std::array::from_fn(|d| std::array::from_fn(|b| std::array::from_fn(|a| weight(d, b, a))))
        };
        let rates: Vec<Vec<PointRate>> = (0..2).map(|m| (0..n).map(|i| rate(m, i)).collect()).collect();
        let read = |arch: pulp::Arch, reading: Reading| {
            let mut out = vec![vec![0.0; n]; 2];
            let mut work = RateWork { arch, ..RateWork::default() };
            table.add_rates((&held, &forces), (&moved, &forces), &rates, reading, &mut work, &mut out);
            out
        };
        for reading in [Reading::Field, Reading::Loads, Reading::Both] {
            let found = read(pulp::Arch::new(), reading);
            assert_eq!(found, read(pulp::Arch::Scalar, reading), "other bits on another machine");
            for (motion, found) in found.iter().enumerate() {
                for (i, found) in found.iter().enumerate() {
                    let part = |j: usize, d: usize| {
                        let unit = |place: usize| TablePoint {
                            weights: rates[motion][place][d],
                            parts: std::array::from_fn(|k| f64::from(u8::from(k == d))),
                            ..moved[place]
                        };
                        let field = if reading == Reading::Loads { 0.0 } else { table.entry(&unit(i), &held[j]) };
                        let loads = if reading == Reading::Field { 0.0 } else { table.entry(&held[i], &unit(j)) };
                        forces[j] * (field + loads)
                    };
                    let wanted: f64 =
                        (0..n).flat_map(|j| (0..DIRECTIONS).map(move |d| (j, d))).map(|(j, d)| part(j, d)).sum();
                    assert!((found - wanted).abs() < 1e-10, "{reading:?}, row {i}: {found}, not {wanted}");
                }
            }
        }
    }
}
