//! Pairs of gears, elastic on coarse meshes, and gearboxes made of them.

use std::sync::Arc;

use fem::{
    Material,
    beam::{BeamPiece, BeamSection},
};
use gearbox::{
    Bearing, Disc, GearMesh, GearboxError, MeshElement, MeshForces, Meshing, Operation, Shaft, Structure, Torque,
    Vector12,
};
use geometry::{Gear, GearData, GearPair, Sense};
use ltca::StaticOptions;
use lumped::shaft18::MeshGeometry;
use mesh::{Extent, StructuredOptions};
use nalgebra::Vector6;
use reduction::ElasticGear;
use testing::Case;

/// Module 3 mm, 20 degrees, face width 20 mm; gear 1 with a right-hand helix where it is above 0.
pub fn pair(teeth: [u32; 2], helix_deg: f64) -> GearPair {
    of_widths(teeth, helix_deg, [20.0; 2])
}

/// The same with a face width for each gear, mm.
pub fn of_widths(teeth: [u32; 2], helix_deg: f64, widths: [f64; 2]) -> GearPair {
    let gear = |i: usize| {
        let helix = [helix_deg, -helix_deg][i].to_radians();
        let z = teeth[i];
        let bore_diameter = 0.55 * 3.0 * f64::from(z) / helix.cos();
        let face_width = widths[i];
        Gear::new(GearData { teeth: z, helix_angle: helix, bore_diameter, face_width, ..GearData::default() }).unwrap()
    };
    GearPair::new(gear(0), gear(1), None).unwrap()
}

/// One-tooth sectors of few linear elements: what is compared is the same on both sides.
pub const SECTOR: StructuredOptions = StructuredOptions {
    order: 1,
    elements_profile: 2,
    elements_fillet: 2,
    elements_thickness: 2,
    elements_face: 3,
    elements_rim: 2,
    extent: Extent::Periodic,
};

/// Both gears reduced from such sectors.
pub fn reduced(pair: &GearPair, options: &StaticOptions) -> Arc<[ElasticGear; 2]> {
    Arc::new(Case::meshed(pair.clone(), &SECTOR, options.torque).reduced_gears(options))
}

/// Options of a mesh as it runs; the torque is that of the pair alone.
pub fn options(pair: &GearPair, meshing: &Meshing, torque: f64) -> StaticOptions {
    StaticOptions::new(torque, pair).with_contact(|c| {
        c.driver = meshing.driver;
        c.sense = meshing.sense;
        c.slices = 16;
    })
}

/// A solid shaft of some length and diameter with its z = 0 at a place.
pub fn shaft(name: &str, origin: [f64; 3], length: f64, diameter: f64) -> Shaft {
    let section = BeamSection::new(diameter, 0.0, Material::STEEL).unwrap();
    Shaft { name: name.into(), origin, pieces: vec![BeamPiece { length, section }], longest_element: 20.0 }
}

/// A bearing that holds in x, y, z and against tilting.
pub fn bearing(name: &str, shaft: usize, position: f64, axial: f64) -> Bearing {
    Bearing::diagonal(name, shaft, position, [3e5, 2e5, axial, 2e7, 1e7, 0.0])
}

pub fn operation(structure: &Structure, input: usize, sense: Sense, torques: Vec<Torque>) -> Operation {
    Operation { input, sense, torques, keys: vec![0.0; structure.discs.len()], held: Vec::new() }
}

/// One pair: gears in the middle of two shafts at a direction, couplings at the shafts' ends.
///
/// Discs: 0, 1 the gears, 2 input, 3 output.
pub fn single(pair: &GearPair, direction: f64) -> Structure {
    let a = pair.centre_distance();
    // Along +x exactly, as a pair alone stands.
    let (sin, cos) = if direction == 0.0 { (0.0, 1.0) } else { direction.sin_cos() };
    Structure {
        shafts: vec![shaft("in", [0.0; 3], 150.0, 30.0), shaft("out", [a * cos, a * sin, 0.0], 150.0, 40.0)],
        discs: vec![
            Disc::seat("pinion", 0, 60.0),
            Disc::seat("wheel", 1, 60.0),
            Disc::seat("input", 0, 0.0),
            Disc::seat("output", 1, 150.0),
        ],
        bearings: vec![
            bearing("A", 0, 20.0, 1e5),
            bearing("B", 0, 130.0, 0.0),
            bearing("C", 1, 20.0, 1e5),
            bearing("D", 1, 130.0, 0.0),
        ],
        ..Structure::default()
    }
}

