//! The same pair with few degrees of freedom
//!
//! | module | what it is | DOF |
//! |---|---|---|
//! | [`iso`] | tooth and mesh stiffness after ISO 6336-1, method B, and what follows from it in closed form | 0 |
//! | [`impact`] | rigid gears on their true flanks, impact function, stick-slip friction | 1 to 12 |
//! | [`shaft18`] | lumped shafts with helical meshes between them, natural frequencies and backlash | as many as are kept; 18 |

mod dead_zone;
pub mod error;
mod fourier;
pub mod impact;
pub mod iso;
pub mod shaft18;

pub use dead_zone::{Beyond, DeadZone};
pub use error::LumpedError;
pub use fourier::{Fourier, FourierTorque};
