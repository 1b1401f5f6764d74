//! Tests that need programs of others: which of them were left out?
//!
//! A test that cannot be done on this machine has neither passed nor failed. A [`Suite`] shows it as *ignored*, with the reason, in the result line of its
//! own test program, and keeps a record; [`summary`] says at the end of all tests what the records hold. Tests of doc examples come last in
//! `cargo test --workspace`, and of these the package whose name is the last in the alphabet: this one. So the example below is the very last test;
//! it writes past the harness, which would keep for itself what a passed test says.
//!
//! ```
//! testing::tell();
//! ```

mod programs;
mod record;
mod suite;

pub use programs::{browser, program, python};
pub use record::{FOLDER, Record, folder, note, summary, tell};
pub use suite::Suite;
