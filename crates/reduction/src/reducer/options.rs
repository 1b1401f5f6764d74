//! What is kept of a gear, and the method of condensation.

use fem::{ElementOptions, Wanted};
use geometry::Side;

/// What to keep of a gear.
#[derive(Debug, Clone)]
pub struct ReductionOptions {
    /// Sides of the teeth whose flanks are kept.
    pub sides: Vec<Side>,
    /// Number of teeth W of a window.
    pub window: usize,
    /// First tooth of the window that is reduced immediately.
    pub first: u32,
    /// Element variants.
    pub elements: ElementOptions,
}

/// Stage of a reduction, for progress reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReductionStage {
    /// Stiffness and factor of one sector, and the ring of all sectors.
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

/// Observer of a reduction: it is told of each stage and can cancel the work.
#[derive(Clone, Copy)]
pub struct ReductionWatch<'a> {
    /// Called at the beginning of each stage.
    pub tell: &'a (dyn Fn(ReductionStage) + Sync),
    /// Called between the stages; tells whether the result is still wanted.
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

/// Method by which a gear is condensed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReductionWay {
    /// One sector, joined with itself.
    CyclicSector,
    /// One sector, joined with itself, and bolts at places of the gear beside it; what contact does not need by one factor of
    /// the whole gear.
    SectorAndBolts,
    /// One factor of the whole gear.
    General,
}

impl ReductionWay {
    /// Name for tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::CyclicSector => "cyclic sector",
            Self::SectorAndBolts => "cyclic sector, and bolts",
            Self::General => "general",
        }
    }
}