/// Two stages, 17/53 and 19/47, the intermediate shaft carries gear 2 and gear 3; gear 4's axis is off the plane of the
/// first two. Discs: 0 to 3 the gears, 4 input, 5 output.
pub fn two_stages() -> (Structure, Vec<GearMesh>) {
    let (first, second) = (pair([17, 53], 15.0), pair([19, 47], -12.0));
    let (a1, a2) = (first.centre_distance(), second.centre_distance());
    let second_at = [a1 + a2 * 1.1f64.cos(), a2 * 1.1f64.sin(), 0.0];
    let structure = Structure {
        shafts: vec![
            shaft("fast", [0.0; 3], 200.0, 25.0),
            shaft("middle", [a1, 0.0, 0.0], 200.0, 35.0),
            shaft("slow", second_at, 200.0, 50.0),
        ],
        discs: vec![
            Disc::seat("gear 1", 0, 50.0),
            Disc::seat("gear 2", 1, 50.0),
            Disc::seat("gear 3", 1, 140.0),
            Disc::seat("gear 4", 2, 140.0),
            Disc::seat("input", 0, 0.0),
            Disc::seat("output", 2, 200.0),
        ],
        bearings: (0..3)
            .flat_map(|s| [bearing(&format!("{s} fixed"), s, 10.0, 1e5), bearing(&format!("{s} loose"), s, 190.0, 0.0)])
            .collect(),
        ..Structure::default()
    };
    let mesh = |name: &str, discs, pair| GearMesh { name: name.into(), discs, pair };
    (structure, vec![mesh("first", [0, 1], first), mesh("second", [2, 3], second)])
}

/// A mesh as a spring of 4e5 N/mm along its line of action.
pub fn spring(mesh: &GearMesh, meshing: &Meshing) -> LinearMesh {
    let line = MeshGeometry::of_pair(&mesh.pair, meshing.side()).line().unwrap();
    LinearMesh { levers: line.levers, stiffness: 4e5, excess: 0.0 }
}

pub fn springs(_: usize, mesh: &GearMesh, meshing: &Meshing) -> Result<Box<dyn MeshElement>, GearboxError> {
    Ok(Box::new(spring(mesh, meshing)))
}

/// A mesh as a spring along its line of action that presses and does not pull: F = k max(0, h . q + e).
#[derive(Debug, Clone, PartialEq)]
pub struct LinearMesh {
    /// What displacements of gear 1 and gear 2 compress it by, in the mesh's own axes: 1, mm.
    pub levers: [Vector6<f64>; 2],
    /// Stiffness along the normal, N/mm.
    pub stiffness: f64,
    /// What the flanks are thicker by than nominal ones, along the normal, mm.
    pub excess: f64,
}

impl MeshElement for LinearMesh {
    fn go_to(&mut self, _cycles: f64) -> Result<(), GearboxError> {
        Ok(())
    }

    fn evaluate(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError> {
        let h = Vector12::from_fn(|i, _| self.levers[i / 6][i % 6]);
        let compression = h.dot(displacements) + self.excess;
        // Also no force for a compression that is no number: the solver then says that there is no equilibrium.
        let stiffness = if compression > 0.0 { self.stiffness } else { 0.0 };
        let normal_force = if compression > 0.0 { self.stiffness * compression } else { 0.0 };
        Ok(MeshForces { force: -normal_force * h, tangent: -stiffness * h * h.transpose(), normal_force })
    }
}
