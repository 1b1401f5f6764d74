//! Which teeth are in the window now, and how do coordinates carry over?
//!
//! A window of W teeth of each gear is kept; it slides over the material one tooth at a time, both gears at once,
//! while the outgoing tooth is unloaded. Pairs have running numbers k that never wrap: pinion tooth k mod z1 meets wheel
//! tooth -k mod z2.

mod carry;
mod error;
mod station;
mod window;

pub use carry::carry_coordinates;
pub use error::AleError;
pub use station::Station;
pub use window::{ToothWindow, teeth_needed};
