//! Tests that need programs of others: which of them were left out?
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

mod programs;
mod random;
mod record;
mod suite;

pub use programs::{browser, program, python};
pub use random::Random;
pub use record::{FOLDER, Record, folder, note, summary};
pub use suite::Suite;

/// Read by rustdoc when it looks for examples, which is after all tests that write it.
#[cfg(doctest)]
pub mod left_out {
    include!(concat!(env!("ALE_GEAR_RECORDS"), "/examples.rs"));
}
