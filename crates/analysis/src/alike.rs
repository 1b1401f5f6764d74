//! Which scenes have meshes and matrices in common.

use scene::{ContactScene, Method, Model, ModificationScene, Scene};

/// What scenes have in common that stand on the same reduced gears (`SharedModels`).
#[derive(Debug, Clone, PartialEq)]
pub struct SharedGears(Scene);

impl SharedGears {
    /// Shared gears of a scene. One that shares no gears is alike to itself alone.
    pub fn of(scene: &Scene) -> Self {
        Self(if shares(scene) { of_gears(&kind(scene)) } else { scene.clone() })
    }
}

/// A kind without what reduced gears know nothing of: slices.
pub(crate) fn of_gears(kind: &Scene) -> Scene {
    Scene { contact: ContactScene { slices: None, ..kind.contact }, ..kind.clone() }
}

/// Whether a scene shares its model with others.
pub(crate) fn shares(scene: &Scene) -> bool {
    scene.analysis.model == Model::Reduced && scene.accuracy.is_none()
}

/// What scenes of one kind have in common: all that meshes, matrices and tables of the contact depend on.
pub(crate) fn kind(scene: &Scene) -> Scene {
    let mut kind = scene.clone();
    kind.name.clear();
    kind.set.clear();
    kind.file.clear();
    for gear in [&mut kind.pinion, &mut kind.wheel] {
        gear.modification = ModificationScene::default();
        gear.pitch_errors_um.clear();
        gear.pitch_errors_file = None;
        // Paths as the scene means them.
        if let Some(mesh) = &mut gear.mesh {
            mesh.set_path(scene.resolve(mesh.path()));
        }
    }
    kind.pair.misalignment = Default::default();
    (kind.operation.torque_nm, kind.operation.speed_rpm) = (0.0, 0.0);
    (kind.analysis.positions_per_cycle, kind.analysis.cycles) = (1, 1);
    kind.contact.friction = 0.0;
    if kind.contact.method == Method::Slice {
        // Stresses are recovered from the gears, and asked for by the case.
        kind.output.contact_lines = false;
    }
    kind
}
