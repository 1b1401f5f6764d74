//! Structured hexahedral mesh of a gear: the transverse section of one tooth, rotated from tooth to tooth and twisted
//! along the helix.
//!
//! ```text
//!        tip                 tooth block: columns across, rows from the tip down to the neck
//!      +-----+               rim block:   columns from cut to cut, rows from fillet and neck down to the bore
//!      |tooth|
//!      |     |               The neck, where three blocks meet, lies where the fillet's tangent has turned to 65
//!   __/ neck  \__            degrees from the circumference: above the place of the greatest stress.
//!  |rim           |
//!  +-----bore-----+
//! ```
//!
//! A ring is meshed in the same way with its rim outside and its teeth inside. Radii and angles of its section are
//! negative ([`geometry::TransverseProfile`]), and its `bore`, the surface that holds the gear, is its outer surface.
//! Flank nodes, including mid-side nodes, lie on the exact helicoid; all teeth are exact copies of one. Groups: `bore`,
//! `side_front` (z = +b/2), `side_back`, `flank_left_<k>`, `flank_right_<k>` (tip circle to root form circle), and, if
//! the gear is not whole, `cut_0` (towards the preceding tooth) and `cut_1`.

mod error;
mod face_elements;
mod options;
mod outline;
mod quality;
mod section;
mod sweep;

pub use error::StructuredError;
pub use face_elements::{FaceResolution, face_elements};
pub use options::{Extent, StructuredOptions};

use geometry::Gear;

use crate::Mesh;
use outline::Outline;
use section::Section;

/// Meshes a gear in its own frame (axis +z, centre line of tooth 0 at mid-face on +x), lengths in mm.
///
/// # Errors
/// [`StructuredError`]: a count that is too small, a rim too thin for the bore, a layer that rotates too far, an
/// element with a scaled Jacobian below 0.1, more than 20 million nodes.
///
/// # Example
/// One tooth with one element along the face: every node of a hex8 section occurs twice.
/// ```
/// # use mesh::{Extent, StructuredOptions, generate};
/// let gear = geometry::Gear::new(geometry::GearData::default())?;
/// let options = StructuredOptions { order: 1, elements_face: 1, extent: Extent::Periodic, ..Default::default() };
/// let mesh = generate(&gear, &options)?;
/// assert_eq!(mesh.nodes.len() % 2, 0);
/// assert!(mesh.surface("cut_0").is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn generate(gear: &Gear, options: &StructuredOptions) -> Result<Mesh, StructuredError> {
    options.check(gear.teeth())?;
    check_twist(gear, options)?;
    let outline = Outline::new(gear, options);
    let section = Section::new(gear, options, &outline)?;
    quality::check(gear, options, &section)?;
    Ok(sweep::sweep(gear, options, &section))
}

/// Most that a section may turn over one element, rad: its middle then loses 1 - cos^2(turn/2) = 6 % of its area.
const MOST_TURN: f64 = 0.5;

/// Scaled Jacobians are blind to this: at the nodes a wrung element looks sound.
fn check_twist(gear: &Gear, options: &StructuredOptions) -> Result<(), StructuredError> {
    let whole = (gear.twist() * gear.face_width()).abs();
    let turn = whole / f64::from(options.elements_face);
    if turn <= MOST_TURN {
        return Ok(());
    }
    Err(StructuredError::Twist {
        elements_face: options.elements_face,
        turn_deg: turn.to_degrees(),
        most_deg: MOST_TURN.to_degrees(),
        least: (whole / MOST_TURN).ceil().min(f64::from(u32::MAX)) as u32,
    })
}
