//! Rigid gears on their true flanks: an impact function of the overlap instead of elasticity.
//!
//! The files in the order of the model:
//!
//! 1. [`ImpactLaw`]: force by overlap and its rate; [`contact_stiffness`]: its constant after Hertz;
//! 2. [`StickSlip`]: friction by sliding speed;
//! 3. [`ImpactOptions`]: bodies, bearings, drive, load;
//! 4. `flanks`: where teeth are nearest, slice by slice, with the search of [`contact`];
//! 5. [`ImpactMechanism`]: equations of motion, static equilibrium, [`ImpactRow`]s of a history.
//!
//! [`RigidCoordinates`] are deviations from the nominal motion; with rigid shafts and a prescribed speed the transmission
//! error alone.
//!
//! Seed: "Simulation analysis of helical gears in the gear box of the rolling mill", which lets ADAMS find one contact
//! of two solids a tooth pair. Here each pair has the same law slice by slice, so that a pair comes in and goes out
//! with the length of its contact line.

mod coordinates;
mod flanks;
mod forces;
mod friction;
mod history;
mod law;
mod mechanism;
mod options;

pub use coordinates::RigidCoordinates;
pub use forces::FlankForce;
pub use friction::StickSlip;
pub use history::ImpactRow;
pub use law::{ImpactLaw, contact_stiffness};
pub use mechanism::ImpactMechanism;
pub use options::ImpactOptions;
