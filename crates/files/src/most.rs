//! What a file of each kind may have at the most, bytes: far more than any of use, far less than memory.

/// Scenes, studies, plans, gearboxes, REXS, a page that tables go into; the largest known REXS files have 5 MB.
pub const DOCUMENT: u64 = 64 << 20;
/// Topographies and pitch deviations: a grid of 2000 by 2000 points has 50 MB.
pub const DATA: u64 = 512 << 20;
/// Meshes: ten million nodes have 1 GB.
pub const MESH: u64 = 8 << 30;
/// `summary.json`, with the inputs of the run in it.
pub const SUMMARY: u64 = 64 << 20;
/// Rows of a result, cases of a plan: a million rows of a hundred columns have 1 GB.
pub const ROWS: u64 = 4 << 30;
/// State of a motion; source of a report.
pub const STATE: u64 = 1 << 30;
/// Reduced gears and maps; as much as the whole cache keeps.
pub const RECORD: u64 = 4 << 30;
