//! ale-gear from Python.
//!
//! | file | what is in it |
//! |---|---|
//! | `scene` | a checked scene, from tables, text, a file, REXS |
//! | `values` | Python's values as those of a scene |
//! | `mesh` | meshes from arrays and to arrays |
//! | `pair` | a pair with its reduction held, and what it can be asked |
//! | `analyses` | a scene in time, along a key, over many cases, at its optimum: into a folder |
//! | `gearbox` | shafts, bearings and several meshes |
//! | `at_rest` | a scene at rest: held in memory, written when it is asked for |
//! | `result` | what a run gives: columns, headline numbers, files |
//! | `remark` | what a result says beside its numbers |
//! | `views` | arrays of the program as arrays of NumPy, without a copy |
//! | `work` | runs without the interpreter's lock, with progress and Ctrl-C |
//! | `error` | errors as exceptions with place, key and hint |
//! | `words` | what is varied and what is wanted |
//! | `arguments` | arguments of Python, each with its own complaint |

mod analyses;
mod arguments;
mod at_rest;
mod error;
mod gearbox;
mod mesh;
mod pair;
mod remark;
mod result;
mod scene;
mod values;
mod views;
mod words;
mod work;

use pyo3::prelude::*;

/// The compiled part of `ale_gear`; its names are those of the package.
#[pymodule(gil_used = false)]
mod _native {
    #[pymodule_export]
    use crate::{gearbox::Gearbox, mesh::Mesh, pair::Pair, remark::Remark, result::Result, scene::Scene};

    /// Version of the program.
    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "the name that Python has for it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
