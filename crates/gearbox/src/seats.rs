//! Shafts, bearings and housing condensed to the seats of gears and couplings. Theory (83).

use fem::Condensation;
use nalgebra::{DMatrix, DVector};

use crate::{Assembly, GearboxError};

/// Seats: the places of the shafts that forces act on, six coordinates each, and which of them are free. Rolling
/// bearings, preloaded ones and those in carriers are such places; after them come the open seats of the housing.
///
/// ```text
/// K_s = T' K T,   q = T y   (all other coordinates follow, exactly at rest);   y = B z
/// ```
/// B leaves out the held turn of the input, and lets the seats of a held shaft turn about its axis together.
#[derive(Debug, Clone)]
pub(crate) struct Seats {
    /// First coordinate of each seat among those of the assembly.
    nodes: Vec<usize>,
    /// Shaft of each seat.
    shafts: Vec<usize>,
    size: usize,
    condensation: Condensation,
    /// K_s.
    pub stiffness: DMatrix<f64>,
    /// B.
    pub basis: DMatrix<f64>,
}

impl Seats {
    /// Seats of the discs on which forces act. `held` tells which shafts are rigid in rigid bearings.
    pub fn new(assembly: &Assembly, discs: &[usize], held: &[bool], input: usize) -> Result<Self, GearboxError> {
        let (mut nodes, mut shafts) = (Vec::new(), Vec::new());
        for &disc in discs {
            let shaft = assembly.structure().discs[disc].shaft;
            let Some(node) = assembly.disc(disc) else { continue };
            if !nodes.contains(&node) {
                nodes.push(node);
                shafts.push(shaft);
            }
        }
        for (i, bearing) in assembly.structure().bearings.iter().enumerate() {
            let acts = bearing.law.is_some() || bearing.is_pressed() || assembly.structure().seat_turns(bearing);
            for ((node, _), shaft) in
                assembly.bearing_ends(i).zip([Some(bearing.shaft), bearing.outer].into_iter().flatten())
            {
                if acts && !nodes.contains(&node) {
                    nodes.push(node);
                    shafts.push(shaft);
                }
            }
        }
        let open = assembly.supports().open();
        let in_housing = open.iter().filter_map(|b| assembly.open_seat(*b)).flat_map(|at| at..at + 6);
        let kept: Vec<usize> = nodes.iter().flat_map(|n| *n..*n + 6).chain(in_housing).collect();
        let mut k = assembly.stiffness_without_meshes();
        // A held shaft keeps no elasticity of its own: what it does to the housing, it does not by moving.
        for (shaft, _) in held.iter().enumerate().filter(|(_, h)| **h) {
            assembly.hold(shaft, &mut k, &kept);
        }
        let condensation = Condensation::new(&k, &kept)?;
        let raw = condensation.of(&k);
        let stiffness = 0.5 * (&raw + raw.transpose());
        let input_node = assembly.disc(input);
        let input_shaft = assembly.structure().discs[input].shaft;
        let mut columns: Vec<DVector<f64>> = Vec::new();
        let mut turning: Vec<usize> = Vec::new();
        for (seat, (&node, &shaft)) in nodes.iter().zip(&shafts).enumerate() {
            for axis in 0..6 {
                let mut column = DVector::zeros(kept.len());
                if held[shaft] {
                    if axis != 5 || shaft == input_shaft || turning.contains(&shaft) {
                        continue;
                    }
                    turning.push(shaft);
                    shafts.iter().enumerate().filter(|(_, s)| **s == shaft).for_each(|(i, _)| column[6 * i + 5] = 1.0);
                } else if axis == 5 && Some(node) == input_node {
                    continue;
                } else {
                    column[6 * seat + axis] = 1.0;
                }
                columns.push(column);
            }
        }
        for (at, &bearing) in open.iter().enumerate() {
            let shaft = assembly.structure().bearings[bearing].shaft;
            for axis in 0..6 {
                // What neither rolling elements nor the housing hold stays where it is.
                if assembly.supports().is_housed(bearing, axis) || (axis < 5 && !held[shaft]) {
                    let mut column = DVector::zeros(kept.len());
                    column[6 * (nodes.len() + at) + axis] = 1.0;
                    columns.push(column);
                }
            }
        }
        let basis = DMatrix::from_fn(kept.len(), columns.len(), |i, j| columns[j][i]);
        let size = kept.len();
        Ok(Self { nodes, shafts, size, condensation, stiffness, basis })
    }

    /// First coordinate of a disc's seat in the list of seat coordinates.
    pub fn of_disc(&self, assembly: &Assembly, disc: usize) -> Option<usize> {
        self.of_node(assembly.disc(disc)?)
    }

    /// First coordinate of a node in the list of seat coordinates, from its first coordinate in the assembly.
    pub fn of_node(&self, node: usize) -> Option<usize> {
        Some(6 * self.nodes.iter().position(|n| *n == node)?)
    }

    /// First coordinate of an open seat of the housing in the list of seat coordinates.
    pub fn of_open(&self, assembly: &Assembly, at: usize) -> Option<usize> {
        let first = assembly.supports().open().first().and_then(|b| assembly.open_seat(*b))?;
        Some(6 * self.nodes.len() + at - first)
    }

    /// Converts forces on all coordinates to forces on the seats; there must be no forces elsewhere.
    pub fn of_all(&self, forces: &DVector<f64>, assembly: &Assembly) -> DVector<f64> {
        let mut own = DVector::zeros(self.size);
        for (i, node) in self.nodes.iter().enumerate() {
            (0..6).for_each(|k| own[6 * i + k] = forces[node + k]);
        }
        for at in assembly.supports().open().iter().filter_map(|b| assembly.open_seat(*b)) {
            if let Some(to) = self.of_open(assembly, at) {
                (0..6).for_each(|k| own[to + k] = forces[at + k]);
            }
        }
        own
    }

    /// Seats of a shaft, each with its first coordinate among the seats and in the assembly.
    pub fn on_shaft(&self, shaft: usize) -> impl Iterator<Item = (usize, usize)> {
        let all = self.nodes.iter().zip(&self.shafts).enumerate();
        all.filter(move |(_, (_, s))| **s == shaft).map(|(i, (node, _))| (6 * i, *node))
    }

    /// Number of coordinates of all seats.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Displacements of all nodes from those of the seats.
    pub fn all(&self, seats: &DVector<f64>) -> DVector<f64> {
        &self.condensation.map * seats
    }
}
