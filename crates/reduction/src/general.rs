//! Condensation with one sparse factor of the whole gear, cyclic or not.

use std::ops::Range;

use faer::{Mat, MatMut};
use fem::{DofMap, ElementOptions, Material, PartedFactor, StressOperator, Wanted, dense, unless_unwanted};
use mesh::{BoreCoupling, Mesh, MeshedGear};

use crate::{ReductionError, elastic_bore::ElasticBore, load::Load, mean_seat::MeanSeat};

/// Columns of all free degrees of freedom held at a time: 256 of 10^5 freedoms are 200 MB.
const COLUMNS: usize = 256;

/// A gear whose stiffness is factored as a whole, with the nodes of one window last if they are its coordinates.
#[derive(Debug)]
pub(crate) struct GeneralGear {
    dofs: DofMap,
    /// Factor of the stiffness, or of K~ where the bore is held by its means.
    factor: PartedFactor,
    seat: Option<MeanSeat>,
}

/// A window as the factor sees it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Seen<'a> {
    /// Nodes of the window are last in the factor.
    Last,
    /// Under these loads.
    Loads(&'a [Load]),
}

impl GeneralGear {
    /// Assembles and factors with the nodes `last` (ascending) last.
    pub(crate) fn new(
        gear: &MeshedGear,
        material: &Material,
        elements: &ElementOptions,
        last: &[u32],
        wanted: Wanted<'_>,
    ) -> Result<Self, ReductionError> {
        let mesh = gear.mesh();
        let dofs = DofMap::new(mesh.nodes.len(), gear.held_nodes());
        let bore = ElasticBore::of(gear);
        let mut stiffness = ElasticBore::stiffness(bore.as_ref(), mesh, (material, elements), &dofs)?;
        let seat = match gear.bore_coupling() {
            BoreCoupling::Kinematic | BoreCoupling::Elastic(_) => None,
            BoreCoupling::Distributing => Some(MeanSeat::new(gear, &dofs)?),
        };
        if let Some(seat) = &seat {
            stiffness = seat.held(stiffness)?;
        }
        let factor = PartedFactor::new(stiffness, &node_dofs(&dofs, last), wanted)?;
        Ok(Self { dofs, factor, seat })
    }

    /// Number of free degrees of freedom.
    pub(crate) fn free_count(&self) -> usize {
        self.dofs.free_count()
    }

    /// K^-1 b in place for forces b (N) on all free freedoms, n x k; of a bore that is held by its means P K~^-1 P' b.
    pub(crate) fn solve(&self, mut rhs: MatMut<'_, f64>) -> Result<(), ReductionError> {
        if let Some(seat) = &self.seat {
            seat.balance(rhs.as_mut());
        }
        self.factor.solve(rhs.as_mut())?;
        if let Some(seat) = &self.seat {
            seat.settle(rhs);
        }
        Ok(())
    }

    /// Rows `wanted` of the same.
    fn solve_rows(&self, forces: &Mat<f64>, wanted: &[usize]) -> Result<Mat<f64>, ReductionError> {
        if self.seat.is_none() {
            return Ok(self.factor.solve_rows(forces.as_ref(), wanted)?);
        }
        let mut all = forces.clone();
        self.solve(all.as_mut())?;
        Ok(Mat::from_fn(wanted.len(), all.ncols(), |i, j| all[(wanted[i], j)]))
    }

    /// C of a window, mm/N.
    pub(crate) fn compliance(&self, seen: Seen, wanted: Wanted<'_>) -> Result<Mat<f64>, ReductionError> {
        match (seen, &self.seat) {
            (Seen::Last, None) => Ok(self.factor.compliance()),
            (Seen::Last, Some(seat)) => {
                let mut reactions = seat.reactions().clone();
                self.factor.solve(reactions.as_mut())?;
                Ok(seat.compliance(&self.factor.compliance(), self.factor.boundary(), &reactions))
            }
            (Seen::Loads(loads), _) => {
                let compliance = self.compliance_between(loads, loads, wanted)?;
                Ok(symmetric(&compliance))
            }
        }
    }

