//! Key of 32 bytes for everything that the numbers of a record depend on.

use std::fmt;

use blake3::Hasher;
use fem::Material;
use geometry::{Gear, Side};
use mesh::{BoreCoupling, MeshedGear};
use pulp::bytemuck;

use super::{MAGIC, RECORD_VERSION};
use crate::ReductionOptions;

/// Name of a record: equal for equal meshes, materials, gears and options, in practice different for any others.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RecordKey(pub(super) [u8; 32]);

impl RecordKey {
    /// The key in a file, whatever gear it belongs to; `None` if the file is not a record.
    pub fn in_file(bytes: &[u8]) -> Option<Self> {
        let header = bytes.strip_prefix(&MAGIC)?;
        Some(Self(*header.get(4..)?.first_chunk()?))
    }
}

impl fmt::Display for RecordKey {
    /// 64 hexadecimal digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// BLAKE3 of everything that a reduced gear depends on: version of the format and of the program, nodes, elements, bore
/// and flanks of the mesh, material, nominal geometry (it positions the half teeth), kept flanks. `way` names the
/// method of reduction, because the results of the two methods are equal only to round-off.
///
/// Micro-geometry and torque are not included, because the reduced gear does not depend on them.
pub fn record_key(
    gear: &MeshedGear,
    geometry: &Gear,
    material: &Material,
    options: &ReductionOptions,
    way: &str,
) -> RecordKey {
    let mut hasher = Hasher::new();
    let mut words = |text: &str| {
        number(&mut hasher, text.len() as u64);
        hasher.update(text.as_bytes());
    };
    words(env!("CARGO_PKG_VERSION"));
    words(way);
    // Debug prints every number with as many digits as it takes to read the same one back.
    words(&format!("{material:?} {options:?} {:?}", geometry.data()));
    number(&mut hasher, u64::from(RECORD_VERSION));
    mesh(&mut hasher, gear);
    RecordKey(*hasher.finalize().as_bytes())
}

fn mesh(hasher: &mut Hasher, gear: &MeshedGear) {
    let mesh = gear.mesh();
    number(hasher, u64::from(gear.tooth_count()));
    number(hasher, u64::from(gear.is_whole_gear()));
    number(hasher, u64::from(gear.is_periodic_sector()));
    // Gears whose teeth are numbered counter-clockwise are what records knew before there were rings.
    if gear.numbering_sign() < 0.0 {
        hasher.update(b"clockwise");
    }
    number(hasher, mesh.nodes.len() as u64);
    update(hasher, mesh.nodes.as_flattened(), |x| x.to_le_bytes());
    for block in &mesh.blocks {
        number(hasher, block.kind.gmsh_type() as u64);
        numbers(hasher, &block.connectivity);
    }
    numbers(hasher, gear.bore_nodes());
    // A rigid bore is what records knew before there was another.
    if gear.bore_coupling() != BoreCoupling::Kinematic {
        hasher.update(gear.bore_coupling().name().as_bytes());
        // Means and springs come of the faces, which need not be those that their nodes have.
        gear.bore().faces.iter().for_each(|face| numbers(hasher, face.nodes()));
        if let Some(springs) = gear.bore_coupling().foundation() {
            hasher.update(format!("{springs:?}").as_bytes());
        }
    }
    for cut in gear.cuts().into_iter().flatten() {
        numbers(hasher, &cut.nodes());
    }
    for tooth in gear.teeth() {
        for side in [Side::Left, Side::Right] {
            for face in gear.flank(tooth, side).unwrap_or_default() {
                number(hasher, u64::from(tooth) << 1 | u64::from(side == Side::Right));
                numbers(hasher, face.nodes());
            }
        }
    }
}

fn number(hasher: &mut Hasher, value: u64) {
    hasher.update(&value.to_le_bytes());
}

/// A list with its length before it, so that two lists never run into each other.
fn numbers(hasher: &mut Hasher, values: &[u32]) {
    number(hasher, values.len() as u64);
    update(hasher, values, |v| v.to_le_bytes());
}

/// Bytes of values, little-endian.
fn update<T: bytemuck::NoUninit, const N: usize>(hasher: &mut Hasher, values: &[T], bytes: impl Fn(T) -> [u8; N]) {
    if cfg!(target_endian = "little") {
        hasher.update(bytemuck::cast_slice(values));
    } else {
        values.iter().for_each(|value| {
            hasher.update(&bytes(*value));
        });
    }
}
