//! Compliance of a half tooth clamped beyond its centre surface: the part of a mesh's compliance that a closed form
//! replaces.

use std::collections::BTreeMap;

use faer::Mat;
use fem::{BoundaryLastFactor, DofMap, ElementOptions, Material, SymmetricMatrix};
use geometry::{Gear, Side};
use mesh::{ElementBlock, Mesh, MeshedGear};

use crate::{FlankGrid, LayerProfile, ReductionError, cyclic::face_nodes, general::load_compliance, load::missing};

/// Compliance W_c of a flank when everything is clamped except the half of its tooth between the flank and the tooth's
/// centre surface.
///
/// A point load on a mesh makes an indentation whose depth depends on the mesh and not on the gear. The same
/// indentation is in W (the whole gear) and in W_c, so W - W_c is free of it. W - W_c describes the deflection of the
/// tooth's centre surface; it is smooth and nearly the same on every mesh. The indentation itself is computed in closed
/// form (crate `contact`, `LocalContact`). The free nodes are those above the root circle on the loaded side of the
/// centre surface. W - W_c is positive semi-definite, because clamping only reduces compliance.
#[derive(Debug, Clone)]
pub struct LocalCompliance {
    /// Flank nodes, as numbers of the mesh, ascending.
    pub nodes: Vec<u32>,
    /// W_c, mm/N, 3 n x 3 n, with coordinates as in [`crate::ReducedGear`]; the rows of a clamped node are 0.
    pub compliance: Mat<f64>,
    /// Mean distance by which the clamped nodes next to the free half lie beyond the centre surface, mm; 0 if the mesh
    /// has nodes on that surface. The layer is deeper by this distance.
    pub overshoot: f64,
    /// Response of this half to a line load whose contact band is resolved.
    pub layer: LayerProfile,
}

/// Distances below this count as on the surface, relative to the normal module.
const ON_SURFACE: f64 = 1e-3;

impl LocalCompliance {
    /// The half of tooth `tooth` behind its flank on `side`.
    ///
    /// # Errors
    /// [`ReductionError::MissingFlank`], [`ReductionError::Fem`].
    pub fn new(
        gear: &MeshedGear,
        geometry: &Gear,
        material: &Material,
        elements: &ElementOptions,
        tooth: u32,
        side: Side,
    ) -> Result<Self, ReductionError> {
        let nodes = face_nodes(gear.flank(tooth, side).ok_or_else(|| missing(gear, (tooth, side)))?);
        let half = FreeHalf::new(gear, geometry, material, elements, tooth, side)?;
        let kept: Vec<usize> = nodes.iter().filter_map(|n| half.position(*n)).flat_map(|p| 3 * p..3 * p + 3).collect();
        let small = BoundaryLastFactor::new(&half.stiffness, &kept)?.compliance();
        // Rows of nodes that are clamped (a pointed tip) stay zero.
        let at: Vec<usize> = (0..nodes.len()).filter(|&i| half.position(nodes[i]).is_some()).collect();
        let mut compliance = Mat::zeros(3 * nodes.len(), 3 * nodes.len());
        for (b, &j) in at.iter().enumerate() {
            for (a, &i) in at.iter().enumerate() {
                for (y, x) in (0..3).flat_map(|y| (0..3).map(move |x| (y, x))) {
                    compliance[(3 * i + x, 3 * j + y)] = small[(3 * a + x, 3 * b + y)];
                }
            }
        }
        let layer = LayerProfile::new(geometry, material.poisson(), half.overshoot)?;
        Ok(Self { nodes, compliance, overshoot: half.overshoot, layer })
    }

    /// Local compliance for loads on the nodes of a grid; `nodes` are then those of the grid.
    ///
    /// # Errors
    /// [`ReductionError::Fem`].
    pub fn on_grid(
        gear: &MeshedGear,
        geometry: &Gear,
        material: &Material,
        elements: &ElementOptions,
        (tooth, side): (u32, Side),
        grid: &FlankGrid,
    ) -> Result<Self, ReductionError> {
        let half = FreeHalf::new(gear, geometry, material, elements, tooth, side)?;
        let factor = BoundaryLastFactor::new(&half.stiffness, &[])?;
        let compliance = load_compliance(factor.n(), &grid.loads, |n| half.position(n), |rhs| Ok(factor.solve(rhs)?))?;
        let layer = LayerProfile::new(geometry, material.poisson(), half.overshoot)?;
        let nodes = (0..grid.positions.len() as u32).collect();
        Ok(Self { nodes, compliance, overshoot: half.overshoot, layer })
    }
}

