//! Meshes of the built-in mesher that are refined alike in all five directions.

use mesh::GroupNames;
use scene::{MesherScene, Scene};
use serde::Serialize;

/// A mesh with so many elements along the active profile and as fine in every other direction.
///
/// Errors of the discretisation fall as one power of the element size only where all directions are refined alike:
/// refinement along the profile alone converges to a wrong answer (theory, section 15).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Rung {
    /// Elements along the active profile.
    pub elements_profile: u32,
    /// Linear elements in place of quadratic ones.
    pub linear: bool,
}

/// Length of a face element over the normal module, times the number of elements along the profile.
const FACE_LENGTH_MODULES: f64 = 9.0;
/// Elements in the rim, at least: two in place of three double the error of the coarsest mesh.
const LEAST_RIM: u32 = 3;

impl Rung {
    /// Those of the ladder, coarse to fine.
    pub const ALL: [Self; 7] = [
        Self::quadratic(2),
        Self::quadratic(3),
        Self::quadratic(4),
        Self::quadratic(6),
        Self::quadratic(8),
        Self::quadratic(10),
        Self::quadratic(12),
    ];

    /// Quadratic elements.
    const fn quadratic(elements_profile: u32) -> Self {
        Self { elements_profile, linear: false }
    }

    /// The same mesh of linear elements.
    #[must_use]
    pub const fn linear(self) -> Self {
        Self { linear: true, ..self }
    }

    /// The next coarser one of the ladder.
    pub fn coarser(self) -> Option<Self> {
        Self::ALL.iter().rev().find(|r| **r < self).copied()
    }

    /// The next finer one of the ladder.
    pub fn finer(self) -> Option<Self> {
        Self::ALL.iter().find(|r| **r > self).copied()
    }

    /// The rung that both gears of a scene stand on.
    pub fn of(scene: &Scene) -> Option<Self> {
        let stands = |rung: &Self| {
            let own = rung.mesher(scene.pair.face_width_mm, scene.pair.normal_module_mm);
            scene
                .gears()
                .iter()
                .all(|g| g.mesher.is_some_and(|m| MesherScene { sector_teeth: m.sector_teeth, ..own } == m))
        };
        Self::ALL.into_iter().find(stands)
    }

    /// Numbers of elements of a gear in a pair of this face width and normal module, both mm.
    pub fn mesher(self, face_width: f64, normal_module: f64) -> MesherScene {
        let n = self.elements_profile;
        let by_length = (f64::from(n) * face_width / (FACE_LENGTH_MODULES * normal_module)).ceil() as u32;
        MesherScene {
            order: if self.linear { 1 } else { 2 },
            elements_profile: n,
            elements_fillet: n,
            // Even, so that nodes lie on the tooth's centre surface, where slice contact cuts it.
            elements_thickness: 2 * n.div_ceil(3),
            elements_face: by_length.max(n + 2),
            elements_rim: n.max(LEAST_RIM),
            sector_teeth: 0,
        }
    }

    /// The scene with both gears on this mesh; teeth of an open sector stay.
    pub fn scene(self, scene: &Scene) -> Scene {
        let mut own = scene.clone();
        let mesher = self.mesher(scene.pair.face_width_mm, scene.pair.normal_module_mm);
        for gear in [&mut own.pinion, &mut own.wheel] {
            let sector_teeth = gear.mesher.map_or(0, |m| m.sector_teeth);
            gear.mesher = Some(MesherScene { sector_teeth, ..mesher });
            gear.mesh = None;
            gear.groups = GroupNames::default();
        }
        own
    }
}
