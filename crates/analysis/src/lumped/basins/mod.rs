//! Basins of attraction: the motion to which a pair settles from each state of a plane.
//!
//! | module | what it does |
//! |---|---|
//! | `analysis` | [`BasinAnalysis`]: runs a scene from all states of the plane |
//! | `plane` | the states |
//! | `start` | [`BasinStart`]: one of them, and where it leads |
//! | `attractor` | [`Attractor`]: motions that runs end in, told apart |
//! | `headline` | what is read off them |

mod analysis;
mod attractor;
mod headline;
mod plane;
mod start;

pub use analysis::{BasinAnalysis, BasinResult};
pub use attractor::Attractor;
pub use headline::BasinHeadline;
pub use start::BasinStart;
