//! One sector, condensed to its cuts and its loads.

use faer::{Mat, MatMut, MatRef};
use fem::{BoundaryLastFactor, DofMap, ElementOptions, Material, Wanted, dense, unless_unwanted};
use mesh::Mesh;

use super::{
    SectorMesh,
    chain::{RowSeat, stacked},
    seat::{SIX, SectorSeat},
};
use crate::{ReductionError, elastic_bore::ElasticBore, load::Load};

/// Columns of full length that are held at a time: 256 of 10^5 freedoms are 200 MB.
const COLUMNS: usize = 256;

/// A sector as its cuts and its loads see it.
///
/// ```text
/// u_I = X f + T u_c,   X = K_II^-1 P,   T = -K_II^-1 K_Ic
/// ends: K_c u_c = ends of others + H f,   H = T' P,   displacement under the loads: P' u = A f + H' u_c,   A = P' X
/// ```
/// | name | shape   | unit | meaning                                                                     |
/// |------|---------|------|-----------------------------------------------------------------------------|
/// | P    | n x 3m  | 1    | m unit loads, three directions each                                         |
/// | u_c  | 2c      | mm   | left cut in the sector's frame, right cut in the next sector's (same place)  |
/// | K_c  | 2c x 2c | N/mm | stiffness between the cuts, loads free                                      |
/// | H    | 2c x 3m | 1    | force on the held cuts for a unit load, taken as a load on them             |
/// | A    | 3m x 3m | mm/N | displacement under the loads with the cuts held                             |
///
/// Of a bore that is held by its means, six loads g on every sector (the seat) follow both cuts among the ends, in the sector's
/// frame: H and T have six rows and columns more.
///
/// Loads on single nodes (`kept`) stand beside the cuts at the end of the factor, so that everything is read off its
/// last triangle. Source: static condensation, Guyan, AIAA J. 3(2), 1965; the flexibility form of it.
#[derive(Debug)]
pub(super) struct Sector {
    mesh: Mesh,
    pub(super) dofs: DofMap,
    factor: BoundaryLastFactor,
    /// L' of the sparse loads, by matrix row; empty when nodes are kept.
    spread: Vec<Load>,
    /// Freedoms of the nodes that are kept.
    kept: usize,
    /// Freedoms of one cut.
    pub(super) cut: usize,
    turn: [f64; 2],
    pub(super) stiffness: Mat<f64>,
    pub(super) transfer: Mat<f64>,
    pub(super) own: Mat<f64>,
    seat: Option<SeatedSector>,
}

/// The seat of a sector, and what it does.
#[derive(Debug)]
pub(super) struct SeatedSector {
    pub seat: SectorSeat,
    /// Displacement of all freedoms by unit g, loads on kept nodes and cuts held, n x 6.
    field: Mat<f64>,
    /// What it does to the cuts, and to itself.
    pub row: RowSeat,
}

/// What forces on all freedoms do, columns of them: q.
#[derive(Debug)]
pub(super) struct UnderForces {
    /// Displacement of all freedoms with kept nodes and cuts held, n x q.
    field: Mat<f64>,
    /// Forces on both cuts, loads free, and displacement along the seat, 2c (+ 6) x q.
    pub ends: Mat<f64>,
    /// Work on themselves with the cuts held, q x q.
    pub own: Mat<f64>,
    /// Displacement under the loads with the cuts held, 3m x q.
    pub on_loads: Mat<f64>,
    /// Resultants R'f, 6 x q, of a sector with a seat.
    pub resultants: Mat<f64>,
}

impl UnderForces {
    /// Displacement of all freedoms with kept nodes and cuts held, n x q.
    pub(super) fn field(&self) -> MatRef<'_, f64> {
        self.field.as_ref()
    }
}

