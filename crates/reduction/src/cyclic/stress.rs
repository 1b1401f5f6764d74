//! Stress at nodes of a cyclic gear, known by what one sector's loads do to the sectors about it.

use std::collections::BTreeMap;

use faer::Mat;
use fem::{StressOperator, dense};
use mesh::Face;

use super::CyclicGear;
use crate::{ReductionError, stress_recovery::StressRecovery};

/// Stress at some nodes under forces on the coordinates, in the frame of copy 0.
///
/// ```text
/// sigma = sum over copies, turned:  share S_d R' f,   S_d = Q' [X delta_d0 + T u_c(d)]
/// ```
/// A window of w teeth has w (w + 2) blocks of stress by force; of their distances d only 2 w + 1 differ, and S_d is
/// stored once each, in the sector's own frame.
#[derive(Debug, Clone)]
pub(crate) struct SectorStress {
    /// S_d, 6 rows a node of the sector, a column a load of it, MPa/N, by sectors behind the stress.
    local: BTreeMap<u32, Mat<f64>>,
    /// Loaded copies: turn of their frame.
    loaded: Vec<[[f64; 3]; 3]>,
    /// Loaded copy and load of each coordinate node.
    coordinates: Vec<(usize, usize)>,
    /// Copies with nodes: turn of a tensor, and distance from each loaded copy.
    copies: Vec<([[f64; 6]; 6], Vec<u32>)>,
    /// Copy, first row of S_d, and share in the mean of each node.
    shares: Vec<Vec<(usize, usize, f64)>>,
}

impl SectorStress {
    /// Stress at each node under forces on the coordinates (N), MPa.
    pub(crate) fn under(&self, forces: &[f64]) -> Vec<[f64; 6]> {
        let rows = self.local.values().next().map_or(0, Mat::nrows);
        let loads = self.local.values().next().map_or(0, Mat::ncols);
        let mut own = vec![vec![0.0; loads]; self.loaded.len()];
        for (&(from, load), force) in self.coordinates.iter().zip(forces.as_chunks::<3>().0) {
            for (b, own) in own[from][3 * load..3 * load + 3].iter_mut().enumerate() {
                *own += (0..3).map(|a| self.loaded[from][a][b] * force[a]).sum::<f64>();
            }
        }
        let mut stress = vec![[0.0; 6]; self.shares.len()];
        for (copy, (turn, distances)) in self.copies.iter().enumerate() {
            let mut here = vec![0.0; rows];
            for (own, distance) in own.iter().zip(distances) {
                let Some(local) = self.local.get(distance) else { continue };
                // Column by column, as the matrix lies in memory.
                for (column, &force) in local.col_iter().zip(own).filter(|(_, force)| **force != 0.0) {
                    here.iter_mut().zip(column.iter()).for_each(|(s, &mode)| *s += mode * force);
                }
            }
            for (stress, shares) in stress.iter_mut().zip(&self.shares) {
                for &(_, from, share) in shares.iter().filter(|s| s.0 == copy) {
                    for (s, row) in stress.iter_mut().zip(turn) {
                        *s += share * row.iter().zip(&here[from..from + 6]).map(|(t, s)| t * s).sum::<f64>();
                    }
                }
            }
        }
        stress
    }

    /// Stress for unit forces on the coordinates, MPa/N: 6 rows a node.
    pub(crate) fn matrix(&self) -> Mat<f64> {
        let mut stress = Mat::<f64>::zeros(6 * self.shares.len(), 3 * self.coordinates.len());
        for (copy, (turn, distances)) in self.copies.iter().enumerate() {
            let local = self.turned_loads(distances);
            for (i, shares) in self.shares.iter().enumerate() {
                for &(_, from, share) in shares.iter().filter(|s| s.0 == copy) {
                    for k in 0..stress.ncols() {
                        for (a, row) in turn.iter().enumerate() {
                            let turned: f64 = row.iter().enumerate().map(|(b, t)| t * local[(from + b, k)]).sum();
                            stress[(6 * i + a, k)] += share * turned;
                        }
                    }
                }
            }
        }
        stress
    }

    /// What unit forces on the coordinates do in a copy so far from the loaded ones, in its frame.
    fn turned_loads(&self, distances: &[u32]) -> Mat<f64> {
        let rows = self.local.values().next().map_or(0, Mat::nrows);
        let mut of = Mat::zeros(rows, 3 * self.coordinates.len());
        for (i, &(from, load)) in self.coordinates.iter().enumerate() {
            let Some(own) = self.local.get(&distances[from]) else { continue };
            for (a, turn) in self.loaded[from].iter().enumerate() {
                for row in 0..rows {
                    of[(row, 3 * i + a)] = (0..3).map(|b| own[(row, 3 * load + b)] * turn[b]).sum();
                }
            }
        }
        of
    }
}

impl CyclicGear {
    /// Stress at nodes of the larger mesh by forces on the coordinates, in the frame of copy 0.
    ///
    /// On a cut the mean is over the elements (faces) on both of its sides.
    pub(crate) fn stress(&self, nodes: &[u32], recovery: StressRecovery) -> Result<SectorStress, ReductionError> {
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
        let mut copies: Vec<u32> = parts.iter().flatten().map(|p| p.0).collect();
        for list in [&mut own, &mut copies] {
            list.sort_unstable();
            list.dedup();
        }
        let (mesh, dofs) = (self.sector.mesh(), &self.sector.dofs);
        let operator = match &faces {
            None => StressOperator::new(mesh, &self.material, &self.elements, dofs, &own)?,
            Some(faces) => StressOperator::on_surface(mesh, &self.material, dofs, faces, &own)?,
        };
        let [by_load, by_cut] = self.sector.stress(&operator)?;
        let unit = Mat::<f64>::identity(self.sector.loads(), self.sector.loads());
        let offsets = copies.iter().flat_map(|&to| self.loaded().map(move |from| self.apart(from, to)));
        let ends = self.ends_about(unit.as_ref(), offsets);
        // Of a sector by loads so many sectors behind it, all in their own frames.
        let of = |(d, ends): (u32, Mat<f64>)| {
            let through = dense::product(by_cut.as_ref(), ends.as_ref());
            (d, if d == 0 { through + &by_load } else { through })
        };
        let local = ends.into_iter().map(of).collect();
        let place = |&(copy, node, share): &(u32, u32, f64)| {
            (copies.partition_point(|&c| c < copy), 6 * own.partition_point(|&known| known < node), share)
        };
        let shares = parts.iter().map(|part| part.iter().map(place).collect()).collect();
        let loaded: Vec<u32> = self.loaded().collect();
        let at = |&(copy, load): &(u32, usize)| (loaded.iter().position(|&l| l == copy).unwrap_or(0), load);
        let coordinates = self.coordinates.iter().map(at).collect();
        let distances = |&to: &u32| loaded.iter().map(|&from| self.apart(from, to)).collect();
        let copies = copies.iter().map(|to| (tensor_turn(self.angle(*to)), distances(to))).collect();
        let loaded = loaded.iter().map(|&from| self.turn(from)).collect();
        Ok(SectorStress { local, loaded, coordinates, copies, shares })
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
