//! Whether a scene can be meant as it is written: judged in closed form before any work, and by its result after it.
//!
//! Elasticity here is linear and holds for small strains. A torque in N mm, a modulus in GPa or a width in m gives a
//! result that solves all equations and means nothing.
//!
//! | module | what it does |
//! |---|---|
//! | `estimate` | deflection and pressure by ISO 6336-1 and Hertz |
//! | `digits` | numbers of messages |
//! | `refusal` | refuses what no gear does, with the unit that was meant |
//! | `remarks`, `gearbox` | tell what is unlikely in a scene and in a gearbox file |
//! | `material` | which materials gears and shafts are made of |
//! | `limits` | checks of the result |
//! | `digits` | numbers of messages |

mod estimate;
mod flanks;
mod gearbox;
mod limits;
mod material;
mod refusal;
mod remarks;

pub use estimate::LoadEstimate;
pub use gearbox::gearbox_remarks;
pub(crate) use limits::{deflection_check, deflection_in_motion, effective_modulus, pressure_check};
pub use refusal::{beyond, refuse};
pub use remarks::remarks;
