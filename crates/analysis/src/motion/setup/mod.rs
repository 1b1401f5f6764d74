//! Everything before the first step: what the scene asks for in the solvers' units, gears, the quasi-static cycle, the
//! mechanism.

mod elasticity;
mod inertia;
mod options;
mod prepare;
mod stable;

pub use elasticity::{ElasticHeadline, KeptModes};
pub(crate) use elasticity::{Elasticity, Vibration, mesh_range_hz};
pub use inertia::InertiaHeadline;
pub use options::{RPM, bearing, drive, motion_options, scheme, speed, stated_body, steady_by, torque};
pub(crate) use options::{body, pair_drive};
pub use prepare::QuasiStatic;
pub(crate) use prepare::{MotionInputs, PreparedMotion, fastest_hz, prepare};
pub use stable::{Steps, UnstableSteps, refuse_unstable};
