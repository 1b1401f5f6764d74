//! Gear pairs from numbers, meshes of both gears, and static models of them.

use std::path::PathBuf;

use contact::Method;
use fem::{ElementOptions, Material};
use geometry::{Gear, GearData, GearModifications, GearPair, Shaper};
use ltca::{StaticModel, StaticOptions};
use mesh::{Extent, GroupNames, Mesh, MeshedGear, StructuredOptions};
use reduction::{ElasticGear, FullGear, GearReducer, ReductionOptions};

/// A gear pair with the meshes of both gears, of steel.
pub struct Case {
    /// Exact geometry of both gears.
    pub pair: GearPair,
    /// Meshes of pinion and wheel.
    pub meshes: [MeshedGear; 2],
    /// Integration and incompatible modes of the elements.
    pub elements: ElementOptions,
    /// Torque of the driven gear, N mm.
    pub torque: f64,
}

/// The default pair: 30/30 teeth, normal module 3 mm, helix angle 20 degrees.
pub fn default_pair() -> GearPair {
    let [pinion, wheel] = default_data(20.0);
    GearPair::new(Gear::new(pinion).unwrap(), Gear::new(wheel).unwrap(), None).unwrap()
}

/// Gears of the default pair at another helix angle, degrees.
pub fn default_data(beta_deg: f64) -> [GearData; 2] {
    let data = GearData { helix_angle: beta_deg.to_radians(), ..GearData::default() };
    [data.clone(), GearData { helix_angle: -data.helix_angle, ..data }]
}

/// The folder `meshes` of the repository.
pub fn meshes_folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../meshes")
}

fn read(name: &str, teeth: u32) -> MeshedGear {
    let path = meshes_folder().join(name);
    let mesh = Mesh::read(&path).unwrap_or_else(|e| panic!("{e}"));
    MeshedGear::from_groups(mesh, &GroupNames::default(), teeth).unwrap_or_else(|e| panic!("{name}: {e}"))
}

impl Case {
    /// A pair on meshes of the built-in mesher; torque of the driven gear in N mm.
    pub fn meshed(pair: GearPair, options: &StructuredOptions, torque: f64) -> Self {
        let meshes = structured(&pair, options);
        Self { pair, meshes, elements: ElementOptions::default(), torque }
    }

    /// The default pair on two meshes of the finite-element reference, `meshes/reference/`.
    pub fn reference(name: &str, elements: ElementOptions) -> Self {
        Self::read(&format!("reference/{name}_g1.msh"), &format!("reference/{name}_g2.msh"), elements)
    }

    /// The default pair on two meshes of `meshes/`.
    pub fn read(pinion: &str, wheel: &str, elements: ElementOptions) -> Self {
        let pair = default_pair();
        let meshes = [read(pinion, pair.pinion.teeth()), read(wheel, pair.wheel.teeth())];
        Self { pair, meshes, elements, torque: 150e3 }
    }

    /// Options of contact by pressed points.
    pub fn options(&self) -> StaticOptions {
        self.slice_options().with_contact(|c| c.method = Method::Nodal)
    }

    /// Options of contact by slices.
    pub fn slice_options(&self) -> StaticOptions {
        StaticOptions::new(self.torque, &self.pair)
    }

    /// Static model on reduced gears.
    pub fn reduced(&self, options: StaticOptions) -> StaticModel {
        let gears = self.reduced_gears(&options);
        StaticModel::new(self.pair.clone(), gears, options).unwrap_or_else(|e| panic!("{e}"))
    }

    /// Both gears, reduced to the flanks and the window of the options.
    pub fn reduced_gears(&self, options: &StaticOptions) -> [ElasticGear; 2] {
        self.reduced_gears_of(options, [Material::STEEL; 2], false)
    }

    /// The same of other materials; `general`: in one factor each, whatever the gear is.
    pub fn reduced_gears_of(
        &self,
        options: &StaticOptions,
        materials: [Material; 2],
        general: bool,
    ) -> [ElasticGear; 2] {
        let make = if general { GearReducer::general } else { GearReducer::new };
        let first = StaticModel::first_teeth(&self.pair, options).unwrap();
        [0, 1].map(|i| {
            let o = ReductionOptions {
                sides: options.contact.sides(),
                window: options.window_teeth(&self.pair),
                first: first[i],
                elements: self.elements,
            };
            ElasticGear::Reduced(make(self.meshes[i].clone(), materials[i], o).unwrap())
        })
    }

    /// Static model with all degrees of freedom of both gears.
    pub fn full(&self, options: StaticOptions) -> StaticModel {
        let gears = [0, 1].map(|i| {
            ElasticGear::Full(FullGear::new(self.meshes[i].clone(), Material::STEEL, &self.elements).unwrap())
        });
        StaticModel::new(self.pair.clone(), gears, options).unwrap_or_else(|e| panic!("{e}"))
    }
}

/// Mean and peak to peak of values.
pub fn mean_and_peak_to_peak(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut n, mut sum, mut low, mut high) = (0.0, 0.0, f64::INFINITY, f64::NEG_INFINITY);
    for v in values {
        (n, sum, low, high) = (n + 1.0, sum + v, v.min(low), v.max(high));
    }
    (sum / n, high - low)
}

/// Meshes of both gears by the built-in mesher.
pub fn structured(pair: &GearPair, options: &StructuredOptions) -> [MeshedGear; 2] {
    [&pair.pinion, &pair.wheel].map(|gear| {
        let mesh = mesh::generate(gear, options).unwrap_or_else(|e| panic!("{e}"));
        MeshedGear::find(mesh, gear, &GroupNames::default()).unwrap().0
    })
}

