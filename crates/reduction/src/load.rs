//! Coordinates of a reduced gear: its flank nodes, or weighted means over them that belong to unit loads on a grid.

use std::collections::BTreeMap;

use geometry::Side;
use mesh::{Face, MeshedGear};

use crate::ReductionError;

/// Nodes of a mesh that carry a unit load, and their shares.
pub(crate) type Load = Vec<(u32, f64)>;

/// A coarse mesh of faces over one flank. Loads on its nodes act on the nodes of the fine mesh around them.
///
/// W - W_c of slice contact is smooth over half a tooth thickness, so a grid of this size is fine enough, and the size
/// of the reduced gear does not grow with the mesh. Positions and loads are in the gear's own frame.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankGrid {
    /// Faces of the grid; node numbers count the grid's nodes from 0.
    pub faces: Vec<Face>,
    /// Positions of the grid nodes, mm.
    pub positions: Vec<[f64; 3]>,
    /// For each grid node, the mesh nodes that carry a unit load on it, with their shares.
    pub loads: Vec<Vec<(u32, f64)>>,
}

/// Grids by tooth and side.
pub type FlankGrids = BTreeMap<(u32, Side), FlankGrid>;

/// What is kept of a flank.
#[derive(Debug)]
pub(crate) enum Coordinates {
    /// Nodes of the flanks.
    FlankNodes,
    /// Means over them.
    Grids(FlankGrids),
}

impl Coordinates {
    /// Whether every coordinate is a node's own displacement.
    pub(crate) fn are_nodes(&self) -> bool {
        matches!(self, Self::FlankNodes)
    }

    /// The boundary nodes of a window: numbers of the mesh, ascending, or of the grids' nodes in turn.
    pub(crate) fn nodes(&self, gear: &MeshedGear, teeth: &[u32], sides: &[Side]) -> Result<Vec<u32>, ReductionError> {
        match self {
            Self::FlankNodes => boundary_nodes(gear, teeth, sides),
            Self::Grids(grids) => {
                let mut count = 0;
                for_each_flank(teeth, sides, |flank| {
                    count += grids.get(&flank).ok_or_else(|| missing(gear, flank))?.positions.len() as u32;
                    Ok(())
                })?;
                Ok((0..count).collect())
            }
        }
    }

    /// The unit loads that belong to the boundary nodes.
    pub(crate) fn loads(&self, gear: &MeshedGear, teeth: &[u32], sides: &[Side]) -> Result<Vec<Load>, ReductionError> {
        match self {
            Self::FlankNodes => {
                Ok(boundary_nodes(gear, teeth, sides)?.into_iter().map(|node| vec![(node, 1.0)]).collect())
            }
            Self::Grids(grids) => {
                let mut loads = Vec::new();
                for_each_flank(teeth, sides, |flank| {
                    loads.extend_from_slice(&grids.get(&flank).ok_or_else(|| missing(gear, flank))?.loads);
                    Ok(())
                })?;
                Ok(loads)
            }
        }
    }
}

fn for_each_flank(
    teeth: &[u32],
    sides: &[Side],
    mut visit: impl FnMut((u32, Side)) -> Result<(), ReductionError>,
) -> Result<(), ReductionError> {
    teeth.iter().flat_map(|&tooth| sides.iter().map(move |&side| (tooth, side))).try_for_each(&mut visit)
}

/// The flank that a mesh or a set of grids does not have.
pub(crate) fn missing(gear: &MeshedGear, (tooth, side): (u32, Side)) -> ReductionError {
    ReductionError::MissingFlank { tooth, side, available: gear.teeth() }
}

/// Nodes of the flanks, ascending, each once.
fn boundary_nodes(gear: &MeshedGear, teeth: &[u32], sides: &[Side]) -> Result<Vec<u32>, ReductionError> {
    let mut nodes = Vec::new();
    for_each_flank(teeth, sides, |(tooth, side)| {
        let faces = gear.flank(tooth, side).ok_or_else(|| missing(gear, (tooth, side)))?;
        for &node in faces.iter().flat_map(|f| f.nodes()) {
            if gear.bore_nodes().binary_search(&node).is_ok() {
                let node = gear.mesh().node_tags[node as usize];
                return Err(ReductionError::BoreOnFlank { node, tooth, side });
            }
            nodes.push(node);
        }
        Ok(())
    })?;
    nodes.sort_unstable();
    nodes.dedup();
    Ok(nodes)
}
