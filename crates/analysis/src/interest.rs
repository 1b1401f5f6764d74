//! Cancellation of a scene whose result is no longer wanted.

use std::sync::Arc;

use fem::Wanted;

use crate::{Observer, PhaseWork, Progress};

/// Whether the parts of a static scene are still wanted. Both functions are called often, by several threads.
///
/// As the observer of any other analysis it cancels what runs once positions are no longer wanted.
#[derive(Clone, Copy)]
pub struct Interest<'a> {
    /// Whether the reduced gears are wanted; called between the steps of a reduction.
    pub gears: Wanted<'a>,
    /// Whether the positions are wanted; called after each of them.
    pub positions: Wanted<'a>,
}

impl Interest<'_> {
    /// Everything is wanted, to the end.
    pub const LASTING: Interest<'static> = Interest { gears: &|| true, positions: &|| true };
}

impl std::fmt::Debug for Interest<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Interest").finish_non_exhaustive()
    }
}

impl Observer for Interest<'_> {
    fn begin(&mut self, _: &str, _: PhaseWork) -> Arc<dyn Progress + '_> {
        Arc::new(*self)
    }

    fn end(&mut self) {}
}

impl Progress for Interest<'_> {
    fn tick(&self) {}

    fn say(&self, _: String) {}

    fn is_cancelled(&self) -> bool {
        !(self.positions)()
    }
}
