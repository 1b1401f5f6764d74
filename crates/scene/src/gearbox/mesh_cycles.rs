//! Cycles of the fastest mesh per rotation of the input, from the numbers of teeth.

use super::file::{GearboxGear, GearboxMesh};

/// Cycles of the fastest mesh in a turn of the shaft `input`; 0 where it drives no mesh.
///
/// Speeds spread from the input over the meshes: a shaft takes that of the first mesh which reaches it.
pub(super) fn fastest_per_turn(input: usize, meshes: &[GearboxMesh], gears: &[GearboxGear]) -> f64 {
    let shafts = gears.iter().map(|gear| gear.shaft + 1).chain([input + 1]).max().unwrap_or(0);
    let mut ratios: Vec<Option<f64>> = vec![None; shafts];
    ratios[input] = Some(1.0);
    let teeth = |mesh: &GearboxMesh| [&mesh.scene.pinion, &mesh.scene.wheel].map(|gear| f64::from(gear.teeth).abs());
    loop {
        let next = meshes.iter().find_map(|mesh| {
            let ([a, b], [z_a, z_b]) = (mesh.gears.map(|gear| gears[gear].shaft), teeth(mesh));
            match (ratios[a], ratios[b]) {
                (Some(own), None) => Some((b, own * z_a / z_b)),
                (None, Some(own)) => Some((a, own * z_b / z_a)),
                _ => None,
            }
        });
        let Some((shaft, ratio)) = next else { break };
        ratios[shaft] = Some(ratio);
    }
    let cycles = |mesh: &GearboxMesh| ratios[gears[mesh.gears[0]].shaft].unwrap_or(0.0) * teeth(mesh)[0];
    meshes.iter().map(cycles).fold(0.0, f64::max)
}
