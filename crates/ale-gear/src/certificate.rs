//! What the command ends with where a result does not hold.

use analysis::Solved;
use report::Cost;

use crate::error::CommandError;

/// The closing table of a result whose files stand, and whether it holds: status 1 where it does not.
pub(crate) type Closing = (String, Result<(), CommandError>);

/// A result whose files stand, and whether it holds.
#[derive(Debug)]
pub(crate) struct Written {
    /// The closing table.
    pub table: String,
    /// Status 1 where its certificate does not hold.
    pub verdict: Result<(), CommandError>,
    /// The answer itself.
    pub solved: Solved,
    /// Cost of the run, as in `summary.json`.
    pub cost: Cost,
}
