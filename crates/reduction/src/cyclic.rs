//! One sector instead of a gear.
//!
//! All teeth of a sound gear are the same, in frames turned by 2 pi / z. One sector is condensed once ([`sector`]); the sectors outside
//! the window are equal super-elements and are joined by doubling ([`chain`]); the window's sectors close the ring:
//!
//! ```text
//!   c_0   c_1        c_w                         K_ring u_c = H_w f          (cuts of the ring)
//!    |--1--|-- ... --|                           C = diag(A) + H_w' K_ring^-1 H_w
//!    |               |
//!    +---- chain ----+    z - w sectors          u = X f + T u_c in every sector
//! ```
//! The result is the condensation of the whole gear to round-off, at the cost of one sector. Nothing is approximated: cuts are eliminated as
//! any other freedom is.

mod chain;
mod sector;
mod sector_mesh;
mod turn;

use std::collections::BTreeMap;

use faer::{Mat, MatMut, MatRef};
use fem::{ElementOptions, Material, dense};
use mesh::Origin;

use crate::{ReductionError, load::Load};
use chain::{Chain, congruent, stacked};
use sector::Sector;
pub(crate) use sector_mesh::SectorMesh;
pub use turn::pitch_permutation;
pub(crate) use turn::{PitchTurn, face_nodes};

/// Weights of two loads within this are the same load on two teeth.
const SAME_LOAD: f64 = 1e-10;

/// A cyclic gear with loads on the flanks of some neighbouring teeth.
#[derive(Debug)]
pub(crate) struct CyclicGear {
    part: SectorMesh,
    sector: Sector,
    material: Material,
    elements: ElementOptions,
    /// Copy and load of each coordinate node.
    coordinates: Vec<(u32, usize)>,
    /// First copy of the window and their number w.
    first: u32,
    count: u32,
    /// The sectors outside of the window, if there are any.
    chain: Option<Chain>,
    /// L of K_ring = L L'.
    ring: Mat<f64>,
}

impl CyclicGear {
    /// Condenses the sector and closes the ring; `loads` are on nodes of the larger mesh, those on single nodes if `keep`.
    ///
    /// `None` when a load lies on a cut or reaches over one: then the sector is not one for these loads.
    pub(crate) fn new(
        part: SectorMesh,
        material: &Material,
        elements: &ElementOptions,
        loads: &[Load],
        keep: bool,
    ) -> Result<Option<Self>, ReductionError> {
        let Some((coordinates, own)) = placed(&part, loads) else { return Ok(None) };
        let (first, count) = arc(coordinates.iter().map(|c| c.0), part.teeth);
        let sector = Sector::new(&part, material, elements, &own, keep)?;
        let rest = (part.teeth - count) as usize;
        let chain = (rest > 0).then(|| Chain::new(&sector.stiffness, rest)).transpose()?;
        let ring = ring(&sector, chain.as_ref(), count as usize)?;
        let (material, elements) = (*material, *elements);
        Ok(Some(Self { part, sector, material, elements, coordinates, first, count, chain, ring }))
    }

    /// Free degrees of freedom of the whole gear.
    pub(crate) fn free_count(&self) -> usize {
        self.part.free_count()
    }

    /// The larger mesh's node that a turn by `pitches` takes `node` to, if the mesh has it.
    pub(crate) fn turned_node(&self, node: u32, pitches: u32) -> Option<u32> {
        let at = self.part.places.get(node as usize)?;
        self.part.node_at(Origin { copy: (at.copy + pitches) % self.part.teeth, node: at.node })
    }

    /// C (mm/N), in the frame of copy 0.
    pub(crate) fn compliance(&self) -> Mat<f64> {
        let mut through = self.forces_on_cuts(None);
        dense::solve_lower(self.ring.as_ref(), through.as_mut());
        let mut compliance = dense::gram(through.as_ref());
        for copy in (0..self.count).map(|j| (self.first + j) % self.part.teeth) {
            let own = self.own_turned(copy);
            let here: Vec<(usize, usize)> = (0..self.coordinates.len())
                .filter(|&i| self.coordinates[i].0 == copy)
                .map(|i| (3 * i, 3 * self.coordinates[i].1))
                .collect();
            for &(j, from_j) in &here {
                for &(i, from_i) in &here {
                    for (a, b) in (0..3).flat_map(|b| (0..3).map(move |a| (a, b))) {
                        compliance[(i + a, j + b)] += own[(from_i + a, from_j + b)];
                    }
                }
            }
        }
        let n = compliance.nrows();
        Mat::from_fn(n, n, |i, j| 0.5 * (compliance[(i, j)] + compliance[(j, i)]))
    }

