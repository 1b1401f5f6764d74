//! Stress at nodes of a cyclic gear, from the effect of one sector's loads on the sectors around it.

use std::sync::Arc;

use faer::{Mat, MatRef};
use fem::{StressOperator, dense};
use mesh::Face;

use super::{CyclicGear, recovery::Share, seat::turned};
use crate::{ReductionError, stress_recovery::StressRecovery};

/// Stress at some nodes under forces on the coordinates, in the frame of copy 0.
///
/// ```text
/// sigma = sum over copies, turned:  share D B u,   u = X f + T u_c
/// ```
/// Nothing is stored window by window: u is the displacement of one sector about the nodes ([`NearField`]).
#[derive(Debug, Clone)]
pub(crate) struct SectorStress {
    field: Arc<NearField>,
    /// D B of the sector's nodes, 6 rows each, by the freedoms of the field.
    operator: StressOperator,
    /// Copy, first row of D B, and share in the mean of each node.
    shares: Vec<Vec<(usize, usize, f64)>>,
}

/// Displacement of some freedoms of a sector in some copies, each in its own frame.
///
/// ```text
/// u(j) = X f(j) + T [v(j); v(j + 1)],   v(j) = sum over loaded copies i:  V(j - i) f(i)
/// ```
/// | name | shape  | unit | meaning                                                                             |
/// |------|--------|------|-------------------------------------------------------------------------------------|
/// | f(i) | 3m     | N    | forces on the loads of copy i                                                       |
/// | v(j) | c      | mm   | cut between copies j - 1 and j                                                       |
/// | V(d) | c x 3m | mm/N | cut so many sectors behind the left cut of the loaded one: 2 w + 2 for a window of w |
/// | X    | s x 3m | mm/N | freedoms asked for, by loads, cuts held                                             |
/// | T    | s x 2c | 1    | the same by cuts                                                                    |
#[derive(Debug)]
struct NearField {
    by_load: Mat<f64>,
    by_cut: Mat<f64>,
    /// V, one below the other.
    cuts: Mat<f64>,
    /// Loads of the seat by forces on the loads of one sector, in its frame, 6 x 3m; none of other bores.
    seat: Mat<f64>,
    /// Loaded copies: turn of their frame.
    loaded: Vec<[[f64; 3]; 3]>,
    /// Loaded copy and load of each coordinate node.
    coordinates: Vec<(usize, usize)>,
    copies: Vec<FieldCopy>,
}

/// A copy in which displacements are asked for.
#[derive(Debug)]
struct FieldCopy {
    /// Which of the loaded ones it is.
    loaded: Option<usize>,
    /// Turn of a tensor into the frame of copy 0.
    turn: [[f64; 6]; 6],
    /// For each loaded copy the place among V of left and right cut.
    cuts: Vec<[usize; 2]>,
    /// For each loaded copy the angle from its frame to this one's, rad.
    angles: Vec<f64>,
}

impl NearField {
    /// u of every copy, one after the other, s x (copies k), for forces on the coordinates (N, n x k).
    fn under(&self, forces: MatRef<'_, f64>) -> Mat<f64> {
        let (k, loads, six) = (forces.ncols(), self.by_load.ncols(), self.seat.nrows());
        let c = (self.by_cut.ncols() - six) / 2;
        let mut own = Mat::<f64>::zeros(loads, k * self.loaded.len());
        for (i, &(from, load)) in self.coordinates.iter().enumerate() {
            for (j, b) in (0..k).flat_map(|j| (0..3).map(move |b| (j, b))) {
                own[(3 * load + b, k * from + j)] +=
                    (0..3).map(|a| self.loaded[from][a][b] * forces[(3 * i + a, j)]).sum::<f64>();
            }
        }
        let moved = dense::product(self.cuts.as_ref(), own.as_ref());
        let balanced = dense::product(self.seat.as_ref(), own.as_ref());
        let mut ends = Mat::<f64>::zeros(2 * c + six, k * self.copies.len());
        let mut loaded = Mat::<f64>::zeros(loads, k * self.copies.len());
        for (to, copy) in self.copies.iter().enumerate() {
            for (from, cuts) in copy.cuts.iter().enumerate() {
                for (end, cut) in cuts.iter().enumerate() {
                    let mut sum = ends.as_mut().submatrix_mut(end * c, k * to, c, k);
                    sum += moved.submatrix(cut * c, k * from, c, k);
                }
            }
            for (from, &angle) in copy.angles.iter().enumerate().filter(|_| six > 0) {
                let mut sum = ends.as_mut().submatrix_mut(2 * c, k * to, six, k);
                sum += turned(balanced.subcols(k * from, k), -angle);
            }
            if let Some(from) = copy.loaded {
                loaded.as_mut().subcols_mut(k * to, k).copy_from(own.subcols(k * from, k));
            }
        }
        dense::product(self.by_load.as_ref(), loaded.as_ref()) + dense::product(self.by_cut.as_ref(), ends.as_ref())
    }
}

impl SectorStress {
    /// Stress under forces on the coordinates (N, n x k), MPa: 6 rows a node.
    pub(crate) fn under(&self, forces: MatRef<'_, f64>) -> Result<Mat<f64>, ReductionError> {
        let k = forces.ncols();
        let own = self.operator.apply(self.field.under(forces).as_ref())?;
        let mut stress = Mat::<f64>::zeros(6 * self.shares.len(), k);
        for (i, shares) in self.shares.iter().enumerate() {
            for &(copy, from, share) in shares {
                for (a, row) in self.field.copies[copy].turn.iter().enumerate() {
                    for j in 0..k {
                        let turned: f64 = row.iter().enumerate().map(|(b, t)| t * own[(from + b, k * copy + j)]).sum();
                        stress[(6 * i + a, j)] += share * turned;
                    }
                }
            }
        }
        Ok(stress)
    }

