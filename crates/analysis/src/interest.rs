//! Cancellation of a scene whose result is no longer wanted.

use fem::Wanted;

/// Whether the parts of a static scene are still wanted. Both functions are called often, by several threads.
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
