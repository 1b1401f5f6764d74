//! Bolts at places of a cyclic gear, beside what holds all its teeth alike: Woodbury's formula. Theory (13g).

use std::collections::{BTreeMap, BTreeSet};

use faer::{Mat, MatRef, linalg::solvers::Solve};
use fem::{ElementOptions, Material, Wanted, dense};
use mesh::{Bolts, MeshedGear};

use super::{
    CyclicGear, PitchTurn, SectorLoads, SectorMesh,
    between::{Spot, by_copy},
    placement::{Placed, placed, placed_among},
    seat::turned,
    sector::UnderForces,
};
use crate::{
    ReductionError,
    bolt_shares::{BoltShares, springs},
    load::Load,
    turned_rows::turn_rows,
};

/// Freedoms under bolts up to which their matrices are dense: 2,000 take 32 MB and some seconds.
const MOST_ROWS: usize = 2000;

/// Pitches that are round-off of an angle.
const SAME_PLACE: f64 = 1e-9;

/// A cyclic gear on bolts.
///
/// ```text
/// lambda = -K_b (U lambda + U_f' f + G q),   G' lambda + R_f' f = 0        lambda: forces of the bolts on the m freedoms under them
/// [lambda; q] = -S [U_f R_f]' f,   S = [1 + K_b U, K_b G; G', 0]^-1 diag(K_b, 1)
/// C' = C - [U_f R_f] S [U_f R_f]'
/// ```
/// Displacements by one load are taken from one solution, those of bolts and flanks alike, though U_f' is known from U_f as well:
/// what the means of the bore miss of a rigid motion, 1e-9 of a ring, is then a part of q and of no result.
///
/// | name | shape | unit | meaning |
/// |---|---|---|---|
/// | K_b | m x m | N/mm | springs of the bolts that do not open |
/// | U, U_f | m x m, 3n x m | mm/N | displacement of these freedoms, of a window, by forces on them, without bolts |
/// | q | 6 | mm | motion of a gear that nothing else holds as a rigid body, against the means of its bore; else none |
/// | G, R_f | m x 6, 3n x 6 | 1 | what q moves |
///
/// Source: Woodbury, Inverting modified matrices, 1950.
#[derive(Debug)]
pub(crate) struct BoltedGear {
    pub(super) cyclic: CyclicGear,
    bolts: Bolts,
    /// Loads of the sector that windows are made of.
    loads: Vec<Load>,
    pub(super) under: UnderForces,
    /// Copy of the sector of each freedom under the bolts, and its column of `under`.
    pub(super) rows: Vec<(u32, usize)>,
    /// S, and [U G].
    pub(super) held: Mat<f64>,
    pub(super) moved: Mat<f64>,
    pub(super) shares: BoltShares,
}

