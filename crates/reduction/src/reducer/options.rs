//! What is kept of a gear, and which way it is condensed.

use fem::ElementOptions;
use geometry::Side;

/// What to keep.
#[derive(Debug, Clone)]
pub struct ReductionOptions {
    /// Sides of the teeth whose flanks are kept.
    pub sides: Vec<Side>,
    /// Number of teeth W of a window.
    pub window: usize,
    /// First tooth of the window that is reduced at once.
    pub first: u32,
    /// Element variants.
    pub elements: ElementOptions,
}

/// Which way a gear was condensed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReductionWay {
    /// One sector, joined with itself.
    CyclicSector,
    /// The whole gear in one factor.
    General,
}

impl ReductionWay {
    /// In words, for tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::CyclicSector => "cyclic sector",
            Self::General => "general",
        }
    }
}