impl Sector {
    /// Factors a sector under loads on nodes of its inside; each load on one node makes that node a kept one. A factor
    /// that is `known` is not made again.
    pub(super) fn new(
        part: &SectorMesh,
        material: &Material,
        elements: &ElementOptions,
        loads: &[Load],
        (keep, known): (bool, Option<BoundaryLastFactor>),
        wanted: Wanted<'_>,
    ) -> Result<Self, ReductionError> {
        let dofs = DofMap::new(part.mesh.nodes.len(), &part.held);
        let rows = |nodes: &mut dyn Iterator<Item = u32>| -> Vec<usize> {
            nodes.flat_map(|n| (0..3).map(move |axis| (n, axis))).filter_map(|(n, axis)| dofs.dof(n, axis)).collect()
        };
        let free: Vec<[u32; 2]> = part.cuts.iter().filter(|c| dofs.position(c[0]).is_some()).copied().collect();
        let mut boundary = Vec::new();
        if keep {
            boundary = rows(&mut loads.iter().flatten().map(|&(n, _)| n));
        }
        let kept = boundary.len();
        let left = rows(&mut free.iter().map(|c| c[0]));
        let seat = SectorSeat::new(part, &dofs, (&left, material.young_mpa()))?;
        boundary.extend_from_slice(&left);
        boundary.extend(rows(&mut free.iter().map(|c| c[1])));
        let cut = 3 * free.len();
        let fits = |known: &BoundaryLastFactor| known.n() == dofs.free_count() && known.boundary() == boundary;
        let factor = match known.filter(fits) {
            Some(known) => known,
            None => {
                let bore = part.bore.as_ref();
                let mut stiffness = ElasticBore::stiffness(bore, &part.mesh, (material, elements), &dofs)?;
                // A free sector has no factor.
                for (seat, spring) in seat.iter().flat_map(|seat| seat.springs.map(|spring| (seat, spring))) {
                    stiffness.add(left[spring], left[spring], seat.stiffness)?;
                }
                BoundaryLastFactor::in_place_of(stiffness, &boundary, wanted)?
            }
        };
        let spread = if keep { Vec::new() } else { loads.to_vec() };
        let (sin, cos) = (part.way * (std::f64::consts::TAU / f64::from(part.teeth))).sin_cos();
        let mut sector = Self {
            mesh: part.mesh.clone(),
            dofs,
            factor,
            spread,
            kept,
            cut,
            turn: [sin, cos],
            stiffness: Mat::new(),
            transfer: Mat::new(),
            own: Mat::new(),
            seat: None,
        };
        sector.condense(keep, seat.as_ref(), wanted)?;
        if let Some(seat) = seat {
            let UnderForces { field, ends, own, on_loads, .. } = sector.under_forces(seat.forces.as_ref())?;
            let row = RowSeat { ends, own, pitch: seat.pitch };
            sector.transfer = stacked(sector.transfer.as_ref(), on_loads.transpose());
            sector.seat = Some(SeatedSector { seat, field, row });
        }
        Ok(sector)
    }

    /// K_c, H and A.
    fn condense(&mut self, keep: bool, seat: Option<&SectorSeat>, wanted: Wanted<'_>) -> Result<(), ReductionError> {
        let (kept, ends) = (self.kept, 2 * self.cut);
        let l = self.factor.boundary_factor();
        let mut stiffness = dense::times_transpose(l.get(kept.., kept..));
        for (seat, spring) in seat.iter().flat_map(|seat| seat.springs.map(|spring| (seat, spring))) {
            stiffness[(spring, spring)] -= seat.stiffness;
        }
        self.next_frame(stiffness.as_mut());
        stiffness = stiffness.transpose().to_owned();
        self.next_frame(stiffness.as_mut());
        self.stiffness = stiffness;
        unless_unwanted(wanted)?;
        if keep {
            // K = L L' with the kept nodes before the cuts: A = (L_FF L_FF')^-1, H = -L_cF L_FF^-1.
            self.own = dense::inverse_of_product(l.get(..kept, ..kept));
            let mut adjoint = l.get(kept.., ..kept).transpose().to_owned();
            dense::solve_lower_transposed(l.get(..kept, ..kept), adjoint.as_mut());
            let mut transfer = Mat::from_fn(ends, kept, |i, j| -adjoint[(j, i)]);
            self.next_frame(transfer.as_mut());
            self.transfer = transfer;
            return Ok(());
        }
        let count = 3 * self.spread.len();
        let (mut own, mut transfer) = (Mat::<f64>::zeros(count, count), Mat::zeros(ends, count));
        for start in (0..count).step_by(COLUMNS) {
            unless_unwanted(wanted)?;
            let width = (count - start).min(COLUMNS);
            let unit = unit_columns(count, start, width);
            let answer = self.adjoint(self.force(unit.as_ref()).as_ref())?;
            own.as_mut().subcols_mut(start, width).copy_from(answer.get(..count, ..));
            transfer.as_mut().subcols_mut(start, width).copy_from(answer.get(count.., ..));
        }
        self.own = Mat::from_fn(count, count, |i, j| 0.5 * (own[(i, j)] + own[(j, i)]));
        self.transfer = transfer;
        Ok(())
    }

