//! Where files are looked for.

/// Where a scene and the files that it names stand.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum Origin {
    /// In files.
    #[default]
    Disk,
    /// In the program.
    Program,
}
