//! Coarse grids over the flanks of a gear whose mesh has too many flank nodes.

use std::collections::BTreeMap;

use geometry::{Gear, Side};
use mesh::{Face, FaceKind, MeshedGear};
use reduction::{FlankGrid, FlankGrids};

use crate::{ContactError, flank::FlankPatch};

/// Grids of `counts` quadratic faces (profile, face width) over the flanks on `sides` of `teeth`; `tolerance` (mm) is
/// that of flank patches.
///
/// The load on a grid node is distributed to the mesh nodes of the face on which it lies, by that face's shape
/// functions.
///
/// # Errors
/// [`ContactError::Reduction`] for a flank that the mesh does not have, [`ContactError::Flank`] if it does not lie on
/// its smooth surface.
pub fn flank_grids(
    gear: &MeshedGear,
    geometry: &Gear,
    teeth: &[u32],
    sides: &[Side],
    counts: [usize; 2],
    tolerance: f64,
) -> Result<FlankGrids, ContactError> {
    const NAME: &str = "gear";
    let mut grids = BTreeMap::new();
    for &tooth in teeth {
        for &side in sides {
            let missing = || ContactError::Reduction {
                gear: NAME,
                source: reduction::ReductionError::MissingFlank { tooth, side, available: gear.teeth() },
            };
            let faces = gear.flank(tooth, side).ok_or_else(missing)?;
            let surface = Box::new(geometry.flank_of(side, i64::from(tooth)));
            let patch = FlankPatch::new(i64::from(tooth), surface, &gear.mesh().nodes, faces, Some, tolerance)
                .map_err(|source| ContactError::Flank { gear: NAME, source: Box::new(source) })?;
            grids.insert((tooth, side), grid(&patch, counts).ok_or_else(missing)?);
        }
    }
    Ok(grids)
}

fn grid(patch: &FlankPatch, [nu, nz]: [usize; 2]) -> Option<FlankGrid> {
    let [low, high] = patch.range();
    let (rows, columns) = (2 * nu + 1, 2 * nz + 1);
    let (mut positions, mut loads) = (Vec::new(), Vec::new());
    for i in 0..rows {
        for j in 0..columns {
            let share = [i as f64 / (rows - 1) as f64, j as f64 / (columns - 1) as f64];
            let at = [0, 1].map(|k| low[k] + share[k] * (high[k] - low[k]));
            positions.push(patch.surface().point(at).into());
            loads.push(patch.node_weights(patch.nearest_face_at(at)?));
        }
    }
    let node = |i: usize, j: usize| (i * columns + j) as u32;
    let face = |i: usize, j: usize| {
        let (a, b) = (2 * i, 2 * j);
        let corners = [node(a, b), node(a + 2, b), node(a + 2, b + 2), node(a, b + 2)];
        let edges = [node(a + 1, b), node(a + 2, b + 1), node(a + 1, b + 2), node(a, b + 1)];
        Face::new(FaceKind::Quad9, &[&corners[..], &edges, &[node(a + 1, b + 1)]].concat())
    };
    let faces = (0..nu).flat_map(|i| (0..nz).map(move |j| (i, j))).map(|(i, j)| face(i, j)).collect();
    Some(FlankGrid { faces, positions, loads })
}