    /// Displacements of the coordinates `of` under unit forces on those of `under`, mm/N: P_of' K^-1 P_under.
    pub(crate) fn compliance_between(
        &self,
        of: &[Load],
        under: &[Load],
        wanted: Wanted<'_>,
    ) -> Result<Mat<f64>, ReductionError> {
        let (support, of) = self.on_support(of);
        let mut compliance = Mat::<f64>::zeros(3 * of.len(), 3 * under.len());
        for start in (0..3 * under.len()).step_by(COLUMNS) {
            unless_unwanted(wanted)?;
            let width = (3 * under.len() - start).min(COLUMNS);
            let field = self.under_loads(under, start..start + width, &support)?;
            compliance.as_mut().subcols_mut(start, width).copy_from(means(&of, &field));
        }
        Ok(compliance)
    }

    /// Forces on nodes of the mesh as forces on freedoms.
    pub(crate) fn forces_on(&self, loads: &[Vec<(u32, [f64; 3])>]) -> Vec<Vec<(usize, f64)>> {
        let on = |&(node, force): &(u32, [f64; 3])| {
            let at = self.dofs.position(node).map(|place| 3 * place);
            at.into_iter().flat_map(move |at| (0..3).map(move |axis| (at + axis, force[axis])))
        };
        loads.iter().map(|load| load.iter().flat_map(on).filter(|own| own.1 != 0.0).collect()).collect()
    }

    /// Work of forces `of` on the displacements under forces `under`, each on freedoms.
    pub(crate) fn between(
        &self,
        of: &[Vec<(usize, f64)>],
        under: &[Vec<(usize, f64)>],
    ) -> Result<Mat<f64>, ReductionError> {
        let mut wanted: Vec<usize> = of.iter().flatten().map(|part| part.0).collect();
        wanted.sort_unstable();
        wanted.dedup();
        let number = |dof: usize| wanted.partition_point(|known| *known < dof);
        let of: Vec<Vec<(usize, f64)>> =
            of.iter().map(|load| load.iter().map(|&(dof, f)| (number(dof), f)).collect()).collect();
        let mut work = Mat::<f64>::zeros(of.len(), under.len());
        for start in (0..under.len()).step_by(COLUMNS) {
            let width = (under.len() - start).min(COLUMNS);
            let field = self.under_forces(&under[start..start + width], &wanted)?;
            let block =
                Mat::from_fn(of.len(), width, |i, j| of[i].iter().map(|&(at, f)| f * field[(at, j)]).sum::<f64>());
            work.as_mut().subcols_mut(start, width).copy_from(&block);
        }
        Ok(work)
    }

    /// Rows `wanted` of the displacements under unit forces on some coordinates of a window.
    fn under_loads(&self, loads: &[Load], columns: Range<usize>, wanted: &[usize]) -> Result<Mat<f64>, ReductionError> {
        let column = |c: usize| -> Vec<(usize, f64)> {
            let at = |&(n, w): &(u32, f64)| Some((3 * self.dofs.position(n)? + c % 3, w));
            loads[c / 3].iter().filter_map(at).collect()
        };
        let forces: Vec<Vec<(usize, f64)>> = columns.map(column).collect();
        self.under_forces(&forces, wanted)
    }

    /// Rows `wanted` of the displacements under forces on freedoms.
    fn under_forces(&self, forces: &[Vec<(usize, f64)>], wanted: &[usize]) -> Result<Mat<f64>, ReductionError> {
        if self.seat.is_none() {
            return Ok(self.factor.solve_few(forces, wanted)?);
        }
        let mut all = Mat::zeros(self.factor.n(), forces.len());
        for (j, force) in forces.iter().enumerate() {
            force.iter().for_each(|&(dof, f)| all[(dof, j)] += f);
        }
        self.solve_rows(&all, wanted)
    }

    /// Displacement of all free freedoms, n x k, for coordinates u (mm) of a window, which the forces f (N) hold.
    pub(crate) fn fields(&self, seen: Seen, u: &Mat<f64>, f: &Mat<f64>) -> Result<Mat<f64>, ReductionError> {
        match seen {
            Seen::Last => Ok(self.factor.expand(u.as_ref())?),
            Seen::Loads(loads) => {
                let mut field = spread(loads, f, self.factor.n(), |n| self.dofs.position(n));
                self.solve(field.as_mut())?;
                Ok(field)
            }
        }
    }

