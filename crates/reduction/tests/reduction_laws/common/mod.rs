//! Small gears and their meshes.

use fem::ElementOptions;
use geometry::{Gear, GearData, Side};
use mesh::{Extent, GroupNames, MeshedGear, StructuredOptions};
use reduction::ReductionOptions;

pub fn gear(teeth: u32, beta_deg: f64) -> Gear {
    Gear::new(GearData {
        teeth,
        helix_angle: beta_deg.to_radians(),
        face_width: 8.0,
        bore_diameter: 0.45 * 3.0 * f64::from(teeth),
        profile_shift: if teeth < 17 { 0.4 } else { 0.0 },
        ..GearData::default()
    })
    .unwrap()
}

/// As few elements as a gear can have, times `fine` in the tooth.
pub fn meshed(gear: &Gear, order: u32, fine: u32, extent: Extent) -> MeshedGear {
    let options = StructuredOptions {
        order,
        elements_profile: fine,
        elements_fillet: 2,
        elements_thickness: fine,
        elements_face: fine,
        elements_rim: 1,
        extent,
    };
    let mesh = mesh::generate(gear, &options).unwrap();
    MeshedGear::from_groups(mesh, &GroupNames::default(), gear.teeth()).unwrap()
}

pub fn options(sides: &[Side], window: usize, first: u32) -> ReductionOptions {
    ReductionOptions { sides: sides.to_vec(), window, first, elements: ElementOptions::default() }
}
