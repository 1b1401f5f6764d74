//! Gear data from REXS files (Reusable Engineering EXchange Standard, rexs.info, versions 1.0 to 1.4 and later; XML),
//! and pairs written as REXS files.
//!
//! | module | what it does |
//! |---|---|
//! | `file` | the text of a file; packed files and JSON are named |
//! | `document` | components, relations, load cases and attributes with units, and which of them were taken |
//! | `left` | what the file has beside that, in words |
//! | `train` | shafts, stages and loads: speeds, and the torque of a stage |
//! | `planetary` | members of a planetary stage |
//! | `pair` | a stage as a scene |
//! | `gear` | what a gear and its flanks state |
//! | `shaft` | sections and steel of a shaft |
//! | `frame` | where shafts and parts stand |
//! | `bearing` | bearings as tables of a gearbox file |
//! | `gearbox` | a whole file as a gearbox file with the scenes of its pairs |
//! | `writer` | its tables |
//! | `out` | a pair as a REXS file |
//! | `error` | what is refused |

mod bearing;
mod document;
mod error;
mod file;
mod frame;
mod gear;
mod gearbox;
mod left;
mod out;
mod pair;
mod planetary;
mod shaft;
mod train;
mod writer;

pub use error::RexsError;
pub use file::read_rexs;
pub use gearbox::{RexsGearbox, read_gearbox};
pub use out::rexs_of;
pub use pair::{RexsPair, read_pair};
pub use shaft::{RexsShaft, read_shaft};
