//! One case of a plan as a scene.

use scene::plan::Plan;
use store::check_memory;

use crate::{error::CommandError, memory, resolution::with_slices, scene::Scene};

/// A case of a plan, if it is one.
pub(super) fn is_one(plan: &Plan, case: usize) -> Result<usize, CommandError> {
    let count = plan.cases.count();
    if case < count {
        return Ok(case);
    }
    let hint = format!("cases are numbered from 0 to {}", count.saturating_sub(1));
    Err(CommandError::input(format_args!("{}: there is no case {case}", plan.file.display()), Some(hint)))
}

/// The scene of a case, as it is run by itself.
pub(super) fn scene_of(plan: &Plan, case: usize) -> Result<Scene, CommandError> {
    let scene = with_slices(plan.scene(is_one(plan, case)?)?);
    check_memory(&scene, memory::available_bytes())?;
    Ok(scene)
}
