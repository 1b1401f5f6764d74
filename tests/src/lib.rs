//! What tests and benches across crates share: the default pair, its meshes, and models of them.
#![allow(missing_docs, reason = "for tests and benches alone")]

pub mod judged;
pub mod killed;
#[allow(clippy::print_stdout, reason = "the figures of a fit are what commands call it for")]
pub mod law_fit;
pub mod measured_motion;
pub mod measured_pair;
pub mod moving;
pub mod pair_law_fit;
pub mod pairs_done;
pub mod program;
pub mod random_motion;
pub mod random_scene;
pub mod random_scenes;
pub mod readers;
pub mod recorded;
pub mod scaled;
pub mod small_scenes;

use std::path::PathBuf;

use contact::Method;
use fem::{ElementOptions, Material};
use geometry::{Gear, GearData, GearModifications, GearPair};
use ltca::{StaticModel, StaticOptions};
use mesh::{GearMesh, GroupNames, Mesh};
use reduction::{ElasticGear, FullGear, GearReducer, ReductionOptions};

/// A pair with the meshes of both gears.
pub struct Case {
    pub pair: GearPair,
    pub meshes: [GearMesh; 2],
    pub elements: ElementOptions,
    pub torque: f64,
}

pub fn steel() -> Material {
    Material::new(2.06e5, 0.3, 7.85e-9).unwrap()
}

pub fn default_pair() -> GearPair {
    let data = GearData::default();
    let wheel = GearData { helix_angle: -data.helix_angle, ..data.clone() };
    GearPair::new(Gear::new(data).unwrap(), Gear::new(wheel).unwrap(), None).unwrap()
}

pub fn meshes_folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../meshes")
}

fn read(name: &str, teeth: u32) -> GearMesh {
    let path = meshes_folder().join(name);
    let mesh = Mesh::read(&path).unwrap_or_else(|e| panic!("{e}"));
    GearMesh::from_groups(mesh, &GroupNames::default(), teeth).unwrap_or_else(|e| panic!("{name}: {e}"))
}

impl Case {
    /// One of the pairs of meshes of the finite-element reference.
    pub fn reference(name: &str, elements: ElementOptions) -> Self {
        Self::read(&format!("reference/{name}_g1.msh"), &format!("reference/{name}_g2.msh"), elements)
    }

    /// The default pair on two meshes of `meshes/`.
    pub fn read(pinion: &str, wheel: &str, elements: ElementOptions) -> Self {
        let pair = default_pair();
        let meshes = [read(pinion, pair.pinion.teeth()), read(wheel, pair.wheel.teeth())];
        Self { pair, meshes, elements, torque: 150e3 }
    }

    /// Pressed points.
    pub fn options(&self) -> StaticOptions {
        self.slice_options().with_contact(|c| c.method = Method::Nodal)
    }

    /// Slices.
    pub fn slice_options(&self) -> StaticOptions {
        StaticOptions::new(self.torque, &self.pair)
    }

    pub fn reduced(&self, options: StaticOptions) -> StaticModel {
        let gears = self.reduced_gears(&options);
        StaticModel::new(self.pair.clone(), gears, options).unwrap_or_else(|e| panic!("{e}"))
    }

    pub fn reduced_gears(&self, options: &StaticOptions) -> [ElasticGear; 2] {
        let first = StaticModel::first_teeth(&self.pair, options).unwrap();
        [0, 1].map(|i| {
            let o = ReductionOptions {
                sides: options.contact.sides(),
                window: options.window_teeth(&self.pair),
                first: first[i],
                elements: self.elements,
            };
            ElasticGear::Reduced(GearReducer::new(self.meshes[i].clone(), steel(), o).unwrap())
        })
    }

    pub fn full(&self, options: StaticOptions) -> StaticModel {
        let gears =
            [0, 1].map(|i| ElasticGear::Full(FullGear::new(self.meshes[i].clone(), steel(), &self.elements).unwrap()));
        StaticModel::new(self.pair.clone(), gears, options).unwrap_or_else(|e| panic!("{e}"))
    }
}

/// Mean and peak to peak.
pub fn summary(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut n, mut sum, mut low, mut high) = (0.0, 0.0, f64::INFINITY, f64::NEG_INFINITY);
    for v in values {
        (n, sum, low, high) = (n + 1.0, sum + v, v.min(low), v.max(high));
    }
    (sum / n, high - low)
}

