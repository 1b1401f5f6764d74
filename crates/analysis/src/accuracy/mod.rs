//! How exact is an answer, and which is the cheapest model that is exact enough?
//!
//! A solved cycle is held against a companion: the same meshes of linear elements where it stands on a rung of the
//! ladder, else a rung of its own; against half its slices; against half its positions. How an error goes with such a
//! difference was learnt from random pairs ([`Calibration`]). [`AccurateAnalysis`] climbs the ladder until the bounds
//! keep what a scene asks for. Theory, section 15.
//!
//! | file | question |
//! |---|---|
//! | `analysis` | which rung is exact enough? |
//! | `rung`, `kept_gears` | which meshes are there, and which gears are reduced already? |
//! | `estimate`, `companion`, `solved_cycle` | what is seen of the error of a run? |
//! | `of_results` | what are the bounds of runs that are solved? |
//! | `calibration` | how does the error go with what is seen? |
//! | `quantity`, `bound` | of which numbers, and how much is it? |
//! | `coverage`, `coverage_flanks` | what do bounds not cover? |

mod analysis;
mod bound;
mod calibration;
mod companion;
mod coverage;
mod coverage_flanks;
mod estimate;
mod kept_gears;
mod of_results;
mod quantity;
mod rung;
mod solved_cycle;

pub use analysis::{AccurateAnalysis, AccurateResult, TriedRung};
pub use bound::{Bound, Cause, Term};
pub use calibration::{Calibration, Law, MeshLaw, PositionsLaw, QuantityLaws};
pub use estimate::Accuracy;
pub(crate) use of_results::BoundsOfResults;
pub use quantity::{Sample, goes_with_deflection, value_of};
pub use rung::Rung;
pub use scene::Quantity;
pub use solved_cycle::SolvedCycle;
