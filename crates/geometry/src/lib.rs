//! Exact geometry of a gear pair.
//!
//! Involute gears after ISO 21771, external gears and rings: spur and helical, either hand, profile shift, working
//! centre distance, tooth thinning and backlash, root fillets cut by a rack or a shaper. The crate gives flanks as
//! exact surfaces, contact lines in the plane of action, and micro-geometry. Lengths are in mm, angles in rad.
//!
//! * A gear's own frame has its axis on +z, mid-face at z = 0 and the centre line of tooth 0 at mid-face on +x.
//! * Teeth are numbered counter-clockwise seen from +z; the *left* flank is the counter-clockwise side of a tooth.
//! * An internal gear has the signs of ISO 21771: z, all diameters and the centre distance are negative. Its teeth are
//!   numbered clockwise. Its left flank is the clockwise side, seen with the tooth pointing up. So in both kinds of
//!   pair left flanks touch left flanks, and pinion tooth k meets wheel tooth -k.
//! * A helix angle > 0 is right-handed.

mod contact_lines;
mod data;
mod error;
mod even_loss;
mod flank;
mod gear;
mod interference;
mod internal_mesh;
mod iso1328;
pub mod modification;
mod pair;
mod profile;
mod rack;
mod roots;
mod rotation;
mod shaper;
mod sheet;

pub use contact_lines::ContactLine;
pub use data::{GearData, Shaper};
pub use error::{GeometryError, Undercut};
pub use flank::{Flank, FlankPoint, Side};
pub use gear::Gear;
pub use iso1328::{FlankTolerances, TOLERANCE_CLASSES};
pub use modification::{FlankModification, GearModifications, ModifiedFlank};
pub use pair::GearPair;
pub use profile::TransverseProfile;
pub use rotation::{Driver, Sense};
pub use shaper::ShapedRoot;
pub use sheet::{Balls, GearSheet, GeometrySheet, PathPoint, RingSheet, Span};

/// Points and vectors, mm.
pub type Vec3 = nalgebra::Vector3<f64>;

/// Involute function inv(alpha) = tan(alpha) - alpha.
pub fn involute(alpha: f64) -> f64 {
    alpha.tan() - alpha
}