impl BoltedGear {
    /// Condenses one sector of a whole gear without its bolts, and puts these beside it; `loads` are those of a window, on single
    /// nodes if `keep`.
    ///
    /// `None` for a gear without bolts, or that is not cyclic without them, and for more bolts than fit into memory.
    ///
    /// # Errors
    /// [`ReductionError::Bore`] for bolts that the bore does not have; those of the sector.
    pub(crate) fn new(
        gear: &MeshedGear,
        (material, elements): (&Material, &ElementOptions),
        loads: &[Load],
        keep: bool,
        wanted: Wanted<'_>,
    ) -> Result<Option<Self>, ReductionError> {
        let Some((base, bolts)) = gear.bore_coupling().beside_bolts() else { return Ok(None) };
        let base = gear.clone().coupled(base);
        let part = PitchTurn::of_gear(&base).and_then(|turn| SectorMesh::of_whole(&base, &turn));
        let Some(part) = part else { return Ok(None) };
        drop(base);
        let pitch = part.way * (std::f64::consts::TAU / f64::from(part.teeth));
        let faces = part.bore.as_ref().map_or(part.seat.as_deref(), |bore| Some(bore.faces())).unwrap_or_default();
        let points = bolts.points(&part.mesh, faces, (part.teeth, pitch)).map_err(ReductionError::bore)?;
        let nodes: BTreeSet<(u32, u32)> =
            points.iter().flat_map(|p| p.spring.face.nodes().iter().map(|&node| (p.copy, node))).collect();
        if 3 * nodes.len() > MOST_ROWS {
            return Ok(None);
        }
        let Some(Placed { own, .. }) = placed(&part, loads) else { return Ok(None) };
        let Some(cyclic) = CyclicGear::new(part, material, elements, loads, (keep, None), wanted)? else {
            return Ok(None);
        };
        let columns: BTreeSet<u32> = nodes.iter().map(|node| node.1).collect();
        let mut forces = Mat::<f64>::zeros(cyclic.sector.dofs.free_count(), 3 * columns.len());
        for (i, &node) in columns.iter().enumerate() {
            for axis in 0..3 {
                let Some(row) = cyclic.sector.dofs.dof(node, axis) else { return Ok(None) };
                forces[(row, 3 * i + axis)] = 1.0;
            }
        }
        let under = cyclic.sector.under_forces(forces.as_ref())?;
        let columns: BTreeMap<u32, usize> = columns.into_iter().zip((0..).step_by(3)).collect();
        let row = |&(copy, node): &(u32, u32)| (0..3).map(move |axis| (copy, node, axis));
        let rows: Vec<(u32, usize)> = nodes
            .iter()
            .flat_map(row)
            .filter_map(|(copy, node, axis)| Some((copy, columns.get(&node)? + axis)))
            .collect();
        let numbers: BTreeMap<(u32, u32), usize> = nodes.into_iter().zip((0..).step_by(3)).collect();
        let of_node = |copy: u32, node: u32| numbers.get(&(copy, node)).copied();
        let shares = BoltShares::new((&bolts, &points), (rows.len(), &of_node), gear.numbering_sign());
        let stiffness = springs(&points, rows.len(), &of_node);
        let mut own = Self { cyclic, bolts, loads: own, under, rows, held: Mat::new(), moved: Mat::new(), shares };
        (own.held, own.moved) = own.joined(&stiffness);
        Ok(Some(own))
    }

    /// S and [U G].
    fn joined(&self, stiffness: &Mat<f64>) -> (Mat<f64>, Mat<f64>) {
        let (m, six) = (self.rows.len(), self.under.resultants.nrows());
        let copies: BTreeSet<u32> = self.rows.iter().map(|row| row.0).collect();
        let apart = |to: u32, from: u32| self.cyclic.apart(from, to);
        let distances = copies.iter().flat_map(|&to| copies.iter().map(move |&from| apart(to, from)));
        let block = |(d, ends): (u32, Mat<f64>)| {
            let through = dense::product(self.under.ends.transpose(), ends.as_ref());
            (d, if d == 0 { through + &self.under.own } else { through })
        };
        let loads = self.forces(Mat::<f64>::identity(self.under.own.ncols(), self.under.own.ncols()).as_ref());
        let blocks: BTreeMap<u32, Mat<f64>> =
            self.cyclic.ends_under(&loads, distances).into_iter().map(block).collect();
        let opening = |i: usize, j: usize| {
            let ((to, row), (from, column)) = (self.rows[i], self.rows[j]);
            blocks.get(&apart(to, from)).map_or(0.0, |block| block[(row, column)])
        };
        let turned_on = |&copy: &u32| (copy, turned(self.under.resultants.as_ref(), self.cyclic.angle(copy)));
        let motions: BTreeMap<u32, Mat<f64>> = copies.iter().filter(|_| six > 0).map(turned_on).collect();
        let motion = |i: usize, k: usize| motions.get(&self.rows[i].0).map_or(0.0, |own| own[(k, self.rows[i].1)]);
        let moved = Mat::from_fn(m, m + six, |i, j| match j.checked_sub(m) {
            None => opening(i, j),
            Some(k) => motion(i, k),
        });
        let mut system = Mat::<f64>::identity(m + six, m + six);
        let mut right = Mat::<f64>::identity(m + six, m + six);
        right.as_mut().submatrix_mut(0, 0, m, m).copy_from(stiffness);
        let mut above = system.as_mut().subrows_mut(0, m);
        above += dense::product(stiffness.as_ref(), moved.as_ref());
        let mut below = system.as_mut().subrows_mut(m, six);
        below.fill(0.0);
        for (i, k) in (0..m).flat_map(|i| (0..six).map(move |k| (i, k))) {
            below[(k, i)] = moved[(i, m + k)];
        }
        (system.partial_piv_lu().solve(&right), moved)
    }