    /// A with every 3 x 3 block turned from the frame of a copy into that of copy 0.
    fn own_turned(&self, copy: u32) -> Mat<f64> {
        let (sin, cos) = self.angle(copy).sin_cos();
        let mut own = self.sector.own.clone();
        for _ in 0..2 {
            for column in own.col_iter_mut() {
                let mut column = column;
                for i in (0..column.nrows()).step_by(3) {
                    let (x, y) = (column[i], column[i + 1]);
                    column[i] = cos * x - sin * y;
                    column[i + 1] = sin * x + cos * y;
                }
            }
            own = own.transpose().to_owned();
        }
        own
    }

    /// Turn from the frame of a copy into that of copy 0.
    fn turn(&self, copy: u32) -> [[f64; 3]; 3] {
        let (sin, cos) = self.angle(copy).sin_cos();
        [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]]
    }

    fn angle(&self, copy: u32) -> f64 {
        std::f64::consts::TAU * f64::from(copy % self.part.teeth) / f64::from(self.part.teeth)
    }

    /// Rows of the ring's matrix at which the left cut of the window's j-th sector starts (j = w: its last cut).
    fn cut_row(&self, j: usize) -> usize {
        let closed = if self.chain.is_none() { self.count as usize } else { usize::MAX };
        self.sector.cut * (j % closed)
    }

    /// Sectors from the window's first to a copy.
    fn offset(&self, copy: u32) -> usize {
        let z = self.part.teeth;
        ((copy % z + z - self.first) % z) as usize
    }

    /// H_w f for forces f on the coordinates (3n x k, N); without any, H_w itself.
    fn forces_on_cuts(&self, forces: Option<MatRef<'_, f64>>) -> Mat<f64> {
        let (c, ring) = (self.sector.cut, self.ring.nrows());
        let mut on_cuts = Mat::zeros(ring, forces.map_or(3 * self.coordinates.len(), |f| f.ncols()));
        let add = |mut target: MatMut<'_, f64>, j: usize, ends: MatRef<'_, f64>| {
            let mut left = target.as_mut().subrows_mut(self.cut_row(j), c);
            left += ends.subrows(0, c);
            let mut right = target.as_mut().subrows_mut(self.cut_row(j + 1), c);
            right += ends.subrows(c, c);
        };
        match forces {
            Some(f) => {
                for j in 0..self.count {
                    let ends =
                        dense::product(self.sector.transfer.as_ref(), self.forces_in(self.first + j, f).as_ref());
                    add(on_cuts.as_mut(), j as usize, ends.as_ref());
                }
            }
            None => {
                for (i, &(copy, load)) in self.coordinates.iter().enumerate() {
                    let turn = self.turn(copy);
                    let columns = self.sector.transfer.subcols(3 * load, 3);
                    let ends = Mat::from_fn(2 * c, 3, |row, a| (0..3).map(|b| columns[(row, b)] * turn[a][b]).sum());
                    add(on_cuts.as_mut().subcols_mut(3 * i, 3), self.offset(copy), ends.as_ref());
                }
            }
        }
        on_cuts
    }

    /// Forces on a copy's loads in its own frame, 3m x k, of forces on the coordinates.
    fn forces_in(&self, copy: u32, forces: MatRef<'_, f64>) -> Mat<f64> {
        let copy = copy % self.part.teeth;
        let turn = self.turn(copy);
        let mut own = Mat::<f64>::zeros(self.sector.loads(), forces.ncols());
        for (i, &(_, load)) in self.coordinates.iter().enumerate().filter(|(_, c)| c.0 == copy) {
            for k in 0..forces.ncols() {
                for b in 0..3 {
                    own[(3 * load + b, k)] += (0..3).map(|a| turn[a][b] * forces[(3 * i + a, k)]).sum::<f64>();
                }
            }
        }
        own
    }

    /// Displacements of the ring's cuts under forces on the coordinates; without any, under unit forces.
    fn ring_cuts(&self, forces: Option<MatRef<'_, f64>>) -> Mat<f64> {
        let mut cuts = self.forces_on_cuts(forces);
        dense::solve_lower(self.ring.as_ref(), cuts.as_mut());
        dense::solve_lower_transposed(self.ring.as_ref(), cuts.as_mut());
        cuts
    }

    /// Displacements of both cuts of some copies, 2c x k each, from those of the ring's cuts.
    fn ends_of(&self, copies: &[u32], ring: MatRef<'_, f64>) -> Vec<Mat<f64>> {
        let (c, w) = (self.sector.cut, self.count as usize);
        let cut = |j: usize| ring.subrows(self.cut_row(j), c);
        // Cut i of the chain is cut w + i of the gear; its last one is the ring's first.
        let mut wanted: Vec<usize> = copies.iter().map(|&k| self.offset(k)).filter(|&j| j >= w).collect();
        wanted = wanted.iter().flat_map(|j| [j - w, j - w + 1]).collect();
        let inner: BTreeMap<usize, Mat<f64>> = match &self.chain {
            Some(chain) if !wanted.is_empty() => chain.cuts(stacked(cut(w), cut(0)).as_ref(), &wanted),
            _ => BTreeMap::new(),
        };
        let ends = copies.iter().map(|&k| self.offset(k)).map(|j| {
            if j < w {
                return stacked(cut(j), cut(j + 1));
            }
            let at = |i: usize| inner.get(&i).map_or(ring.subrows(0, c), |m| m.as_ref());
            stacked(at(j - w), at(j - w + 1))
        });
        ends.collect()
    }

    /// Displacement of all free freedoms of the sector in some copies, each in its own frame, one column a copy, for forces on
    /// the coordinates (N).
    fn fields(&self, copies: &[u32], forces: &[f64]) -> Result<Mat<f64>, ReductionError> {
        let forces = MatRef::from_column_major_slice(forces, forces.len(), 1);
        let ends = self.ends_of(copies, self.ring_cuts(Some(forces)).as_ref());
        let loads: Vec<Mat<f64>> = copies.iter().map(|&k| self.forces_in(k, forces)).collect();
        let f = Mat::from_fn(self.sector.loads(), copies.len(), |i, j| loads[j][(i, 0)]);
        let ends = Mat::from_fn(2 * self.sector.cut, copies.len(), |i, j| ends[j][(i, 0)]);
        self.sector.field(self.sector.basis(f.as_ref(), ends.as_ref()).as_ref())
    }

    /// Displacement (mm) of every node of the larger mesh under forces on the coordinates of the window that stands `shift` pitches on, in the
    /// mesh's frame.
    pub(crate) fn expand(&self, forces: &[f64], shift: u32) -> Result<Vec<[f64; 3]>, ReductionError> {
        let z = self.part.teeth;
        let mut copies: Vec<u32> = self.part.places.iter().map(|p| (p.copy + z - shift % z) % z).collect();
        copies.sort_unstable();
        copies.dedup();
        let fields = self.fields(&copies, forces)?;
        let mut all = Vec::with_capacity(self.part.places.len());
        for place in &self.part.places {
            let column = copies.binary_search(&((place.copy + z - shift % z) % z)).unwrap_or_default();
            all.push(self.at(place.node, place.copy, fields.as_ref(), column));
        }
        Ok(all)
    }

    /// Displacement of a sector's node in one column of its fields, turned by so many pitches.
    fn at(&self, node: u32, pitches: u32, fields: MatRef<'_, f64>, column: usize) -> [f64; 3] {
        let u = [0, 1, 2].map(|axis| self.sector.dofs.dof(node, axis).map_or(0.0, |row| fields[(row, column)]));
        self.turn(pitches).map(|row| (0..3).map(|k| row[k] * u[k]).sum())
    }

    /// Coordinates of the window that stands `pitches` on, in its own frame, under forces on those of this one.
    pub(crate) fn carry(&self, forces: &[f64], pitches: u32, loads: &[Load]) -> Result<Vec<f64>, ReductionError> {
        let z = self.part.teeth;
        let mut copies: Vec<u32> = self.coordinates.iter().map(|c| (c.0 + pitches) % z).collect();
        copies.sort_unstable();
        copies.dedup();
        let fields = self.fields(&copies, forces)?;
        let mut carried = Vec::with_capacity(3 * self.coordinates.len());
        for (&(copy, _), load) in self.coordinates.iter().zip(loads) {
            let column = copies.binary_search(&((copy + pitches) % z)).unwrap_or_default();
            let mut mean = [0.0; 3];
            for &(node, weight) in load {
                let u = self.at(self.part.places[node as usize].node, copy, fields.as_ref(), column);
                mean.iter_mut().zip(u).for_each(|(m, u)| *m += weight * u);
            }
            carried.extend(mean);
        }
        Ok(carried)
    }

    /// Stress at nodes of the larger mesh (6 rows a node, MPa) for unit forces on the coordinates, in the frame of copy 0.
    ///
    /// On a cut the mean is over the elements on both of its sides.
    pub(crate) fn stress(&self, nodes: &[u32]) -> Result<Mat<f64>, ReductionError> {
        let parts: Vec<Vec<(u32, u32, f64)>> = self.shares(nodes)?;
        let mut own: Vec<u32> = parts.iter().flatten().map(|p| p.1).collect();
        let mut copies: Vec<u32> = parts.iter().flatten().map(|p| p.0).collect();
        for list in [&mut own, &mut copies] {
            list.sort_unstable();
            list.dedup();
        }
        let [by_load, by_cut] = self.sector.stress(&self.material, &self.elements, &own)?;
        let unit = Mat::<f64>::identity(3 * self.coordinates.len(), 3 * self.coordinates.len());
        let ring = self.ring_cuts(None);
        let mut stress = Mat::<f64>::zeros(6 * nodes.len(), unit.ncols());
        for &copy in &copies {
            let ends = &self.ends_of(&[copy], ring.as_ref())[0];
            let mut local = dense::product(by_cut.as_ref(), ends.as_ref());
            if self.offset(copy) < self.count as usize {
                local += dense::product(by_load.as_ref(), self.forces_in(copy, unit.as_ref()).as_ref());
            }
            let turn = tensor_turn(self.angle(copy));
            for (i, part) in parts.iter().enumerate() {
                for &(_, node, share) in part.iter().filter(|p| p.0 == copy) {
                    let from = 6 * own.binary_search(&node).unwrap_or_default();
                    for k in 0..stress.ncols() {
                        for (a, row) in turn.iter().enumerate() {
                            let turned: f64 = row.iter().enumerate().map(|(b, t)| t * local[(from + b, k)]).sum();
                            stress[(6 * i + a, k)] += share * turned;
                        }
                    }
                }
            }
        }
        Ok(stress)
    }

    /// Copies, sector's nodes and shares of which the nodal mean at each node is made.
    fn shares(&self, nodes: &[u32]) -> Result<Vec<Vec<(u32, u32, f64)>>, ReductionError> {
        let (z, touching) = (self.part.teeth, self.sector.touching());
        let count = self.part.places.len();
        let of = |&node: &u32| {
            let wrong = || fem::FemError::Shape { what: "nodes", expected: count, found: node as usize };
            let place = self.part.places.get(node as usize).ok_or_else(wrong)?;
            let Some(right) = self.part.right_of(place.node) else {
                return Ok(vec![(place.copy, place.node, 1.0)]);
            };
            let [here, behind] = [place.node, right].map(|n| f64::from(touching[n as usize]));
            let sum = (here + behind).max(1.0);
            Ok(vec![(place.copy, place.node, here / sum), ((place.copy + z - 1) % z, right, behind / sum)])
        };
        nodes.iter().map(of).collect()
    }

    /// M^ (t) of the coordinates, whose stiffness is `stiffness`, in the frame of copy 0.
    pub(crate) fn mass(&self, stiffness: &Mat<f64>) -> Result<Mat<f64>, ReductionError> {
        let own = self.sector.mass(&self.material)?;
        let forces = stiffness.as_ref();
        let ring = self.ring_cuts(Some(forces));
        let mut mass = Mat::<f64>::zeros(forces.nrows(), forces.ncols());
        for j in 0..self.count {
            let copy = (self.first + j) % self.part.teeth;
            let ends = &self.ends_of(&[copy], ring.as_ref())[0];
            let basis = self.sector.basis(self.forces_in(copy, forces).as_ref(), ends.as_ref());
            mass += congruent(&own, &basis);
        }
        if let Some(chain) = &self.chain {
            let c = self.sector.cut;
            let unit = Mat::<f64>::identity(2 * c, 2 * c);
            let unloaded = Mat::<f64>::zeros(self.sector.loads(), 2 * c);
            let free = congruent(&own, &self.sector.basis(unloaded.as_ref(), unit.as_ref()));
            let ends = stacked(ring.subrows(self.cut_row(self.count as usize), c), ring.subrows(self.cut_row(0), c));
            mass += congruent(&chain.mass(&free), &ends);
        }
        Ok(Mat::from_fn(mass.nrows(), mass.ncols(), |i, j| 0.5 * (mass[(i, j)] + mass[(j, i)])))
    }
}

