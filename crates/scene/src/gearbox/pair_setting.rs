//! Keys of the pairs' scenes, set in addition to a gearbox file: `mesh.WHICH.scene.KEY`.

use crate::Setting;

/// Parts of a key before those of the scene of a pair: `mesh.WHICH.scene.`.
const OF_PAIR: usize = 3;

/// Whether a key is one of the scene of a pair.
pub(super) fn is_of_pair(setting: &Setting) -> bool {
    let path = setting.path();
    path.len() > OF_PAIR && path[0] == "mesh" && path[2] == "scene"
}

/// A key of the scene of a pair that is set beside the gearbox file.
pub(super) struct PairSetting {
    /// Number or name of the mesh.
    pub mesh: String,
    /// As the scene has it.
    pub setting: Setting,
    /// As the user has written it.
    pub key: String,
}

impl PairSetting {
    pub fn of(written: &Setting) -> Self {
        let (mesh, key) = (written.path()[1].clone(), written.key().to_owned());
        Self { mesh, setting: written.below(OF_PAIR), key }
    }
}