    /// Forces on the columns of `under` (q x k, N) as loads on one sector.
    pub(super) fn forces(&self, forces: MatRef<'_, f64>) -> SectorLoads {
        SectorLoads {
            ends: dense::product(self.under.ends.as_ref(), forces),
            resultants: dense::product(self.under.resultants.as_ref(), forces),
        }
    }

    /// Coordinates of a window with these loads on nodes of the whole gear, in the gear's own frame.
    pub(super) fn spots(&self, loads: &[Load]) -> Result<Vec<Spot>, ReductionError> {
        let places = placed_among(&self.cyclic.part, loads, &self.loads).ok_or(ReductionError::OtherGear)?;
        let spot = |(copy, load)| Spot { copy, load, angle: self.cyclic.angle(copy) };
        Ok(places.into_iter().map(spot).collect())
    }

    /// [U_f R_f] of a window, 3n x (m + 6).
    pub(super) fn seen_by(&self, spots: &[Spot]) -> Mat<f64> {
        let (m, six) = (self.rows.len(), self.under.resultants.nrows());
        let (windows, cyclic) = (by_copy(spots), &self.cyclic);
        let copies: BTreeSet<u32> = self.rows.iter().map(|row| row.0).collect();
        let distances = windows.iter().flat_map(|to| copies.iter().map(move |&from| cyclic.apart(from, to.copy)));
        let loads = self.forces(Mat::<f64>::identity(self.under.own.ncols(), self.under.own.ncols()).as_ref());
        let ends = cyclic.ends_under(&loads, distances);
        let mut seen = Mat::<f64>::zeros(3 * spots.len(), m + six);
        for to in &windows {
            let mut put = |block: &Mat<f64>, column: &dyn Fn(usize) -> Option<usize>| {
                let mut block = block.clone();
                turn_rows(&mut block, to.angle);
                for (j, at) in (0..m + six).filter_map(|j| Some((j, column(j)?))) {
                    for &(i, load) in &to.nodes {
                        (0..3).for_each(|k| seen[(3 * i + k, j)] = block[(3 * load + k, at)]);
                    }
                }
            };
            for &from in &copies {
                let d = cyclic.apart(from, to.copy);
                let Some(ends) = ends.get(&d) else { continue };
                let mut block = dense::product(cyclic.sector.transfer.transpose(), ends.as_ref());
                if d == 0 {
                    block += &self.under.on_loads;
                }
                put(&block, &|j| self.rows.get(j).filter(|row| row.0 == from).map(|row| row.1));
            }
            if let Some(seat) = &cyclic.seat {
                let motions = turned(seat.of_loads.as_ref(), cyclic.angle(to.copy)).transpose().to_owned();
                put(&motions, &|j| j.checked_sub(m));
            }
        }
        seen
    }

    /// C of a window with these loads on nodes of the whole gear, in the gear's own frame, mm/N.
    ///
    /// # Errors
    /// [`ReductionError::OtherGear`] for loads that are not those of the first window, turned.
    pub(crate) fn compliance(&self, loads: &[Load]) -> Result<Mat<f64>, ReductionError> {
        let found = self.between(loads, (self, loads))?;
        Ok(Mat::from_fn(found.nrows(), found.ncols(), |i, j| 0.5 * (found[(i, j)] + found[(j, i)])))
    }

