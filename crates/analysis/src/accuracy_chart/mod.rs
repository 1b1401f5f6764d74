//! Accuracy against cost of all models of a scene: the points, and their measurement.
//!
//! | module | what it does |
//! |---|---|
//! | `plan` | the list of ways to compute the scene and of mesh densities |
//! | `measure` | runs one point, twice: with everything before it, and once more |
//! | `lumped_scene`, `lumped_point` | the scene as one of a cheaper model, and a point of it |
//! | `calculix_point` | the same by CalculiX |
//! | `motion` | the models in motion at the scene's torque and speed |
//! | `resonance` | the models in motion over a range of speeds |
//! | `own_bounds` | what a point says of its own error |
//! | `guard`, `memory`, `phase_times` | what memory or patience would not stand; what a point took |
//! | `speed_up` | one scene, reduced and not |
//! | `chart` | all points with the refined reference |

mod calculix_point;
mod chart;
mod guard;
mod lumped_point;
mod lumped_scene;
mod measure;
mod measured;
mod memory;
mod motion;
mod own_bounds;
mod phase_times;
mod plan;
mod resonance;
mod speed_up;

pub use chart::{AccuracyChart, ChartOptions, Outcome, PointRow, WorkPrecision};
pub use memory::{MemoryGauge, NoGauge};
pub use motion::{MotionPoint, MotionRow, REDUCED};
pub use own_bounds::{OwnBound, OwnBounds};
pub use plan::{CALCULIX, Density, FED, FULL, Point, Way, ways};
pub use resonance::{ResonanceCurve, ResonancePoint, ResonancePrecision, SpeedPoint, resonance_precision};
pub use speed_up::{SpeedUp, speed_up};
