//! Mass, centre of mass and inertia of a body.

use mesh::{ElementKind, Mesh, element::QuadratureRule};
use rayon::prelude::*;

use crate::{
    FemError, Material,
    assembly::check_blocks,
    element_matrices::{Table, checked_jacobian},
};

/// Mass, centre of mass and inertia of a body.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct MassProperties {
    /// Volume, mm^3.
    pub volume_mm3: f64,
    /// Mass, t.
    pub mass_t: f64,
    /// Centre of mass, mm.
    pub centre_mm: [f64; 3],
    /// Inertia tensor about the centre of mass, t mm^2: J = integral rho ((x . x) I - x x').
    pub inertia_tmm2: [[f64; 3]; 3],
}

impl MassProperties {
    /// Inertia tensor about another `point` (mm), t mm^2 (Huygens and Steiner).
    pub fn inertia_about_tmm2(&self, point: [f64; 3]) -> [[f64; 3]; 3] {
        let d = [0, 1, 2].map(|a| self.centre_mm[a] - point[a]);
        std::array::from_fn(|a| std::array::from_fn(|b| self.inertia_tmm2[a][b] + self.mass_t * spread(d, a, b)))
    }
}

/// Entry (a, b) of (d . d) I - d d'.
fn spread(d: [f64; 3], a: usize, b: usize) -> f64 {
    let square = if a == b { d[0] * d[0] + d[1] * d[1] + d[2] * d[2] } else { 0.0 };
    square - d[a] * d[b]
}

/// Elements a parallel task sums up.
const CHUNK: usize = 1024;

/// Mass properties of a mesh of one material. The result has the same bits for any number of threads.
///
/// # Errors
/// [`FemError::Inverted`], [`FemError::NodeOutOfRange`], [`FemError::RaggedBlock`].
pub fn mass_properties(mesh: &Mesh, material: &Material) -> Result<MassProperties, FemError> {
    check_blocks(mesh)?;
    // moments about a point of the body: far from the origin the inertia would drown in round-off
    let origin = mesh.nodes.first().copied().unwrap_or_default();
    let mut total = Moments::default();
    for block in &mesh.blocks {
        let table = Table::new(block.kind, QuadratureRule::Mass);
        let nodes = block.kind.node_count();
        let parts: Vec<Result<Moments, FemError>> = block
            .connectivity
            .par_chunks(CHUNK * nodes)
            .zip(block.tags.par_chunks(CHUNK))
            .map(|(connectivity, tags)| {
                let mut sum = Moments::default();
                for (element, &tag) in connectivity.chunks(nodes).zip(tags) {
                    let x: Vec<[f64; 3]> = element
                        .iter()
                        .map(|&node| [0, 1, 2].map(|a| mesh.nodes[node as usize][a] - origin[a]))
                        .collect();
                    sum.add_element(block.kind, tag, &x, &table)?;
                }
                Ok(sum)
            })
            .collect();
        for part in parts {
            total.add(&part?);
        }
    }
    let Moments { volume, first, second } = total;
    let offset = first.map(|m| if volume > 0.0 { m / volume } else { 0.0 });
    let rho = material.density_t_per_mm3();
    let central = |a: usize, b: usize| second[a][b] - volume * offset[a] * offset[b];
    let trace = central(0, 0) + central(1, 1) + central(2, 2);
    Ok(MassProperties {
        volume_mm3: volume,
        mass_t: rho * volume,
        centre_mm: [0, 1, 2].map(|a| origin[a] + offset[a]),
        inertia_tmm2: std::array::from_fn(|a| {
            std::array::from_fn(|b| rho * (if a == b { trace } else { 0.0 } - central(a, b)))
        }),
    })
}

/// Integrals of 1, x and x x' over the volume.
#[derive(Debug, Clone, Copy, Default)]
struct Moments {
    volume: f64,
    first: [f64; 3],
    second: [[f64; 3]; 3],
}

impl Moments {
    fn add_element(
        &mut self,
        kind: ElementKind,
        tag: u64,
        coordinates: &[[f64; 3]],
        table: &Table,
    ) -> Result<(), FemError> {
        for point in &table.points {
            let (_, det) = checked_jacobian(kind, tag, coordinates, &point.dn)?;
            let volume = point.weight * det;
            let x = [0, 1, 2].map(|a| point.n.iter().zip(coordinates).map(|(n, x)| n * x[a]).sum::<f64>());
            self.volume += volume;
            for a in 0..3 {
                self.first[a] += volume * x[a];
                for b in 0..3 {
                    self.second[a][b] += volume * x[a] * x[b];
                }
            }
        }
        Ok(())
    }

    fn add(&mut self, other: &Self) {
        self.volume += other.volume;
        for a in 0..3 {
            self.first[a] += other.first[a];
            for b in 0..3 {
                self.second[a][b] += other.second[a][b];
            }
        }
    }
}
