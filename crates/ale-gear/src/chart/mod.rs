//! Accuracy against cost of every model of a scene: which points there are, and how each is measured.
//!
//! | module | what it does |
//! |---|---|
//! | `plan` | the list of ways to compute the scene and of mesh densities |
//! | `measure` | runs one point, twice: with everything before it, and once more |
//! | `ladder_scene`, `ladder_point` | the scene as one of a cheaper model, and a point of it |
//! | `calculix_point` | the same by CalculiX |
//! | `motion` | the models in motion at the scene's torque and speed |
//! | `guard` | leaves out what memory or patience would not stand |
//! | `speed_up` | one scene, reduced and not |
//! | `table` | all points with the refined reference |

mod calculix_point;
mod guard;
mod ladder_point;
mod ladder_scene;
mod measure;
mod motion;
mod plan;
mod speed_up;
mod table;

pub(crate) use motion::REDUCED;
pub use motion::{MotionPoint, MotionRow};
pub(crate) use plan::{CALCULIX, FED, FULL};
pub use plan::{Density, Point, Way, ways};
pub(crate) use speed_up::{SpeedUp, speed_up};
pub use table::{ChartOptions, Outcome, PointRow, WorkPrecision, chart, point_count};
