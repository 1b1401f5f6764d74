//! Tables that contact makes of a gear's compliance, kept with the gear from run to run.

use std::{fmt, sync::Arc};

/// Names a table: equal for equal content, in practice different for any other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct TableKey(pub(crate) [u8; 32]);

impl TableKey {
    /// Key of all that a table depends on beside the gear's own matrices.
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

/// A table and how far it is off.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptTable {
    /// Error of what is read from it, relative.
    pub error: f64,
    /// Its part along the normals, which contact without friction reads alone.
    pub normal: Arc<Vec<f64>>,
    /// The rest, where it is at hand; else it may be in a file of its own.
    pub others: Option<Arc<Vec<f64>>>,
}