    /// The factor, cuts and kept nodes last.
    pub(super) fn factor(&self) -> &BoundaryLastFactor {
        &self.factor
    }

    /// The seat, and what it does.
    pub(super) fn seat(&self) -> Option<&SeatedSector> {
        self.seat.as_ref()
    }

    /// Unknowns of both cuts and of the seat, 2c (+ 6).
    pub(super) fn ends(&self) -> usize {
        2 * self.cut + self.seat.as_ref().map_or(0, |_| SIX)
    }

    /// R of the seat under the loads, 3m x 6.
    pub(super) fn rigid_of_loads(&self, seat: &SectorSeat) -> Mat<f64> {
        if self.kept > 0 {
            let rows = &self.factor.boundary()[..self.kept];
            return Mat::from_fn(self.kept, SIX, |i, k| seat.rigid[(rows[i], k)]);
        }
        let mut moved = Mat::<f64>::zeros(3 * self.spread.len(), SIX);
        for (i, load) in self.spread.iter().enumerate() {
            for (row, weight, axis) in self.rows(load) {
                (0..SIX).for_each(|k| moved[(3 * i + axis, k)] += weight * seat.rigid[(row, k)]);
            }
        }
        moved
    }

    /// R of the seat on both cuts, 2c x 6.
    pub(super) fn rigid_of_cuts(&self, seat: &SectorSeat) -> Mat<f64> {
        let rows = &self.factor.boundary()[self.kept..];
        let mut moved = Mat::from_fn(rows.len(), SIX, |i, k| seat.rigid[(rows[i], k)]);
        self.next_frame(moved.as_mut());
        moved
    }

    /// What forces on all freedoms (n x q, N) do.
    pub(super) fn under_forces(&self, forces: MatRef<'_, f64>) -> Result<UnderForces, ReductionError> {
        let held = Mat::zeros(self.factor.boundary().len(), forces.ncols());
        let field = self.factor.solve_held(forces, held.as_ref())?;
        let all = self.factor.condense(forces)?;
        let (on_kept, on_cuts) = all.as_ref().split_at_row(self.kept);
        let mut ends = on_cuts.to_owned();
        self.next_frame(ends.as_mut());
        let mut own = dense::product(forces.transpose(), field.as_ref());
        let mut resultants = Mat::zeros(0, forces.ncols());
        let on_loads = if self.kept > 0 {
            let moved = dense::product(self.own.as_ref(), on_kept);
            ends += dense::product(self.transfer.get(..2 * self.cut, ..), on_kept);
            own += dense::product(on_kept.transpose(), moved.as_ref());
            moved
        } else {
            self.under_loads(field.as_ref())
        };
        if let Some(SeatedSector { seat, field, .. }) = &self.seat {
            let mut along = dense::product(field.transpose(), forces);
            if self.kept > 0 {
                along += dense::product(self.transfer.get(2 * self.cut.., ..), on_kept);
            }
            ends = stacked(ends.as_ref(), along.as_ref());
            resultants = dense::product(seat.rigid.transpose(), forces);
        }
        Ok(UnderForces { field, ends, own, on_loads, resultants })
    }

    /// Displacements under the loads that are not on kept nodes, of fields, 3m x k.
    fn under_loads(&self, field: MatRef<'_, f64>) -> Mat<f64> {
        let mut own = Mat::<f64>::zeros(3 * self.spread.len(), field.ncols());
        for (i, load) in self.spread.iter().enumerate() {
            for (row, weight, axis) in self.rows(load) {
                (0..field.ncols()).for_each(|j| own[(3 * i + axis, j)] += weight * field[(row, j)]);
            }
        }
        own
    }

    /// Freedoms of the loads, 3m.
    pub(super) fn loads(&self) -> usize {
        self.own.nrows()
    }

    /// Rows of the right cut (the last ones) from the sector's frame into that of the next sector.
    fn next_frame(&self, ends: MatMut<'_, f64>) {
        self.turn_right(ends, -1.0);
    }

    /// Back from the frame of the next sector.
    fn own_frame(&self, ends: MatMut<'_, f64>) {
        self.turn_right(ends, 1.0);
    }

