//! Condensation of a cyclic gear from one of its sectors.
//!
//! All teeth of a gear without defects are equal in frames that are rotated by 2 pi / z. One sector is condensed once
//! ([`sector`]). The others are equal super-elements; they are joined by doubling ([`chain`]) and close the ring:
//!
//! ```text
//!   c_0   c_1                     K_ring u_c = H f                    (two cuts, f on the sector between them)
//!    |--0--|                      u_c of the other sectors            (down the joins of the chain)
//!    |     |                      B_d = delta_d0 A + H' u_c(d)        (of the loads d sectors on)
//!    +chain+    z - 1 sectors     u = X f + T u_c in every sector
//! ```
//! Loads on any sector are rotated loads on the first one. So the compliance of a window of teeth consists of the
//! blocks B_d = B_-d', which follow from the loads of one tooth. The result equals the condensation of the whole gear
//! to round-off, at the cost of one sector. Nothing is approximated: the degrees of freedom of the cuts are eliminated
//! like any others.

mod between;
mod blocks;
mod bolt_fields;
mod bolts;
mod chain;
mod placement;
mod pressures;
mod recovery;
mod seat;
mod sector;
mod sector_mesh;
mod stress;
mod turn;
mod vibration;

use std::collections::BTreeMap;

use faer::{Mat, MatRef};
use fem::{BoundaryLastFactor, ElementOptions, Material, Wanted, dense, unless_unwanted};
use mesh::Origin;

use crate::{ReductionError, load::Load};
pub(crate) use blocks::{ToothBlocks, turned};
pub(crate) use bolts::BoltedGear;
use chain::{Chain, stacked};
use placement::{Placed, arc, placed};
use seat::SIX;
use sector::{SeatedSector, Sector};
pub(crate) use sector_mesh::SectorMesh;
pub(crate) use stress::SectorStress;
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
    /// All sectors but one.
    chain: Chain,
    /// L of K_ring = L L', 2c x 2c: the cuts of that one; with six springs where the bore is held by its means.
    ring: Mat<f64>,
    seat: Option<RingSeat>,
}

/// The seat of a bore that is held by its means in the ring of all sectors, as the cuts of one see it. Theory (13f).
///
/// ```text
/// K~ u_p = H f + H_g g,   g = -M^-1 R' f,   u_c = u_p - R_c M^-1 (G g + H_g' u_p + A_g' f)
/// ```
#[derive(Debug)]
struct RingSeat {
    /// H_g, 2c x 6, and G, 6 x 6.
    ends: Mat<f64>,
    own: Mat<f64>,
    /// R_c of the cuts, 2c x 6.
    rigid: Mat<f64>,
    /// R' of the sector's loads, 6 x 3m.
    of_loads: Mat<f64>,
}

/// What loads on one sector do: forces on its cuts and displacement along its seat, 2c (+ 6) x k, and their resultants, 6 x k.
struct SectorLoads {
    ends: Mat<f64>,
    resultants: Mat<f64>,
}

impl CyclicGear {
    /// Condenses the sector and closes the ring; `loads` are on nodes of the larger mesh, those on single nodes if
    /// `keep`. The sector's factor may be `known`.
    ///
    /// `None` when a load lies on a cut or reaches over one, or the sector is alone: then it is not one for these loads.
    pub(crate) fn new(
        part: SectorMesh,
        material: &Material,
        elements: &ElementOptions,
        loads: &[Load],
        (keep, known): (bool, Option<BoundaryLastFactor>),
        wanted: Wanted<'_>,
    ) -> Result<Option<Self>, ReductionError> {
        let Some(Placed { coordinates, own }) = placed(&part, loads) else { return Ok(None) };
        let Some(others) = part.teeth.checked_sub(1).filter(|&others| others > 0) else { return Ok(None) };
        let (first, count) = arc(coordinates.iter().map(|c| c.0), part.teeth);
        let sector = Sector::new(&part, material, elements, &own, (keep, known), wanted)?;
        let seat = sector.seat().map(|seat| seat.row.clone());
        let chain = Chain::new(&sector.stiffness, seat, others as usize, wanted)?;
        unless_unwanted(wanted)?;
        let ring = ring(&sector, &chain)?;
        let seat = sector.seat().map(|seat| RingSeat::new(&sector, seat, &chain));
        let (material, elements) = (*material, *elements);
        Ok(Some(Self { part, sector, material, elements, coordinates, first, count, chain, ring, seat }))
    }

    /// The sector's factor.
    pub(crate) fn factor(&self) -> &BoundaryLastFactor {
        self.sector.factor()
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
        a.teeth == b.teeth
            && a.way == b.way
            && a.mesh == b.mesh
            && a.held == b.held
            && a.bore == b.bore
            && a.seat == b.seat
    }

    /// Copy and node of the sector under a node of the larger mesh.
    pub(crate) fn place(&self, node: u32) -> Option<Origin> {
        self.part.places.get(node as usize).copied()
    }

