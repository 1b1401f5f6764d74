//! Writes the CalculiX input deck of one position.

use std::fmt::Write;

use fem::Material;
use geometry::Side;
use mesh::{BoreCoupling, MeshedGear};

use super::{
    CalculixError, element_type,
    elements::{Numbering, node_order},
};

/// One gear at its position.
#[derive(Debug, Clone, Copy)]
pub struct Body<'a> {
    /// The meshed gear, in its own frame.
    pub gear: &'a MeshedGear,
    /// Material of the gear.
    pub material: &'a Material,
    /// Rotation about its own axis, rad, +z.
    pub angle: f64,
    /// x and z of its centre at mid-face, mm; y is 0.
    pub centre: [f64; 2],
}

/// Both gears at one position, with load on the driven one.
#[derive(Debug, Clone, Copy)]
pub struct Deck<'a> {
    /// Pinion and wheel at the pose at which they just touch without load.
    pub bodies: [Body<'a>; 2],
    /// Index of the driven gear.
    pub driven: usize,
    /// Side of the teeth loaded by the torque.
    pub side: Side,
    /// Pinion and wheel tooth of each pair that may touch.
    pub pairs: &'a [[u32; 2]],
    /// Torque on the driven gear against its motion, N mm, > 0.
    pub torque: f64,
    /// Angle by which the driven gear is rotated into contact beforehand, rad, > 0, because without contact its
    /// rotation would have no stiffness. The mesh pushes it back; this motion is part of the result.
    pub closing: f64,
    /// Penalty stiffness: pressure per penetration, MPa/mm.
    pub penalty: f64,
}

const NAMES: [&str; 2] = ["pinion", "wheel"];
/// CalculiX takes at most 16 entries a line.
const A_LINE: usize = 15;

impl Deck<'_> {
    /// Numbers of the driven gear's rigid body: its reference node and the node whose "displacement" is its rotation.
    fn rigid_nodes(&self) -> [usize; 2] {
        let nodes: usize = self.bodies.iter().map(|b| b.gear.mesh().nodes.len()).sum();
        [nodes + 1, nodes + 2]
    }

    /// Sense of the load on the driven gear about +z, in which it also yields; the other one of a ring, which turns as its pinion does.
    pub(super) fn sense(&self) -> f64 {
        self.bodies[self.driven].gear.numbering_sign() * self.side.sign()
    }

    /// Text of the deck; node and element numbers count through both gears from 1.
    ///
    /// # Errors
    /// [`CalculixError::NoSuchElement`], [`CalculixError::MissingFlank`], [`CalculixError::SoftBore`],
    /// [`CalculixError::OutOfRange`].
    pub fn text(&self) -> Result<String, CalculixError> {
        for (name, value) in
            [("torque [N mm]", self.torque), ("closing angle [rad]", self.closing), ("penalty [MPa/mm]", self.penalty)]
        {
            if !(value.is_finite() && value > 0.0) {
                return Err(CalculixError::OutOfRange { name, value, expected: "above 0" });
            }
        }
        let coupling = |i: usize| self.bodies[i].gear.bore_coupling();
        if let Some(i) = [0, 1].into_iter().find(|i| coupling(*i) != BoreCoupling::Kinematic) {
            return Err(CalculixError::SoftBore { gear: NAMES[i], coupling: coupling(i).name() });
        }
        let mut t = String::new();
        let (mut first_node, mut first_element) = (1, 1);
        for i in 0..2 {
            let body = self.bodies[i];
            let turned = body.angle + if i == self.driven { self.sense() * self.closing } else { 0.0 };
            t += &Body { angle: turned, ..body }.text(NAMES[i], [first_node, first_element])?;
            for (k, teeth) in self.pairs.iter().enumerate() {
                t += &body.flank_text(&format!("{}_{k}", NAMES[i]), NAMES[i], (teeth[i], self.side), first_element)?;
            }
            let mesh = body.gear.mesh();
            first_node += mesh.nodes.len();
            first_element += mesh.element_count();
        }
        self.rest(&mut t);
        Ok(t)
    }

    /// Contact, supports, load and what is to be printed.
    fn rest(&self, t: &mut String) {
        let (driver, driven) = (NAMES[1 - self.driven], NAMES[self.driven]);
        let [reference, rotation] = self.rigid_nodes();
        let [x, z] = self.bodies[self.driven].centre;
        line(t, format_args!("*NODE, NSET=axis\n{reference}, {x:.12e}, 0., {z:.12e}"));
        line(t, format_args!("*NODE, NSET=rotation\n{rotation}, {x:.12e}, 0., {z:.12e}"));
        line(t, format_args!("*RIGID BODY, NSET=bore_{driven}, REF NODE={reference}, ROT NODE={rotation}"));
        line(t, format_args!("*SURFACE INTERACTION, NAME=flanks"));
        line(t, format_args!("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{:.6e}", self.penalty));
        for k in 0..self.pairs.len() {
            line(t, format_args!("*CONTACT PAIR, INTERACTION=flanks, TYPE=SURFACE TO SURFACE"));
            line(t, format_args!("{driver}_{k}, {driven}_{k}"));
        }
        line(t, format_args!("*BOUNDARY\nbore_{driver}, 1, 3"));
        line(t, format_args!("{reference}, 1, 3\n{rotation}, 1, 2"));
        line(t, format_args!("*STEP, INC=100\n*STATIC\n1., 1."));
        line(t, format_args!("*CLOAD\n{rotation}, 3, {:.12e}", self.sense() * self.torque));
        line(t, format_args!("*NODE PRINT, NSET=rotation\nU"));
        for k in 0..self.pairs.len() {
            line(t, format_args!("*CONTACT PRINT, SLAVE={driver}_{k}, MASTER={driven}_{k}\nCF"));
        }
        line(t, format_args!("*END STEP"));
    }
}

