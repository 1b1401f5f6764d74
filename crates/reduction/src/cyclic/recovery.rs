//! Recovers fields and mass of any sector from the loads.

use faer::{Mat, MatRef};
use mesh::{Face, Origin};

use super::{
    CyclicGear,
    chain::{Chain, congruent, stacked},
};
use crate::{ReductionError, load::Load};

/// Copy, node of the sector, and share in a nodal mean.
pub(super) type Share = (u32, u32, f64);

impl CyclicGear {
    /// Displacement of all free freedoms of the sector in some copies, each in its own frame, for forces on the
    /// coordinates (N, n x k): column k j + i is that of copy j under the i-th forces.
    fn fields(&self, copies: &[u32], forces: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        let k = forces.ncols();
        let ends = self.ends_of(copies, forces);
        let loads: Vec<Mat<f64>> = copies.iter().map(|&copy| self.forces_in(copy, forces)).collect();
        let parallel_map =
            |rows: usize, of: &[Mat<f64>]| Mat::from_fn(rows, copies.len() * k, |i, j| of[j / k][(i, j % k)]);
        let (f, ends) = (parallel_map(self.sector.loads(), &loads), parallel_map(self.sector.ends(), &ends));
        self.sector.field(self.sector.basis(f.as_ref(), ends.as_ref()).as_ref())
    }

    /// Displacement (mm) of nodes of the larger mesh (`None`: of every one) under forces on the coordinates (N, n x k)
    /// of the window that stands `shift` pitches on, in the mesh's frame; one list a column. Only sectors with such
    /// nodes are gone through.
    pub(crate) fn expand(
        &self,
        forces: MatRef<'_, f64>,
        shift: u32,
        nodes: Option<&[u32]>,
    ) -> Result<Vec<Vec<[f64; 3]>>, ReductionError> {
        let (z, k) = (self.part.teeth, forces.ncols());
        let every: Vec<u32>;
        let nodes = match nodes {
            Some(nodes) => nodes,
            None => {
                every = (0..self.part.places.len() as u32).collect();
                &every
            }
        };
        let place = |&node: &u32| {
            let count = self.part.places.len();
            let wrong = || fem::FemError::Shape { what: "nodes", expected: count, found: node as usize };
            self.part.places.get(node as usize).copied().ok_or_else(wrong)
        };
        let places = nodes.iter().map(place).collect::<Result<Vec<_>, _>>()?;
        let loaded = |copy: u32| (copy + z - shift % z) % z;
        let mut copies: Vec<u32> = places.iter().map(|p| loaded(p.copy)).collect();
        copies.sort_unstable();
        copies.dedup();
        let fields = self.fields(&copies, forces)?;
        // Of each copy its turn and its first column.
        let turned: Vec<([[f64; 3]; 3], usize)> =
            (0..z).map(|copy| (self.turn(copy), k * copies.partition_point(|&c| c < loaded(copy)))).collect();
        let rows = |node: u32| [0, 1, 2].map(|axis| self.sector.dofs.dof(node, axis));
        let known: Vec<[Option<usize>; 3]> = (0..self.part.mesh.nodes.len() as u32).map(rows).collect();
        let of_column = |i: usize| {
            let at = |p: &Origin| {
                let (turn, first) = &turned[p.copy as usize];
                let field = fields.col_as_slice(first + i);
                turned_by(turn, known[p.node as usize].map(|row| row.map_or(0.0, |row| field[row])))
            };
            places.iter().map(at).collect()
        };
        Ok((0..k).map(of_column).collect())
    }

    /// Displacement of a sector's node in one column of its fields, turned by so many pitches.
    fn at(&self, node: u32, pitches: u32, fields: MatRef<'_, f64>, column: usize) -> [f64; 3] {
        let u = [0, 1, 2].map(|axis| self.sector.dofs.dof(node, axis).map_or(0.0, |row| fields[(row, column)]));
        turned_by(&self.turn(pitches), u)
    }

    /// Coordinates of the window that stands `pitches` on, in its own frame, under forces on those of this one.
    pub(crate) fn carry(&self, forces: &[f64], pitches: u32, loads: &[Load]) -> Result<Vec<f64>, ReductionError> {
        let z = self.part.teeth;
        let mut copies: Vec<u32> = self.coordinates.iter().map(|c| (c.0 + pitches) % z).collect();
        copies.sort_unstable();
        copies.dedup();
        let fields = self.fields(&copies, MatRef::from_column_major_slice(forces, forces.len(), 1))?;
        let mut carried = Vec::with_capacity(3 * self.coordinates.len());
        for (&(copy, _), load) in self.coordinates.iter().zip(loads) {
            let column = copies.partition_point(|&c| c < (copy + pitches) % z);
            let mut mean = [0.0; 3];
            for &(node, weight) in load {
                let u = self.at(self.part.places[node as usize].node, copy, fields.as_ref(), column);
                mean.iter_mut().zip(u).for_each(|(m, u)| *m += weight * u);
            }
            carried.extend(mean);
        }
        Ok(carried)
    }

