//! Force and stiffness of a rolling bearing. Theory (97) to (101).
//!
//! | module | what it does |
//! |---|---|
//! | `hertz` | contact of a ball and a raceway: stiffness, pressure |
//! | `geometry` | what is in a bearing, as drawings have it, and whether it fits |
//! | `catalogue`, `dimensions` | the same estimated from bore, outer diameter and static load rating, or width |
//! | `ball`, `roller` | one row of balls, of rollers: energy, force and tangent |
//! | `reply` | force, moment and tangent of a bearing |
//! | `laminae` | rollers lamina by lamina, on a bore that gives way |
//! | `law` | all rows together: [`RollingBearing`] |
//! | `life`, `rating` | how long it lasts, and how far it is from dents |
//! | `friction` | how much power it loses |
//! | `seat` | which thrust its seat takes: rings that float |
//! | `state` | what is told of it, and the linear bearing that stands for it |
//! | `error` | what is refused |
//!
//! Model of ISO/TS 16281: rigid rings, steel, no friction, no centrifugal forces, no cage; contacts have no edges.

mod ball;
mod catalogue;
mod dimensions;
mod error;
mod friction;
mod geometry;
mod hertz;
mod laminae;
mod law;
mod life;
mod rating;
mod reply;
mod roller;
mod seat;
mod state;

pub use catalogue::{Catalogue, Filling};
pub use dimensions::BoundaryDimensions;
pub use error::RollingBearingError;
pub use friction::RollingFriction;
pub use geometry::{AxialSetting, BallGeometry, RollerGeometry, RollerProfile, RollingElements, Row};
pub use hertz::PointContact;
pub(crate) use laminae::Cylinders;
pub use law::{ElementLoad, RollingBearing};
pub use life::LifeModification;
pub use reply::RollingReply;
pub use seat::AxialSeat;
pub use state::RollingState;
pub(crate) use state::Tangent;

/// Young's modulus (MPa) and Poisson's ratio of bearing steel, as ISO 76 and ISO 281 count with them.
const STEEL: [f64; 2] = [2.07e5, 0.3];