/// Meshes of the built-in mesher; `counts`: elements along the profile, the fillet, across the tooth, along the face,
/// in the rim.
fn meshes(pair: &GearPair, order: u32, counts: [u32; 5], extent: mesh::Extent) -> [GearMesh; 2] {
    let [profile, fillet, thickness, face, rim] = counts;
    let options = mesh::StructuredOptions {
        order,
        elements_profile: profile,
        elements_fillet: fillet,
        elements_thickness: thickness,
        elements_face: face,
        elements_rim: rim,
        extent,
    };
    [&pair.pinion, &pair.wheel].map(|gear| {
        let mesh = mesh::generate(gear, &options).unwrap_or_else(|e| panic!("{e}"));
        GearMesh::from_groups(mesh, &GroupNames::default(), gear.teeth()).unwrap()
    })
}

/// The default pair at another helix angle in degrees on meshes of the built-in mesher, hex8;
/// `counts`: elements along the profile, the fillet, across the tooth, along the face, in the rim.
pub fn generated(beta_deg: f64, counts: [u32; 5]) -> Case {
    let data = GearData { helix_angle: beta_deg.to_radians(), ..GearData::default() };
    let wheel = GearData { helix_angle: -data.helix_angle, ..data.clone() };
    let pair = GearPair::new(Gear::new(data).unwrap(), Gear::new(wheel).unwrap(), None).unwrap();
    let meshes = meshes(&pair, 1, counts, mesh::Extent::Whole);
    Case { pair, meshes, elements: ElementOptions::default(), torque: 150e3 }
}

/// Any pair on quadratic meshes of the built-in mesher; `wheel` bears its own helix angle, `counts` as in
/// [`generated`].
pub fn quadratic(
    data: [GearData; 2],
    centre_distance: Option<f64>,
    torque: f64,
    counts: [u32; 5],
    extent: mesh::Extent,
) -> Case {
    of_order(2, data, centre_distance, torque, counts, extent)
}

/// The same on meshes of order 1 or 2.
pub fn of_order(
    order: u32,
    [pinion, wheel]: [GearData; 2],
    centre_distance: Option<f64>,
    torque: f64,
    counts: [u32; 5],
    extent: mesh::Extent,
) -> Case {
    let pair = GearPair::new(Gear::new(pinion).unwrap(), Gear::new(wheel).unwrap(), centre_distance).unwrap();
    let meshes = meshes(&pair, order, counts, extent);
    Case { pair, meshes, elements: ElementOptions::default(), torque }
}

/// A pair whose gears have face widths of their own (mm) and an offset of their mid-faces (mm), on meshes of the built-in
/// mesher with face elements of 2 mm; `counts`: elements along the profile, the fillet, across the tooth, in the rim.
pub fn of_widths(
    order: u32,
    data: [GearData; 2],
    widths: [f64; 2],
    offset: f64,
    [profile, fillet, thickness, rim]: [u32; 4],
    extent: mesh::Extent,
) -> Case {
    let [pinion, wheel] = [0, 1].map(|i| GearData { face_width: widths[i], ..data[i].clone() });
    let pair = GearPair::new(Gear::new(pinion).unwrap(), Gear::new(wheel).unwrap(), None).unwrap();
    let pair = pair.with_mid_face_offset(offset).unwrap_or_else(|e| panic!("{e}"));
    let counts = |width: f64| [profile, fillet, thickness, (width / 2.0).round() as u32, rim];
    let [[first, _], [_, second]] = widths.map(|width| meshes(&pair, order, counts(width), extent));
    Case { pair, meshes: [first, second], elements: ElementOptions::default(), torque: 150e3 }
}

/// The default pair at another helix angle, degrees.
pub fn default_data(beta_deg: f64) -> [GearData; 2] {
    let data = GearData { helix_angle: beta_deg.to_radians(), ..GearData::default() };
    [data.clone(), GearData { helix_angle: -data.helix_angle, ..data }]
}

/// The same pair with micro-geometry.
pub fn modified(pair: &GearPair, modifications: [GearModifications; 2]) -> GearPair {
    let [a, b] = modifications;
    let pinion = pair.pinion.clone().with_modifications(a).unwrap();
    let wheel = pair.wheel.clone().with_modifications(b).unwrap();
    let moved = GearPair::new(pinion, wheel, Some(pair.centre_distance())).unwrap();
    moved.with_mid_face_offset(pair.mid_face_offset()).unwrap()
}

/// The same mesh, larger.
pub fn scaled(gear: &GearMesh, by: f64) -> GearMesh {
    let mut mesh = gear.mesh().clone();
    mesh.nodes.iter_mut().flatten().for_each(|x| *x *= by);
    GearMesh::from_groups(mesh, &GroupNames::default(), gear.tooth_count()).unwrap()
}
