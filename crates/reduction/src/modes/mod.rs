//! Normal modes of a gear held at its bore. Theory (58).
//!
//! ```text
//! K phi = omega^2 M phi,   Phi' M Phi = 1,   u = Phi q + (C - Phi Omega^-2 Phi') f
//! ```
//! Modes with free flanks belong to the gear and do not depend on a window. Their coordinates q stay unchanged when
//! teeth enter or leave the window. The rest of the compliance responds statically (MacNeal, Comput. Struct. 1 (1971)
//! 581; with contact on such a massless boundary: arXiv 2111.07693).

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
