//! A reduced gear without its factor: what a later run needs, and its file format.
#![doc = include_str!("format.md")]

mod columns;
mod error;
mod factor;
mod key;
mod read;
mod table;
mod write;

use std::sync::Arc;

use geometry::Side;

use crate::{KeptTable, LocalCompliance, ReducedGear, TableKey, reducer::Summary};

pub use error::RecordError;
pub use factor::{factor_bytes, read_factor};
pub use key::{RecordKey, record_key};
pub use table::{read_table, table_bytes};

/// Version of the file format, of the meaning of its numbers and of the code that computes them. The version is part of
/// every key, and files of another version are not read. The test `a_record_of_another_code_has_another_version`
/// detects when it must be raised.
pub const RECORD_VERSION: u32 = 8;

/// First bytes of a file.
const MAGIC: [u8; 16] = *b"ale-gear reduced";
/// First bytes of a file of columns of a tooth.
const COLUMNS: [u8; 16] = *b"ale-gear columns";
/// First bytes of a file of a table's other directions.
const TABLE: [u8; 16] = *b"ale-gear table  ";
/// First bytes of a file of the factor of a sector.
const FACTOR: [u8; 16] = *b"ale-gear factor ";
/// Bytes before the payload: magic, version, key, length of the payload, checksum.
const HEADER: usize = 16 + 4 + 32 + 8 + 32;

/// What contact needs of a reduced gear: the matrices of its first window, half teeth, tables computed from them, and
/// its lowest elastic frequency. The factor is not included. A reducer made from a record asks a
/// [`PartStore`](crate::PartStore) for the factor, or computes it again, when displacement fields or stress modes are
/// needed.
///
/// File format, little-endian; described in `format.md` in the folder of this source file:
///
/// | bytes | what |
/// |---|---|
/// | 16 | `ale-gear reduced` |
/// | 4 | [`RECORD_VERSION`] |
/// | 32 | [`RecordKey`]: BLAKE3 of everything that the numbers depend on |
/// | 8 | length of the payload |
/// | 32 | BLAKE3 of all bytes above and the payload |
/// | .. | payload: how it was condensed; lowest frequency; first window; half teeth; tables |
#[derive(Debug, Clone)]
pub struct ReductionRecord {
    /// How it was condensed.
    pub(crate) summary: Summary,
    /// Lowest frequency with the bore held and the flanks free, Hz, if it was asked for.
    pub(crate) lowest_hz: Option<f64>,
    /// The first window.
    pub(crate) window: Arc<ReducedGear>,
    /// Half teeth by tooth and side.
    pub(crate) halves: Vec<((u32, Side), Arc<LocalCompliance>)>,
    /// Tables that contact made of the first window.
    pub(crate) tables: Vec<(TableKey, KeptTable)>,
}

impl ReductionRecord {
    /// Tables that contact has computed from the gear, by key.
    pub fn tables(&self) -> &[(TableKey, KeptTable)] {
        &self.tables
    }
}
