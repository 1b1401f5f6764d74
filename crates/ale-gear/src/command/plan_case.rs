//! One case of a plan as what it is run as.

use scene::{Machine, plan::Plan};
use store::check_memory;

use crate::{error::CommandError, memory, resolution::with_slices};

/// A case of a plan, if it is one.
pub(super) fn is_one(plan: &Plan, case: usize) -> Result<usize, CommandError> {
    let count = plan.cases.count();
    if case < count {
        return Ok(case);
    }
    let hint = format!("cases are numbered from 0 to {}", count.saturating_sub(1));
    Err(CommandError::input(format_args!("{}: there is no case {case}", plan.file.display()), Some(hint)))
}

/// The pair, or the gearbox, of a case, as it is run by itself.
pub(super) fn machine_of(plan: &Plan, case: usize) -> Result<Machine, CommandError> {
    Ok(match plan.machine(is_one(plan, case)?)? {
        Machine::Pair(scene) => {
            let scene = with_slices(*scene);
            check_memory(&scene, memory::available_bytes())?;
            Machine::Pair(Box::new(scene))
        }
        gearbox => gearbox,
    })
}
