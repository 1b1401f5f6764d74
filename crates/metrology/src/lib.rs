//! What does a measured flank say?
//!
//! Measured gears from files of measuring machines, the flanks that they are made into, evaluation by ISO 1328-1:2013,
//! and the waves of all teeth over the rotation. Deviations are in um, normal to the flank, positive where the flank
//! stands proud (ISO 1328-1); depths of `geometry` count the other way. Lengths in mm, angles in rad. Teeth are counted
//! from 0, as `geometry` counts them; files count from 1.
//!
//! | file | what |
//! |---|---|
//! | `measured_gear` | traces, pitch, header of one measured gear |
//! | `mka` | curve files of Klingelnberg's P machines: reader and writer |
//! | `gde` | VDI/VDE 2610 (XML) through a map of names |
//! | `flanks` | from traces to topographies by tooth and pitch errors |
//! | `gaussian` | the low pass of ISO 16610-21, with straight lines kept up to the ends |
//! | `evaluation` | slope, form, total, crowning, twist, pitch, tolerance classes |
//! | `ripple` | sines over the rotation through the traces of all teeth |

mod error;
mod evaluation;
mod flanks;
mod gaussian;
mod gde;
mod least_squares;
mod measured_gear;
mod mka;
mod ripple;

pub use error::MetrologyError;
pub use evaluation::{GearEvaluation, PitchEvaluation, TraceEvaluation, evaluate, evaluate_trace};
pub use flanks::{MeasuredFlanks, flanks};
pub use gaussian::low_pass;
pub use gde::{GdeNames, read_gde};
pub use measured_gear::{GearHeader, MeasuredGear, Pitch, Range, Trace, TraceKind};
pub use mka::{read_mka, write_mka};
pub use ripple::{Ripple, ripple};
