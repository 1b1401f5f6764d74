//! What tests of several crates share: gear pairs from numbers, their models at rest and in motion, one small document of every
//! kind, random numbers, and a record of tests that need programs of others.
//!
//! A test that cannot be done on this machine has neither passed nor failed. A [`Suite`] shows it as *ignored*, with
//! the reason, in the result line of its own test program, and keeps a record. Examples in documentation are tested
//! after all else, package by package in the order of the alphabet, and this package is the last. So at the end of
//! `cargo test --workspace` every test that was left out stands once more, as an ignored example of a module named
//! after the reason, and is counted in the very last result line. [`summary`] says the same in words.
//!
//! ```
//! let nothing = std::env::temp_dir().join("a folder that is not there");
//! assert_eq!(testing::summary(&nothing), "tests that need programs of others: none has been run yet\n");
//! ```

mod case;
mod cases;
mod holes;
pub mod moving;
mod programs;
mod random;
mod record;
pub mod small_scenes;
mod suite;
pub mod waves;

pub use case::{
    Case, default_data, default_pair, generated, mean_and_peak_to_peak, meshes_folder, modified, nrel_planet_in_ring,
    of_order, of_widths, planet_in_ring, quadratic, scaled, structured,
};
pub use cases::{ALL_CASES, cases};
pub use holes::with_holes;
pub use programs::{browser, program, python};
pub use random::Random;
pub use record::{FOLDER, Record, folder, note, summary};
pub use suite::Suite;

/// Read by rustdoc when it looks for examples, which is after all tests that write it.
#[cfg(doctest)]
pub mod left_out {
    include!(concat!(env!("ALE_GEAR_RECORDS"), "/examples.rs"));
}
