//! Finds scenes that have meshes and matrices in common.

use scene::{Method, Model, ModificationScene, Scene};

/// The part of a scene that determines its reduced gears; scenes with equal parts share them (`SharedModels`).
#[derive(Debug, Clone, PartialEq)]
pub struct SharedGears(Scene);

impl SharedGears {
    /// Shared gears of a scene. A scene that shares no gears is equal only to itself.
    pub fn of(scene: &Scene) -> Self {
        Self(if shares(scene) { kind(scene) } else { scene.clone() })
    }
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
    (kind.contact.friction, kind.contact.slices) = (0.0, None);
    if kind.contact.method == Method::Slice {
        // Stresses are recovered from the gears, and asked for by the case.
        kind.output.contact_lines = false;
    }
    kind
}