/// L of the stiffness of the ring's cuts, loads free.
fn ring(sector: &Sector, chain: Option<&Chain>, count: usize) -> Result<Mat<f64>, ReductionError> {
    let c = sector.cut;
    let cuts = if chain.is_some() { count + 1 } else { count };
    let mut stiffness = Mat::<f64>::zeros(cuts * c, cuts * c);
    let mut add = |element: &Mat<f64>, at: [usize; 2]| {
        for (a, b) in (0..2).flat_map(|a| (0..2).map(move |b| (a, b))) {
            let mut block = stiffness.as_mut().submatrix_mut(at[a] * c, at[b] * c, c, c);
            block += element.as_ref().submatrix(a * c, b * c, c, c);
        }
    };
    (0..count).for_each(|j| add(&sector.stiffness, [j, (j + 1) % cuts]));
    if let Some(chain) = chain {
        add(&chain.stiffness, [count, 0]);
    }
    Ok(dense::cholesky(stiffness.as_ref())?)
}

/// Copy and number of each load, and the different loads on nodes of one sector; `None` when one is on a cut or in two copies.
fn placed(part: &SectorMesh, loads: &[Load]) -> Option<(Vec<(u32, usize)>, Vec<Load>)> {
    let mut own: Vec<Load> = Vec::new();
    // Loads of the same nodes, to be found by them.
    let mut known: BTreeMap<Vec<u32>, Vec<usize>> = BTreeMap::new();
    let mut coordinates = Vec::with_capacity(loads.len());
    for load in loads {
        let mut copies: Vec<u32> = Vec::new();
        let mut mine: Load = Vec::with_capacity(load.len());
        for &(node, weight) in load {
            let place = part.places.get(node as usize)?;
            if part.right_of(place.node).is_some() {
                return None;
            }
            copies.push(place.copy);
            mine.push((place.node, weight));
        }
        let copy = *copies.first()?;
        if copies.iter().any(|&c| c != copy) {
            return None;
        }
        mine.sort_by_key(|&(node, _)| node);
        let key: Vec<u32> = mine.iter().filter(|(_, w)| w.abs() > SAME_LOAD).map(|&(node, _)| node).collect();
        let weight = |load: &Load, node| load.iter().find(|p| p.0 == node).map_or(0.0, |p| p.1);
        let same = |&&i: &&usize| mine.iter().all(|&(n, w)| (w - weight(&own[i], n)).abs() <= SAME_LOAD);
        let numbers = known.entry(key).or_default();
        let number = match numbers.iter().find(same) {
            Some(&number) => number,
            None => {
                numbers.push(own.len());
                own.push(mine);
                own.len() - 1
            }
        };
        coordinates.push((copy, number));
    }
    Some((coordinates, own))
}

/// First and number of the neighbouring copies that hold all those given: what the widest gap leaves.
fn arc(copies: impl Iterator<Item = u32>, teeth: u32) -> (u32, u32) {
    let mut copies: Vec<u32> = copies.collect();
    copies.sort_unstable();
    copies.dedup();
    let Some(&last) = copies.last() else { return (0, 1) };
    let mut best = (copies[0], teeth - (copies[0] + teeth - last) + 1);
    for pair in copies.windows(2) {
        let count = teeth - (pair[1] - pair[0]) + 1;
        if count < best.1 {
            best = (pair[1], count);
        }
    }
    best
}

/// Components xx, yy, zz, xy, yz, zx of a tensor after a turn by `angle` about z.
fn tensor_turn(angle: f64) -> [[f64; 6]; 6] {
    let (s, c) = angle.sin_cos();
    [
        [c * c, s * s, 0.0, -2.0 * s * c, 0.0, 0.0],
        [s * s, c * c, 0.0, 2.0 * s * c, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        [s * c, -s * c, 0.0, c * c - s * s, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, c, s],
        [0.0, 0.0, 0.0, 0.0, -s, c],
    ]
}
