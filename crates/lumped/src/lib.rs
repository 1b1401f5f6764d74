//! The same pair with few degrees of freedom
//!
//! | module | what it is | DOF |
//! |---|---|---|
//! | [`iso`] | tooth and mesh stiffness after ISO 6336-1, method B, and what follows from it in closed form | 0 |

pub mod error;
pub mod iso;

pub use error::LumpedError;
