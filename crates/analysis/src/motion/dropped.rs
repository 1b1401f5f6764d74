//! A force that is lost at a tooth change of a pair.

use ale::AleError;
use gearbox::motion::PairModel;
use ltca::StaticError;

use crate::in_motion::force_jump_check;

/// Tooth changes of a pair's window that set off a jump of the normal force, as an error: a wider window may do.
pub(super) fn dropped_by(system: &PairModel, jump_n: f64, largest_n: f64) -> Option<StaticError> {
    let window = system.options().statics.window_teeth(system.pair());
    let holds = force_jump_check(jump_n, largest_n).holds();
    (!holds).then_some(StaticError::Window(AleError::Dropped { window, jump_n, largest_n }))
}
