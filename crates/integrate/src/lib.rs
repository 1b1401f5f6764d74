//! Time integration of mechanical systems with a constant mass matrix: motion, settling to a steady state, restart. The
//! crate contains no gear physics.
//!
//! ```text
//! M q'' = f(t, q, q')
//! ```
//! All mechanisms share the integrators and the [`Course`] of cycles, rows, events and checkpoints: the gear pair, the
//! gearbox, the lumped models, an oscillator with one degree of freedom. A property that is shown for one of them holds
//! for all. New physics is a new [`Mechanism`], never a new time loop.

mod course;
mod eigenvalues;
mod error;
mod events;
mod integrator;
mod ledger;
mod lu;
mod mechanism;
mod newton;
mod periodicity;
mod scheme;
mod stability;
mod state;
mod stepper;
mod sweep;
mod whole_cycles;

pub use course::{
    Ahead, Checkpoint, Compared, Counts, Course, CycleTimes, EvenRows, Follower, Goal, Method, OnlyRows, Resumable,
    Row, RowPlace, RowReader, Settle, Stage, Stop, Timetable,
};
pub use eigenvalues::eigenvalues;
pub use error::MotionError;
pub use events::{Crossing, Direction};
pub use integrator::{Integrator, Progress};
pub use ledger::Ledger;
pub use mechanism::{Forces, Mechanism};
pub use periodicity::{Envelope, LONGEST_PERIOD, Periodicity, Recurrence, SignalRecurrence, difference};
pub use scheme::{Scheme, SteadySteps, StepControl};
pub use stability::{StepLimit, Stiffest};
pub use state::State;
pub use sweep::{SweepDirection, sweep};
pub use whole_cycles::whole_cycles;
