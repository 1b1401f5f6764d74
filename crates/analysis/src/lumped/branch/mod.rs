//! Periodic motions along a parameter, stable and unstable: resonance curves around their folds.
//!
//! | module | what it does |
//! |---|---|
//! | `analysis` | [`ContinuationAnalysis`]: follows the branch of a scene |
//! | `family` | a scene's model over the parameter, as the search for periodic motions asks for it |
//! | `point` | what is read off a motion |
//! | `in_time` | the same motion integrated in time |
//! | `headline` | what is read off the branch |

mod analysis;
mod family;
mod headline;
mod in_time;
mod point;

pub use analysis::{ContinuationAnalysis, ContinuationResult};
pub use headline::ContinuationHeadline;