/// The free half of a tooth as a structure of its own.
struct FreeHalf {
    /// Number of each of its nodes in the part, by number of the mesh.
    number: BTreeMap<u32, u32>,
    dofs: DofMap,
    stiffness: SymmetricMatrix,
    overshoot: f64,
}

impl FreeHalf {
    fn new(
        gear: &MeshedGear,
        geometry: &Gear,
        material: &Material,
        elements: &ElementOptions,
        tooth: u32,
        side: Side,
    ) -> Result<Self, ReductionError> {
        let place = ToothHalf::new(geometry, tooth, side);
        let mesh = gear.mesh();
        let free: Vec<bool> = mesh.nodes.iter().map(|p| place.is_free(p)).collect();
        let (part, number) = elements_with(mesh, &free);
        let fixed: Vec<u32> = number.iter().filter(|(n, _)| !free[**n as usize]).map(|(_, &p)| p).collect();
        let dofs = DofMap::new(part.nodes.len(), &fixed);
        let stiffness = fem::assemble_stiffness(&part, material, &dofs, elements)?;
        let past: Vec<f64> = fixed.iter().filter_map(|&p| place.past_centre(&part.nodes[p as usize])).collect();
        let overshoot = if past.is_empty() { 0.0 } else { past.iter().sum::<f64>() / past.len() as f64 };
        Ok(Self { number, dofs, stiffness, overshoot })
    }

    /// Place of a node of the mesh among the free ones.
    fn position(&self, node: u32) -> Option<usize> {
        self.dofs.position(*self.number.get(&node)?)
    }
}

/// Where the free half of a tooth is.
struct ToothHalf {
    sign: f64,
    /// -1 for a ring, whose radii are negative.
    radial: f64,
    centre: f64,
    twist: f64,
    half_pitch: f64,
    root_radius: f64,
    tolerance: f64,
}

impl ToothHalf {
    fn new(geometry: &Gear, tooth: u32, side: Side) -> Self {
        Self {
            sign: side.sign(),
            centre: geometry.flank_of(side, i64::from(tooth)).centre_angle,
            twist: geometry.twist(),
            half_pitch: 0.5 * geometry.pitch_angle().abs(),
            radial: geometry.sign(),
            root_radius: geometry.root_radius(),
            tolerance: ON_SURFACE * geometry.data().normal_module,
        }
    }

    /// Radius, and angle from the centre surface towards the flank, within half a turn; of a ring both are negative there.
    fn polar(&self, &[x, y, z]: &[f64; 3]) -> (f64, f64) {
        let angle = (self.radial * y).atan2(self.radial * x) - self.centre - self.twist * z;
        let turn = std::f64::consts::TAU;
        (self.radial * x.hypot(y), self.sign * (angle - turn * (angle / turn).round()))
    }

    fn is_free(&self, p: &[f64; 3]) -> bool {
        let (r, angle) = self.polar(p);
        r > self.root_radius + self.tolerance
            && r * angle.sin() > self.tolerance
            && self.radial * angle < self.half_pitch
    }

    /// Distance past the centre surface of a clamped point of the tooth, mm; `None` for points of the rim and the next
    /// tooth.
    fn past_centre(&self, p: &[f64; 3]) -> Option<f64> {
        let (r, angle) = self.polar(p);
        let inside = r > self.root_radius + self.tolerance && angle.abs() < self.half_pitch;
        (inside && r * angle.sin() <= self.tolerance).then(|| (-r * angle.sin()).max(0.0))
    }
}

/// The elements that have at least one marked node, and the new number of each of their nodes.
fn elements_with(mesh: &Mesh, marked: &[bool]) -> (Mesh, BTreeMap<u32, u32>) {
    let mut blocks: Vec<ElementBlock> = Vec::new();
    for block in &mesh.blocks {
        let mut part = ElementBlock { kind: block.kind, connectivity: Vec::new(), tags: Vec::new() };
        for (element, &tag) in block.elements().zip(&block.tags) {
            if element.iter().any(|&n| marked[n as usize]) {
                part.connectivity.extend_from_slice(element);
                part.tags.push(tag);
            }
        }
        if !part.is_empty() {
            blocks.push(part);
        }
    }
    let mut number: BTreeMap<u32, u32> = blocks.iter().flat_map(|b| &b.connectivity).map(|&n| (n, 0)).collect();
    number.values_mut().zip(0..).for_each(|(p, i)| *p = i);
    for node in blocks.iter_mut().flat_map(|b| &mut b.connectivity) {
        *node = number[node];
    }
    let nodes = number.keys().map(|&n| mesh.nodes[n as usize]).collect();
    let node_tags = number.keys().map(|&n| mesh.node_tags[n as usize]).collect();
    (Mesh { nodes, node_tags, blocks, ..Mesh::default() }, number)
}
