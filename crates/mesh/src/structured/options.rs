//! Options of the structured mesher.

use super::StructuredError;
use crate::ElementKind;

/// Largest mesh made, in lattice points; a few GB. Nothing here could be solved on it.
const MOST_NODES: u32 = 20_000_000;

/// How much of the gear is meshed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Extent {
    /// All z teeth, no cut faces.
    #[default]
    Whole,
    /// Only tooth 0; `cut_1` is `cut_0` rotated by 2 pi / z, node by node.
    Periodic,
    /// k teeth about tooth 0 with free cut faces. If teeth are numbered clockwise, the range is counted downwards: k =
    /// 3 gives -1, 0, 1.
    Sector(u32),
}

/// Element kind and element counts of the structured mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StructuredOptions {
    /// Element order: 1 for hex8, 2 for hex20.
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
    /// Part of the gear that is meshed.
    pub extent: Extent,
}

impl Default for StructuredOptions {
    /// Six quadratic elements along the flank and six along each fillet of a whole gear: root stress within 3 % of
    /// settled (docs/validation.md).
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
    /// The element kind of this order.
    pub fn kind(&self) -> ElementKind {
        if self.order == 1 { ElementKind::Hex8 } else { ElementKind::Hex20 }
    }

    /// Every complaint that needs no geometry.
    pub(super) fn check(&self, gear_teeth: u32) -> Result<(), StructuredError> {
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
