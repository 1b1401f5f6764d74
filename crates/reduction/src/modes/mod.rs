//! Normal modes of a gear that is held at its bore. Theory (58).
//!
//! ```text
//! K phi = omega^2 M phi,   Phi' M Phi = 1,   u = Phi q + (C - Phi Omega^-2 Phi') f
//! ```
//! Modes with the flanks free are a gear's own: they know nothing of a window, and their coordinates q go on unchanged
//! as teeth come and go. What is left of the compliance answers at once (MacNeal, Comput. Struct. 1 (1971) 581; with
//! contact on such a massless boundary: arXiv 2111.07693).

mod basis;
mod choice;
mod craig_bampton;
mod gear_modes;
mod held;
mod krylov;
mod lowest;
mod pencil;
mod rigid_share;
mod spin;
mod standing;
mod turn;
mod whole;

pub use choice::ModeChoice;
pub use gear_modes::GearModes;
pub use lowest::LowestFrequencies;
pub(crate) use pencil::Pencil;
pub use standing::StandingModes;