    /// The same at some nodes of the mesh, for each column the displacements (mm) in their order.
    pub(crate) fn fields_at(
        &self,
        (seen, nodes): (Seen, &[u32]),
        u: &Mat<f64>,
        f: &Mat<f64>,
    ) -> Result<Vec<Vec<[f64; 3]>>, ReductionError> {
        let count = self.dofs.node_count();
        if let Some(&found) = nodes.iter().find(|n| **n as usize >= count) {
            return Err(fem::FemError::Shape { what: "nodes", expected: count, found: found as usize }.into());
        }
        let dofs = node_dofs(&self.dofs, nodes);
        let rows = match seen {
            Seen::Last => self.factor.expand_rows(u.as_ref(), &dofs)?,
            Seen::Loads(loads) if self.seat.is_none() => {
                let on = |j: usize| {
                    let of_load = |(i, load): (usize, &Load)| {
                        let at = |&(n, w): &(u32, f64)| Some((3 * self.dofs.position(n)?, w));
                        let of_axes =
                            |(at, w): (usize, f64)| [0, 1, 2].map(|axis| (at + axis, w * f[(3 * i + axis, j)]));
                        load.iter().filter_map(at).flat_map(of_axes).collect::<Vec<_>>()
                    };
                    loads.iter().enumerate().flat_map(of_load).collect()
                };
                let forces: Vec<Vec<(usize, f64)>> = (0..f.ncols()).map(on).collect();
                self.factor.solve_few(&forces, &dofs)?
            }
            Seen::Loads(loads) => {
                self.solve_rows(&spread(loads, f, self.factor.n(), |n| self.dofs.position(n)), &dofs)?
            }
        };
        let of_column = |j: usize| {
            let mut row = 0;
            let of_node = |&n: &u32| {
                if self.dofs.position(n).is_none() {
                    return [0.0; 3];
                }
                row += 3;
                [0, 1, 2].map(|axis| rows[(row - 3 + axis, j)])
            };
            nodes.iter().map(of_node).collect()
        };
        Ok((0..rows.ncols()).map(of_column).collect())
    }

    /// Forces on a window's coordinates that do the work of given ones, n x k: T' force for a window that is last, else
    /// P' K^-1 force, which is their displacement.
    fn adjoint(&self, seen: Seen, force: &Mat<f64>) -> Result<Mat<f64>, ReductionError> {
        match seen {
            Seen::Last => Ok(self.factor.condense(force.as_ref())?),
            Seen::Loads(loads) => {
                let (wanted, loads) = self.on_support(loads);
                let field = self.solve_rows(force, &wanted)?;
                Ok(means(&loads, &field))
            }
        }
    }

    /// Freedoms under some loads, and the loads on these alone: number of the node among them, and share.
    fn on_support(&self, loads: &[Load]) -> (Vec<usize>, Vec<Vec<(usize, f64)>>) {
        let mut nodes: Vec<usize> = loads.iter().flatten().filter_map(|&(n, _)| self.dofs.position(n)).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let number = |&(n, w): &(u32, f64)| Some((nodes.binary_search(&self.dofs.position(n)?).ok()?, w));
        let loads = loads.iter().map(|load| load.iter().filter_map(number).collect()).collect();
        (nodes.iter().flat_map(|&p| 3 * p..3 * p + 3).collect(), loads)
    }

    /// Stress at some nodes, 6 rows a node: for unit coordinates (MPa/mm) of a window that is last, else for unit
    /// forces (MPa/N).
    ///
    /// Made from whichever has fewer columns: the rows of D B, sparse vectors that go through the forward substitution
    /// once (the adjoint way, `S' = T' (D B)'`), or the columns of T, of which back substitution finds what D B asks
    /// for. Either way the branches of the factor that neither window nor nodes are in are passed over, so put nodes in
    /// the order of their place.
    pub(crate) fn stress(
        &self,
        seen: Seen,
        coordinates: usize,
        operator: &StressOperator,
    ) -> Result<Mat<f64>, ReductionError> {
        let m = operator.node_count();
        let mut stress = Mat::<f64>::zeros(6 * m, coordinates);
        if 6 * m <= coordinates {
            for start in (0..m).step_by(COLUMNS / 6) {
                let end = m.min(start + COLUMNS / 6);
                let rows = self.adjoint(seen, &operator.transposed(start..end)?)?;
                stress.as_mut().subrows_mut(6 * start, 6 * (end - start)).copy_from(rows.transpose());
            }
            return Ok(stress);
        }
        let moved = StressOperator::moved(std::iter::once(operator));
        let support: Vec<usize> = moved.iter().flat_map(|&place| 3 * place..3 * place + 3).collect();
        let operator = operator.clone().of(&moved);
        for start in (0..coordinates).step_by(COLUMNS) {
            let width = (coordinates - start).min(COLUMNS);
            let field = match seen {
                Seen::Last => self.factor.expand_rows(unit_columns(coordinates, start, width).as_ref(), &support)?,
                Seen::Loads(loads) => self.under_loads(loads, start..start + width, &support)?,
            };
            stress.as_mut().subcols_mut(start, width).copy_from(operator.apply(field.as_ref())?);
        }
        Ok(stress)
    }

