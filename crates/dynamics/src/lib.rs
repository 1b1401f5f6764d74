//! How do the bodies move?

pub mod result;

pub use result::{Certificate, PairResult, StaticHistory, StaticPosition, Wrench};
