//! Writes a record as bytes.

use faer::Mat;
use geometry::Side;
use pulp::bytemuck;

use super::{HEADER, MAGIC, RECORD_VERSION, RecordKey, ReductionRecord};
use crate::{KeptTable, ReductionWay, cyclic::ToothBlocks, reducer::Summary};

impl ReductionRecord {
    /// The content of a file; the same record gives the same bytes.
    pub fn to_bytes(&self, key: &RecordKey) -> Vec<u8> {
        sealed(MAGIC, key, self.size(), |bytes| self.payload(bytes))
    }

    /// About the length of the payload.
    fn size(&self) -> usize {
        let window = match self.window.blocks() {
            None => 8 * self.window.coordinates().pow(2),
            Some(teeth) => teeth.blocks.iter().map(|block| 8 * block.nrows() * block.ncols() + 64).sum(),
        };
        let window = window + 16 * self.window.nodes.len();
        let halves = self.halves.iter().map(|(_, h)| 8 * h.compliance.ncols().pow(2) + 4096);
        let tables = self.tables.iter().map(|(_, table)| 8 * table.normal.len() + 64);
        window + halves.sum::<usize>() + tables.sum::<usize>() + 4096
    }

    fn payload(&self, bytes: &mut Vec<u8>) {
        let Summary { way, cyclic, free_count } = self.summary;
        bytes.push(match way {
            ReductionWay::General => 0,
            ReductionWay::CyclicSector => 1,
            ReductionWay::SectorAndBolts => 2,
        });
        bytes.push(u8::from(cyclic));
        bytes.extend((free_count as u64).to_le_bytes());
        bytes.extend(self.lowest_hz.unwrap_or(f64::NAN).to_le_bytes());
        let window = &self.window;
        list(bytes, &window.teeth);
        put(bytes, window.sides.len());
        bytes.extend(window.sides.iter().map(|s| side_byte(*s)));
        list(bytes, &window.nodes);
        match window.blocks() {
            None => {
                bytes.push(0);
                matrix(bytes, window.compliance());
            }
            Some(ToothBlocks { blocks, places, angles }) => {
                bytes.push(1);
                numbers(bytes, angles);
                list(bytes, places.as_flattened());
                blocks.iter().for_each(|block| matrix(bytes, block));
            }
        }
        put(bytes, self.halves.len());
        for ((tooth, side), half) in &self.halves {
            bytes.extend(tooth.to_le_bytes());
            bytes.push(side_byte(*side));
            list(bytes, &half.nodes);
            matrix(bytes, &half.compliance);
            bytes.extend(half.overshoot.to_le_bytes());
            let (lists, values) = half.layer.parts();
            for list in lists {
                numbers(bytes, list);
            }
            reals(bytes, &values);
        }
        put(bytes, self.tables.len());
        for (key, KeptTable { error, normal, .. }) in &self.tables {
            bytes.extend(key.0);
            bytes.extend(error.to_le_bytes());
            numbers(bytes, normal);
        }
    }
}

/// A file of a kind with its payload, about `size` long.
pub(super) fn sealed(magic: [u8; 16], key: &RecordKey, size: usize, payload: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADER + size);
    bytes.extend(magic);
    bytes.extend(RECORD_VERSION.to_le_bytes());
    bytes.extend(key.0);
    bytes.extend([0; 8 + 32]); // length and checksum, known below
    payload(&mut bytes);
    let length = (bytes.len() - HEADER) as u64;
    bytes[HEADER - 40..HEADER - 32].copy_from_slice(&length.to_le_bytes());
    let checksum = checksum(&bytes);
    bytes[HEADER - 32..HEADER].copy_from_slice(&checksum);
    bytes
}

/// BLAKE3 of a file's bytes without those of the checksum itself.
fn checksum(bytes: &[u8]) -> [u8; 32] {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&bytes[..HEADER - 32]);
    hasher.update(&bytes[HEADER..]);
    *hasher.finalize().as_bytes()
}

fn side_byte(side: Side) -> u8 {
    u8::from(side == Side::Right)
}

/// A count; nothing here comes near 2^32 entries, which would be 32 GB a list.
fn put(bytes: &mut Vec<u8>, count: usize) {
    bytes.extend((count as u32).to_le_bytes());
}

pub(super) fn list(bytes: &mut Vec<u8>, values: &[u32]) {
    put(bytes, values.len());
    values.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
}

/// Numbers with their count before them.
pub(super) fn numbers(bytes: &mut Vec<u8>, values: &[f64]) {
    put(bytes, values.len());
    reals(bytes, values);
}

fn reals(bytes: &mut Vec<u8>, values: &[f64]) {
    if cfg!(target_endian = "little") {
        bytes.extend_from_slice(bytemuck::cast_slice(values));
    } else {
        values.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
    }
}

/// Rows, columns, then column by column.
pub(super) fn matrix(bytes: &mut Vec<u8>, m: &Mat<f64>) {
    put(bytes, m.nrows());
    put(bytes, m.ncols());
    for j in 0..m.ncols() {
        reals(bytes, m.col_as_slice(j));
    }
}
