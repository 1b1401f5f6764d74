//! Structure of a gearbox: shafts, discs, bearings, a housing and linear meshes.

use std::f64::consts::PI;

use fem::beam::BeamPiece;
use lumped::shaft18::MeshGeometry;
use nalgebra::{DMatrix, Matrix6, Vector6};

use crate::{Bearing, ElasticBody, GearboxError};

/// A shaft: consecutive Timoshenko beam sections along +z.
#[derive(Debug, Clone, PartialEq)]
pub struct Shaft {
    /// Name for messages and tables.
    pub name: String,
    /// Position of the shaft's own z = 0 in the gearbox, mm. Axes of all shafts are along +z.
    pub origin: [f64; 3],
    /// Sections, starting at the shaft's own z = 0; empty for a rigid body, whose discs and bearings are all at z = 0.
    pub pieces: Vec<BeamPiece>,
    /// Longest beam element, mm; it does not affect static results, because the elements are exact.
    pub longest_element: f64,
}

/// A rigid disc or gear body on a shaft. Without mass it is a seat: of an elastic gear, of a coupling, or of any other
/// point on which a force acts.
#[derive(Debug, Clone, PartialEq)]
pub struct Disc {
    /// Name for messages and tables.
    pub name: String,
    /// Index of the shaft, from 0.
    pub shaft: usize,
    /// Position of its mid-plane, mm from the shaft's z = 0.
    pub position: f64,
    /// Height of its mid-plane above the cross-section with which it moves, mm. It is 0 for most discs. It differs for
    /// a gear that is meshed as one body with part of the shaft, or that sits on a hub of this length. The
    /// cross-section must be on the shaft, the mid-plane need not.
    pub reach: f64,
    /// Mass, t.
    pub mass: f64,
    /// Inertia about a diameter through its centre, t mm^2.
    pub diametral_inertia: f64,
    /// Inertia about the axis, t mm^2.
    pub polar_inertia: f64,
}

/// A mesh as one spring along its line of action: a mean mesh stiffness for natural frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshSpring {
    /// Name for messages and tables.
    pub name: String,
    /// Disc indices of gears 1 and 2.
    pub discs: [usize; 2],
    /// Compression of the spring for unit displacements and rotations of gear 1 and gear 2: 1, mm.
    pub levers: [Vector6<f64>; 2],
    /// Stiffness along the normal, N/mm.
    pub stiffness: f64,
}

/// A mesh as a stiffness between its gears, including tilts and elastic modes: the mean tangent of an exact contact,
/// rotated to common axes.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticMesh {
    /// Name for messages and tables.
    pub name: String,
    /// Disc indices of gears 1 and 2.
    pub discs: [usize; 2],
    /// Stiffness for displacements and rotations of gear 1 and gear 2, followed by the modes of both if their discs
    /// have an [`ElasticBody`]; common axes, symmetric: N/mm, N, N mm, with mm t^(1/2) instead of mm for modes.
    pub stiffness: DMatrix<f64>,
}

/// A machine behind a coupling that transmits only torque: its rotor rotates with the shaft and does not tilt with it.
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    /// Name for messages and tables.
    pub name: String,
    /// Index of the disc with which it rotates.
    pub disc: usize,
    /// Inertia about its axis, t mm^2.
    pub inertia: f64,
}

/// All parts of a gearbox. Lengths in mm, forces in N, masses in t; common axes x, y, z.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Structure {
    /// Shafts.
    pub shafts: Vec<Shaft>,
    /// Discs, gears and seats.
    pub discs: Vec<Disc>,
    /// Bearings.
    pub bearings: Vec<Bearing>,
    /// Stiffness of the housing between the bearing seats, six coordinates per bearing in order, symmetric; the housing
    /// is held at its foundation. `None`: rigid.
    pub housing: Option<DMatrix<f64>>,
    /// Meshes as springs.
    pub springs: Vec<MeshSpring>,
    /// Meshes as whole stiffness matrices.
    pub elastic_meshes: Vec<ElasticMesh>,
    /// Modes of gears, at most once per disc; only for vibration. In a motion, gears are rigid apart from their teeth.
    pub bodies: Vec<ElasticBody>,
    /// Machines at the ends of the train.
    pub machines: Vec<Machine>,
    /// Shafts that do not rotate and whose rotation is held by their bearings: carriers in their own frame, and pins.
    pub standing: Vec<usize>,
    /// Shaft that does not rotate in space while the frame of the carrier rotates: a ring or a sun. Its bearings hold
    /// its rotation. `None`: the carrier does not rotate in space.
    pub fixed: Option<usize>,
}

impl Disc {
    /// A seat without mass.
    pub fn seat(name: impl Into<String>, shaft: usize, position: f64) -> Self {
        Self { name: name.into(), shaft, position, reach: 0.0, mass: 0.0, diametral_inertia: 0.0, polar_inertia: 0.0 }
    }

