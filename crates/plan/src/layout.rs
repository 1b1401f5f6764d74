//! What a study and a plan know of their cases before these run.

use analysis::lumped::is_lumped;
use columns::{LumpedLayout, history_columns};
use scene::{Machine, Scene};
use store::checkpoint::motion_column_names;

/// Columns whose rows a plan reads numbers off: of `history.csv` of a pair, of `motion.csv` or `positions.csv` of a gearbox.
pub fn columns_of(machine: &Machine) -> Option<Vec<String>> {
    match machine {
        Machine::Pair(scene) => columns_of_scene(scene),
        Machine::Gearbox(file) => Some(columns::gearbox::history_columns(file)),
    }
}

/// Columns that a scene's `history.csv` will have, but for those of single pairs.
pub fn columns_of_scene(scene: &Scene) -> Option<Vec<String>> {
    match &scene.motion {
        Some(_) if is_lumped(scene) => Some(LumpedLayout::of(scene).sheet().names()),
        Some(_) => Some(motion_column_names(scene)),
        None => Some(history_columns(scene, &[])),
    }
}
