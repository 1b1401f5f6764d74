//! The default pair on its coarse meshes, read and reduced.

use std::{error::Error, path::Path};

use fem::{ElementOptions, Material};
use geometry::{Gear, GearData, GearPair};
use ltca::{StaticModel, StaticOptions};
use mesh::{GroupNames, Mesh, MeshedGear};
use reduction::{ElasticGear, GearReducer, ReductionOptions};

/// 30/30 teeth, module 3 mm, helix angle 20 degrees, and the meshes of both gears.
pub fn coarse() -> Result<(GearPair, [MeshedGear; 2]), Box<dyn Error>> {
    let pinion = GearData::default();
    let wheel = GearData { helix_angle: -pinion.helix_angle, ..pinion.clone() };
    let pair = GearPair::new(Gear::new(pinion)?, Gear::new(wheel)?, None)?;
    let read = |gear: &str, teeth: u32| -> Result<MeshedGear, Box<dyn Error>> {
        let file = format!("{}/../../meshes/coarse_hex8_{gear}.msh", env!("CARGO_MANIFEST_DIR"));
        Ok(MeshedGear::from_groups(Mesh::read(Path::new(&file))?, &GroupNames::default(), teeth)?)
    };
    let meshes = [read("pinion", pair.pinion.teeth())?, read("wheel", pair.wheel.teeth())?];
    Ok((pair, meshes))
}

/// Both gears condensed to the flanks that these options press, in the window that a run begins with.
pub fn reduced(
    pair: &GearPair,
    meshes: &[MeshedGear; 2],
    options: &StaticOptions,
) -> Result<[ElasticGear; 2], Box<dyn Error>> {
    let first = StaticModel::first_teeth(pair, options)?;
    let reduce = |i: usize| -> Result<ElasticGear, Box<dyn Error>> {
        let of = ReductionOptions {
            sides: options.contact.sides(),
            window: options.window_teeth(pair),
            first: first[i],
            elements: ElementOptions::default(),
        };
        Ok(ElasticGear::Reduced(GearReducer::new(meshes[i].clone(), Material::STEEL, of)?))
    };
    Ok([reduce(0)?, reduce(1)?])
}
