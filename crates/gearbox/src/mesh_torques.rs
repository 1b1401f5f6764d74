//! Torques of the meshes of a train without closed loops, from equilibrium alone.

use geometry::Gear;

use crate::{GearMesh, Operation, Structure};

/// Torques (N mm about +z) of each mesh on its gear 1 and its gear 2, without friction. `None` if meshes form a closed
/// loop, in which the shares depend on stiffness, and if a shaft fixed in space takes a torque.
///
/// ```text
/// T_mesh + sum T_loads + sum T_meshes beyond = 0 on every shaft but that of the input,   T_1 / T_2 = z_1 / z_2 (below zero of a ring)
/// ```
pub fn mesh_torques(structure: &Structure, meshes: &[GearMesh], operation: &Operation) -> Option<Vec<[f64; 2]>> {
    if structure.fixed.is_some() {
        return None;
    }
    let shaft = |disc: usize| Some(structure.discs.get(disc)?.shaft);
    let ends = meshes.iter().map(|m| Some([shaft(m.discs[0])?, shaft(m.discs[1])?])).collect::<Option<Vec<_>>>()?;
    // Shafts from the input on, each with the mesh and the end of it by which it was reached.
    let mut order: Vec<(usize, Option<(usize, usize)>)> = vec![(shaft(operation.input)?, None)];
    let mut at = 0;
    while let Some(&(own, by)) = order.get(at) {
        for (i, both) in ends.iter().enumerate().filter(|(i, _)| by.is_none_or(|(mesh, _)| mesh != *i)) {
            for (from, to) in [(0, 1), (1, 0)] {
                if both[from] == own {
                    if order.iter().any(|(known, _)| *known == both[to]) {
                        return None;
                    }
                    order.push((both[to], Some((i, to))));
                }
            }
        }
        at += 1;
    }
    let mut on_shaft = vec![0.0; structure.shafts.len()];
    for load in &operation.torques {
        *on_shaft.get_mut(shaft(load.disc)?)? += load.torque;
    }
    let mut all = vec![[0.0; 2]; meshes.len()];
    for &(own, by) in order.iter().rev() {
        let Some((mesh, end)) = by else { continue };
        let teeth = [&meshes[mesh].pair.pinion, &meshes[mesh].pair.wheel].map(Gear::signed_teeth);
        let torque = 0.0 - on_shaft[own];
        // Forces on both gears of an external pair have the same sense about their own axes, those of a ring the other.
        let other = torque * teeth[1 - end] / teeth[end];
        all[mesh][end] = torque;
        all[mesh][1 - end] = other;
        on_shaft[ends[mesh][1 - end]] += other;
    }
    Some(all)
}