    /// Stress for unit forces on the coordinates, MPa/N: 6 rows a node.
    pub(crate) fn matrix(&self) -> Result<Mat<f64>, ReductionError> {
        let n = 3 * self.field.coordinates.len();
        self.under(Mat::<f64>::identity(n, n).as_ref())
    }
}

/// Nodes with a stress, as those of copies of the sector.
struct Recovered {
    operator: StressOperator,
    /// Ascending; 6 rows each.
    own: Vec<u32>,
    parts: Vec<Vec<Share>>,
}

impl CyclicGear {
    /// Stress at nodes of the larger mesh by forces on the coordinates, in the frame of copy 0, by some recoveries, which
    /// share what they know of the displacement.
    ///
    /// On a cut the mean is over the elements (faces) on both of its sides.
    pub(crate) fn stress<const N: usize>(
        &self,
        nodes: &[u32],
        recoveries: [StressRecovery<'_>; N],
    ) -> [Result<SectorStress, ReductionError>; N] {
        let recovered = recoveries.map(|recovery| self.recovered(nodes, recovery));
        let known = || recovered.iter().flatten();
        let mut copies: Vec<u32> = known().flat_map(|r| &r.parts).flatten().map(|p| p.0).collect();
        copies.sort_unstable();
        copies.dedup();
        let moved = StressOperator::moved(known().map(|r| &r.operator));
        let field = self.near_field(&moved, &copies).map(Arc::new);
        recovered.map(|recovered| {
            let Recovered { operator, own, parts } = recovered?;
            let place = |&(copy, node, share): &Share| {
                (copies.partition_point(|&c| c < copy), 6 * own.partition_point(|&known| known < node), share)
            };
            let shares = parts.iter().map(|part| part.iter().map(place).collect()).collect();
            Ok(SectorStress { field: field.clone()?, operator: operator.of(&moved), shares })
        })
    }

    fn recovered(&self, nodes: &[u32], recovery: StressRecovery<'_>) -> Result<Recovered, ReductionError> {
        let faces = match recovery {
            StressRecovery::Volume => None,
            StressRecovery::Surface(faces) => Some(faces.iter().map(|faces| self.own_faces(faces)).collect::<Vec<_>>()),
        };
        let touching = match &faces {
            None => self.sector.elements_about(),
            Some(faces) => {
                let mut count = vec![0; self.part.mesh.nodes.len()];
                faces.iter().flatten().flat_map(Face::nodes).for_each(|&n| count[n as usize] += 1);
                count
            }
        };
        let parts = self.shares(nodes, &touching)?;
        let mut own: Vec<u32> = parts.iter().flatten().map(|p| p.1).collect();
        own.sort_unstable();
        own.dedup();
        let (mesh, dofs) = (self.sector.mesh(), &self.sector.dofs);
        let operator = match &faces {
            None => StressOperator::new(mesh, &self.material, &self.elements, dofs, &own)?,
            Some(faces) => StressOperator::on_surface(mesh, &self.material, dofs, faces, &own)?,
        };
        Ok(Recovered { operator, own, parts })
    }

    /// Displacement of free nodes of the sector, by their place among these, in some copies.
    fn near_field(&self, moved: &[usize], copies: &[u32]) -> Result<NearField, ReductionError> {
        let z = self.part.teeth;
        let loaded: Vec<u32> = self.loaded().collect();
        // Cuts by distance: the right cut of a sector is the left one of the next.
        let apart = |&to: &u32| loaded.iter().map(move |&from| [0, 1].map(|end| (self.apart(from, to) + end) % z));
        let mut distances: Vec<u32> = copies.iter().flat_map(apart).flatten().collect();
        distances.sort_unstable();
        distances.dedup();
        let unit = Mat::<f64>::identity(self.sector.loads(), self.sector.loads());
        let loads = self.sector_loads(unit.as_ref());
        let mut cuts = Mat::zeros(distances.len() * self.sector.cut, unit.ncols());
        for (i, cut) in self.cuts_under(&loads, &distances).iter().enumerate() {
            cuts.as_mut().subrows_mut(i * self.sector.cut, self.sector.cut).copy_from(cut);
        }
        let at = |distance: u32| distances.partition_point(|&d| d < distance);
        let copy = |to: &u32| FieldCopy {
            loaded: loaded.iter().position(|from| from == to),
            turn: tensor_turn(self.angle(*to)),
            cuts: apart(to).map(|ends| ends.map(at)).collect(),
            angles: loaded.iter().map(|from| self.angle(self.apart(*from, *to))).collect(),
        };
        let seat = self.sector.seat().map(|own| own.seat.balance(loads.resultants.as_ref()));
        let of = |&(copy, load): &(u32, usize)| (loaded.iter().position(|&l| l == copy).unwrap_or(0), load);
        let rows: Vec<usize> = moved.iter().flat_map(|&place| 3 * place..3 * place + 3).collect();
        let [by_load, by_cut] = self.sector.rows_of_field(&rows)?;
        Ok(NearField {
            by_load,
            by_cut,
            cuts,
            seat: seat.unwrap_or_else(|| Mat::zeros(0, unit.ncols())),
            loaded: loaded.iter().map(|&from| self.turn(from)).collect(),
            coordinates: self.coordinates.iter().map(of).collect(),
            copies: copies.iter().map(copy).collect(),
        })
    }
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