    /// Displacements (mm) of a window under unit forces (N) on another one, of this gear or of another reduction of it, whose teeth
    /// may be counted from another one on: its bolts then stand as many pitches back. 3n x 3m, each window in its own frame.
    ///
    /// # Errors
    /// [`ReductionError::OtherReduction`], [`ReductionError::OtherGear`].
    pub(crate) fn between(
        &self,
        loads: &[Load],
        (other, theirs): (&Self, &[Load]),
    ) -> Result<Mat<f64>, ReductionError> {
        let on = self.pitches_on(other).ok_or(ReductionError::OtherReduction)?;
        let z = self.cyclic.part.teeth;
        let own = self.spots(loads)?;
        let theirs = other.spots(theirs)?;
        let placed: Vec<Spot> = theirs.iter().map(|spot| Spot { copy: (spot.copy + on) % z, ..*spot }).collect();
        let free = self.cyclic.between_spots(&other.cyclic, [&own, &placed])?;
        let carried = dense::product(other.held.as_ref(), other.moved_by(&theirs).as_ref());
        let m = self.rows.len();
        let mut here = carried.clone();
        for (i, &(copy, row)) in other.rows.iter().enumerate() {
            let at = self.rows.binary_search(&((copy + on) % z, row)).map_err(|_| ReductionError::OtherReduction)?;
            here.row_mut(at).copy_from(carried.row(i));
        }
        if self.cyclic.seat.is_some() {
            let motion = carried.subrows(m, carried.nrows() - m);
            here.as_mut().subrows_mut(m, carried.nrows() - m).copy_from(turned(motion, self.cyclic.angle(on)));
        }
        Ok(free - dense::product(self.seen_by(&own).as_ref(), here.as_ref()))
    }

    /// Pitches by which tooth 0 of another reduction of the same gear on bolts stands on from that of this one; `None` where it is
    /// no such reduction.
    fn pitches_on(&self, other: &Self) -> Option<u32> {
        let (z, pitch) = (self.cyclic.part.teeth, self.cyclic.angle(1));
        let on = (self.bolts.first_angle - other.bolts.first_angle) / pitch;
        let alike = self.bolts == Bolts { first_angle: self.bolts.first_angle, ..other.bolts };
        let same = alike && (on - on.round()).abs() < SAME_PLACE && self.rows.len() == other.rows.len();
        same.then(|| (on.round() as i64).rem_euclid(i64::from(z)) as u32)
    }

    /// [U_f R_f]' of a window, (m + 6) x 3n.
    pub(super) fn moved_by(&self, spots: &[Spot]) -> Mat<f64> {
        let unit = Mat::<f64>::identity(self.cyclic.sector.loads(), self.cyclic.sector.loads());
        let count = self.held.nrows();
        let mut moved = Mat::<f64>::zeros(count, 3 * spots.len());
        for from in by_copy(spots) {
            let mut of_loads = self.under_loads(from.copy, unit.as_ref()).transpose().to_owned();
            turn_rows(&mut of_loads, from.angle);
            for &(i, load) in &from.nodes {
                for (k, row) in (0..3).flat_map(|k| (0..count).map(move |row| (k, row))) {
                    moved[(row, 3 * i + k)] = of_loads[(3 * load + k, row)];
                }
            }
        }
        moved
    }

    /// Displacements of the freedoms under bolts (mm) and resultants of forces (3m x k, N) on the loads of one copy in its frame.
    pub(super) fn under_loads(&self, copy: u32, forces: MatRef<'_, f64>) -> Mat<f64> {
        let (m, k, cyclic) = (self.rows.len(), forces.ncols(), &self.cyclic);
        let copies: BTreeSet<u32> = self.rows.iter().map(|row| row.0).collect();
        let ends = cyclic.ends_about(forces, copies.iter().map(|&to| cyclic.apart(copy, to)));
        let mut all = Mat::<f64>::zeros(self.held.nrows(), k);
        for &to in &copies {
            let d = cyclic.apart(copy, to);
            let Some(ends) = ends.get(&d) else { continue };
            let mut moved = dense::product(self.under.ends.transpose(), ends.as_ref());
            if d == 0 {
                moved += dense::product(self.under.on_loads.transpose(), forces);
            }
            for (i, &(_, row)) in self.rows.iter().enumerate().filter(|(_, own)| own.0 == to) {
                (0..k).for_each(|j| all[(i, j)] = moved[(row, j)]);
            }
        }
        if let Some(seat) = &cyclic.seat {
            let resultants = dense::product(seat.of_loads.as_ref(), forces);
            all.as_mut().subrows_mut(m, 6).copy_from(turned(resultants.as_ref(), cyclic.angle(copy)));
        }
        all
    }

    /// Free degrees of freedom of the whole gear.
    pub(crate) fn free_count(&self) -> usize {
        self.cyclic.free_count()
    }
}
