//! What a study and a plan know of their cases before these run.

use analysis::lumped::is_lumped;
use columns::{LumpedLayout, history_columns};
use scene::Scene;
use store::checkpoint::motion_column_names;

/// Columns that a scene's `history.csv` will have, but for those of single pairs.
pub fn columns_of(scene: &Scene) -> Option<Vec<String>> {
    match &scene.motion {
        Some(_) if is_lumped(scene) => Some(LumpedLayout::of(scene).sheet().names()),
        Some(_) => Some(motion_column_names(scene)),
        None => Some(history_columns(scene, &[])),
    }
}
