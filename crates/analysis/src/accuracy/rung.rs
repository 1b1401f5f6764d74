//! Meshes of the built-in mesher that are refined uniformly in all five directions.

use mesh::GroupNames;
use scene::{MesherScene, Scene};
use serde::Serialize;

/// A mesh with a given number of elements along the active profile and corresponding fineness in every other direction.
///
/// Discretisation errors fall with one power of the element size only if all directions are refined uniformly.
/// Refinement along the profile alone converges to a wrong result (theory, section 15).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Rung {
    /// Elements along the active profile.
    pub elements_profile: u32,
}

/// Length of a face element over the normal module, times the number of elements along the profile.
const FACE_LENGTH_MODULES: f64 = 9.0;
/// Elements of fillet and rim beyond those along the profile: what the coarsest meshes lack first.
const MORE_IN_FILLET: u32 = 1;
const MORE_IN_RIM: u32 = 2;

impl Rung {
    /// Rungs of the ladder, from coarse to fine.
    pub const ALL: [Self; 7] = [
        Self::along_profile(2),
        Self::along_profile(3),
        Self::along_profile(4),
        Self::along_profile(6),
        Self::along_profile(8),
        Self::along_profile(10),
        Self::along_profile(12),
    ];

    const fn along_profile(elements_profile: u32) -> Self {
        Self { elements_profile }
    }

    /// The next coarser rung of the ladder.
    pub fn coarser(self) -> Option<Self> {
        Self::ALL.iter().rev().find(|r| **r < self).copied()
    }

    /// The next finer rung of the ladder.
    pub fn finer(self) -> Option<Self> {
        Self::ALL.iter().find(|r| **r > self).copied()
    }

    /// The rung of both gears of a scene; a gear that another mesh asks for may have more elements along the face.
    pub fn of(scene: &Scene) -> Option<Self> {
        let stands = |rung: &Self| {
            let own = rung.mesher(scene);
            scene.gears().iter().all(|g| {
                g.mesher.is_some_and(|m| {
                    let face = own.elements_face.max(m.elements_face);
                    MesherScene { sector_teeth: m.sector_teeth, elements_face: face, ..own } == m
                })
            })
        };
        Self::ALL.into_iter().find(stands)
    }

    /// Element counts for a gear of the scene's pair.
    ///
    /// Contact lines cross helical flanks obliquely; the larger the angle, the more elements are needed along the face.
    pub fn mesher(self, scene: &Scene) -> MesherScene {
        let n = self.elements_profile;
        let slope = scene.pinion.helix_angle().tan().abs();
        // Gears of two widths have one mesh, fine enough for the wider one.
        let [first, second] = scene.face_widths_mm();
        let modules = first.max(second) / scene.pair.normal_module_mm;
        let by_length = (f64::from(n) * modules / FACE_LENGTH_MODULES * (1.0 + slope)).ceil() as u32;
        let oblique = (f64::from(n) * slope).round() as u32;
        MesherScene {
            order: 2,
            elements_profile: n,
            elements_fillet: n + MORE_IN_FILLET,
            // Even, so that nodes lie on the tooth's centre surface, where slice contact cuts it.
            elements_thickness: 2 * n.div_ceil(3),
            elements_face: by_length.max(n + 2 + oblique),
            elements_rim: n + MORE_IN_RIM,
            ..MesherScene::default()
        }
    }

    /// The scene with both gears on this mesh; the number of teeth of an open sector is kept.
    pub fn scene(self, scene: &Scene) -> Scene {
        let mut own = scene.clone();
        let mesher = self.mesher(scene);
        for gear in [&mut own.pinion, &mut own.wheel] {
            let sector_teeth = gear.mesher.map_or(0, |m| m.sector_teeth);
            gear.mesher = Some(MesherScene { sector_teeth, ..mesher });
            gear.mesh = None;
            gear.groups = GroupNames::default();
        }
        own
    }
}

/// Whether the scene brings a mesh that no rung replaces.
pub(crate) fn has_own_mesh(scene: &Scene) -> bool {
    scene.gears().iter().any(|g| g.mesh.is_some())
}