    fn turn_right(&self, mut ends: MatMut<'_, f64>, sense: f64) {
        let ([sin, cos], start) = ([sense * self.turn[0], self.turn[1]], ends.nrows() - self.cut);
        for j in 0..ends.ncols() {
            for i in (start..ends.nrows()).step_by(3) {
                let (x, y) = (ends[(i, j)], ends[(i + 1, j)]);
                ends[(i, j)] = cos * x - sin * y;
                ends[(i + 1, j)] = sin * x + cos * y;
            }
        }
    }

    /// Nodal forces P f, n x k, of loads that are not on kept nodes.
    fn force(&self, f: MatRef<'_, f64>) -> Mat<f64> {
        let mut force = Mat::zeros(self.dofs.free_count(), f.ncols());
        for (i, load) in self.spread.iter().enumerate() {
            for (row, weight, axis) in self.rows(load) {
                (0..f.ncols()).for_each(|j| force[(row, j)] += weight * f[(3 * i + axis, j)]);
            }
        }
        force
    }

    /// Matrix row, weight and axis of a load's parts.
    fn rows<'a>(&'a self, load: &'a Load) -> impl Iterator<Item = (usize, f64, usize)> + 'a {
        let row = |&(node, weight): &(u32, f64), axis| self.dofs.dof(node, axis).map(|row| (row, weight, axis));
        load.iter().flat_map(move |part| (0..3).filter_map(move |axis| row(part, axis)))
    }

    /// P' X: displacements under the loads, the cuts held, by unit loads of the same sector with other loads, mm/N, 3m x 3n.
    pub(super) fn under(&self, other: &Self) -> Result<Mat<f64>, ReductionError> {
        let of_kept = self.factor.boundary()[..self.kept].iter().map(|&row| vec![(row, 1.0)]);
        let of_spread = self.spread.iter().flat_map(|load| {
            let on =
                move |axis| self.rows(load).filter(move |part| part.2 == axis).map(|(row, weight, _)| (row, weight));
            (0..3).map(move |axis| on(axis).collect::<Vec<_>>())
        });
        let loads: Vec<Vec<(usize, f64)>> = of_kept.chain(of_spread).collect();
        let mut rows: Vec<usize> = loads.iter().flatten().map(|part| part.0).collect();
        rows.sort_unstable();
        rows.dedup();
        let [field, _] = other.rows_of_field(&rows)?;
        let at = |row: usize| rows.partition_point(|&known| known < row);
        let entry = |i: usize, j: usize| loads[i].iter().map(|&(row, weight)| weight * field[(at(row), j)]).sum();
        Ok(Mat::from_fn(loads.len(), field.ncols(), entry))
    }

    /// As [`Sector::basis`], where other forces move the loads as well, by `moved` (3m x k, mm) with the cuts held.
    pub(super) fn basis_with(&self, f: MatRef<'_, f64>, moved: MatRef<'_, f64>, ends: MatRef<'_, f64>) -> Mat<f64> {
        let mut basis = self.basis(f, ends);
        if self.kept > 0 {
            let mut own = basis.as_mut().subrows_mut(0, moved.nrows());
            own += moved;
        }
        basis
    }

    /// What a field is made of, from loads (3m x k, N) and ends (cuts, mm, and seat): displacements of kept nodes or loads,
    /// then ends.
    pub(super) fn basis(&self, f: MatRef<'_, f64>, ends: MatRef<'_, f64>) -> Mat<f64> {
        if self.kept == 0 {
            return stacked(f, ends);
        }
        let kept = dense::product(self.own.as_ref(), f) + dense::product(self.transfer.transpose(), ends);
        stacked(kept.as_ref(), ends)
    }

    /// Displacement of all free freedoms, n x k, mm, in the sector's frame, of [`Sector::basis`].
    pub(super) fn field(&self, basis: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        let (own, by_seat) = basis.split_at_row(basis.nrows() + 2 * self.cut - self.ends());
        let mut own = own.to_owned();
        self.own_frame(own.as_mut());
        let count = self.spread.len() * 3;
        let mut field = if self.kept > 0 {
            self.factor.expand(own.as_ref())?
        } else {
            self.factor.solve_held(self.force(own.get(..count, ..)).as_ref(), own.get(count.., ..))?
        };
        if let Some(seat) = &self.seat {
            field += dense::product(seat.field.as_ref(), by_seat);
        }
        Ok(field)
    }

