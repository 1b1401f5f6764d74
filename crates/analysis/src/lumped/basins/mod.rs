//! Basins of attraction: to which motion a pair settles from each state of a plane.
//!
//! | module | what it does |
//! |---|---|
//! | `analysis` | [`BasinAnalysis`]: runs a scene from all states of the plane |
//! | `plane` | the states |
//! | `attractor` | [`Attractor`]: motions that runs end in, told apart |
//! | `headline` | what is read off them |

mod analysis;
mod attractor;
mod headline;
mod plane;

pub use analysis::{BasinAnalysis, BasinResult, BasinStart};
pub use attractor::Attractor;
pub use headline::BasinHeadline;