/// Options of the built-in mesher; `counts`: elements along the profile, the fillet, across the tooth, along the face,
/// in the rim.
fn options(order: u32, counts: [u32; 5], extent: Extent) -> StructuredOptions {
    let [profile, fillet, thickness, face, rim] = counts;
    StructuredOptions {
        order,
        elements_profile: profile,
        elements_fillet: fillet,
        elements_thickness: thickness,
        elements_face: face,
        elements_rim: rim,
        extent,
    }
}

/// 20 teeth in a ring of 52, module 3 mm, at a helix angle in degrees.
pub fn planet_in_ring(beta_deg: f64) -> [GearData; 2] {
    let pinion = GearData {
        teeth: 20,
        helix_angle: beta_deg.to_radians(),
        profile_shift: 0.3,
        bore_diameter: 30.0,
        face_width: 15.0,
        ..GearData::default()
    };
    let ring = GearData {
        teeth: 52,
        profile_shift: -0.1,
        bore_diameter: -200.0,
        addendum_coefficient: 0.85,
        root_radius_coefficient: 0.25,
        ..pinion.clone()
    };
    [pinion, ring.with_usual_shaper(0.0)]
}

/// Planet and ring of the second stage of NREL's 5 MW reference gearbox, a seventh of their size, with the torque on the ring
/// at 250 N/mm of 12 mm face; teeth thinned by `allowance` (mm), quadratic meshes with `counts` as in [`generated`].
pub fn nrel_planet_in_ring(allowance: f64, counts: [u32; 5], extent: Extent) -> Case {
    let data = GearData {
        normal_module: 3.0,
        helix_angle: 0.0,
        face_width: 12.0,
        thickness_allowance: allowance,
        ..GearData::default()
    };
    let planet = GearData {
        teeth: 36,
        profile_shift: 0.5039,
        bore_diameter: 60.0,
        tip_diameter: Some(36.0 * 3.0 + 2.0 * (3.0 * 1.5039 - 0.25)),
        ..data.clone()
    };
    let ring = GearData {
        teeth: 93,
        profile_shift: 0.1171,
        bore_diameter: -310.0,
        root_radius_coefficient: 0.3,
        shaper: Some(Shaper { teeth: 30, profile_shift: 0.0 }),
        ..data
    };
    quadratic([planet, ring], Some(-584.0 / 7.0), 250.0 * 12.0 * 131.1, counts, extent)
}

/// The default pair at another helix angle in degrees on whole gears of the built-in mesher, hex8; `counts`: elements
/// along the profile, the fillet, across the tooth, along the face, in the rim.
pub fn generated(beta_deg: f64, counts: [u32; 5]) -> Case {
    of_order(1, default_data(beta_deg), None, 150e3, counts, Extent::Whole)
}

/// Any pair on quadratic meshes of the built-in mesher; `wheel` bears its own helix angle, `counts` as in
/// [`generated`].
pub fn quadratic(
    data: [GearData; 2],
    centre_distance: Option<f64>,
    torque: f64,
    counts: [u32; 5],
    extent: Extent,
) -> Case {
    of_order(2, data, centre_distance, torque, counts, extent)
}

/// Any pair on meshes of order 1 or 2 of the built-in mesher; arguments as those of [`quadratic`].
pub fn of_order(
    order: u32,
    [pinion, wheel]: [GearData; 2],
    centre_distance: Option<f64>,
    torque: f64,
    counts: [u32; 5],
    extent: Extent,
) -> Case {
    let pair = GearPair::new(Gear::new(pinion).unwrap(), Gear::new(wheel).unwrap(), centre_distance).unwrap();
    Case::meshed(pair, &options(order, counts, extent), torque)
}

/// A pair whose gears have face widths of their own (mm) and an offset of their mid-faces (mm), on meshes of the built-in
/// mesher with face elements of 2 mm; `counts`: elements along the profile, the fillet, across the tooth, in the rim.
pub fn of_widths(
    order: u32,
    data: [GearData; 2],
    widths: [f64; 2],
    offset: f64,
    [profile, fillet, thickness, rim]: [u32; 4],
    extent: Extent,
) -> Case {
    let [pinion, wheel] = [0, 1].map(|i| GearData { face_width: widths[i], ..data[i].clone() });
    let pair = GearPair::new(Gear::new(pinion).unwrap(), Gear::new(wheel).unwrap(), None).unwrap();
    let pair = pair.with_mid_face_offset(offset).unwrap_or_else(|e| panic!("{e}"));
    let counts = |width: f64| [profile, fillet, thickness, (width / 2.0).round() as u32, rim];
    let [[first, _], [_, second]] = widths.map(|width| structured(&pair, &options(order, counts(width), extent)));
    Case { pair, meshes: [first, second], elements: ElementOptions::default(), torque: 150e3 }
}

/// A pair with other micro-geometry.
pub fn modified(pair: &GearPair, modifications: [GearModifications; 2]) -> GearPair {
    let [a, b] = modifications;
    let pinion = pair.pinion.clone().with_modifications(a).unwrap();
    let wheel = pair.wheel.clone().with_modifications(b).unwrap();
    let moved = GearPair::new(pinion, wheel, Some(pair.centre_distance())).unwrap();
    moved.with_mid_face_offset(pair.mid_face_offset()).unwrap()
}

/// A mesh with all lengths times a factor.
pub fn scaled(gear: &MeshedGear, by: f64) -> MeshedGear {
    let mut mesh = gear.mesh().clone();
    mesh.nodes.iter_mut().flatten().for_each(|x| *x *= by);
    MeshedGear::from_groups(mesh, &GroupNames::default(), gear.tooth_count()).unwrap()
}
