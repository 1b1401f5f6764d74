//! Integration in time of mechanical systems with a constant mass matrix.
//!
//! ```text
//! M q'' = f(t, q, q')
//! ```
//! The same integrators run the meshed pair, the lumped models and a one-degree oscillator: what is shown for one holds for all.

mod energy;
mod error;
mod events;
mod generalised_alpha;
mod integrator;
mod ledger;
mod mechanism;
mod newton;
mod runge_kutta;
mod scheme;
mod stability;
mod state;

pub use error::MotionError;
pub use events::{Crossing, Direction};
pub use integrator::{Integrator, Progress};
pub use ledger::Ledger;
pub use mechanism::{Forces, Mechanism};
pub use scheme::{Scheme, StepControl};
pub use stability::{StepLimit, Stiffest};
pub use state::State;