    /// Loads on nodes of the larger mesh as those of one sector, each different one once.
    pub(crate) fn own_loads(&self, loads: &[Load]) -> Vec<Load> {
        placed(&self.part, loads).map(|p| p.own).unwrap_or_default()
    }

    /// C (mm/N), in the frame of copy 0, tooth by tooth.
    pub(crate) fn compliance(&self) -> ToothBlocks {
        let place = |&(copy, load): &(u32, usize)| [self.offset(copy) as u32, load as u32];
        ToothBlocks {
            blocks: self.blocks(),
            places: self.coordinates.iter().map(place).collect(),
            angles: (0..self.count).map(|j| self.angle(self.first + j)).collect(),
        }
    }

    /// B_d, d = 0 .. w - 1: displacements under the loads of the d-th sector on, in its frame, by unit loads on one in
    /// its own, mm/N, 3m x 3m each. B_0 is symmetric to the bit.
    fn blocks(&self) -> Vec<Mat<f64>> {
        let unit = Mat::<f64>::identity(self.sector.loads(), self.sector.loads());
        let ends = self.ends_about(unit.as_ref(), 0..self.count);
        let block = |(&d, ends): (&u32, &Mat<f64>)| {
            let through = dense::product(self.sector.transfer.transpose(), ends.as_ref());
            if d > 0 {
                return through;
            }
            let all = through + &self.sector.own;
            Mat::from_fn(all.nrows(), all.ncols(), |i, j| 0.5 * (all[(i, j)] + all[(j, i)]))
        };
        ends.iter().map(block).collect()
    }

    /// Turn from the frame of a copy into that of copy 0.
    fn turn(&self, copy: u32) -> [[f64; 3]; 3] {
        let (sin, cos) = self.angle(copy).sin_cos();
        [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]]
    }

    fn angle(&self, copy: u32) -> f64 {
        self.part.way * (std::f64::consts::TAU * f64::from(copy % self.part.teeth) / f64::from(self.part.teeth))
    }

    /// Sectors from the window's first to a copy.
    fn offset(&self, copy: u32) -> usize {
        let z = self.part.teeth;
        ((copy % z + z - self.first) % z) as usize
    }

    /// Displacements of both cuts and loads of the seat (2c (+ 6) x k, mm) of the sectors so many (below z) on from one whose
    /// loads take `forces` (3m x k, N), each in its own frame.
    fn ends_about(&self, forces: MatRef<'_, f64>, offsets: impl Iterator<Item = u32>) -> BTreeMap<u32, Mat<f64>> {
        self.ends_under(&self.sector_loads(forces), offsets)
    }

    /// The same of any loads on one sector.
    fn ends_under(&self, loads: &SectorLoads, offsets: impl Iterator<Item = u32>) -> BTreeMap<u32, Mat<f64>> {
        let z = self.part.teeth;
        let mut offsets: Vec<u32> = offsets.collect();
        offsets.sort_unstable();
        offsets.dedup();
        let mut distances: Vec<u32> = offsets.iter().flat_map(|&d| [d, (d + 1) % z]).collect();
        distances.sort_unstable();
        distances.dedup();
        let cuts = self.cuts_under(loads, &distances);
        let at = |distance: u32| cuts[distances.partition_point(|&d| d < distance)].as_ref();
        let seat = self.sector.seat().map(|own| (own, own.seat.balance(loads.resultants.as_ref())));
        let ends = |d: u32| {
            let cuts = stacked(at(d), at((d + 1) % z));
            match &seat {
                Some((own, g)) => stacked(cuts.as_ref(), own.seat.seen_from(g.as_ref(), d).as_ref()),
                None => cuts,
            }
        };
        offsets.into_iter().map(|d| (d, ends(d))).collect()
    }

    /// Forces on the loads of a sector (3m x k, N) as loads on it.
    fn sector_loads(&self, forces: MatRef<'_, f64>) -> SectorLoads {
        let resultants = match &self.seat {
            Some(seat) => dense::product(seat.of_loads.as_ref(), forces),
            None => Mat::zeros(0, forces.ncols()),
        };
        SectorLoads { ends: dense::product(self.sector.transfer.as_ref(), forces), resultants }
    }

    /// Displacements of the cuts (c x k, mm) at some `distances` (below z, in sectors) from the left one of a loaded sector, each in
    /// the frame of the sector on its counter-clockwise side.
    fn cuts_under(&self, loads: &SectorLoads, distances: &[u32]) -> Vec<Mat<f64>> {
        let (c, z) = (self.sector.cut, self.part.teeth);
        let mut own = loads.ends.get(..2 * c, ..).to_owned();
        let balance = self.sector.seat().map(|seat| seat.seat.balance(loads.resultants.as_ref()));
        if let (Some(seat), Some(g)) = (&self.seat, &balance) {
            own += dense::product(seat.ends.as_ref(), g.as_ref());
        }
        dense::solve_lower(self.ring.as_ref(), own.as_mut());
        dense::solve_lower_transposed(self.ring.as_ref(), own.as_mut());
        if let (Some(seat), Some(g), Some(of_sector)) = (&self.seat, &balance, self.sector.seat()) {
            let mean = dense::product(seat.own.as_ref(), g.as_ref())
                + dense::product(seat.ends.transpose(), own.as_ref())
                + loads.ends.get(2 * c.., ..);
            own += dense::product(seat.rigid.as_ref(), of_sector.seat.balance(mean.as_ref()).as_ref());
        }
        let (left, right) = own.as_ref().split_at_row(c);
        // Cut i of the chain is cut i + 1 of the gear; its last one is the sector's left one.
        let in_chain = |&d: &u32| ((d + z - 1) % z) as usize;
        let wanted: Vec<usize> = distances.iter().map(in_chain).collect();
        let of_chain = match (self.sector.seat(), &balance) {
            (Some(seat), Some(g)) => seat.seat.seen_from(g.as_ref(), 1),
            _ => Mat::zeros(SIX, own.ncols()),
        };
        let mut found = self.chain.cuts(stacked(right, left).as_ref(), of_chain.as_ref(), &wanted);
        wanted.iter().map(|cut| found.remove(cut).unwrap_or_else(|| left.to_owned())).collect()
    }

    /// The copies with loads.
    fn loaded(&self) -> impl Iterator<Item = u32> + Clone {
        let (first, z) = (self.first, self.part.teeth);
        (0..self.count).map(move |j| (first + j) % z)
    }

    /// Sectors from copy `from` to copy `to`.
    fn apart(&self, from: u32, to: u32) -> u32 {
        let z = self.part.teeth;
        (to % z + z - from % z) % z
    }

    /// Displacements of both cuts and loads of the seat (2c (+ 6) x k, mm) of some copies, each in its own frame, under forces on the coordinates
    /// (N, 3n x k).
    fn ends_of(&self, copies: &[u32], forces: MatRef<'_, f64>) -> Vec<Mat<f64>> {
        let (k, m) = (forces.ncols(), self.sector.loads());
        let mut own = Mat::<f64>::zeros(m, k * self.count as usize);
        for (j, copy) in self.loaded().enumerate() {
            own.as_mut().subcols_mut(j * k, k).copy_from(self.forces_in(copy, forces));
        }
        let offsets = copies.iter().flat_map(|&to| self.loaded().map(move |from| self.apart(from, to)));
        let found = self.ends_about(own.as_ref(), offsets);
        let sum = |&to: &u32| {
            let mut ends = Mat::<f64>::zeros(self.sector.ends(), k);
            for (j, from) in self.loaded().enumerate() {
                if let Some(all) = found.get(&self.apart(from, to)) {
                    ends += all.subcols(j * k, k);
                }
            }
            ends
        };
        copies.iter().map(sum).collect()
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
}

