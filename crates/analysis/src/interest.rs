//! Who waits for a scene may lose interest in it.

use fem::Wanted;

/// Whether what a scene at rest needs is still wanted. Both are asked often, by several threads.
#[derive(Clone, Copy)]
pub struct Interest<'a> {
    /// Whether the reduced gears are wanted, asked between the steps of a reduction.
    pub gears: Wanted<'a>,
    /// Whether the positions are wanted, asked after each of them.
    pub positions: Wanted<'a>,
}

impl Interest<'_> {
    /// All is wanted, to the end.
    pub const LASTING: Interest<'static> = Interest { gears: &|| true, positions: &|| true };
}

impl std::fmt::Debug for Interest<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Interest").finish_non_exhaustive()
    }
}