    /// A ring between two diameters (mm), with given width (mm) and density (t/mm^3).
    ///
    /// ```text
    /// m = rho pi w (D^2 - d^2)/4,   I_p = m (D^2 + d^2)/8,   I_d = I_p/2 + m w^2/12
    /// ```
    pub fn ring(
        name: impl Into<String>,
        shaft: usize,
        position: f64,
        [outer, inner]: [f64; 2],
        width: f64,
        density: f64,
    ) -> Self {
        let mass = density * PI * width * 0.25 * (outer * outer - inner * inner);
        let polar_inertia = mass * (outer * outer + inner * inner) / 8.0;
        let diametral_inertia = 0.5 * polar_inertia + mass * width * width / 12.0;
        Self { name: name.into(), shaft, position, reach: 0.0, mass, diametral_inertia, polar_inertia }
    }

    /// The same disc, moving with the cross-section at `seat` (mm from the shaft's z = 0).
    pub fn seated_at(self, seat: f64) -> Self {
        Self { reach: self.position - seat, ..self }
    }

    /// Mass (t) and inertia (t mm^2) that its six coordinates move.
    pub(crate) fn inertia(&self) -> [f64; 6] {
        let Self { mass, diametral_inertia, polar_inertia, .. } = *self;
        [mass, mass, mass, diametral_inertia, diametral_inertia, polar_inertia]
    }

    /// Place of the disc's cross-section, mm from the shaft's z = 0.
    pub(crate) fn seat_position(&self) -> f64 {
        self.position - self.reach
    }
}

impl MeshSpring {
    /// The spring of two involute gears with even load; its levers are those of theory (53).
    ///
    /// # Errors
    /// [`GearboxError::Mesh`] if the gears have no line of action.
    pub fn new(
        name: impl Into<String>,
        discs: [usize; 2],
        geometry: &MeshGeometry,
        stiffness: f64,
    ) -> Result<Self, GearboxError> {
        let name = name.into();
        let line = geometry.line().map_err(|source| GearboxError::Mesh { mesh: name.clone(), source })?;
        Ok(Self { name, discs, levers: line.levers, stiffness })
    }
}

impl Structure {
    /// Checks that all parts sit on existing shafts, and all values have a meaning.
    pub(crate) fn check(&self) -> Result<(), GearboxError> {
        if self.shafts.is_empty() {
            return Err(GearboxError::NoShafts);
        }
        for shaft in &self.shafts {
            for value in shaft.origin {
                finite(&shaft.name, "origin, mm", value)?;
            }
        }
        self.check_size()?;
        for disc in &self.discs {
            finite(&disc.name, "position, mm", disc.position)?;
            finite(&disc.name, "reach, mm", disc.reach)?;
            self.on_shaft(&disc.name, disc.shaft, disc.seat_position())?;
            not_negative(&disc.name, "mass, t", disc.mass)?;
            not_negative(&disc.name, "diametral inertia, t mm^2", disc.diametral_inertia)?;
            not_negative(&disc.name, "polar inertia, t mm^2", disc.polar_inertia)?;
        }
        for bearing in &self.bearings {
            self.on_shaft(&bearing.name, bearing.shaft, bearing.position)?;
            let of = |m: &Matrix6<f64>| DMatrix::from_column_slice(6, 6, m.as_slice());
            elastic(&bearing.name, "stiffness", &of(&bearing.stiffness))?;
            elastic(&bearing.name, "damping", &of(&bearing.damping))?;
            for value in bearing.preload.iter().chain([&bearing.stored]) {
                finite(&bearing.name, "preload, N, N mm", *value)?;
            }
            for value in &bearing.offset {
                finite(&bearing.name, "offset of its seat, mm", *value)?;
            }
        }
        self.check_seats()?;
        self.check_bores()?;
        if let Some(housing) = &self.housing {
            let (bearings, wanted) = (self.bearings.len(), 6 * self.bearings.len());
            if let Some(&found) = [housing.nrows(), housing.ncols()].iter().find(|n| **n != wanted) {
                return Err(GearboxError::HousingSize { found, bearings, wanted });
            }
            elastic("housing", "stiffness", housing)?;
        }
        for spring in &self.springs {
            self.has_discs(&spring.name, spring.discs)?;
            not_negative(&spring.name, "mesh stiffness, N/mm", spring.stiffness)?;
            for value in spring.levers.iter().flat_map(|h| h.iter()) {
                finite(&spring.name, "lever of the mesh", *value)?;
            }
        }
        for machine in &self.machines {
            self.has_discs(&machine.name, [machine.disc; 2])?;
            not_negative(&machine.name, "inertia, t mm^2", machine.inertia)?;
        }
        for (i, body) in self.bodies.iter().enumerate() {
            self.has_discs("the modes of a gear", [body.disc; 2])?;
            let disc = &self.discs[body.disc];
            body.check(&disc.name, disc.inertia())?;
            if self.bodies[..i].iter().any(|other| other.disc == body.disc) {
                let (found, wanted) = (2, 1);
                return Err(GearboxError::Count { what: "sets of modes of one gear", found, wanted });
            }
        }
        for mesh in &self.elastic_meshes {
            self.has_discs(&mesh.name, mesh.discs)?;
            let wanted = 12 + mesh.discs.iter().map(|disc| self.modes_of(*disc)).sum::<usize>();
            if let Some(&found) = [mesh.stiffness.nrows(), mesh.stiffness.ncols()].iter().find(|n| **n != wanted) {
                return Err(GearboxError::Count { what: "coordinates of a mesh stiffness", found, wanted });
            }
            elastic(&mesh.name, "mesh stiffness", &mesh.stiffness)?;
        }
        Ok(())
    }

