//! Which values of some parameters make curves flattest within limits?
//!
//! Curves and limited numbers come with their derivatives; the search goes by convex steps in a region of trust:
//!
//! | module | what it does |
//! |---|---|
//! | `goal` | curves, and what of them shall be small |
//! | `convex` | the linear or quadratic programme of a step, for the solver `clarabel` |
//! | `search` | step after step, each evaluated before it is taken |
//! | `rounding` | the best values that a machine can be set to |
//!
//! It knows nothing of gears: values are numbers, a curve is one mesh cycle of anything.

mod convex;
mod goal;
mod rounding;
mod search;

pub use goal::{Curve, Evaluation, Goal, Limited, Measure, Over};
pub use rounding::rounded;
pub use search::{Bounds, Evaluated, Search, SearchResult, Stop, TakenStep};
