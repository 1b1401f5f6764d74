//! What can go wrong at a tooth change.

/// A tooth change that must not happen, or a window that cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AleError {
    /// The outgoing tooth still carries load.
    #[error(
        "pair {pair} still carries {force_n:.3} N and cannot leave the window (pinion tooth {pinion_tooth}, wheel tooth {wheel_tooth})"
    )]
    LoadedTooth {
        /// Running number of the pair.
        pair: i64,
        /// Pinion tooth.
        pinion_tooth: u32,
        /// Wheel tooth.
        wheel_tooth: u32,
        /// Its normal force, N.
        force_n: f64,
    },
    /// More teeth than the gear has.
    #[error("a window of {window} teeth does not fit a gear of {teeth} teeth")]
    TooWide {
        /// Teeth of the window.
        window: usize,
        /// Teeth of the gear.
        teeth: u32,
    },
    /// Loads for another number of pairs.
    #[error("{given} pair forces for a window of {window} pairs")]
    WrongCount {
        /// Forces given.
        given: usize,
        /// Pairs of the window.
        window: usize,
    },
    /// The reduced gear could not be expanded.
    #[error(transparent)]
    Reduction(#[from] reduction::ReductionError),
}

impl AleError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        match self {
            Self::LoadedTooth { .. } => Some("use a wider window (analysis.window_teeth) or less torque".into()),
            Self::TooWide { teeth, .. } => Some(format!("use at most {teeth} teeth in the window")),
            Self::WrongCount { .. } => None,
            Self::Reduction(e) => e.hint(),
        }
    }
}
