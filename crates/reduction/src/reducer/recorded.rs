//! Makes gears from records, and records from gears.

use std::sync::OnceLock;

use fem::Material;
use mesh::MeshedGear;

use super::{
    GearReducer, ReductionOptions, ReductionWatch, ReductionWay,
    asked::Asked,
    condense::{Condensed, sectors},
};
use crate::{KeptTable, ReductionError, ReductionRecord, TableKey, load::Coordinates};

/// Tables that are kept of a gear: a plan of cases may ask for any number.
const MOST_TABLES: usize = 2;
/// Values of a table that is kept: 32 MB.
const MOST_VALUES: usize = 4 << 20;

impl GearReducer {
    /// Makes a gear from a record. Mesh, material and options must be those from which the record was made
    /// ([`crate::record_key`] ensures this). If `record` is for another first window, the gear is reduced again.
    ///
    /// # Errors
    /// Those of [`GearReducer::new`].
    pub fn from_record(
        gear: MeshedGear,
        material: Material,
        options: ReductionOptions,
        record: ReductionRecord,
    ) -> Result<Self, ReductionError> {
        let ReductionRecord { summary, lowest_hz, window: base, halves, tables } = record;
        let first = options.first % gear.tooth_count().max(1);
        let general = summary.way == ReductionWay::General;
        if base.teeth.first() != Some(&first) {
            return Self::watched(gear, material, options, general, ReductionWatch::IDLE);
        }
        let seen = match (gear.is_periodic_sector(), general) {
            (false, _) => None,
            (true, true) => Some(gear.clone().whole()?),
            (true, false) if summary.way == ReductionWay::SectorAndBolts => Some(gear.clone().whole()?),
            (true, false) => sectors(&gear, None, &options)?.and_then(|(_, copies)| copies),
        };
        let (gear, given) = match seen {
            Some(seen) => (seen, Some(gear)),
            None => (gear, None),
        };
        let condensed = Condensed { gear, coordinates: Coordinates::FlankNodes, summary, base };
        let asked = Asked::recorded(halves, lowest_hz, tables);
        Ok(Self { given, asked, ..Self::assembled(material, options, condensed, OnceLock::new()) })
    }

    /// What a later run needs of this gear: the first window, half teeth, tables and lowest frequency that have been
    /// requested so far. Further windows, and the parts of tables that are not for the normals, are in a
    /// [`PartStore`](crate::PartStore). `None` if an existing record is complete, and for a gear reduced to grids or by
    /// its layers.
    pub fn record(&self) -> Option<ReductionRecord> {
        let record = || self.asked.record(self.summary, &self.base);
        (self.coordinates.are_nodes() && self.stack().is_none()).then(record).flatten()
    }

    /// A stored table of a window of the gear.
    pub fn kept_table(&self, key: &TableKey) -> Option<KeptTable> {
        self.asked.tables().get(key).cloned()
    }

    /// Stores a table of a window of the gear. `key` stands for everything else that the table depends on. Large
    /// tables, and more than two tables, are not stored.
    pub fn keep_table(&self, key: TableKey, table: &KeptTable) {
        let mut tables = self.asked.tables();
        let values = table.normal.len() + table.others.as_ref().map_or(0, |others| others.len());
        if tables.len() < MOST_TABLES && values <= MOST_VALUES {
            tables.insert(key, table.clone());
        }
    }

    /// Whether the gear came from a record.
    pub fn is_from_record(&self) -> bool {
        self.asked.is_from_record()
    }
}
