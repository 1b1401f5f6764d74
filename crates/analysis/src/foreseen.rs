//! How long what is to come will take.

use scene::{Reduction, Scene};

use crate::meshes::SceneMesh;

/// About how long the reduction of both gears takes, s; for the progress bar only. On two cores of 2020 or so: a sector
/// of 8 000 degrees of
/// freedom 0.4 s, a whole gear of 86 000 degrees of freedom 4 s and of 338 000 35 s.
pub fn foreseen_s(scene: &Scene, meshes: &[SceneMesh; 2]) -> f64 {
    let of = |m: &SceneMesh| {
        let gear = &m.gear;
        let dof = 3 * gear.mesh().nodes.len();
        let teeth = gear.tooth_count() as usize;
        // Whether all teeth are the same is found out on the way; a mesh made tooth by tooth has as many nodes in each.
        let whole = gear.is_whole_gear() && gear.mesh().nodes.len().is_multiple_of(teeth);
        let cyclic = gear.is_periodic_sector() || (whole && scene.analysis.reduction != Some(Reduction::General));
        match (cyclic, gear.is_periodic_sector()) {
            (true, true) => sector_s(dof),
            (true, false) => sector_s(dof / teeth) + 1e-6 * dof as f64,
            (false, _) => 4.0 * (dof as f64 / 86e3).powf(1.6),
        }
    };
    meshes.iter().map(of).fold(0.0, f64::max)
}

fn sector_s(dof: usize) -> f64 {
    0.4 * (dof as f64 / 8e3).powf(1.8)
}
