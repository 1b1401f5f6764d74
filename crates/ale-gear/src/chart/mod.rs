//! Accuracy against cost of every model of a scene: which points there are, and how each is measured.
//!
//! | module | what it does |
//! |---|---|
//! | `plan` | the list of ways to compute the scene and of mesh densities |
//! | `measure` | runs one point, twice: with everything before it, and once more |
//! | `calculix_point` | the same by CalculiX |
//! | `guard` | leaves out what memory or patience would not stand |
//! | `speed_up` | one scene, reduced and not |
//! | `table` | all points with the refined reference |

mod calculix_point;
mod guard;
mod measure;
mod plan;
mod speed_up;
mod table;

pub(crate) use plan::{CALCULIX, FULL};
pub use plan::{Density, Point, Way, ways};
pub(crate) use speed_up::{SpeedUp, speed_up};
pub use table::{ChartOptions, Outcome, PointRow, WorkPrecision, chart, point_count};
