//! Where do gear contact solvers fail, and does this one?
//!
//! Every known way in which such solvers fail is a [`FailureMode`]: a scene that a user can run, the naive way failing
//! where the program still has it, the robust way passing, and the [`Figure`]s that show both. [`MODES`] lists them in
//! the order of their numbers; [`FailureMode::examine`] runs one. [`MAPS`] are maps over two keys of a scene: where a
//! method solves, warns, refuses and fails.

mod bench;
mod chosen;
mod error;
mod figure;
pub mod files;
mod maps;
mod mode;
mod modes;
mod pieces;

pub use chosen::chosen;
pub use error::EnvelopeError;
pub use figure::{Asked, Figure, Shown, Value};
pub use maps::{Cell, DrawnMap, EnvelopeMap, MAPS, Outcome};
pub use mode::{Examined, FailureMode};
pub use modes::MODES;
pub use pieces::contact_patch::contact_patch_deviation;
