//! The same pair with few degrees of freedom
//!
//! | module | what it is | DOF |
//! |---|---|---|
//! | [`iso`] | tooth and mesh stiffness after ISO 6336-1, method B, and what follows from it in closed form | 0 |

mod dead_zone;
pub mod error;
mod fourier;
pub mod iso;

pub use dead_zone::{Beyond, DeadZone};
pub use error::LumpedError;
pub use fourier::{Fourier, FourierTorque};
