//! What the command ends with where a result does not hold.

use crate::error::CommandError;

/// A result whose files stand, and whether it holds.
#[derive(Debug)]
pub(crate) struct Written {
    /// The closing table.
    pub table: String,
    /// Status 1 where its certificate does not hold.
    pub verdict: Result<(), CommandError>,
}

impl Written {
    /// Of a closing table and what the certificate says.
    pub fn of((table, verdict): report::Told) -> Self {
        Self { table, verdict: verdict.map_err(CommandError::from) }
    }
}
