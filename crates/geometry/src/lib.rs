//! What shape is a gear pair, exactly?
//!
//! External involute gears after ISO 21771: spur and helical, either hand, profile shift, working centre
//! distance, thinning and backlash, rack-generated root fillet; flanks as exact surfaces; contact lines in the
//! plane of action; micro-geometry. Lengths in mm, angles in rad.
//!
//! * A gear's own frame has its axis on +z, mid-face at z = 0 and the centre line of tooth 0 at mid-face on +x.
//! * Teeth are numbered counter-clockwise seen from +z; the *left* flank is the counter-clockwise side of a tooth.
//! * Helix angle > 0: right hand.

mod contact_lines;
mod data;
mod error;
mod even_loss;
mod flank;
mod gear;
mod interference;
mod iso1328;
pub mod modification;
mod pair;
mod profile;
mod rotation;
mod sheet;

pub use contact_lines::ContactLine;
pub use data::GearData;
pub use error::{GeometryError, Undercut};
pub use flank::{Flank, FlankPoint, Side};
pub use gear::Gear;
pub use iso1328::{FlankTolerances, TOLERANCE_CLASSES};
pub use modification::{FlankModification, GearModifications, ModifiedFlank};
pub use pair::GearPair;
pub use profile::TransverseProfile;
pub use rotation::{Driver, Sense};
pub use sheet::{Balls, GearSheet, GeometrySheet, PathPoint, Span};

/// Points and vectors, mm.
pub type Vec3 = nalgebra::Vector3<f64>;

/// Involute function inv(alpha) = tan(alpha) - alpha.
pub fn involute(alpha: f64) -> f64 {
    alpha.tan() - alpha
}
