//! Torques of the meshes of a train from equilibrium alone: of closed loops their even shares.

use geometry::Gear;
use nalgebra::{DMatrix, DVector};

use crate::{GearMesh, Operation, Structure};

/// Singular values over the largest arm that are round-off.
const SINGULAR: f64 = 1e-10;
/// Torques left over the loads that are round-off.
const SAME: f64 = 1e-9;

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

/// Torques (N mm about +z) of each mesh on its gear 1 and its gear 2, without friction, of closed loops the shares with
/// the least sum of squared forces: those of planets that are all alike, and a measure of what the loops must carry,
/// since of n meshes one has at least 1/sqrt(n) of their root of squares. Those of [`mesh_torques`] where there is no
/// loop.
///
/// ```text
/// sum_m a_m r_m F_m + sum T_loads = 0   on every shaft that turns, but that of the input;   sum F_m^2 -> min
/// a_m = 1 on gear 1, z_2/z_1 on gear 2 (below zero of a ring);   r_m: pitch radius of gear 1
/// ```
///
/// A load on a carrier is held by the input and the shaft that is fixed in space, by their meshes together.
///
/// `None` where no forces of the teeth are in equilibrium: a load on a shaft that no mesh reaches.
pub fn even_mesh_torques(structure: &Structure, meshes: &[GearMesh], operation: &Operation) -> Option<Vec<[f64; 2]>> {
    let shaft = |disc: usize| Some(structure.discs.get(disc)?.shaft);
    let input = shaft(operation.input)?;
    let turns = |own: usize| own != input && structure.fixed != Some(own) && !structure.standing.contains(&own);
    let holds = |own: usize| structure.fixed.is_some_and(|fixed| own == fixed || own == input);
    // The last row is that of the carrier.
    let carrier = structure.shafts.len();
    let mut a = DMatrix::zeros(carrier + 1, meshes.len());
    let mut b = DVector::zeros(carrier + 1);
    let arms: Vec<[f64; 2]> = meshes.iter().map(|mesh| arms(&mesh.pair.pinion, &mesh.pair.wheel)).collect();
    for (i, (mesh, arms)) in meshes.iter().zip(&arms).enumerate() {
        for (disc, arm) in mesh.discs.into_iter().zip(arms) {
            let own = shaft(disc)?;
            if turns(own) {
                a[(own, i)] += arm;
            } else if holds(own) {
                a[(carrier, i)] += arm;
            }
        }
    }
    for load in &operation.torques {
        let own = shaft(load.disc)?;
        if turns(own) {
            b[own] -= load.torque;
        } else if structure.fixed.is_some() && structure.standing.contains(&own) {
            b[carrier] += load.torque;
        }
    }
    if !operation.torques.iter().any(|load| shaft(load.disc).is_some_and(|own| structure.standing.contains(&own))) {
        // Where the carrier drives, its torque follows from the others.
        a.row_mut(carrier).fill(0.0);
    }
    let (size, scale): (f64, f64) = (b.norm(), a.amax());
    let forces = a.clone().svd(true, true).solve(&b, SINGULAR * scale).ok()?;
    if (&a * &forces - b).norm() > SAME * size {
        return None;
    }
    Some(arms.iter().zip(forces.iter()).map(|(arms, force)| arms.map(|arm| arm * force)).collect())
}

/// Arms of a tangential force on gear 1 and gear 2, mm: torques of both per unit of force.
fn arms(one: &Gear, two: &Gear) -> [f64; 2] {
    let arm = one.reference_radius().abs();
    [arm, arm * two.signed_teeth() / one.signed_teeth()]
}