impl Body<'_> {
    /// Cards of a gear: its nodes, elements and material, and the set `bore_NAME` of the nodes of its bore. Nodes and
    /// elements are numbered from `first` on.
    ///
    /// # Errors
    /// [`CalculixError::NoSuchElement`].
    pub fn text(&self, name: &str, [first_node, first_element]: [usize; 2]) -> Result<String, CalculixError> {
        let Body { gear, material, angle, centre } = *self;
        let (mesh, mut text) = (gear.mesh(), String::new());
        let t = &mut text;
        let (sin, cos) = angle.sin_cos();
        line(t, format_args!("*NODE, NSET=all_{name}"));
        for (n, [x, y, z]) in mesh.nodes.iter().enumerate() {
            // CalculiX reads at most 20 characters a number.
            let (px, py, pz) = (centre[0] + cos * x - sin * y, sin * x + cos * y, centre[1] + z);
            line(t, format_args!("{}, {px:.12e}, {py:.12e}, {pz:.12e}", first_node + n));
        }
        let mut number = first_element;
        for block in &mesh.blocks {
            line(t, format_args!("*ELEMENT, TYPE={}, ELSET={name}", element_type(block.kind)?));
            for nodes in block.elements() {
                let ordered = node_order(block.kind).iter().map(|&l| first_node + nodes[l] as usize);
                numbers(t, std::iter::once(number).chain(ordered));
                number += 1;
            }
        }
        line(t, format_args!("*MATERIAL, NAME=material_{name}"));
        line(t, format_args!("*ELASTIC\n{:.12e}, {:.12e}", material.young_mpa(), material.poisson()));
        line(t, format_args!("*DENSITY\n{:.12e}", material.density_t_per_mm3()));
        line(t, format_args!("*SOLID SECTION, ELSET={name}, MATERIAL=material_{name}"));
        line(t, format_args!("*NSET, NSET=bore_{name}"));
        for &n in gear.bore_nodes() {
            line(t, format_args!("{},", first_node + n as usize));
        }
        Ok(text)
    }

    /// Card of the surface of one flank, for a gear whose elements are numbered from `first_element` on.
    ///
    /// # Errors
    /// [`CalculixError::MissingFlank`].
    pub fn flank_text(
        &self,
        surface: &str,
        name: &'static str,
        (tooth, side): (u32, Side),
        first_element: usize,
    ) -> Result<String, CalculixError> {
        let mesh = self.gear.mesh();
        let numbering = Numbering::new(mesh);
        let missing = || CalculixError::MissingFlank { gear: name, side: side.name(), tooth };
        let mut text = format!("*SURFACE, NAME={surface}, TYPE=ELEMENT\n");
        for face in self.gear.flank(tooth, side).ok_or_else(missing)? {
            let (element, number) = numbering.face(mesh, face).ok_or_else(missing)?;
            line(&mut text, format_args!("{}, S{number}", first_element + element));
        }
        Ok(text)
    }
}

fn line(t: &mut String, what: std::fmt::Arguments<'_>) {
    // Writing to a String cannot fail.
    let _ = t.write_fmt(what);
    t.push('\n');
}

/// Numbers over as many lines as they need; a comma at the end means that it goes on.
fn numbers(t: &mut String, numbers: impl Iterator<Item = usize>) {
    let words: Vec<String> = numbers.map(|n| n.to_string()).collect();
    let lines: Vec<String> = words.chunks(A_LINE).map(|chunk| chunk.join(", ")).collect();
    line(t, format_args!("{}", lines.join(",\n")));
}
