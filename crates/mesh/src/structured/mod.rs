//! Structured hexahedral mesh of a gear: one tooth's transverse section, turned from tooth to tooth and twisted along the helix.
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
//! Flank nodes, mid-side nodes included, lie on the exact helicoid; all teeth are exact copies of one.
//! Groups: `bore`, `side_front` (z = +b/2), `side_back`, `flank_left_<k>`, `flank_right_<k>` (tip circle to root form
//! circle), `cut_0` (clockwise) and `cut_1` where the gear is not whole.

mod error;
mod face_elements;
mod outline;
mod quality;
mod section;
mod sweep;

pub use error::StructuredError;
pub use face_elements::face_elements;

use geometry::Gear;

use crate::{ElementKind, Mesh};
use outline::Outline;
use section::Section;

/// Largest mesh made, in lattice points; a few GB. Nothing here could be solved on it.
const MOST_NODES: u32 = 20_000_000;

/// How much of the gear is meshed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Extent {
    /// All z teeth, no cut faces.
    #[default]
    Whole,
    /// Tooth 0 alone; `cut_1` is `cut_0` turned by 2 pi / z, node by node.
    Periodic,
    /// k teeth about tooth 0, cut faces free; clockwise teeth count down: k = 3 gives -1, 0, 1.
    Sector(u32),
}

/// Element kind and counts of the structured mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StructuredOptions {
    /// 1: hex8, 2: hex20.
    pub order: u32,
    /// Elements along the flank, from the tip circle to the root form circle.
    pub elements_profile: u32,
    /// Elements along the fillet and root land, from the root form circle to the middle of the tooth space; at least 2.
    pub elements_fillet: u32,
    /// Elements across the tooth.
    pub elements_thickness: u32,
    /// Elements along the face width.
    pub elements_face: u32,
    /// Elements from the fillet to the bore.
    pub elements_rim: u32,
    /// How much of the gear.
    pub extent: Extent,
}

impl Default for StructuredOptions {
    /// Six quadratic elements along the flank and six along each fillet of a whole gear: root stress within 3 % of settled (docs/validation.md).
    fn default() -> Self {
        Self {
            order: 2,
            elements_profile: 6,
            elements_fillet: 6,
            elements_thickness: 4,
            elements_face: 6,
            elements_rim: 5,
            extent: Extent::Whole,
        }
    }
}

impl StructuredOptions {
    /// The element kind of that order.
    pub fn kind(&self) -> ElementKind {
        if self.order == 1 { ElementKind::Hex8 } else { ElementKind::Hex20 }
    }

    /// Every complaint that needs no geometry.
    fn check(&self, gear_teeth: u32) -> Result<(), StructuredError> {
        if !(1..=2).contains(&self.order) {
            return Err(StructuredError::Order { order: self.order });
        }
        let counts = [
            ("elements_profile", self.elements_profile, 1),
            ("elements_fillet", self.elements_fillet, 2),
            ("elements_thickness", self.elements_thickness, 1),
            ("elements_face", self.elements_face, 1),
            ("elements_rim", self.elements_rim, 1),
        ];
        for (name, value, least) in counts {
            if !(least..=10_000).contains(&value) {
                return Err(StructuredError::Count { name, value, least });
            }
        }
        if let Extent::Sector(teeth) = self.extent
            && !(1..gear_teeth).contains(&teeth)
        {
            return Err(StructuredError::Sector { teeth, gear_teeth });
        }
        // before anything is allocated: a bound that counts every lattice point
        let teeth = match self.extent {
            Extent::Whole => gear_teeth,
            Extent::Periodic => 1,
            Extent::Sector(teeth) => teeth,
        };
        let [profile, fillet, thickness, face, rim] =
            counts.map(|(_, value, _)| u128::from(value) * u128::from(self.order));
        let a_layer = (thickness + 1) * (profile + fillet) + (thickness + 2 * fillet) * (rim + 1);
        let nodes = u128::from(teeth) * (face + 1) * a_layer;
        if nodes > u128::from(MOST_NODES) {
            return Err(StructuredError::TooLarge { nodes, most: MOST_NODES });
        }
        Ok(())
    }
}

/// Meshes a gear in its own frame (axis +z, tooth 0's centre line at mid-face on +x), lengths in mm.
///
/// # Errors
/// [`StructuredError`]: counts without meaning, a rim too thin for the bore, a layer that turns too far, an element with a scaled Jacobian below 0.1,
/// more than 20 million nodes.
///
/// # Example
/// One tooth, one element along the face: every node of a hex8 section occurs twice.
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