    /// Transpose of [`Sector::field`]: from forces on all freedoms (n x k, N) to those on the basis.
    pub(super) fn adjoint(&self, force: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        let mut all = self.factor.condense(force)?;
        self.next_frame(all.as_mut());
        if self.kept == 0 {
            let held = Mat::zeros(2 * self.cut, force.ncols());
            let field = self.factor.solve_held(force, held.as_ref())?;
            all = stacked(self.under_loads(field.as_ref()).as_ref(), all.as_ref());
        }
        if let Some(seat) = &self.seat {
            all = stacked(all.as_ref(), dense::product(seat.field.transpose(), force).as_ref());
        }
        Ok(all)
    }

    /// Forces on the cuts (2c x k, N) that do the work of forces on all freedoms (n x k, N), the inside following
    /// freely; of a sector without loads.
    pub(super) fn ends_under(&self, force: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        let mut ends = self.factor.condense(force)?;
        self.next_frame(ends.as_mut());
        Ok(ends)
    }

    /// Displacement of all free freedoms (n x k, mm) under forces on them (N), the cuts moved by `ends` (2c x k, mm);
    /// of a sector without loads.
    pub(super) fn field_under(&self, force: MatRef<'_, f64>, ends: &Mat<f64>) -> Result<Mat<f64>, ReductionError> {
        let mut ends = ends.clone();
        self.own_frame(ends.as_mut());
        Ok(self.factor.solve_held(force, ends.as_ref())?)
    }

    /// The sector's mesh.
    pub(super) fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Rows of the displacement of all free freedoms for unit loads (3m columns, mm/N) and unit displacements of the cuts
    /// (2c columns) and of the seat, in the sector's frame.
    pub(super) fn rows_of_field(&self, rows: &[usize]) -> Result<[Mat<f64>; 2], ReductionError> {
        let (m, ends) = (self.loads(), self.ends());
        let mut field = Mat::<f64>::zeros(rows.len(), m + ends);
        for start in (0..m + ends).step_by(COLUMNS) {
            let width = (m + ends - start).min(COLUMNS);
            let unit = unit_columns(m + ends, start, width);
            let block = if self.kept > 0 {
                let (own, by_seat) = unit.as_ref().split_at_row(m + 2 * self.cut);
                let mut own = own.to_owned();
                self.own_frame(own.as_mut());
                let mut block = self.factor.expand_rows(own.as_ref(), rows)?;
                if let Some(seat) = &self.seat {
                    let known = Mat::from_fn(rows.len(), SIX, |i, k| seat.field[(rows[i], k)]);
                    block += dense::product(known.as_ref(), by_seat);
                }
                block
            } else {
                let all = self.field(unit.as_ref())?;
                Mat::from_fn(rows.len(), width, |i, j| all[(rows[i], j)])
            };
            field.as_mut().subcols_mut(start, width).copy_from(block);
        }
        let (by_first, by_cut) = field.as_ref().split_at_col(m);
        if self.kept == 0 {
            return Ok([by_first.to_owned(), by_cut.to_owned()]);
        }
        // By displacements of the kept nodes so far: loads and cuts move them by A f + H' u_c.
        let through = dense::product(by_first, self.transfer.transpose());
        Ok([dense::product(by_first, self.own.as_ref()), through + by_cut])
    }

    /// Mass (t) on the basis: the field's mass by congruence, column block by column block.
    pub(super) fn mass(&self, material: &Material) -> Result<Mat<f64>, ReductionError> {
        let mass = fem::assemble_mass(&self.mesh, material, &self.dofs)?;
        let n = self.loads() + self.ends();
        let mut condensed = Mat::<f64>::zeros(n, n);
        for start in (0..n).step_by(COLUMNS) {
            let width = (n - start).min(COLUMNS);
            let field = self.field(unit_columns(n, start, width).as_ref())?;
            let block = self.adjoint(mass.multiply(field.as_ref())?.as_ref())?;
            condensed.as_mut().subcols_mut(start, width).copy_from(&block);
        }
        Ok(Mat::from_fn(n, n, |i, j| 0.5 * (condensed[(i, j)] + condensed[(j, i)])))
    }

    /// Number of elements about each node.
    pub(super) fn elements_about(&self) -> Vec<u32> {
        let mut count = vec![0; self.mesh.nodes.len()];
        self.mesh.blocks.iter().flat_map(|b| &b.connectivity).for_each(|&n| count[n as usize] += 1);
        count
    }
}

/// Columns start .. start + width of the identity, n x width.
fn unit_columns(n: usize, start: usize, width: usize) -> Mat<f64> {
    Mat::from_fn(n, width, |i, j| f64::from(u8::from(i == start + j)))
}
