//! Estimated time and memory of the remaining work.

use fem::PartedFactor;

use crate::{Observer, meshes::SceneMesh};

/// From so many seconds on who waits is told before the work.
const LONG_S: f64 = 20.0;

/// Tells how long the reduction of both gears takes and how much memory, where that is long; hands the seconds on.
/// `general`: without the symmetry of the teeth; `sides`: of the teeth, each of which takes a reduction.
pub(crate) fn announced_seconds(
    observer: &mut dyn Observer,
    (general, meshes): (bool, &[SceneMesh; 2]),
    sides: f64,
) -> f64 {
    let seconds = sides * estimated_seconds(general, meshes);
    if seconds >= LONG_S {
        let time = if seconds < 120.0 { format!("{seconds:.0} s") } else { format!("{:.0} min", seconds / 60.0) };
        let gb = meshes.iter().map(|mesh| factor_gb(general, mesh)).sum::<f64>();
        let memory = if gb >= 1.0 { format!(" and {gb:.0} GB of memory") } else { String::new() };
        observer
            .note(format!("reducing the gears takes some {time}{memory} on two cores, unless they are in the cache"));
    }
    seconds
}

/// About what the factor of a whole gear takes with its stiffness, GB: 86 000 rows that are held of a factor in pieces take
/// 0.5 GB, and a row of the stiffness of quadratic hexahedra 1.6 kB. One sector takes little.
fn factor_gb(general: bool, mesh: &SceneMesh) -> f64 {
    match size(general, mesh) {
        Size::Sector { .. } => 0.0,
        Size::Whole { dof } => 0.5 * PartedFactor::rows_held(dof as usize) as f64 / 86e3 + 1.6e-6 * dof,
    }
}

/// About how long the reduction of both gears takes, s; for those who wait only. On two cores of 2020 or so: a sector
/// of 8 000 degrees of freedom 0.4 s, a whole gear of 124 000 degrees of freedom 5 s and of 662 000 45 s.
fn estimated_seconds(general: bool, meshes: &[SceneMesh; 2]) -> f64 {
    meshes.iter().map(|mesh| estimated_gear_seconds(general, mesh)).fold(0.0, f64::max)
}

/// Estimated time of the reduction of one gear, s.
pub(crate) fn estimated_gear_seconds(general: bool, mesh: &SceneMesh) -> f64 {
    match size(general, mesh) {
        Size::Sector { dof, whole } => 0.4 * (dof / 8e3).powf(1.8) + 1e-6 * whole,
        Size::Whole { dof } => 5.0 * (dof / 124e3).powf(1.3),
    }
}

/// What is factored of a gear, degrees of freedom.
enum Size {
    /// One sector, of a mesh of so many in all.
    Sector { dof: f64, whole: f64 },
    /// All of it.
    Whole { dof: f64 },
}

fn size(general: bool, mesh: &SceneMesh) -> Size {
    let gear = &mesh.gear;
    let nodes = gear.mesh().nodes.len();
    let (dof, teeth) = (3.0 * nodes as f64, gear.tooth_count() as usize);
    if gear.is_periodic_sector() {
        return Size::Sector { dof, whole: 0.0 };
    }
    // Whether all teeth are the same is found out on the way; a mesh made tooth by tooth has as many nodes in each.
    let alike = gear.is_whole_gear() && nodes.is_multiple_of(teeth);
    if alike && !general { Size::Sector { dof: dof / teeth as f64, whole: dof } } else { Size::Whole { dof } }
}
