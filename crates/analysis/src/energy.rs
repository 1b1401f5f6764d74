//! The ledger of a motion, row by row.

use integrate::Ledger;

/// The ledger at a time.
#[derive(Debug, Clone, Copy)]
pub struct EnergyRecord {
    /// s.
    pub time: f64,
    /// Work and energy since the start, N mm = mJ.
    pub ledger: Ledger,
}
