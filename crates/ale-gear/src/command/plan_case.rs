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
    let machine = sliced(plan.machine(is_one(plan, case)?)?);
    if let Some(scene) = machine.pair() {
        check_memory(scene, memory::available_bytes())?;
    }
    Ok(machine)
}

/// A pair with the slices that it is run with; a gearbox as it is.
pub(super) fn sliced(machine: Machine) -> Machine {
    match machine {
        Machine::Pair(scene) => Machine::Pair(Box::new(with_slices(*scene))),
        gearbox => gearbox,
    }
}