    /// M^ = T' M T (t) of a window with `stiffness` K^.
    ///
    /// Column block by column block: T c by back-substitution, M times that, T' by forward substitution. Phi_IC is
    /// never held as a whole.
    pub(crate) fn mass(
        &self,
        seen: Seen,
        mesh: &Mesh,
        material: &Material,
        stiffness: &Mat<f64>,
    ) -> Result<Mat<f64>, ReductionError> {
        let mass = fem::assemble_mass(mesh, material, &self.dofs)?;
        let n = stiffness.nrows();
        let mut condensed = Mat::<f64>::zeros(n, n);
        for start in (0..n).step_by(COLUMNS) {
            let width = (n - start).min(COLUMNS);
            let forces = stiffness.subcols(start, width).to_owned();
            let modes = self.fields(seen, &unit_columns(n, start, width), &forces)?;
            let mut block = self.adjoint(seen, &mass.multiply(modes.as_ref())?)?;
            if matches!(seen, Seen::Loads(_)) {
                block = dense::product(stiffness.as_ref(), block.as_ref());
            }
            condensed.as_mut().subcols_mut(start, width).copy_from(&block);
        }
        Ok(symmetric(&condensed))
    }
}

/// Matrix rows of the nodes' free freedoms, x, y, z of each node in turn.
fn node_dofs(dofs: &DofMap, nodes: &[u32]) -> Vec<usize> {
    nodes.iter().flat_map(|&n| (0..3).filter_map(move |axis| dofs.dof(n, axis))).collect()
}

/// Columns start .. start + width of the identity, n x width.
pub(crate) fn unit_columns(n: usize, start: usize, width: usize) -> Mat<f64> {
    Mat::from_fn(n, width, |i, j| f64::from(u8::from(i == start + j)))
}

/// P f, `free` x k; `position` places a mesh node among the free ones.
fn spread(loads: &[Load], f: &Mat<f64>, free: usize, position: impl Fn(u32) -> Option<usize>) -> Mat<f64> {
    let mut force = Mat::zeros(free, f.ncols());
    for (i, load) in loads.iter().enumerate() {
        for (at, weight) in load.iter().filter_map(|&(n, w)| Some((3 * position(n)?, w))) {
            for j in 0..f.ncols() {
                (0..3).for_each(|axis| force[(at + axis, j)] += weight * f[(3 * i + axis, j)]);
            }
        }
    }
    force
}

/// P' u for loads on nodes by their place among the free ones.
fn means(loads: &[Vec<(usize, f64)>], field: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(3 * loads.len(), field.ncols(), |i, j| {
        loads[i / 3].iter().map(|&(at, w)| w * field[(3 * at + i % 3, j)]).sum()
    })
}

/// P' K^-1 P for the loads P, three directions each, mm/N; `position` places a mesh node among the `free` freedoms,
/// `solve` is K^-1 in place.
pub(crate) fn load_compliance(
    free: usize,
    loads: &[Load],
    position: impl Fn(u32) -> Option<usize>,
    solve: impl Fn(MatMut<'_, f64>) -> Result<(), ReductionError>,
) -> Result<Mat<f64>, ReductionError> {
    let placed: Vec<Vec<(usize, f64)>> =
        loads.iter().map(|load| load.iter().filter_map(|&(n, w)| Some((position(n)?, w))).collect()).collect();
    let n = 3 * loads.len();
    let mut compliance = Mat::<f64>::zeros(n, n);
    for start in (0..n).step_by(COLUMNS) {
        let width = (n - start).min(COLUMNS);
        let mut columns = spread(loads, &unit_columns(n, start, width), free, &position);
        solve(columns.as_mut())?;
        compliance.as_mut().subcols_mut(start, width).copy_from(means(&placed, &columns));
    }
    Ok(symmetric(&compliance))
}

/// Half of A + A'.
pub(crate) fn symmetric(a: &Mat<f64>) -> Mat<f64> {
    Mat::from_fn(a.nrows(), a.ncols(), |i, j| 0.5 * (a[(i, j)] + a[(j, i)]))
}
