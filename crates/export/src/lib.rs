//! What do solved positions look like to other programs, and in space?
//!
//! | module | what it does |
//! |---|---|
//! | [`paraview`] | `.vtu` and `.pvd` |
//! | [`universal`] | functions as UFF 58 |
//! | [`view`] | both gears in space, packed for a page |
//! | [`StaticFileSink`] | positions at rest, as they come |
//! | [`MotionFileSink`] | rows, checkpoints and fields of a motion, as they come |

mod error;
mod motion_sink;
pub mod paraview;
mod static_sink;
pub mod universal;
pub mod view;

pub use error::ExportError;
pub use motion_sink::MotionFileSink;
pub use static_sink::StaticFileSink;
