//! How does any mechanism move, settle, and go on from a stored state? Systems with a constant mass matrix; no gear in it.
//!
//! ```text
//! M q'' = f(t, q, q')
//! ```
//! The same integrators, and the same [`Course`] of cycles, rows, events and checkpoints, run the meshed pair, the gearbox,
//! the lumped models and a one-degree oscillator: what is shown for one holds for all. New physics brings a
//! [`Mechanism`], never a loop.

mod course;
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
mod sweep;

pub use course::{
    Checkpoint, Compared, Counts, Course, CycleTimes, EvenRows, Follower, Goal, Method, OnlyRows, Resumable, Row,
    RowPlace, RowReader, Settle, Stage, Stop, Timetable,
};
pub use eigenvalues::eigenvalues;
pub use error::MotionError;
pub use events::{Crossing, Direction};
pub use integrator::{Integrator, Progress};
pub use ledger::Ledger;
pub use mechanism::{Forces, Mechanism};
pub use periodicity::{Envelope, LONGEST_PERIOD, Periodicity, Recurrence, SignalRecurrence, difference};
pub use scheme::{Scheme, StepControl};
pub use stability::{StepLimit, Stiffest};
pub use state::State;
pub use sweep::{SweepDirection, sweep};
