//! Contact pressure as a field on the flank nodes.

use std::collections::BTreeMap;

use crate::{flank::FlankPatch, nodal::ContactRow};

/// Pressure (MPa) at the boundary nodes of body `body` (0 or 1): nodal force divided by nodal area.
///
/// ```text
/// p_i = sum_j |N_i(x_j)| F_j / integral of |N_i|
/// ```
/// The forces of single points scatter if there are more points than nodes, because only their sums on the nodes act on
/// the body. These sums converge with the mesh. `patches` are all patches of the body, `rows` all rows of the contact.
pub fn nodal_pressures(patches: &[FlankPatch], body: usize, rows: &[ContactRow], forces: &[f64]) -> BTreeMap<u32, f64> {
    let mut areas = BTreeMap::new();
    for (node, area) in patches.iter().flat_map(FlankPatch::nodal_areas) {
        *areas.entry(node).or_insert(0.0) += area;
    }
    let mut pressures: BTreeMap<u32, f64> = areas.keys().map(|&node| (node, 0.0)).collect();
    for (row, f) in rows.iter().zip(forces).filter(|(_, f)| **f > 0.0) {
        let support = &row.supports[body];
        for (node, w) in support.nodes[..support.count].iter().zip(&support.weights[..support.count]) {
            if let (Some(p), Some(area)) = (pressures.get_mut(node), areas.get(node))
                && *area > 0.0
            {
                *p += w.abs() * f / area;
            }
        }
    }
    pressures
}
