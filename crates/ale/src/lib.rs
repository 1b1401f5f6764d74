//! The window of tooth pairs that slides along a rotating gear pair: its teeth, its changes and its width.
//!
//! A window of W teeth of each gear is kept. It moves over the material one tooth at a time, on both gears at once,
//! while the outgoing tooth is unloaded. Pairs have running numbers k that never wrap: pinion tooth k mod z1 meets
//! wheel tooth -k mod z2.

mod error;
mod sliding;
mod station;
mod window;

pub use error::AleError;
pub use sliding::{SlidingWindow, solve_widening};
pub use station::Station;
pub use window::{ToothWindow, teeth_needed};
