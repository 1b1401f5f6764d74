//! One sector instead of a gear.
//!
//! All teeth of a sound gear are the same, in frames turned by 2 pi / z. One sector is condensed once ([`sector`]); the
//! sectors outside the window are equal super-elements and are joined by doubling ([`chain`]); the window's sectors
//! close the ring:
//!
//! ```text
//!   c_0   c_1        c_w                         K_ring u_c = H_w f          (cuts of the ring)
//!    |--1--|-- ... --|                           C = diag(A) + H_w' K_ring^-1 H_w
//!    |               |
//!    +---- chain ----+    z - w sectors          u = X f + T u_c in every sector
//! ```
//! The result is the condensation of the whole gear to round-off, at the cost of one sector. Nothing is approximated:
//! cuts are eliminated as any other freedom is.

mod chain;
mod placement;
mod recovery;
mod sector;
mod sector_mesh;
mod turn;
mod vibration;

use faer::{Mat, MatMut, MatRef};
use fem::{ElementOptions, Material, Wanted, dense, unless_unwanted};
use mesh::Origin;

use crate::{ReductionError, load::Load};
use chain::Chain;
use placement::{Placed, arc, placed};
use sector::Sector;
pub(crate) use sector_mesh::SectorMesh;
pub(crate) use turn::{PitchTurn, face_nodes};
pub(crate) use vibration::VibratingSector;

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
    /// Condenses the sector and closes the ring; `loads` are on nodes of the larger mesh, those on single nodes if
    /// `keep`.
    ///
    /// `None` when a load lies on a cut or reaches over one: then the sector is not one for these loads.
    pub(crate) fn new(
        part: SectorMesh,
        material: &Material,
        elements: &ElementOptions,
        loads: &[Load],
        keep: bool,
        wanted: Wanted<'_>,
    ) -> Result<Option<Self>, ReductionError> {
        let Some(Placed { coordinates, own }) = placed(&part, loads) else { return Ok(None) };
        let (first, count) = arc(coordinates.iter().map(|c| c.0), part.teeth);
        let sector = Sector::new(&part, material, elements, &own, keep, wanted)?;
        let rest = (part.teeth - count) as usize;
        let chain = (rest > 0).then(|| Chain::new(&sector.stiffness, rest, wanted)).transpose()?;
        unless_unwanted(wanted)?;
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

    /// The sector with its mass and without loads.
    pub(crate) fn vibrating(&self) -> Result<VibratingSector, ReductionError> {
        VibratingSector::new(&self.part, &self.material, &self.elements)
    }

    /// Whether another gear is made of the same sector.
    pub(crate) fn has_sector_of(&self, other: &Self) -> bool {
        let [a, b] = [&self.part, &other.part];
        a.teeth == b.teeth && a.way == b.way && a.mesh == b.mesh && a.held == b.held
    }

    /// Copy and node of the sector under a node of the larger mesh.
    pub(crate) fn place(&self, node: u32) -> Option<Origin> {
        self.part.places.get(node as usize).copied()
    }

    /// Loads on nodes of the larger mesh as those of one sector, each different one once.
    pub(crate) fn own_loads(&self, loads: &[Load]) -> Vec<Load> {
        placed(&self.part, loads).map(|p| p.own).unwrap_or_default()
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
        self.part.way * (std::f64::consts::TAU * f64::from(copy % self.part.teeth) / f64::from(self.part.teeth))
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