    /// Number of elastic modes of a disc.
    pub(crate) fn modes_of(&self, disc: usize) -> usize {
        self.bodies.iter().find(|body| body.disc == disc).map_or(0, ElasticBody::count)
    }

    /// Checks that no gear has modes of its own, which a motion in time has no coordinates for.
    pub(crate) fn check_rigid(&self) -> Result<(), GearboxError> {
        match self.bodies.first() {
            Some(body) => Err(GearboxError::ModesInMotion { gear: self.discs[body.disc].name.clone() }),
            None => Ok(()),
        }
    }

    /// Checks that the matrices of all nodes are small enough for dense algebra.
    fn check_size(&self) -> Result<(), GearboxError> {
        const MOST: usize = 600;
        let of_shaft = |shaft: &Shaft| {
            let of_piece = |p: &BeamPiece| (p.length / shaft.longest_element).ceil().max(1.0);
            1.0 + shaft.pieces.iter().map(of_piece).sum::<f64>()
        };
        let nodes = self.shafts.iter().map(of_shaft).sum::<f64>() + (self.discs.len() + self.bearings.len()) as f64;
        let nodes = nodes + self.bodies.iter().map(|body| body.count() as f64 / 6.0).sum::<f64>();
        // What is no number is told by the shaft itself.
        if nodes > MOST as f64 { Err(GearboxError::TooLarge { nodes, most: MOST }) } else { Ok(()) }
    }

    /// Checks that the discs of a mesh exist.
    pub(crate) fn has_discs(&self, part: &str, discs: [usize; 2]) -> Result<(), GearboxError> {
        let count = self.discs.len();
        match discs.into_iter().find(|d| *d >= count) {
            Some(disc) => Err(GearboxError::NoDisc { part: part.into(), disc, count }),
            None => Ok(()),
        }
    }

    /// Checks that a shaft exists.
    pub(crate) fn has_shaft(&self, part: &str, shaft: usize) -> Result<&Shaft, GearboxError> {
        let none = || GearboxError::NoShaft { part: part.into(), shaft, count: self.shafts.len() };
        self.shafts.get(shaft).ok_or_else(none)
    }

    pub(crate) fn on_shaft(&self, part: &str, shaft: usize, position_mm: f64) -> Result<(), GearboxError> {
        let on = self.has_shaft(part, shaft)?;
        let length_mm: f64 = on.pieces.iter().map(|p| p.length).sum();
        let near = 1e-9 * length_mm;
        if (-near..=length_mm + near).contains(&position_mm) {
            return Ok(());
        }
        Err(GearboxError::OffShaft { part: part.into(), position_mm, length_mm })
    }
}

fn finite(part: &str, quantity: &'static str, value: f64) -> Result<(), GearboxError> {
    if value.is_finite() { Ok(()) } else { Err(GearboxError::OutOfRange { part: part.into(), quantity, value }) }
}

fn not_negative(part: &str, quantity: &'static str, value: f64) -> Result<(), GearboxError> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(GearboxError::OutOfRange { part: part.into(), quantity, value })
    }
}

/// A symmetric matrix without negative eigenvalues, but for round-off and the digits of a file.
fn elastic(part: &str, matrix: &'static str, values: &DMatrix<f64>) -> Result<(), GearboxError> {
    const DIGITS: f64 = 1e-6;
    if let Some(value) = values.iter().copied().find(|x| !x.is_finite()) {
        return Err(GearboxError::OutOfRange { part: part.into(), quantity: matrix, value });
    }
    let bad = |off: f64| Err(GearboxError::NotElastic { part: part.into(), matrix, off });
    let largest = values.amax();
    if largest == 0.0 {
        return Ok(());
    }
    // Turns and displacements differ by the square of a length: scaled, small entries count as well.
    let scale: Vec<f64> = values.diagonal().iter().map(|d| if *d > 0.0 { d.sqrt().recip() } else { 1.0 }).collect();
    let n = values.nrows();
    let scaled = DMatrix::from_fn(n, n, |i, j| values[(i, j)] * scale[i] * scale[j]);
    let off = (&scaled - scaled.transpose()).amax();
    if off > DIGITS * scaled.amax() {
        return bad(off / scaled.amax());
    }
    let least = scaled.clone().symmetric_eigenvalues().min();
    if least < -DIGITS * scaled.amax() { bad(-least / scaled.amax()) } else { Ok(()) }
}
