//! The solved contact of a pair, or of a mesh of a gearbox, in the form that ratings need.

use contact::{Site, SliceResult};
use gearbox::MeshState;
use geometry::Sense;
use ltca::StaticHistory;
use rating::PressedPlace;
use scene::Scene;

use crate::results::{PressurePlace, PressureSpot, base_radius_mm, face_load_factor, largest_tensions, mesh_tensions};

/// What ratings read of a solved contact, all positions together.
#[derive(Debug)]
pub(crate) struct SolvedMesh {
    /// K_Hbeta of the solved distribution of the load.
    pub face_load_factor: Option<f64>,
    /// Places that press.
    pub pressed: Vec<PressedPlace>,
    /// Largest pressure, MPa, and its place; `None` without slices.
    pub hardest: Option<(f64, PressurePlace)>,
    /// Largest first principal stresses of the fillets, MPa; `None` where they are not computed.
    pub root_tensions: Option<[f64; 2]>,
    /// Positions.
    pub positions: usize,
    /// Sums over the positions of the moments on pinion and wheel, N mm without sign.
    pub moments: [f64; 2],
}

impl SolvedMesh {
    /// Values of a static pair.
    pub fn of(scene: &Scene, history: &StaticHistory) -> Self {
        let positions = &history.positions;
        let largest = positions.iter().map(|p| p.max_pressure).fold(0.0, f64::max);
        let moment = |gear: usize| positions.iter().map(|p| p.wrench[gear].moment[2].abs()).sum::<f64>();
        let pairs = positions.iter().flat_map(|p| &p.pairs);
        Self {
            face_load_factor: face_load_factor(scene.contact.slices.unwrap_or(1) as usize, positions),
            pressed: pairs.flat_map(|pair| pressed(scene, pair.normal_force, &pair.slices)).collect(),
            hardest: PressurePlace::of(scene, history).map(|place| (largest, place)),
            root_tensions: largest_tensions(positions.iter().map(|p| &p.root_stress)),
            positions: positions.len(),
            moments: [0, 1].map(moment),
        }
    }

    /// Values of a mesh of a static gearbox, whose slices are those of all its tooth pairs.
    pub fn of_mesh(scene: &Scene, meshes: &[&MeshState], sense: Sense) -> Self {
        let slices = || meshes.iter().flat_map(|m| &m.slices);
        let hardest = SliceResult::hardest(slices()).and_then(|hardest| {
            let own = meshes.iter().find(|m| m.slices.iter().any(|s| std::ptr::eq(s, hardest)))?;
            let spot = PressureSpot::of(base_radius_mm(scene, 0), [hardest])?;
            let turned = 360.0 * sense.sign() as f64 * own.cycles / f64::from(scene.pinion.teeth);
            Some((hardest.pressure, PressurePlace::of_spot(&spot, turned, own.cycles.rem_euclid(1.0))))
        });
        let moment = |gear: usize| meshes.iter().map(|m| m.moment[gear][2].abs()).sum::<f64>();
        Self {
            face_load_factor: ltca::face_load_factor(scene.contact.slices.unwrap_or(1) as usize, slices()),
            pressed: meshes.iter().flat_map(|m| pressed(scene, m.normal_force, &m.slices)).collect(),
            hardest,
            root_tensions: mesh_tensions(meshes),
            positions: meshes.len(),
            moments: [0, 1].map(moment),
        }
    }
}

/// Places of some slices whose normal forces add up to a force, N.
fn pressed(scene: &Scene, normal_force: f64, slices: &[SliceResult]) -> Vec<PressedPlace> {
    let base = [0, 1].map(|gear| base_radius_mm(scene, gear));
    let all: f64 = slices.iter().map(|s| s.line_load).sum();
    let share = if all > 0.0 { normal_force / all } else { 0.0 };
    let place = |s: &SliceResult| PressedPlace {
        radii: [0, 1].map(|gear| base[gear] * s.roll[gear].abs()),
        force: share * s.line_load,
        line_load: s.line_load,
        pressure: s.pressure,
        is_edge: matches!(s.site, Site::PinionTipEdge | Site::WheelTipEdge),
    };
    slices.iter().map(place).collect()
}
