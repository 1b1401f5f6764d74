//! How does any mechanism move? Integration in time of mechanical systems with a constant mass matrix; no gear in it.
//!
//! ```text
//! M q'' = f(t, q, q')
//! ```
//! The same integrators run the meshed pair, the lumped models and a one-degree oscillator: what is shown for one holds
//! for all.

mod eigenvalues;
mod energy;
mod error;
mod events;
mod generalised_alpha;
mod integrator;
mod ledger;
mod mechanism;
mod newton;
mod periodicity;
mod runge_kutta;
mod scheme;
mod stability;
mod state;
mod stepper;

pub use eigenvalues::eigenvalues;
pub use error::MotionError;
pub use events::{Crossing, Direction};
pub use integrator::{Integrator, Progress};
pub use ledger::Ledger;
pub use mechanism::{Forces, Mechanism};
pub use periodicity::{Envelope, LONGEST_PERIOD, Periodicity, Recurrence, difference};
pub use scheme::{Scheme, StepControl};
pub use stability::{StepLimit, Stiffest};
pub use state::State;
