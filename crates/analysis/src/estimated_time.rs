//! How long what is to come will take, and how much memory.

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

/// About what the factor of a whole gear takes, GB: of nested dissection in space it grows with the power 4/3, and
/// 86 000 degrees of freedom take 0.5 GB. One sector takes little.
fn factor_gb(general: bool, mesh: &SceneMesh) -> f64 {
    match size(general, mesh) {
        Size::Sector { .. } => 0.0,
        Size::Whole { dof } => 0.5 * (dof / 86e3).powf(4.0 / 3.0),
    }
}

/// About how long the reduction of both gears takes, s; for those who wait only. On two cores of 2020 or so: a sector
/// of 8 000 degrees of freedom 0.4 s, a whole gear of 86 000 degrees of freedom 4 s and of 338 000 35 s.
fn estimated_seconds(general: bool, meshes: &[SceneMesh; 2]) -> f64 {
    meshes.iter().map(|mesh| estimated_gear_seconds(general, mesh)).fold(0.0, f64::max)
}

/// Estimated time of the reduction of one gear, s.
pub(crate) fn estimated_gear_seconds(general: bool, mesh: &SceneMesh) -> f64 {
    match size(general, mesh) {
        Size::Sector { dof, whole } => 0.4 * (dof / 8e3).powf(1.8) + 1e-6 * whole,
        Size::Whole { dof } => 4.0 * (dof / 86e3).powf(1.6),
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
