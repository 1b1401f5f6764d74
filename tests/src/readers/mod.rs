//! Every reader of files, each behind one function that takes bytes: what fuzzing and the replay of its corpora share.
//!
//! A reader may refuse whatever it is given; it must not panic, hang or take memory without bound. So these functions
//! return nothing: they go on from what was read as far as a command would before it begins to compute.
//!
//! | file | readers |
//! |---|---|
//! | `meshes` | `.msh` of Gmsh, and the gear in it |
//! | `scenes` | scenes, words of `--set`, studies, gearbox files, REXS |
//! | `measured` | topographies, pitch errors, curve files of measuring machines (MKA), gear data exchange (GDE) |
//! | `kept` | records of reduced gears, checkpoints, rows, result folders, sources of pages |
//! | `limited` | an allocator that ends the program at too much memory |

mod kept;
pub mod limited;
mod measured;
mod meshes;
mod scenes;

pub use kept::{checkpoint, page, record, results, rows, sealed_record};
pub use measured::{gde, mka, pitch_errors, topography};
pub use meshes::{gear_mesh, mesh};
pub use scenes::{gearbox, rexs, scene, setting, study};

/// A reader of bytes.
pub type Reader = fn(&[u8]);

/// All of them, by the name of their target and of the folder of their corpus.
pub const READERS: [(&str, Reader); 16] = [
    ("mesh", mesh),
    ("gear_mesh", gear_mesh),
    ("scene", scene),
    ("setting", setting),
    ("study", study),
    ("gearbox", gearbox),
    ("rexs", rexs),
    ("topography", topography),
    ("pitch_errors", pitch_errors),
    ("mka", mka),
    ("gde", gde),
    ("record", record),
    ("checkpoint", checkpoint),
    ("rows", rows),
    ("results", results),
    ("page", page),
];

/// The bytes before the first zero byte and those behind it: two files in one input.
fn halves(bytes: &[u8]) -> (&[u8], Option<&[u8]>) {
    match bytes.iter().position(|b| *b == 0) {
        Some(at) => (&bytes[..at], Some(&bytes[at + 1..])),
        None => (bytes, None),
    }
}
