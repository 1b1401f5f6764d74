//! What is kept of a gear, and which way it is condensed.

use fem::{ElementOptions, Wanted};
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

/// What a reduction begins, for who waits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReductionStage {
    /// Stiffness and factor of one sector, and the ring of all of them.
    Sector,
    /// Stiffness of the whole gear, its ordering and its factor.
    Factor {
        /// Free degrees of freedom.
        free_count: usize,
    },
    /// Compliance of the window.
    Compliance,
}

impl std::fmt::Display for ReductionStage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Sector => f.write_str("condenses one sector"),
            Self::Factor { free_count } => write!(f, "factors {free_count} degrees of freedom"),
            Self::Compliance => f.write_str("finds the compliance of the window"),
        }
    }
}

/// Who waits for a reduction: hears what is begun, and may lose interest.
#[derive(Clone, Copy)]
pub struct ReductionWatch<'a> {
    /// Hears what is begun.
    pub tell: &'a (dyn Fn(ReductionStage) + Sync),
    /// Whether the rest of the work is still wanted, asked between its steps.
    pub wanted: Wanted<'a>,
}

impl ReductionWatch<'_> {
    /// Hears nothing and wants all.
    pub(crate) const IDLE: ReductionWatch<'static> = ReductionWatch { tell: &|_| (), wanted: &|| true };
}

impl std::fmt::Debug for ReductionWatch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ReductionWatch").finish_non_exhaustive()
    }
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
