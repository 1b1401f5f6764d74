//! Error bounds of a result, and the cheapest model that is accurate enough.
//!
//! The magnitude of the errors of a solved cycle, and its dependence on the pair, were calibrated on random pairs
//! ([`Calibration`]). For similar scenes on calibrated meshes, this and half of the positions are sufficient. Any other
//! cycle is compared with a companion on a rung of the ladder, and with half its slices. [`StaticAnalysis`] climbs the
//! ladder until the bounds meet the accuracy that a scene requests. Theory, section 15.
//!
//! | file | question |
//! |---|---|
//! | `analysis` | which bounds does a scene at rest get? |
//! | `climb`, `rest_ladder` | which rung is exact enough? |
//! | `rung`, `gear_memo` | which meshes are there, and which gears are reduced already? |
//! | `estimate`, `companion`, `solved_cycle`, `seen` | what is seen of the error of a run? |
//! | `exactness` | what is said of a run's error in the end? |
//! | `of_results` | what are the bounds of runs that are solved? |
//! | `calibration`, `calibrated_mesh`, `features`, `law` | how does the error go with what is known of a run? |
//! | `quantity`, `bound` | of which numbers, and how much is it? |
//! | `curves` | what may these numbers miss between the positions that are solved? |
//! | `coverage`, `coverage_flanks` | what do bounds not cover? |
//! | [`motion`] | the same questions of a pair in motion |

mod analysis;
mod bound;
mod calibrated_mesh;
mod calibration;
mod climb;
mod companion;
mod coverage;
mod coverage_flanks;
mod curves;
mod estimate;
mod exactness;
mod features;
mod gear_memo;
mod law;
pub mod motion;
mod of_results;
mod quantity;
mod rest_ladder;
mod rung;
mod seen;
mod solved_cycle;

pub use analysis::StaticAnalysis;
pub use bound::{Bound, Cause, Term};
pub use calibrated_mesh::CalibratedMesh;
pub use calibration::{Calibration, MeshLaw, PairLaw, PositionsLaw, QuantityLaws, logarithm, together};
pub(crate) use climb::{Climbed, Ladder, climb};
pub(crate) use companion::{Companions, stride};
pub use curves::Curves;
pub use exactness::{Accuracy, TriedRung, TriedSettings};
pub use features::{FEATURES, Features, features};
pub use gear_memo::GearMemo;
pub use law::Law;
pub(crate) use of_results::{BoundsOfResults, bounds_of};
pub use quantity::Sample;
use quantity::goes_with_deflection;
pub use rung::Rung;
pub(crate) use rung::has_own_mesh;
pub use scene::Quantity;
pub use seen::{Seen, WholeForce};
pub use solved_cycle::SolvedCycle;
