//! A checked gearbox, in the units of the solvers: mm, N, MPa, rad.

use std::path::PathBuf;

use super::GearboxMotion;
use crate::{Rotation, Scene};

/// A checked gearbox file. Shafts are numbered in the order of the file, and so are gears.
#[derive(Debug, Clone, PartialEq)]
pub struct Gearbox {
    /// Title.
    pub name: String,
    /// Where the file stands; paths in it are relative to its folder.
    pub file: PathBuf,
    /// Shafts.
    pub shafts: Vec<GearboxShaft>,
    /// Bearings.
    pub bearings: Vec<GearboxBearing>,
    /// Gears.
    pub gears: Vec<GearboxGear>,
    /// Meshes.
    pub meshes: Vec<GearboxMesh>,
    /// Where it is driven.
    pub input: GearboxInput,
    /// Loads.
    pub torques: Vec<GearboxTorque>,
    /// Rows of the stiffness of the housing between the bearing seats, N, mm, rad; none: rigid.
    pub housing: Option<Vec<Vec<f64>>>,
    /// Positions a cycle of the first mesh.
    pub positions_per_cycle: u32,
    /// Cycles of the first mesh.
    pub cycles: u32,
    /// How it runs in time; none: at rest alone.
    pub motion: Option<GearboxMotion>,
}

/// A shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxShaft {
    /// Name.
    pub name: String,
    /// Where its own z = 0 lies, mm.
    pub origin: [f64; 3],
    /// Sections from there on.
    pub sections: Vec<GearboxSection>,
    /// Young's modulus, MPa.
    pub young_mpa: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density, t/mm^3; it matters in motion.
    pub density: f64,
    /// Rigid in rigid bearings.
    pub held: bool,
}

/// A length of shaft of one section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxSection {
    /// Length, mm.
    pub length: f64,
    /// Outer diameter, mm.
    pub outer: f64,
    /// Inner diameter, mm.
    pub inner: f64,
}

/// A bearing.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxBearing {
    /// Name.
    pub name: String,
    /// Shaft.
    pub shaft: usize,
    /// Its middle, mm from the shaft's z = 0.
    pub position: f64,
    /// Stiffness for displacements x, y, z and turns about them: N/mm, N, N mm.
    pub stiffness: [[f64; 6]; 6],
    /// Damping along x, y, z, N s/mm.
    pub damping: [f64; 3],
}

/// A gear on a shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxGear {
    /// Name.
    pub name: String,
    /// Shaft.
    pub shaft: usize,
    /// Its mid-plane, mm from the shaft's z = 0.
    pub position: f64,
    /// Angle of tooth 0 against the mark of the shaft, rad.
    pub key: f64,
}

/// Two gears in mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxMesh {
    /// Name.
    pub name: String,
    /// The gears that are pinion and wheel of the scene.
    pub gears: [usize; 2],
    /// What shape they are, how they are meshed and how contact is solved: a scene at rest of the model `reduced` with
    /// slices. Torque, driver and rotation are the gearbox's.
    pub scene: Scene,
}

/// Where the gearbox is driven.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxInput {
    /// Shaft.
    pub shaft: usize,
    /// mm from the shaft's z = 0.
    pub position: f64,
    /// Sense in which it turns.
    pub rotation: Rotation,
    /// Inertia of what drives it, t mm^2.
    pub inertia: f64,
}

/// A load on a shaft, against its rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxTorque {
    /// Shaft.
    pub shaft: usize,
    /// mm from the shaft's z = 0.
    pub position: f64,
    /// N mm, >= 0.
    pub torque: f64,
    /// Inertia of what is driven, t mm^2.
    pub inertia: f64,
}