impl RingSeat {
    fn new(sector: &Sector, own: &SeatedSector, chain: &Chain) -> Self {
        let (c, seat) = (sector.cut, &own.seat);
        let mut ends = own.row.ends.clone();
        let mut sum = own.row.own.clone();
        if let Some(row) = &chain.seat {
            // The chain is seen from its first sector, the next one; it goes from the right cut to the left one.
            let seen = |x: MatRef<'_, f64>| seat::turned(x.transpose(), seat.pitch).transpose().to_owned();
            let of_chain = seen(row.ends.as_ref());
            ends += stacked(of_chain.get(c.., ..), of_chain.get(..c, ..));
            sum += seat::turned(seen(row.own.as_ref()).as_ref(), seat.pitch);
        }
        Self {
            ends,
            own: sum,
            rigid: sector.rigid_of_cuts(seat),
            of_loads: sector.rigid_of_loads(seat).transpose().to_owned(),
        }
    }
}

/// L of the stiffness of one sector's cuts in the ring, loads free.
fn ring(sector: &Sector, chain: &Chain) -> Result<Mat<f64>, ReductionError> {
    let c = sector.cut;
    let mut stiffness = sector.stiffness.clone();
    // The chain goes from the right cut to the left one.
    for (a, b) in (0..2).flat_map(|a| (0..2).map(move |b| (a, b))) {
        let mut block = stiffness.as_mut().submatrix_mut(a * c, b * c, c, c);
        block += chain.stiffness.as_ref().submatrix((1 - a) * c, (1 - b) * c, c, c);
    }
    // A free ring has no factor; loads in balance leave springs without force.
    for (seat, spring) in sector.seat().iter().flat_map(|own| own.seat.springs.map(|spring| (&own.seat, spring))) {
        stiffness[(spring, spring)] += seat.stiffness;
    }
    Ok(dense::cholesky(stiffness.as_ref())?)
}
