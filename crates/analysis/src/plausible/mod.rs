//! Plausibility of a scene: checked in closed form before the solution, and by its result afterwards.
//!
//! Elasticity here is linear and valid for small strains. A torque in N mm, a modulus in GPa or a width in m gives a
//! result that satisfies all equations but is meaningless.
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
