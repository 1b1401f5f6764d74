//! Preparations before the first step: the scene in the solvers' units, gears, the quasi-static cycle, the mechanism.

mod elasticity;
mod inertia;
mod options;
mod prepare;
mod quasi_static;
mod stable;

pub use elasticity::{ElasticHeadline, KeptModes};
pub(crate) use elasticity::{Elasticity, OF_GEARBOX, Vibration, kept_modes, mesh_range_hz};
pub use inertia::InertiaHeadline;
pub use options::{bearing, drive, motion_options, scheme, speed, stated_body, steady_by, torque};
pub(crate) use options::{body, pair_drive};
pub(crate) use prepare::{MotionInputs, PreparedMotion, motion_length, prepare};
pub use quasi_static::QuasiStatic;
pub use scene::RPM;
pub use stable::refuse_unstable;
