//! Sectors of five teeth of the default pair.

use fem::Material;
use geometry::{GearPair, Side};
use mesh::{Extent, MeshedGear, StructuredOptions};
use study::calculix::{Body, Deck};
use testing::{default_pair, structured};

/// N mm.
pub const TORQUE: f64 = 150e3;
/// Teeth that may touch.
pub const PAIRS: [[u32; 2]; 3] = [[29, 1], [0, 0], [1, 29]];

/// Both gears with their meshes.
pub struct Pair {
    pub pair: GearPair,
    pub gears: [MeshedGear; 2],
}

pub fn pair(order: u32) -> Pair {
    let pair = default_pair();
    let options = StructuredOptions {
        order,
        elements_profile: 3,
        elements_fillet: 2,
        elements_thickness: 2,
        elements_face: 3,
        elements_rim: 1,
        extent: Extent::Sector(5),
    };
    let gears = structured(&pair, &options);
    Pair { pair, gears }
}

impl Pair {
    /// Pair 0 in the middle of its path.
    pub fn deck(&self) -> Deck<'_> {
        let Self { pair, gears } = self;
        let angle = pair.middle_angle(Side::Left);
        let turned = [angle, pair.wheel_angle(Side::Left, angle)];
        let body = |i: usize| Body {
            gear: &gears[i],
            material: &Material::STEEL,
            angle: turned[i],
            centre: [[0.0, 0.0], [pair.centre_distance(), pair.mid_face_offset()]][i],
        };
        Deck {
            bodies: [body(0), body(1)],
            driven: 1,
            side: Side::Left,
            pairs: &PAIRS,
            torque: TORQUE,
            closing: 5e-3 / pair.wheel.base_radius(),
            penalty: 1e7,
        }
    }
}
