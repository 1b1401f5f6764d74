//! Tables that contact computes from a gear's compliance; they are stored with the gear for later runs.

use std::{fmt, sync::Arc};

/// Name of a table: equal for equal content, in practice different for different content.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct TableKey(pub(crate) [u8; 32]);

impl TableKey {
    /// Key of everything that a table depends on, in addition to the gear's own matrices.
    pub fn of(content: &[u8]) -> Self {
        Self(*blake3::hash(content).as_bytes())
    }
}

impl fmt::Display for TableKey {
    /// 64 hexadecimal digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// A table and its error.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptTable {
    /// Relative error of values read from the table.
    pub error: f64,
    /// Part of the table for displacements along the normals; contact without friction reads only this part.
    pub normal: Arc<Vec<f64>>,
    /// The other part of the table, if it is in memory; it may also be in a separate file.
    pub others: Option<Arc<Vec<f64>>>,
}