    /// Shares of which the nodal mean at each node is made.
    pub(super) fn shares(&self, nodes: &[u32], touching: &[u32]) -> Result<Vec<Vec<Share>>, ReductionError> {
        let z = self.part.teeth;
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

    /// Faces of the larger mesh as those of the sector, each once; faces that lie in a cut are left out.
    pub(super) fn own_faces(&self, faces: &[Face]) -> Vec<Face> {
        let z = self.part.teeth;
        let own = |face: &Face| {
            let places: Vec<Origin> =
                face.nodes().iter().map(|&n| self.part.places.get(n as usize).copied()).collect::<Option<_>>()?;
            // A node of the right cut is kept as one of the next copy's left cut.
            let in_copy = |copy: u32| -> Option<Vec<u32>> {
                let of = |p: &Origin| match (p.copy == copy, p.copy == (copy + 1) % z) {
                    (true, _) => Some(p.node),
                    (_, true) => self.part.right_of(p.node),
                    _ => None,
                };
                places.iter().map(of).collect()
            };
            let on_left = |p: &Origin| self.part.right_of(p.node).is_some();
            let first = places.iter().find(|p| !on_left(p)).or(places.first())?.copy;
            [first, (first + z - 1) % z].into_iter().find_map(in_copy).map(|nodes| Face::new(face.kind, &nodes))
        };
        let mut all: Vec<Face> = faces.iter().filter_map(own).collect();
        all.sort_by_key(Face::corner_key);
        all.dedup_by_key(|face| face.corner_key());
        all
    }

    /// M^ (t) of the coordinates, whose stiffness is `stiffness`, in the frame of copy 0.
    pub(crate) fn mass(&self, stiffness: &Mat<f64>) -> Result<Mat<f64>, ReductionError> {
        let own = self.sector.mass(&self.material)?;
        let (forces, z) = (stiffness.as_ref(), self.part.teeth);
        if self.sector.seat().is_some() {
            // Its seat loads every sector.
            let copies: Vec<u32> = (0..z).collect();
            let mut mass = Mat::<f64>::zeros(forces.nrows(), forces.ncols());
            for (&copy, ends) in copies.iter().zip(&self.ends_of(&copies, forces)) {
                mass += congruent(&own, &self.sector.basis(self.forces_in(copy, forces).as_ref(), ends.as_ref()));
            }
            return Ok(Mat::from_fn(mass.nrows(), mass.ncols(), |i, j| 0.5 * (mass[(i, j)] + mass[(j, i)])));
        }
        let mut copies: Vec<u32> = self.loaded().collect();
        // The sectors beside the window, whose cuts are the ends of the row of all others.
        copies.extend([(self.first + self.count) % z, (self.first + z - 1) % z]);
        let ends = self.ends_of(&copies, forces);
        let mut mass = Mat::<f64>::zeros(forces.nrows(), forces.ncols());
        for (copy, ends) in self.loaded().zip(&ends) {
            let basis = self.sector.basis(self.forces_in(copy, forces).as_ref(), ends.as_ref());
            mass += congruent(&own, &basis);
        }
        let (rest, w, c) = ((z - self.count) as usize, self.count as usize, self.sector.cut);
        if rest > 0 {
            let chain = Chain::new(&self.sector.stiffness, None, rest, &|| true)?;
            let unit = Mat::<f64>::identity(2 * c, 2 * c);
            let unloaded = Mat::<f64>::zeros(self.sector.loads(), 2 * c);
            let free = congruent(&own, &self.sector.basis(unloaded.as_ref(), unit.as_ref()));
            let ends = stacked(ends[w].get(..c, ..), ends[w + 1].get(c.., ..));
            mass += congruent(&chain.mass(&free), &ends);
        }
        Ok(Mat::from_fn(mass.nrows(), mass.ncols(), |i, j| 0.5 * (mass[(i, j)] + mass[(j, i)])))
    }
}

/// A displacement in the frame of copy 0.
pub(super) fn turned_by(turn: &[[f64; 3]; 3], u: [f64; 3]) -> [f64; 3] {
    turn.map(|[a, b, c]| a * u[0] + b * u[1] + c * u[2])
}
